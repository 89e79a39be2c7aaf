//! A number with its interval.

use serde::{Deserialize, Serialize};

use crate::finite::{NotFinite, finite};

/// A measured number and the interval that covers the truth with the stated confidence; all in one unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Probability of covering the truth, in (0, 1).
    pub confidence: f64,
}

impl Interval {
    /// `value` plus and minus `half_width`.
    pub fn around(value: f64, half_width: f64, confidence: f64) -> Self {
        Interval { value, low: value - half_width, high: value + half_width, confidence }
    }

    /// Half the interval's length.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// True if `x` lies in the closed interval.
    pub fn contains(&self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// The same interval in another unit or as a ratio: everything times `factor` (ends swapped if it is negative).
    pub fn scaled(&self, factor: f64) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        Interval { value: self.value * factor, low: a.min(b), high: a.max(b), confidence: self.confidence }
    }

    pub(crate) fn check(&self, at: &str) -> Result<(), NotFinite> {
        finite(at, "value", self.value)?;
        finite(at, "low", self.low)?;
        finite(at, "high", self.high)?;
        finite(at, "confidence", self.confidence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_negative_factor_keeps_the_ends_in_order() {
        let i = Interval { value: 2.0, low: 1.0, high: 4.0, confidence: 0.95 };
        let s = i.scaled(-2.0);
        assert_eq!((s.value, s.low, s.high), (-4.0, -8.0, -2.0));
        assert!(s.contains(-8.0) && !s.contains(-8.1));
        assert_eq!(s.half_width(), 3.0);
    }
}
