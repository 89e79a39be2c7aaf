//! Refractive indices by name, as Mitsuba has them.

use photonlab_photometry::Spectrum;

use crate::Index;

use super::colour::colour;
use super::element::Element;
use super::error::{Fault, SceneError};
use super::names::{nearest_first, quote};
use super::number::{Range, float, list};

/// Index of the inside of a dielectric that does not say: borosilicate glass.
pub(super) const INTERIOR: f64 = 1.5046;
/// Index of the outside of a dielectric that does not say: air.
pub(super) const EXTERIOR: f64 = 1.000277;

const MATERIALS: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000036),
    ("hydrogen", 1.000132),
    ("air", EXTERIOR),
    ("carbon dioxide", 1.00045),
    ("water", 1.3330),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.52045),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.470),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", INTERIOR),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.5750),
    ("diamond", 2.419),
];

/// Glasses by their makers' Sellmeier coefficients: three b, then three c in square micrometres.
const GLASSES: [(&str, [f64; 6]); 3] = [
    ("n-bk7", [1.03961212, 0.231792344, 1.01046945, 0.00600069867, 0.0200179144, 103.560653]),
    ("n-sf11", [1.73759695, 0.313747346, 1.89878101, 0.013188707, 0.0623068142, 155.23629]),
    ("fused silica", [0.6961663, 0.4079426, 0.8974794, 0.0046791482, 0.0135120631, 97.9340025]),
];

/// The index that a number, a table, a formula or a material's name states; names in any case.
///
/// Mitsuba's names have one index at all wavelengths. Extensions: a `spectrum`, the words `sellmeier` and `cauchy` with their
/// coefficients, and the glasses above disperse.
pub(super) fn index(element: &Element) -> Result<Index, SceneError> {
    if element.tag.name == "spectrum" {
        return match colour(element, Range::INDEX)? {
            Spectrum::Curve(curve) => Ok(Index::Table(curve)),
            other => Ok(Index::Constant(other.max())),
        };
    }
    let value = element.required("value");
    if element.tag.name != "string" {
        let number = float(value).and_then(|number| Range::INDEX.check(number));
        return number.map(Index::Constant).map_err(|fault| element.value_fault(fault));
    }
    let wanted = value.trim().to_ascii_lowercase();
    if let Some(found) = formula(&wanted) {
        return found.map_err(|fault| element.value_fault(fault));
    }
    let constant = MATERIALS.iter().find(|(name, _)| *name == wanted).map(|(_, index)| Index::Constant(*index));
    let glass = || GLASSES.iter().find(|(name, _)| *name == wanted).map(|(_, by)| Index::Sellmeier(*by));
    constant.or_else(glass).ok_or_else(|| {
        let names = MATERIALS.iter().map(|(name, _)| *name).chain(GLASSES.iter().map(|(name, _)| *name));
        let known = nearest_first(value, names);
        let what = format!("{} {} is no known material", element.label(), quote(value));
        element.error(what, format!("give a number as <float>, or one of {known}"))
    })
}

/// `sellmeier b1 b2 b3 c1 c2 c3` or `cauchy a b`, in micrometres.
fn formula(text: &str) -> Option<Result<Index, Fault>> {
    let (name, numbers) = text.split_once(char::is_whitespace)?;
    let made = match name {
        "sellmeier" => list(numbers, &[6]).map(|n| Index::Sellmeier([n[0], n[1], n[2], n[3], n[4], n[5]])),
        "cauchy" => list(numbers, &[2]).map(|n| Index::Cauchy([n[0], n[1]])),
        _ => return None,
    };
    let mend = "give coefficients in micrometres with which the index is at least 1 from 360 to 830 nm";
    Some(made.and_then(|index| {
        // Every nanometre: a pole within the visible shows as an index below one, or none.
        let wrong = (360..=830).find(|&nm| !(1.0..=100.0).contains(&index.at(f64::from(nm))));
        match wrong {
            Some(nm) => Err(Fault::new(format!("makes an index of {} at {nm} nm", index.at(f64::from(nm))), mend)),
            None => Ok(index),
        }
    }))
}
