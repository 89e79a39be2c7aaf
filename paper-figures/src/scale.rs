//! From a value to its place along an axis.

use crate::ticks::{self, Tick};

/// An axis with its range and ticks.
#[derive(Clone, Debug)]
pub(crate) struct Scale {
    log: bool,
    low: f64,
    high: f64,
    /// Labelled ticks.
    pub(crate) ticks: Vec<Tick>,
    /// Unlabelled ticks.
    pub(crate) minor: Vec<f64>,
}

impl Scale {
    /// A linear axis over all `values` (at least one), a little wider; it starts at zero if they come near it.
    pub(crate) fn linear(values: &[f64], wanted: usize) -> Self {
        let (mut low, mut high) = ends(values);
        if low == high {
            let room = if low == 0.0 { 1.0 } else { 0.1 * low.abs() };
            (low, high) = (low - room, high + room);
        }
        let room = 0.05 * (high - low);
        let from_zero = low >= 0.0 && low <= 0.3 * high;
        let to_zero = high <= 0.0 && high >= 0.3 * low;
        low = if from_zero { 0.0 } else { low - room };
        high = if to_zero { 0.0 } else { high + room };
        Scale { log: false, low, high, ticks: ticks::linear(low, high, wanted), minor: Vec::new() }
    }

    /// Names at 1, 2, 3 and on, with half a step on either side.
    pub(crate) fn named(names: &[String]) -> Self {
        let ticks = names.iter().enumerate().map(|(i, name)| Tick { at: i as f64 + 1.0, label: name.clone() });
        Scale { log: false, low: 0.5, high: names.len() as f64 + 0.5, ticks: ticks.collect(), minor: Vec::new() }
    }

    /// A logarithmic axis over all `values` (at least one, all above zero), a little wider.
    pub(crate) fn logarithmic(values: &[f64], wanted: usize) -> Self {
        let (low, high) = ends(values);
        let room = (high / low).powf(0.05).max(1.1);
        let (low, high) = (low / room, high * room);
        let ticks = ticks::logarithmic(low, high, wanted);
        Scale { log: true, low, high, ticks, minor: ticks::between_decades(low, high) }
    }

    /// Zero at the low end, one at the high end.
    pub(crate) fn position(&self, value: f64) -> f64 {
        if self.log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// True if the axis cannot show `value`, which lies below its low end (zero, on a logarithmic axis).
    pub(crate) fn cuts(&self, value: f64) -> bool {
        value < self.low
    }
}

fn ends(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_run_from_zero_to_one() {
        let linear = Scale::linear(&[0.1, 2.0], 5);
        assert_eq!(linear.position(0.0), 0.0);
        let log = Scale::logarithmic(&[1.0, 100.0], 5);
        assert!((log.position(10.0) - 0.5).abs() < 1e-12);
        assert!(log.cuts(0.0) && log.cuts(-1.0) && !log.cuts(1.0));
    }

    #[test]
    fn one_value_still_has_an_axis() {
        for value in [0.0, 5.0, -3.0] {
            let scale = Scale::linear(&[value], 5);
            assert!((0.0..=1.0).contains(&scale.position(value)) && scale.ticks.len() > 1);
        }
        assert!(Scale::logarithmic(&[7.0], 5).ticks.len() > 1);
    }
}
