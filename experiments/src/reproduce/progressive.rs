//! Progressive estimates: the mean of many passes of independent photons whose radius shrinks, at the crest of the torus.

use photonlab_gather::Bandwidth;
use photonlab_measure::{Expected, Interval, Replicates, Row};
use photonlab_readout::SHRINK;
use photonlab_reference::convergence::{
    Error,
    cosine_torus::TRUTH,
    progressive::{Progression, Shrinking},
};

use super::{
    decay::{Decay, Step},
    table::{Table, row},
    torus::read_crest,
    trials::Trials,
};

/// The exponent of Knaus and Zwicker that converges fastest.
const ALPHA: f64 = 2.0 / 3.0;

/// How a sequence's radii are made, one pass from another; the laws have closed forms of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sequence {
    /// `r_(i+1)^2 / r_i^2 = (i + alpha) / (i + 1)`.
    Published,
    /// `r_i = r_1 i^(-SHRINK)`: this program's own.
    Ours,
}

/// What is asked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked<'a> {
    pub(super) photons: u64,
    pub(super) radius: f64,
    pub(super) passes: &'a [u32],
}

/// A sequence's estimates after several numbers of passes, each from photons of its own.
pub(super) struct Progressive {
    pub(super) decay: Decay,
    moments: Vec<Moments>,
}

struct Moments {
    law: Error,
    /// Value less truth.
    off: Replicates,
    /// Squared deviations from the law's mean.
    square: Replicates,
}

impl Sequence {
    pub(super) const ALL: [Self; 2] = [Self::Published, Self::Ours];

    fn title(self) -> &'static str {
        match self {
            Self::Published => "progressive, r^2 by (i + 2/3) / (i + 1)",
            Self::Ours => "progressive, r as i^(-1/6)",
        }
    }

    fn law(self) -> Shrinking {
        match self {
            Self::Published => Shrinking::Ratio { alpha: ALPHA },
            Self::Ours => Shrinking::Power { alpha: ALPHA },
        }
    }

    /// The radii of all passes.
    fn radii(self, first: f64, passes: u32) -> Vec<f64> {
        let mut square = first * first;
        let next = |pass: u32| {
            let (i, radius) = (f64::from(pass), square.sqrt());
            square *= (i + ALPHA) / (i + 1.0);
            match self {
                Self::Published => radius,
                Self::Ours => first * i.powf(-SHRINK),
            }
        };
        (1..=passes).map(next).collect()
    }
}

impl Progressive {
    /// Runs independent sequences.
    pub(super) fn measure(sequence: Sequence, asked: Asked<'_>, first: Trials) -> anyhow::Result<Self> {
        let progression =
            Progression { photons: asked.photons as f64, radius: asked.radius, shrinking: sequence.law() };
        let (mut steps, mut moments) = (Vec::new(), Vec::new());
        for (i, &passes) in asked.passes.iter().enumerate() {
            let law = progression.error(passes);
            let radii = sequence.radii(asked.radius, passes);
            let trials = Trials { group: first.group + i as u64, ..first };
            let columns = trials.run(|stream, scratch| {
                let mut sum = 0.0;
                for &radius in &radii {
                    sum += read_crest(asked.photons, Bandwidth::Radius(radius), stream, scratch)?;
                }
                let off = sum / radii.len() as f64 - TRUTH;
                Ok(vec![off, (off - law.bias).powi(2), off * off])
            })?;
            let column = |index: usize| columns.get(index).copied().unwrap_or_default();
            moments.push(Moments { law, off: column(0), square: column(1) });
            let setting = radii.last().copied().unwrap_or(asked.radius);
            steps.push(Step { effort: f64::from(passes), setting, squared: column(2), law: law.mean_squared() });
        }
        let source = "each pass has its own bias and variance (catalogue H3)";
        Ok(Self { decay: Decay { name: sequence.title(), source, limit: -ALPHA, steps }, moments })
    }

    /// Compares bias and variance with their laws.
    pub(super) fn judge(&self, table: &mut Table, precision: f64) {
        for (step, moments) in self.decay.steps.iter().zip(&self.moments) {
            let Moments { law, off, square } = moments;
            let over = |values: &Replicates, law: f64| -> Option<Interval> {
                Some(values.interval(table.confidence)?.scaled(1.0 / law))
            };
            for (what, measured) in [("bias", over(off, law.bias)), ("variance", over(square, law.variance))] {
                let label = format!("{}, {} passes: {what} over its law", self.decay.name, step.effort);
                table.judge(label, Expected::exact(1.0, self.decay.source), measured, precision);
            }
        }
    }

    /// The decay's rows, with bias and variance.
    pub(super) fn rows(&self) -> Vec<Row> {
        let mut rows = self.decay.rows();
        for (of_step, Moments { law, off, square }) in rows.iter_mut().zip(&self.moments) {
            of_step.extend(row([
                ("bias", off.mean().into()),
                ("bias_std_error", off.std_error().into()),
                ("bias_law", law.bias.into()),
                ("variance", square.mean().into()),
                ("variance_std_error", square.std_error().into()),
                ("variance_law", law.variance.into()),
            ]));
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_are_the_laws() {
        for sequence in Sequence::ALL {
            let law = Progression { photons: 1.0, radius: 0.2, shrinking: sequence.law() };
            for (pass, radius) in (1..).zip(sequence.radii(0.2, 300)) {
                assert!((radius / law.radius_of(pass) - 1.0).abs() < 1e-11, "{sequence:?} {pass}");
            }
        }
    }
}
