//! Expected against measured.

use serde::{Deserialize, Serialize};

use crate::Interval;
use crate::finite::{NotFinite, finite};

/// What is expected, as an interval, and where it comes from; committed before the run that judges it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// The expected value.
    pub value: f64,
    /// The lowest value that still counts as expected.
    pub low: f64,
    /// The highest value that still counts as expected.
    pub high: f64,
    /// The law, catalogue entry or publication that says so.
    pub source: String,
}

impl Expected {
    /// A value known exactly.
    pub fn exact(value: f64, source: impl Into<String>) -> Self {
        Expected::within(value, 0.0, source)
    }

    /// A value plus and minus `tolerance`.
    pub fn within(value: f64, tolerance: f64, source: impl Into<String>) -> Self {
        Expected { value, low: value - tolerance, high: value + tolerance, source: source.into() }
    }

    fn check(&self, at: &str) -> Result<(), NotFinite> {
        finite(at, "value", self.value)?;
        finite(at, "low", self.low)?;
        finite(at, "high", self.high)
    }
}

/// One number of a claim: what was expected, what was measured, and whether they agree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Comparison {
    /// What is compared.
    pub label: String,
    /// The unit of every number here; `1` for a ratio.
    pub unit: String,
    /// What is expected.
    pub expected: Expected,
    /// What was measured; null if it was not.
    pub measured: Option<Interval>,
    /// Whether the two agree; null if nothing was measured.
    pub holds: Option<bool>,
    /// What a reader should know.
    pub note: Option<String>,
}

impl Comparison {
    /// Compares by the rule: it holds if the closed measured interval and the closed expected interval have a point in
    /// common.
    ///
    /// With an exact expectation this is the usual test at level 1 - confidence. A wide interval overlaps much: an
    /// experiment states in its definition how narrow the measured interval must be, and says "not measured" otherwise.
    pub fn judge(
        label: impl Into<String>,
        unit: impl Into<String>,
        expected: Expected,
        measured: Option<Interval>,
    ) -> Self {
        let holds = measured.map(|m| m.low <= expected.high && expected.low <= m.high);
        Comparison { label: label.into(), unit: unit.into(), expected, measured, holds, note: None }
    }

    /// Adds what a reader should know.
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.note = Some(note.into());
        self
    }

    pub(crate) fn check(&self, at: &str) -> Result<(), NotFinite> {
        self.expected.check(&format!("{at}.expected"))?;
        self.measured.map_or(Ok(()), |m| m.check(&format!("{at}.measured")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(low: f64, high: f64) -> Option<bool> {
        let measured = Interval { value: 0.5 * (low + high), low, high, confidence: 0.95 };
        Comparison::judge("x", "1", Expected::within(1.0, 0.1, "test"), Some(measured)).holds
    }

    #[test]
    fn overlap_decides_and_touching_counts() {
        assert_eq!(holds(1.05, 1.2), Some(true));
        assert_eq!(holds(0.0, 5.0), Some(true));
        assert_eq!(holds(1.1, 1.2), Some(true));
        assert_eq!(holds(1.1000001, 1.2), Some(false));
        assert_eq!(holds(0.5, 0.8), Some(false));
        assert_eq!(Comparison::judge("x", "1", Expected::exact(1.0, "test"), None).holds, None);
        assert_eq!(holds(f64::NAN, f64::NAN), Some(false));
    }
}
