//! Refractive indices by name, as Mitsuba has them.

use super::element::Element;
use super::error::SceneError;
use super::names::{nearest_first, quote};
use super::number::{Range, float};

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

/// The index that a number or a material's name states; names in any case.
pub(super) fn index(element: &Element) -> Result<f64, SceneError> {
    let value = element.required("value");
    if element.tag.name != "string" {
        let number = float(value).and_then(|number| Range::INDEX.check(number));
        return number.map_err(|fault| element.value_fault(fault));
    }
    let wanted = value.to_ascii_lowercase();
    MATERIALS.iter().find(|(name, _)| *name == wanted).map(|(_, index)| *index).ok_or_else(|| {
        let known = nearest_first(value, MATERIALS.iter().map(|(name, _)| *name));
        let what = format!("{} {} is no known material", element.label(), quote(value));
        element.error(what, format!("give a number as <float>, or one of {known}"))
    })
}
