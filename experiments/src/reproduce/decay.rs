//! How a mean squared error falls with effort, and how it should.

use photonlab_measure::{
    Expected, Interval, Point, Replicates, Row, Series, SeriesKind, fit_log_log, student_t_quantile,
};

use super::table::{LEAST, Table, row};

/// The error at several efforts, each measured with photons of its own.
pub(super) struct Decay {
    pub(super) name: &'static str,
    /// What the law of the errors is, for tables.
    pub(super) source: &'static str,
    /// The exponent at infinite effort.
    pub(super) limit: f64,
    /// Ascending.
    pub(super) steps: Vec<Step>,
}

/// One effort.
pub(super) struct Step {
    /// Photons or passes.
    pub(super) effort: f64,
    /// Radius (m) or k.
    pub(super) setting: f64,
    /// Squared errors, in units of the mean irradiance squared.
    pub(super) squared: Replicates,
    /// Their mean by the law.
    pub(super) law: f64,
}

impl Decay {
    /// Compares every error with its law, and names it by its effort's `unit`.
    pub(super) fn judge_errors(&self, table: &mut Table, unit: &str, precision: f64) {
        for step in &self.steps {
            let measured = step.squared.interval(table.confidence).map(|error| error.scaled(1.0 / step.law));
            let label = format!("{}, {} {unit}: mean squared error over its law", self.name, step.effort);
            table.judge(label, Expected::exact(1.0, self.source), measured, precision);
        }
    }

    /// Compares the slope with that of the laws; a half-width over `precision` says nothing.
    pub(super) fn judge_slope(&self, table: &mut Table, precision: f64) {
        let law = self.law_slope();
        let expected = Expected::exact(law, format!("the same fit to the laws; {:.3} in the limit", self.limit));
        let label = format!("{}: log-log slope of the mean squared error", self.name);
        table.judge(label, expected, self.slope(table.confidence), precision / law.abs().max(LEAST));
    }

    /// The slope of a log-log fit with the interval that the replicates' scatter leaves it. The points' own scatter about a line would not
    /// do: at finite effort the law is a little bent.
    pub(super) fn slope(&self, confidence: f64) -> Option<Interval> {
        let means: Vec<f64> = self.steps.iter().map(|step| step.squared.mean()).collect::<Option<_>>()?;
        let fit = fit_log_log(&self.efforts(), &means).ok()?;
        let logs: Vec<f64> = self.steps.iter().map(|step| step.effort.ln()).collect();
        let centre = logs.iter().sum::<f64>() / logs.len() as f64;
        let spread: f64 = logs.iter().map(|x| (x - centre).powi(2)).sum();
        let (mut variance, mut freedom) = (0.0, f64::INFINITY);
        for ((step, mean), x) in self.steps.iter().zip(&means).zip(&logs) {
            variance += ((x - centre) / spread * step.squared.std_error()? / mean).powi(2);
            freedom = freedom.min(step.squared.degrees_of_freedom());
        }
        let half = student_t_quantile(confidence, freedom) * variance.sqrt();
        Some(Interval::around(fit.slope, half, confidence))
    }

    /// The same fit to the laws.
    pub(super) fn law_slope(&self) -> f64 {
        let laws: Vec<f64> = self.steps.iter().map(|step| step.law).collect();
        fit_log_log(&self.efforts(), &laws).map_or(f64::NAN, |fit| fit.slope)
    }

    /// The laws' slope between the last two efforts.
    pub(super) fn last_slope(&self) -> Option<f64> {
        self.local_slope(self.steps.len().checked_sub(1)?)
    }

    fn local_slope(&self, to: usize) -> Option<f64> {
        let (before, step) = (&self.steps[to.checked_sub(1)?], &self.steps[to]);
        Some((step.law / before.law).ln() / (step.effort / before.effort).ln())
    }

    fn efforts(&self) -> Vec<f64> {
        self.steps.iter().map(|step| step.effort).collect()
    }

    pub(super) fn rows(&self) -> Vec<Row> {
        let of = |(i, step): (usize, &Step)| {
            row([
                ("estimate", self.name.into()),
                ("effort", step.effort.into()),
                ("radius_or_k", step.setting.into()),
                ("replicates", step.squared.len().into()),
                ("mean_squared_error", step.squared.mean().into()),
                ("std_error", step.squared.std_error().into()),
                ("law", step.law.into()),
                ("local_slope_of_the_law", self.local_slope(i).into()),
            ])
        };
        self.steps.iter().enumerate().map(of).collect()
    }

    /// Marks with their intervals, and the law through them.
    pub(super) fn series(&self, confidence: f64) -> [Series; 2] {
        let mark = |step: &Step| {
            Some(Point::measured(step.effort, step.squared.interval(confidence).filter(|e| e.low > 0.0)?))
        };
        let law = |step: &Step| Point::new(step.effort, step.law);
        [
            Series {
                label: self.name.into(),
                kind: SeriesKind::Measured,
                points: self.steps.iter().filter_map(mark).collect(),
            },
            Series {
                label: "its law".into(),
                kind: SeriesKind::Predicted,
                points: self.steps.iter().map(law).collect(),
            },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of exact powers, twice and zero times their mean: the slope is the power, and its error that of the logarithms.
    #[test]
    fn a_power_has_its_slope() {
        let step = |effort: f64| {
            let law = effort.powf(-0.5);
            let squared = (0..2000).map(|i| law * f64::from(2 * (i % 2))).collect();
            Step { effort, setting: 1.0, squared, law }
        };
        let steps = [1e3, 1e4, 1e5].map(step).into();
        let decay = Decay { name: "power", source: "none", limit: -0.5, steps };
        let slope = decay.slope(0.95).expect("replicates");
        assert!((slope.value + 0.5).abs() < 1e-12 && (decay.law_slope() + 0.5).abs() < 1e-12);
        let relative = 1.0 / 1999.0f64.sqrt();
        let expected = 1.961 * relative / (2.0f64.sqrt() * 10.0f64.ln());
        assert!((slope.half_width() / expected - 1.0).abs() < 1e-3, "{slope:?}");
    }
}
