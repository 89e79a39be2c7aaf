//! Light from infinity: `constant`, `envmap`, `sky`.

use glam::{DAffine3, DMat3, DVec3};
use photonlab_photometry::Spectrum;

use crate::{EnvironmentLight, Sky, SkyLaw, SkyMap};

use super::emitter::emission;
use super::error::SceneError;
use super::number::Range;
use super::object::Object;
use super::picture::picture;
use super::scene::Builder;
use super::transform::{turn, unit};

/// Reads the light of an environment.
pub(super) fn environment(object: Object, builder: &mut Builder) -> Result<EnvironmentLight, SceneError> {
    match object.plugin {
        "constant" => constant(object, builder),
        "envmap" => envmap(object, builder),
        _ => sky(object, builder),
    }
}

fn constant(mut object: Object, builder: &mut Builder) -> Result<EnvironmentLight, SceneError> {
    let radiance = emission(&mut object, "radiance", builder)?;
    object.close(&[])?;
    Ok(EnvironmentLight::Constant { radiance })
}

fn envmap(mut object: Object, builder: &mut Builder) -> Result<EnvironmentLight, SceneError> {
    let to_world = turned(&mut object, true)?;
    let scale = object.float("scale", Range::EMISSION)?.unwrap_or(1.0);
    if object.float("sampling_weight", Range::ANY)?.is_some() || object.boolean("mis_compensation")?.is_some() {
        builder.note("sampling_weight and mis_compensation are for Mitsuba's own sampling and have no effect here");
    }
    let file = object.take("filename", &["string"])?;
    let element = object.element;
    object.close(&["bitmap"])?;
    let file = file.ok_or_else(|| element.error("envmap has no filename", "name a picture (.exr)"))?;
    let (width, height, mut pixels) = picture(file)?;
    for value in pixels.iter_mut().flatten() {
        *value *= scale as f32;
    }
    Ok(EnvironmentLight::Map(SkyMap { width, height, pixels, to_world }))
}

/// The extension `sky`: a law of luminance over the half around local +z.
fn sky(mut object: Object, builder: &mut Builder) -> Result<EnvironmentLight, SceneError> {
    let zenith = rotation(&mut object)? * DVec3::Z;
    let law = match object.choice("distribution", &["uniform", "overcast", "general"])? {
        Some("uniform") => SkyLaw::Uniform,
        Some("general") => general(&mut object, zenith)?,
        _ => SkyLaw::Overcast,
    };
    let sky = Sky { zenith, law };
    let irradiance = object.colour("irradiance", Range::EMISSION)?;
    let given = object.colour("radiance", Range::EMISSION)?;
    if object.float("sampling_weight", Range::ANY)?.is_some() {
        builder.note("sampling_weight is for Mitsuba's own sampling and has no effect here");
    }
    let radiance = match (given, irradiance) {
        (Some(_), Some(_)) => {
            return Err(object.element.error("both radiance and irradiance are given", "keep one of them"));
        }
        (None, Some(irradiance)) => irradiance.scaled(1.0 / sky.horizontal_irradiance()),
        (given, None) => given.unwrap_or(Spectrum::Uniform(1.0)),
    };
    object.close(&[])?;
    Ok(EnvironmentLight::Sky { radiance, sky })
}

fn general(object: &mut Object, zenith: DVec3) -> Result<SkyLaw, SceneError> {
    let kind = object.integer("cie_type")?.unwrap_or(12);
    let kind = u8::try_from(kind).ok().filter(|kind| (1..=15).contains(kind)).ok_or_else(|| {
        object.element.error(format!("cie_type {kind} does not exist"), "give a number from 1 to 15 (ISO 15469)")
    })?;
    let sun = object.vector("sun_direction", Range::ANY)?.unwrap_or(zenith);
    let sun = unit(sun).filter(|sun| sun.dot(zenith) > 0.0);
    let sun = sun.ok_or_else(|| {
        object.element.error("sun_direction is not above the horizon", "give the direction to the sun")
    })?;
    Ok(SkyLaw::General { kind, sun })
}

/// The rotation that `to_world` states; what stands at infinity has no place and no size.
pub(super) fn rotation(object: &mut Object) -> Result<DMat3, SceneError> {
    turned(object, false)
}

/// The same, of what may be mirrored too.
fn turned(object: &mut Object, mirrors: bool) -> Result<DMat3, SceneError> {
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    turn(&to_world, mirrors).ok_or_else(|| {
        let what = "to_world of what stands at infinity is no rotation";
        object.element.error(what, "use rotate or lookat alone")
    })
}
