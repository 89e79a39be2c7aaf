//! The one way in which a reference scene refuses its parameters.

use std::fmt;

/// A parameter for which the scene has no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    /// The parameter's name.
    pub name: &'static str,
    /// The value given.
    pub value: f64,
    /// The condition it breaks.
    pub wanted: &'static str,
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}, but must be {}", self.name, self.value, self.wanted)
    }
}

impl std::error::Error for OutOfRange {}

/// Passes if `holds`; written so that a condition on a NaN fails too.
pub(crate) fn require(holds: bool, name: &'static str, value: f64, wanted: &'static str) -> Result<(), OutOfRange> {
    if holds { Ok(()) } else { Err(OutOfRange { name, value, wanted }) }
}

/// A length, flux or other quantity that must be finite and above zero.
pub(crate) fn require_positive(name: &'static str, value: f64) -> Result<(), OutOfRange> {
    require(value > 0.0 && value.is_finite(), name, value, "finite and above 0")
}

/// A reflectance for which infinitely many bounces converge: in `[0, 1)`.
pub(crate) fn require_albedo(name: &'static str, value: f64) -> Result<(), OutOfRange> {
    require((0.0..1.0).contains(&value), name, value, "at least 0 and below 1")
}
