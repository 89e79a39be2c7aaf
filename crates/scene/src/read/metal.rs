//! Metals: `conductor` and `roughconductor`.

use photonlab_photometry::Spectrum;

use crate::{Bsdf, Conductor};

use super::dielectric::roughness;
use super::element::Element;
use super::error::SceneError;
use super::names::{nearest_first, quote};
use super::number::Range;
use super::object::Object;

/// Complex indices in the three channels of sRGB, from the tables of optical constants that Mitsuba carries, turned into
/// colours as its RGB variants do.
#[rustfmt::skip]
const METALS: [(&str, [f64; 3], [f64; 3]); 38] = [
    ("Ag", [0.15528, 0.11673, 0.13839], [4.8284, 3.1222, 2.1469]),
    ("Al", [1.6575, 0.8804, 0.52124], [9.2238, 6.2695, 4.837]),
    ("AlAs", [3.6053, 3.2329, 2.2163], [0.00067944, 0.0, 0.0075127]),
    ("AlSb", [0.0, 4.1394, 4.6692], [0.0, 0.094009, 1.3006]),
    ("Au", [0.14304, 0.37531, 1.442], [3.983, 2.3856, 1.6034]),
    ("Be", [4.185, 3.185, 2.7841], [3.8355, 3.0101, 2.869]),
    ("Cr", [4.3697, 2.9165, 1.6549], [5.2065, 4.2313, 3.7547]),
    ("CsI", [2.1449, 1.7023, 1.6624], [0.0, 0.0, 0.0]),
    ("Cu", [0.20101, 0.92375, 1.1022], [3.9133, 2.453, 2.1421]),
    ("Cu2O", [3.5518, 2.9499, 2.7519], [0.11421, 0.1939, 0.60613]),
    ("CuO", [3.2475, 2.4478, 2.2102], [0.52109, 0.57003, 0.72218]),
    ("Cu_palik", [0.21323, 0.91972, 1.1024], [3.9219, 2.4573, 2.1366]),
    ("Hg", [2.3989, 1.44, 0.90957], [6.3276, 4.3719, 3.4218]),
    ("HgTe", [4.779, 3.2312, 2.6599], [1.6316, 1.5808, 1.7293]),
    ("Ir", [3.0863, 2.0822, 1.6179], [5.5922, 4.0671, 3.2673]),
    ("K", [0.064043, 0.04641, 0.038185], [2.1042, 1.3489, 0.91313]),
    ("Li", [0.26579, 0.19562, 0.22095], [3.5402, 2.3111, 1.6686]),
    ("MgO", [2.0896, 1.6507, 1.5949], [0.0, 0.0, 0.0]),
    ("Mo", [4.484, 3.5251, 2.7763], [4.1114, 3.4208, 3.1506]),
    ("Na_palik", [0.060269, 0.056141, 0.061988], [3.1793, 2.1125, 1.579]),
    ("Nb", [3.4201, 2.7901, 2.3956], [3.4414, 2.7377, 2.5797]),
    ("Ni_palik", [2.3673, 1.6634, 1.4671], [4.4988, 3.0502, 2.3454]),
    ("Rh", [2.5858, 1.8602, 1.5543], [6.7823, 4.703, 3.9761]),
    ("Se", [4.0583, 2.8429, 2.8209], [0.75405, 0.63844, 0.52181]),
    ("SiC", [3.1723, 2.526, 2.4794], [7.5377e-07, 0.0, 1.0192e-05]),
    ("SnTe", [4.5243, 1.9816, 1.2816], [0.0, 0.0, 0.0]),
    ("Ta", [2.0627, 2.3929, 2.6279], [2.4084, 1.7415, 1.947]),
    ("Te", [7.3902, 4.4821, 2.6371], [3.256, 3.5271, 3.2921]),
    ("ThF4", [1.8307, 1.4422, 1.3877], [0.0, 0.0, 0.0]),
    ("TiC", [3.7005, 2.8374, 2.5823], [3.2656, 2.3516, 2.1728]),
    ("TiN", [1.6484, 1.1505, 1.3798], [3.3683, 1.9435, 1.1021]),
    ("TiO2", [3.4566, 2.8017, 2.9052], [0.00010527, 0.0, 0.00065289]),
    ("VC", [3.6576, 2.7527, 2.5327], [3.0683, 2.1987, 1.9632]),
    ("VN", [2.8656, 2.1192, 1.9401], [3.0322, 2.0561, 1.6163]),
    ("V_palik", [4.2776, 3.5129, 2.7611], [3.4913, 2.8895, 3.1115]),
    ("W", [4.3708, 3.3002, 2.9984], [3.5006, 2.6049, 2.2732]),
    ("a-C", [2.944, 2.2271, 1.9682], [0.88746, 0.7993, 0.81529]),
    ("d-C", [2.7087, 2.3188, 2.2289], [0.0, 0.0, 0.0]),
];

/// Reads a smooth or a rough metal. Mitsuba's default, material "none", is a perfect mirror.
pub(super) fn conductor(mut object: Object, rough: bool) -> Result<Bsdf, SceneError> {
    let roughness = if rough { Some(roughness(&mut object)?) } else { None };
    let material = object.take("material", &["string"])?;
    let eta = object.colour("eta", Range::METAL)?;
    let k = object.colour("k", Range::METAL)?;
    let specular_reflectance = object.colour("specular_reflectance", Range::SHARE)?.unwrap_or(Spectrum::Uniform(1.0));
    object.close(&[])?;
    let named = material.map(metal).transpose()?.flatten();
    if let Some(material) = material.filter(|_| named.is_some() && (eta.is_some() || k.is_some())) {
        return Err(material.error("both a material and eta or k are given", "keep one of them"));
    }
    let (eta, k) = match (named, eta, k) {
        (Some(indices), ..) => indices,
        (None, None, None) if roughness.is_none() => {
            return Ok(Bsdf::Mirror { reflectance: specular_reflectance });
        }
        (None, eta, k) => (eta.unwrap_or(Spectrum::BLACK), k.unwrap_or(Spectrum::Uniform(1.0))),
    };
    Ok(Bsdf::Conductor(Conductor { eta, k, specular_reflectance, roughness }))
}

/// The indices of a named metal; nothing for "none".
fn metal(element: &Element) -> Result<Option<(Spectrum, Spectrum)>, SceneError> {
    let wanted = element.required("value");
    if wanted.eq_ignore_ascii_case("none") {
        return Ok(None);
    }
    let found = METALS.iter().find(|(name, ..)| name.eq_ignore_ascii_case(wanted));
    let found = found.map(|(_, eta, k)| (Spectrum::Rgb(*eta), Spectrum::Rgb(*k)));
    found.map(Some).ok_or_else(|| {
        let known = nearest_first(wanted, METALS.iter().map(|(name, ..)| *name));
        let what = format!("{} is no metal that is known", quote(wanted));
        element.error(what, format!("give eta and k, or one of {known}"))
    })
}
