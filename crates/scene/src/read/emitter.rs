//! Lamps.

use glam::{DAffine3, DVec3};
use photonlab_photometry::Spectrum;

use crate::{Emitter, Pattern};

use super::element::Element;
use super::environment::environment;
use super::error::SceneError;
use super::luminaire::luminaire;
use super::medium::surrounding;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;
use super::transform::unit;

/// Reads a lamp that stands by itself and adds it to the scene.
pub(super) fn emitter<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<(), SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let medium = surrounding(&mut object, builder)?;
    let id = builder.id(element, "emitter", builder.scene.emitters.len())?;
    let emitter = match object.plugin {
        "point" => point(object, id, builder)?,
        "spot" => spot(object, id, builder)?,
        "directional" => directional(object, id, builder)?,
        "ies" => luminaire(object, id, builder)?,
        "constant" | "envmap" | "sky" => {
            if builder.scene.emitters.iter().any(|e| matches!(e, Emitter::Environment { .. })) {
                return Err(element.error("a second environment", "keep one of constant, envmap and sky"));
            }
            Emitter::Environment { id, light: environment(object, builder)?, portals: Vec::new() }
        }
        "portal" => {
            return Err(element.error("a portal outside a shape", "put it into a rectangle in the opening"));
        }
        _ => {
            return Err(element.error("an area lamp outside a shape", "put it into the shape that shines"));
        }
    };
    let emitter = match (emitter, medium) {
        (Emitter::Point { id, position, intensity, pattern, .. }, medium) => {
            Emitter::Point { id, position, intensity, pattern, medium }
        }
        (emitter, None) => emitter,
        (_, Some(_)) => {
            return Err(element.error("a lamp from infinity in a medium", "only lamps at a point stand in one"));
        }
    };
    builder.scene.emitters.push(emitter);
    Ok(())
}

/// The radiance of a lamp that stands inside a shape.
pub(super) fn area(element: &Element, builder: &mut Builder) -> Result<Spectrum, SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    if object.plugin != "area" {
        let what = format!("a {} lamp inside a shape", object.plugin);
        return Err(element.error(what, "put it beside the shape, or use an area lamp"));
    }
    let radiance = emission(&mut object, "radiance", builder)?;
    object.close(&[])?;
    Ok(radiance)
}

fn point(mut object: Object, id: String, builder: &mut Builder) -> Result<Emitter, SceneError> {
    let given = object.vector("position", Range::COORDINATE)?;
    let to_world = object.transform()?;
    check_one_of(&object, given, to_world, "position")?;
    let position = given.or(to_world.map(|transform| transform.translation)).unwrap_or(DVec3::ZERO);
    let intensity = emission(&mut object, "intensity", builder)?;
    let pattern = cosine_power(&mut object)?.unwrap_or(Pattern::Isotropic);
    object.close(&[])?;
    Ok(Emitter::Point { id, position, intensity, pattern, medium: None })
}

/// The extension of `point` by which its intensity is a power of the cosine to `direction`.
fn cosine_power(object: &mut Object) -> Result<Option<Pattern>, SceneError> {
    let exponent = object.float("exponent", Range::EXPONENT)?;
    let direction = object.vector("direction", Range::ANY)?;
    let Some(exponent) = exponent else {
        return match direction {
            Some(_) => Err(object.element.error("a direction without exponent", "give both, or neither")),
            None => Ok(None),
        };
    };
    let along = direction.unwrap_or(DVec3::Z);
    let axis = unit(along).ok_or_else(|| object.element.error("direction is zero", "give one such as 0 0 -1"))?;
    Ok(Some(Pattern::Cosine { axis, exponent }))
}

/// Mitsuba's spot shines along its own +z.
fn spot(mut object: Object, id: String, builder: &mut Builder) -> Result<Emitter, SceneError> {
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    let intensity = emission(&mut object, "intensity", builder)?;
    let cutoff = object.float("cutoff_angle", Range::CUTOFF)?.unwrap_or(20.0);
    let beam = object.float("beam_width", Range::CUTOFF)?.unwrap_or(0.75 * cutoff);
    // A beam wider than the cone is cut off by it, as in Mitsuba.
    let beam = beam.min(cutoff);
    object.close(&["texture"])?;
    let axis = to_world.matrix3.z_axis.normalize();
    let pattern = Pattern::Spot { axis, beam: beam.to_radians(), cutoff: cutoff.to_radians() };
    Ok(Emitter::Point { id, position: to_world.translation, intensity, pattern, medium: None })
}

fn directional(mut object: Object, id: String, builder: &mut Builder) -> Result<Emitter, SceneError> {
    let given = object.vector("direction", Range::ANY)?;
    let to_world = object.transform()?;
    check_one_of(&object, given, to_world, "direction")?;
    let along = given.or(to_world.map(|transform| transform.matrix3.z_axis)).unwrap_or(DVec3::Z);
    let direction =
        unit(along).ok_or_else(|| object.element.error("direction is zero", "give a direction such as 0 0 -1"))?;
    let irradiance = emission(&mut object, "irradiance", builder)?;
    object.close(&[])?;
    Ok(Emitter::Directional { id, direction, irradiance })
}

/// The emitted quantity, 1 if the file does not say, as in Mitsuba.
pub(super) fn emission(object: &mut Object, name: &'static str, builder: &mut Builder) -> Result<Spectrum, SceneError> {
    if object.float("sampling_weight", Range::ANY)?.is_some() {
        builder.note("sampling_weight is for Mitsuba's own sampling and has no effect here");
    }
    Ok(object.colour(name, Range::EMISSION)?.unwrap_or(Spectrum::Uniform(1.0)))
}

/// Checks that a vector and `to_world` do not both say the same.
pub(super) fn check_one_of(
    object: &Object,
    given: Option<DVec3>,
    to_world: Option<DAffine3>,
    name: &str,
) -> Result<(), SceneError> {
    if given.is_some() && to_world.is_some() {
        return Err(object.element.error(format!("both {name} and to_world are given"), "keep one of them"));
    }
    Ok(())
}
