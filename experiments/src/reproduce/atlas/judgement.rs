//! Predicted against measured, mode by mode.

use photonlab_measure::{Comparison, Expected, Group, Row, Verdict};

use super::mode::Measured;
use crate::reproduce::table::row;

/// Photons carry their flux in single precision: a prediction is exact up to this share.
const SINGLE: f64 = 1e-6;

/// How a mode came out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Outcome {
    /// Comparisons made.
    pub(super) compared: usize,
    /// Labels of those whose measured interval misses the prediction.
    pub(super) missed: Vec<String>,
    /// Those measured too coarsely to tell.
    pub(super) wide: usize,
}

impl Outcome {
    /// Its verdict in words.
    fn words(&self) -> String {
        let Self { compared, missed, wide } = self;
        match (missed.len(), wide) {
            (0, 0) => format!("as predicted, {compared} of {compared}"),
            (0, _) => format!("not measured: {wide} of {compared} intervals are wider than the definition asks"),
            (off, _) => format!("not as predicted: {off} of {compared} measured values miss the law"),
        }
    }
}

impl Measured {
    /// The number of comparisons that it will need.
    pub(super) fn comparisons(&self) -> usize {
        self.mode.curves.len() * self.part.sweep.len()
    }

    /// Compares every measured value with its law.
    pub(super) fn judge(&self, confidence: f64, precision: f64, comparisons: &mut Vec<Comparison>) -> Outcome {
        let mut outcome = Outcome::default();
        for (curve, readings) in self.mode.curves.iter().zip(&self.readings) {
            for (&x, reading) in self.part.sweep.iter().zip(readings) {
                let law = (curve.law)(x);
                let expected = Expected::within(law, SINGLE * law.abs(), curve.source);
                let measured = reading.interval(confidence);
                let least = precision * law.abs().max(self.part.least);
                let label = format!("{}, {}, at {x}", self.mode.id, curve.label);
                let comparison = Comparison::judge(label, "1", expected, measured);
                outcome.compared += 1;
                outcome.wide += usize::from(measured.is_none_or(|m| m.half_width() > least));
                if comparison.holds == Some(false) {
                    outcome.missed.push(comparison.label.clone());
                }
                comparisons.push(comparison);
            }
        }
        outcome
    }

    /// The rows of the record.
    pub(super) fn rows(&self) -> Vec<Row> {
        let of_curve = |(curve, readings): (&super::mode::Curve, &Vec<photonlab_measure::Replicates>)| {
            let of_point = |(&x, reading): (&f64, &photonlab_measure::Replicates)| {
                row([
                    ("mode", self.mode.id.into()),
                    ("curve", curve.label.clone().into()),
                    ("remedy", curve.remedy.into()),
                    ("x", x.into()),
                    ("replicates", reading.len().into()),
                    ("mean", reading.mean().into()),
                    ("std_error", reading.std_error().into()),
                    ("law", (curve.law)(x).into()),
                ])
            };
            self.part.sweep.iter().zip(readings).map(of_point).collect::<Vec<_>>()
        };
        self.mode.curves.iter().zip(&self.readings).flat_map(of_curve).collect()
    }

    /// The mode's heading in the report.
    pub(super) fn group(&self, outcome: &Outcome) -> Group {
        let Self { mode, part, .. } = self;
        let not_built = part.not_built.as_ref().map_or(String::new(), |what| format!(" Remedy not built: {what}."));
        let summary = format!(
            "{}. {} Expected: {} Refuted if {}.{not_built}",
            outcome.words(),
            part.statement,
            part.expectation,
            part.refuted_if
        );
        Group { title: mode.title.into(), summary, comparisons: outcome.compared }
    }
}

/// The verdict on all modes, each told by its name.
pub(super) fn conclude(outcomes: &[(&'static str, Outcome)]) -> (Verdict, String) {
    let names = |of: &dyn Fn(&Outcome) -> bool| -> Vec<&str> {
        outcomes.iter().filter(|(_, outcome)| of(outcome)).map(|(name, _)| *name).collect()
    };
    let off = names(&|outcome| !outcome.missed.is_empty());
    let wide = names(&|outcome| outcome.missed.is_empty() && outcome.wide > 0);
    let compared: usize = outcomes.iter().map(|(_, outcome)| outcome.compared).sum();
    let right = outcomes.len() - off.len() - wide.len();
    let mut reason =
        format!("{right} of {} ways of failing follow their laws, {compared} comparisons in all", outcomes.len());
    for (what, names) in [("not as predicted", &off), ("not measured closely enough", &wide)] {
        if !names.is_empty() {
            reason += &format!("; {what}: {}", names.join(", "));
        }
    }
    let verdict = match (off.is_empty(), wide.is_empty()) {
        (false, _) => Verdict::DoesNotHold,
        (true, false) => Verdict::NotMeasured,
        (true, true) => Verdict::Holds,
    };
    (verdict, reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_miss_outweighs_a_wide_interval_and_both_are_named() {
        let right = Outcome { compared: 4, ..Outcome::default() };
        let wide = Outcome { wide: 1, ..right.clone() };
        let off = Outcome { missed: vec!["x".into()], ..wide.clone() };
        assert_eq!(conclude(&[("a", right.clone())]).0, Verdict::Holds);
        assert_eq!(conclude(&[("a", right.clone()), ("b", wide.clone())]).0, Verdict::NotMeasured);
        let (verdict, reason) = conclude(&[("a", right), ("b", wide), ("c", off)]);
        assert_eq!(verdict, Verdict::DoesNotHold);
        assert!(reason.starts_with("1 of 3") && reason.contains("predicted: c;") && reason.ends_with("enough: b"));
    }
}
