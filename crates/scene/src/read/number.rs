//! Numbers as the file writes them, and the ranges they must lie in.

use super::error::Fault;
use super::names::quote;

/// A closed range of numbers, with the words that ask for one of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    low: f64,
    high: f64,
    says: &'static str,
}

/// Shortest and longest length in metres: squares of both are still far inside single precision.
pub(super) const SHORTEST: f64 = 1e-15;
/// See [`SHORTEST`].
pub(super) const LONGEST: f64 = 1e15;

impl Range {
    /// Any finite number.
    pub(super) const ANY: Range = Range { low: f64::MIN, high: f64::MAX, says: "a finite number" };
    /// A coordinate in metres.
    pub(super) const COORDINATE: Range = Range { low: -LONGEST, high: LONGEST, says: "between -1e15 and 1e15" };
    /// A positive length in metres.
    pub(super) const LENGTH: Range = Range { low: SHORTEST, high: LONGEST, says: "positive, between 1e-15 and 1e15" };
    /// A share of light.
    pub(super) const SHARE: Range = Range { low: 0.0, high: 1.0, says: "within [0, 1]" };
    /// Emitted light in any of its quantities.
    pub(super) const EMISSION: Range = Range { low: 0.0, high: 1e30, says: "not negative and at most 1e30" };
    /// Either part of a metal's index.
    pub(super) const METAL: Range = Range { low: 0.0, high: 1e3, says: "within [0, 1000]" };
    /// A power of the cosine.
    pub(super) const EXPONENT: Range = Range { low: 0.0, high: 1e6, says: "within [0, 1000000]" };
    /// A half-angle of a spot in degrees.
    pub(super) const CUTOFF: Range = Range { low: 1e-3, high: 180.0, says: "within [0.001, 180]" };
    /// The spread of microfacets' slopes.
    pub(super) const ROUGHNESS: Range = Range { low: 1e-4, high: 10.0, says: "within [0.0001, 10]" };
    /// Extinguished share per metre.
    pub(super) const EXTINCTION: Range = Range { low: 0.0, high: LONGEST, says: "not negative and at most 1e15" };
    /// Mean cosine of a phase function.
    pub(super) const ANISOTROPY: Range = Range { low: -0.999, high: 0.999, says: "within [-0.999, 0.999]" };
    /// A refractive index.
    pub(super) const INDEX: Range = Range { low: 1.0, high: 100.0, says: "within [1, 100]" };

    /// The number, if it lies inside; NaN lies in no range.
    pub(super) fn check(self, number: f64) -> Result<f64, Fault> {
        if self.low <= number && number <= self.high {
            return Ok(number);
        }
        Err(Fault::new(format!("{number} is out of range"), format!("give a number {}", self.says)))
    }
}

/// One finite number.
pub(super) fn float(text: &str) -> Result<f64, Fault> {
    match text.trim().parse::<f64>() {
        // Adding zero turns -0 into 0.
        Ok(number) if number.is_finite() => Ok(number + 0.0),
        Ok(_) => Err(Fault::new(format!("{} is not a finite number", quote(text)), "give a finite number")),
        Err(_) => Err(Fault::new(format!("{} is not a number", quote(text)), "give one number, such as 0.5")),
    }
}

/// One whole number.
pub(super) fn integer(text: &str) -> Result<i64, Fault> {
    let wrong = |_| Fault::new(format!("{} is not a whole number", quote(text)), "give one, such as 64");
    text.trim().parse::<i64>().map_err(wrong)
}

/// `true` or `false`, in any case.
pub(super) fn boolean(text: &str) -> Result<bool, Fault> {
    match text.trim().to_ascii_lowercase().as_str() {
        "true" => Ok(true),
        "false" => Ok(false),
        _ => Err(Fault::new(format!("{} is neither true nor false", quote(text)), "write true or false")),
    }
}

/// Finite numbers separated by commas or space; how many is one of `counts`.
pub(super) fn list(text: &str, counts: &[usize]) -> Result<Vec<f64>, Fault> {
    let most = counts.iter().max().copied().unwrap_or(0);
    let pieces = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|piece| !piece.is_empty());
    let numbers = pieces.take(most + 1).map(float).collect::<Result<Vec<f64>, Fault>>()?;
    if counts.contains(&numbers.len()) {
        return Ok(numbers);
    }
    let wanted: Vec<String> = counts.iter().map(usize::to_string).collect();
    let wanted = wanted.join(" or ");
    let found = if numbers.len() > most { format!("more than {most}") } else { numbers.len().to_string() };
    Err(Fault::new(
        format!("{} holds {found} numbers", quote(text)),
        format!("give {wanted}, separated by spaces or commas"),
    ))
}
