//! What surfaces do to light: `bsdf` and `ref`.

use photonlab_photometry::Spectrum;

use crate::Bsdf;

use super::dielectric::{dielectric, plastic, thin};
use super::element::Element;
use super::error::SceneError;
use super::metal::conductor;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;

/// The tags that may stand where a surface is described.
pub(super) const TAGS: [&str; 2] = ["bsdf", "ref"];

/// Reads a `bsdf`, or finds the one that a `ref` names.
pub(super) fn bsdf<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    if element.tag.name == "ref" {
        return builder.follow(element, &["bsdf"], bsdf);
    }
    // A `ref` before it may have read it.
    let id = element.attribute("id");
    if let Some(known) = id.and_then(|id| builder.bsdfs.get(id)) {
        return Ok(known.clone());
    }
    let object = Object::open(element)?;
    let bsdf = match object.plugin {
        "diffuse" => diffuse(object),
        "dielectric" => dielectric(object, false),
        "roughdielectric" => dielectric(object, true),
        "thindielectric" => thin(object),
        "plastic" => plastic(object),
        "conductor" => conductor(object, false),
        "roughconductor" => conductor(object, true),
        "diffusetransmitter" => transmitter(object),
        "mask" => mask(object, builder),
        "null" => null(object),
        "twosided" => twosided(object, builder),
        _ => Err(plugins::refuse(&object)),
    }?;
    if let Some(id) = id {
        builder.bsdfs.insert(id, bsdf.clone());
    }
    Ok(bsdf)
}

fn diffuse(mut object: Object) -> Result<Bsdf, SceneError> {
    let reflectance = object.colour("reflectance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(0.5));
    object.close(&[])?;
    Ok(Bsdf::Diffuse { reflectance })
}

/// The extension `diffusetransmitter`: Mitsuba 3 has no such plugin.
fn transmitter(mut object: Object) -> Result<Bsdf, SceneError> {
    let reflectance = object.colour("reflectance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(0.5));
    let transmittance = object.colour("transmittance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(0.5));
    let sum = reflectance.max_of_sum(&transmittance);
    if sum > 1.0 + 1e-12 {
        let what = format!("reflectance and transmittance add up to {sum}");
        return Err(object.element.error(what, "lower one of them: a surface hands on at most what it receives"));
    }
    object.close(&[])?;
    Ok(Bsdf::Transmitter { reflectance, transmittance })
}

fn null(object: Object) -> Result<Bsdf, SceneError> {
    object.close(&[])?;
    Ok(Bsdf::Null)
}

fn mask<'e>(mut object: Object<'e>, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    let opacity = opacity(&mut object)?;
    let child = object.single(&TAGS)?;
    let element = object.element;
    object.close(&[])?;
    let child = child.ok_or_else(|| element.error("mask holds no bsdf", "put one into it"))?;
    Ok(match bsdf(child, builder)? {
        Bsdf::Mask { opacity: inner, surface } => Bsdf::Mask { opacity: opacity * inner, surface },
        Bsdf::Null => Bsdf::Null,
        surface => Bsdf::Mask { opacity, surface: Box::new(surface) },
    })
}

/// A share that is the same for all colours.
fn opacity(object: &mut Object) -> Result<f64, SceneError> {
    match object.colour("opacity", Range::SHARE)? {
        None => Ok(0.5),
        Some(Spectrum::Uniform(share)) => Ok(share),
        Some(Spectrum::Rgb([red, green, blue])) if red == green && green == blue => Ok(red),
        Some(_) => Err(object.element.error("an opacity that differs by colour", "give one number")),
    }
}

fn twosided<'e>(mut object: Object<'e>, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    let children = object.objects(&TAGS);
    let element = object.element;
    object.close(&[])?;
    let sides = children.iter().map(|child| one_side(child, builder)).collect::<Result<Vec<Bsdf>, SceneError>>()?;
    match &sides[..] {
        [both] => Ok(Bsdf::TwoSided { front: Box::new(both.clone()), back: Box::new(both.clone()) }),
        [front, back] => Ok(Bsdf::TwoSided { front: Box::new(front.clone()), back: Box::new(back.clone()) }),
        [] => Err(element.error("twosided holds no bsdf", "put one or two into it")),
        _ => Err(children[2].error("twosided holds more than two bsdfs", "keep one or two")),
    }
}

/// The surface that one side of a `twosided` shows: of another `twosided`, its front.
fn one_side<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<Bsdf, SceneError> {
    match bsdf(element, builder)? {
        Bsdf::TwoSided { front, .. } => Ok(*front),
        passed if passed.joins_its_sides() => {
            Err(element.error("a surface that light passes cannot be two-sided", "use it without twosided"))
        }
        opaque => Ok(opaque),
    }
}
