//! Where an axis has its ticks and what they say.

use crate::number::{minus, power_of_ten, times_power, trimmed};

/// A labelled tick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// The value it stands at.
    pub(crate) at: f64,
    /// What is written beside it.
    pub(crate) label: String,
}

/// Multiples of 1, 2 or 5 times a power of ten in [low, high], about `wanted` of them.
pub(crate) fn linear(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let step = nice_step((high - low) / wanted as f64);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let largest = low.abs().max(high.abs());
    let power = largest.log10().floor() as i32;
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    let label = |x: f64| {
        if x == 0.0 || (1e-3..1e5).contains(&largest) {
            minus(&trimmed_to(x, decimals))
        } else {
            times_power(&trimmed(&format!("{:.6}", x / 10f64.powi(power))), power)
        }
    };
    (first..=last).map(|i| i as f64 * step).map(|at| Tick { at, label: label(at) }).collect()
}

/// Decades in [low, high]; 1, 2 and 5 of each where there are few; every n-th where there are many.
pub(crate) fn logarithmic(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let decades: Vec<f64> = steps(low, high, &[1.0]).collect();
    let values = match decades.len() {
        0..3 => {
            let fine: Vec<f64> = steps(low, high, &[1.0, 2.0, 5.0]).collect();
            if fine.len() < 3 {
                return linear(low, high, wanted.min(5));
            }
            fine
        }
        n => decades.into_iter().rev().step_by(n.div_ceil(wanted)).rev().collect(),
    };
    let plain = values.iter().all(|v| (0.9e-3..1.1e4).contains(v));
    values.into_iter().map(|at| Tick { at, label: log_label(at, plain) }).collect()
}

/// Unlabelled ticks between the decades.
pub(crate) fn between_decades(low: f64, high: f64) -> Vec<f64> {
    if (high / low).log10() > 8.0 {
        return Vec::new();
    }
    steps(low, high, &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]).collect()
}

/// Each mantissa in each decade, in [low, high].
fn steps(low: f64, high: f64, mantissas: &[f64]) -> impl Iterator<Item = f64> {
    let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let inside = move |v: &f64| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(v);
    decades.flat_map(move |d| mantissas.iter().map(move |m| m * 10f64.powi(d))).filter(inside)
}

fn log_label(at: f64, plain: bool) -> String {
    let power = (at.log10() + 1e-9).floor() as i32;
    let mantissa = (at / 10f64.powi(power)).round();
    match (plain, mantissa == 1.0) {
        (true, _) => trimmed_to(at, (-power).max(0) as usize),
        (false, true) => power_of_ten(power),
        (false, false) => times_power(&mantissa.to_string(), power),
    }
}

fn trimmed_to(x: f64, decimals: usize) -> String {
    format!("{x:.decimals$}")
}

fn nice_step(rough: f64) -> f64 {
    let power = 10f64.powf(rough.log10().floor());
    let factor = rough / power;
    let nice = [1.0, 2.0, 5.0].into_iter().find(|n| factor <= n * 1.000_001).unwrap_or(10.0);
    nice * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: Vec<Tick>) -> String {
        ticks.into_iter().map(|t| t.label).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(labels(linear(0.0, 1.04, 6)), "0.0 0.2 0.4 0.6 0.8 1.0");
        assert_eq!(labels(linear(-13.0, 47.0, 6)), "−10 0 10 20 30 40");
        assert_eq!(labels(linear(0.0, 3.1e6, 4)), "0 1×10⁶ 2×10⁶ 3×10⁶");
        assert_eq!(labels(linear(0.24, 0.262, 5)), "0.240 0.245 0.250 0.255 0.260");
    }

    #[test]
    fn decades_where_there_are_enough() {
        assert_eq!(labels(logarithmic(0.008, 12.0, 7)), "0.01 0.1 1 10");
        assert_eq!(labels(logarithmic(8e2, 1.2e6, 7)), "10³ 10⁴ 10⁵ 10⁶");
        assert_eq!(labels(logarithmic(15.0, 450.0, 7)), "20 50 100 200");
        assert_eq!(labels(logarithmic(1.5e6, 4.5e7, 7)), "2×10⁶ 5×10⁶ 10⁷ 2×10⁷");
        assert_eq!(labels(logarithmic(1.9, 2.3, 7)), "1.9 2.0 2.1 2.2 2.3");
        assert_eq!(logarithmic(1e-15, 1e3, 7).len(), 7);
    }
}
