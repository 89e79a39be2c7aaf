//! The comparisons that judge a claim, with one false-alarm rate for all of them.

use photonlab_measure::{Comparison, Expected, Interval, Row, Verdict, sidak_level};
use serde_json::Value;

/// The confidence of a whole table.
const FAMILY: f64 = 0.99;

/// Comparisons in the making.
pub(super) struct Table {
    /// The confidence of each interval.
    pub(super) confidence: f64,
    planned: usize,
    comparisons: Vec<Comparison>,
    too_wide: Vec<String>,
}

/// Below this an expected ratio counts as this much when an interval's width is judged: a leak of zero cannot be known to
/// a share of itself.
pub(super) const LEAST: f64 = 0.01;

impl Table {
    /// A table that will have this many comparisons.
    pub(super) fn new(planned: usize) -> Self {
        let confidence = 1.0 - sidak_level(1.0 - FAMILY, planned);
        Self { confidence, planned, comparisons: Vec::new(), too_wide: Vec::new() }
    }

    /// Compares a ratio with what is expected. An interval wider than `precision` times the expected value (or [`LEAST`],
    /// where next to nothing is expected) on either side says nothing.
    pub(super) fn judge(
        &mut self,
        label: impl Into<String>,
        expected: Expected,
        measured: Option<Interval>,
        precision: f64,
    ) {
        self.judge_in("1", label, expected, measured, precision);
    }

    /// As [`Table::judge`], for numbers with a unit.
    pub(super) fn judge_in(
        &mut self,
        unit: &str,
        label: impl Into<String>,
        expected: Expected,
        measured: Option<Interval>,
        precision: f64,
    ) {
        let label = label.into();
        if measured.is_none_or(|m| m.half_width() > precision * expected.value.abs().max(LEAST)) {
            self.too_wide.push(label.clone());
        }
        self.comparisons.push(Comparison::judge(label, unit, expected, measured));
    }

    /// The comparisons and the verdict: `as_predicted` if all of them hold and were measured narrowly enough.
    pub(super) fn conclude(
        self,
        as_predicted: impl FnOnce() -> (Verdict, String),
    ) -> (Vec<Comparison>, Verdict, String) {
        assert_eq!(self.comparisons.len(), self.planned, "the confidence was shared among the planned comparisons");
        let missed: Vec<&str> =
            self.comparisons.iter().filter(|c| c.holds == Some(false)).map(|c| c.label.as_str()).collect();
        let (verdict, reason) = if !self.too_wide.is_empty() {
            let reason = format!("the intervals are wider than the definition asks: {}", self.too_wide.join("; "));
            (Verdict::NotMeasured, reason)
        } else if !missed.is_empty() {
            let reason = format!("measured values miss the law they should follow: {}", missed.join("; "));
            (Verdict::NotCertifiable, reason)
        } else {
            as_predicted()
        };
        (self.comparisons, verdict, reason)
    }

    /// How a caption names the intervals.
    pub(super) fn intervals(&self) -> String {
        format!("intervals of {:.4} % each, 99 % for the whole table of {}", 100.0 * self.confidence, self.planned)
    }
}

/// A row of a record.
pub(super) fn row<const N: usize>(cells: [(&str, Value); N]) -> Row {
    cells.into_iter().map(|(name, value)| (name.to_string(), value)).collect()
}
