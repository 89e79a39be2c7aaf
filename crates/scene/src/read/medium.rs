//! Participating media: `medium`, and where they are.

use photonlab_photometry::Spectrum;

use crate::{Boundary, Medium, Phase};

use super::element::Element;
use super::error::SceneError;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;

/// Extinction where the file does not say, and albedo, as in Mitsuba.
const SIGMA_T: f64 = 1.0;
const ALBEDO: f64 = 0.75;

/// The media on both sides of a shape; `None` if it parts none.
pub(super) fn boundary<'e>(object: &mut Object<'e>, builder: &mut Builder<'e>) -> Result<Option<Boundary>, SceneError> {
    let interior = side(object, "interior", builder)?;
    let exterior = side(object, "exterior", builder)?;
    Ok((interior.is_some() || exterior.is_some()).then_some(Boundary { interior, exterior }))
}

/// The medium in which a lamp or a sensor stands.
pub(super) fn surrounding<'e>(object: &mut Object<'e>, builder: &mut Builder<'e>) -> Result<Option<u32>, SceneError> {
    side(object, "medium", builder)
}

fn side<'e>(object: &mut Object<'e>, name: &'static str, builder: &mut Builder<'e>) -> Result<Option<u32>, SceneError> {
    object.take(name, &["medium", "ref"])?.map(|element| medium(element, builder)).transpose()
}

/// Reads a medium, or finds the one that a `ref` names.
pub(super) fn medium<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<u32, SceneError> {
    if element.tag.name == "ref" {
        return builder.follow(element, &["medium"], medium);
    }
    // A `ref` before it may have read it.
    let id = element.attribute("id");
    if let Some(&known) = id.and_then(|id| builder.media.get(id)) {
        return Ok(known);
    }
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let scale = object.float("scale", Range::EXTINCTION)?.unwrap_or(1.0);
    let sigma_t = object.colour("sigma_t", Range::EXTINCTION)?.unwrap_or(Spectrum::Uniform(SIGMA_T)).scaled(scale);
    let albedo = object.colour("albedo", Range::SHARE)?.unwrap_or(Spectrum::Uniform(ALBEDO));
    object.boolean("sample_emitters")?;
    object.boolean("has_spectral_extinction")?;
    let phase = object.single(&["phase"])?.map(phase).transpose()?.unwrap_or(Phase::Isotropic);
    object.close(&["volume"])?;
    let index = builder.scene.media.len();
    let name = builder.id(element, "medium", index)?;
    builder.scene.media.push(Medium { id: name, sigma_t, albedo, phase });
    if let Some(id) = id {
        builder.media.insert(id, index as u32);
    }
    Ok(index as u32)
}

fn phase(element: &Element) -> Result<Phase, SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let phase = match object.plugin {
        "hg" => match object.float("g", Range::ANISOTROPY)?.unwrap_or(0.8) {
            0.0 => Phase::Isotropic,
            g => Phase::HenyeyGreenstein(g),
        },
        _ => Phase::Isotropic,
    };
    object.close(&[])?;
    Ok(phase)
}
