//! Lamps from the files that makers publish: the extension `ies`.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DQuat, DVec3};
use photonlab_photometry::Spectrum;

use crate::luminaire::{IntensityTable, read_luminaire};
use crate::{Emitter, Pattern};

use super::element::Element;
use super::emitter::check_one_of;
use super::error::{Fault, SceneError};
use super::lumens::lumens;
use super::names::quote;
use super::number::Range;
use super::object::Object;
use super::picture::beside;
use super::scene::Builder;
use super::transform::{turn, unit};

/// Least luminous equivalent of a spectrum that is scaled to one.
const SMALLEST_LUMENS: f64 = 1e-12;

/// A far-field point source whose intensities stand in a file. `flux` (lm) replaces the file's; `tint` multiplies it, or, if it
/// is by wavelength, is the light's relative spectrum, with the lumens as they are. It is placed by `to_world`, or by `position` and by the `direction` in which its nadir looks, turned there the shortest way
/// (straight up: about its own y).
pub(super) fn luminaire(mut object: Object, id: String, builder: &mut Builder) -> Result<Emitter, SceneError> {
    let file = object.take("filename", &["string"])?;
    let given = object.vector("position", Range::COORDINATE)?;
    let along = object.vector("direction", Range::ANY)?;
    let placed = object.transform()?;
    check_one_of(&object, given, placed, "position")?;
    check_one_of(&object, along, placed, "direction")?;
    let flux = object.float("flux", Range::EMISSION)?;
    let mut tint = object.colour("tint", Range::EMISSION)?.unwrap_or(Spectrum::Uniform(1.0));
    if object.float("sampling_weight", Range::ANY)?.is_some() {
        builder.note("sampling_weight is for Mitsuba's own sampling and has no effect here");
    }
    let element = object.element;
    object.close(&[])?;
    let file = file.ok_or_else(|| element.error("ies has no filename", "name a luminaire file (.ies or .ldt)"))?;
    let to_world = match along {
        Some(along) => looking(unit(along).ok_or_else(|| {
            element.error("direction is zero", "give the direction in which its nadir looks, such as 0 0 -1")
        })?),
        None => turn(&placed.unwrap_or(DAffine3::IDENTITY), false).ok_or_else(|| {
            element.error("to_world of a luminaire shears or mirrors it", "use rotate, lookat and translate alone")
        })?,
    };
    let table = table(element, file.required("value"), builder)?;
    if tint.is_curve() {
        let lumens = lumens(&tint);
        if lumens < SMALLEST_LUMENS {
            return Err(
                element.error("tint has no visible light", "a luminaire is in lumens; give it a visible spectrum")
            );
        }
        tint = tint.scaled(lumens.recip());
    }
    let scale = flux.map_or(1.0, |flux| flux / table.flux()) * table.brightest();
    let intensity = tint.scaled(scale);
    let brightest = |fault: Fault| element.error(format!("its brightest intensity {}", fault.what), fault.mend);
    Range::EMISSION.check(intensity.max()).map_err(brightest)?;
    let position = given.or(placed.map(|transform| transform.translation)).unwrap_or(DVec3::ZERO);
    Ok(Emitter::Point { id, position, intensity, pattern: Pattern::Table { table, to_world }, medium: None })
}

/// The shortest turn of the nadir to a unit vector.
fn looking(along: DVec3) -> DMat3 {
    DMat3::from_quat(DQuat::from_rotation_arc(DVec3::NEG_Z, along))
}

/// The table of a file, read once; what the file says that is not used becomes a note.
fn table(element: &Element, name: &str, builder: &mut Builder) -> Result<Arc<IntensityTable>, SceneError> {
    let path = beside(element, name);
    if let Some(table) = builder.luminaires.get(&path) {
        return Ok(Arc::clone(table));
    }
    let luminaire = read_luminaire(&path).map_err(|error| {
        let place = error.line.map(|line| format!("line {line}: ")).unwrap_or_default();
        element.error(format!("{} {place}{}", quote(name), error.what), error.mend)
    })?;
    for note in luminaire.notes {
        builder.note(&format!("{} {note}", quote(name)));
    }
    let table = Arc::new(luminaire.table);
    builder.luminaires.insert(path, Arc::clone(&table));
    Ok(table)
}
