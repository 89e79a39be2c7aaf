//! Glass and coats: `dielectric`, `thindielectric`, `roughdielectric`, `plastic`.

use photonlab_photometry::Spectrum;

use crate::{Bsdf, Dielectric, Index, Microfacets, Roughness};

use super::error::SceneError;
use super::index::{EXTERIOR, INTERIOR, index};
use super::number::Range;
use super::object::Object;

/// Index of plastic that does not say: polypropylene.
const PLASTIC: f64 = 1.49;
/// Roughness where the file does not say, as in Mitsuba.
const ALPHA: f64 = 0.1;

/// Reads a smooth or a rough interface.
pub(super) fn dielectric(mut object: Object, rough: bool) -> Result<Bsdf, SceneError> {
    let roughness = if rough { Some(roughness(&mut object)?) } else { None };
    let (interior_index, exterior_index) = indices(&mut object)?;
    let specular = specular(&mut object)?;
    object.close(&["eta"])?;
    Ok(Bsdf::Dielectric(Dielectric { interior_index, exterior_index, specular, roughness }))
}

/// Reads a thin plate.
pub(super) fn thin(mut object: Object) -> Result<Bsdf, SceneError> {
    let relative_index = relative_index(&mut object, INTERIOR)?;
    let specular = specular(&mut object)?;
    object.close(&[])?;
    Ok(Bsdf::ThinDielectric { relative_index, specular })
}

/// Reads a coated diffuse body.
pub(super) fn plastic(mut object: Object) -> Result<Bsdf, SceneError> {
    let relative_index = relative_index(&mut object, PLASTIC)?;
    let reflectance = object.colour("diffuse_reflectance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(0.5));
    let specular_reflectance = object.colour("specular_reflectance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(1.0));
    let nonlinear = object.boolean("nonlinear")?.unwrap_or(false);
    object.close(&[])?;
    Ok(Bsdf::Plastic { reflectance, specular_reflectance, relative_index, nonlinear })
}

/// How the microfacets of a rough surface lie.
pub(super) fn roughness(object: &mut Object) -> Result<Roughness, SceneError> {
    let facets = match object.choice("distribution", &["beckmann", "ggx"])? {
        Some("ggx") => Microfacets::Ggx,
        _ => Microfacets::Beckmann,
    };
    let alpha = object.float("alpha", Range::ROUGHNESS)?;
    let [along_u, along_v] = [object.float("alpha_u", Range::ROUGHNESS)?, object.float("alpha_v", Range::ROUGHNESS)?];
    let alpha = match (alpha, along_u, along_v) {
        (alpha, None, None) => alpha.unwrap_or(ALPHA),
        (None, Some(u), Some(v)) if u == v => u,
        (None, Some(_), Some(_)) => {
            let what = "a roughness that differs with direction is known but not built yet";
            return Err(object.element.error(what, "give alpha, the same in all directions, for now"));
        }
        _ => {
            let what = "alpha_u and alpha_v are not both given, or beside alpha";
            return Err(object.element.error(what, "give alpha alone"));
        }
    };
    // Facets are always drawn as seen; Mitsuba's switch changes noise, not light.
    object.boolean("sample_visible")?;
    Ok(Roughness { facets, alpha })
}

/// Inner and outer index.
fn indices(object: &mut Object) -> Result<(Index, Index), SceneError> {
    let tags = ["float", "integer", "string", "spectrum"];
    let inside = object.take("int_ior", &tags)?.map(index).transpose()?.unwrap_or(Index::Constant(INTERIOR));
    let outside = object.take("ext_ior", &tags)?.map(index).transpose()?.unwrap_or(Index::Constant(EXTERIOR));
    Ok((inside, outside))
}

/// Inner over outer index of what cannot disperse.
fn relative_index(object: &mut Object, interior: f64) -> Result<f64, SceneError> {
    let mut constant = |name, default| match object.take(name, &["float", "integer", "string", "spectrum"])? {
        None => Ok(default),
        Some(element) => match index(element)? {
            Index::Constant(index) => Ok(index),
            _ => Err(element.error(
                format!("{name} depends on the wavelength, which only dielectric and roughdielectric can follow"),
                "give one number, or use dielectric",
            )),
        },
    };
    Ok(constant("int_ior", interior)? / constant("ext_ior", EXTERIOR)?)
}

/// Further factors of the reflected and the transmitted share.
fn specular(object: &mut Object) -> Result<[Spectrum; 2], SceneError> {
    let reflected = object.colour("specular_reflectance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(1.0));
    let transmitted = object.colour("specular_transmittance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(1.0));
    Ok([reflected, transmitted])
}
