//! A way of failing: what is swept, what is predicted, and what is measured.

use photonlab_gather::Scratch;
use photonlab_measure::{Axis, Replicates};
use photonlab_sampling::Stream;
use serde::Deserialize;

use crate::reproduce::trials::Trials;

/// What the definition file says of a mode.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Part {
    /// The failure in one sentence.
    pub(super) statement: String,
    /// What is expected.
    pub(super) expectation: String,
    /// What would refute it.
    pub(super) refuted_if: String,
    /// Remedies that are known but not built.
    #[serde(default)]
    pub(super) not_built: Option<String>,
    /// Values of the swept parameter, ascending.
    pub(super) sweep: Vec<f64>,
    /// Photons in a full disc, or in all where the mode says so.
    pub(super) photons: f64,
    /// Repetitions at quick budget.
    pub(super) replicates: u64,
    /// A value below this need not be known to a share of itself, but to that share of this.
    #[serde(default = "tenth")]
    pub(super) least: f64,
}

fn tenth() -> f64 {
    0.1
}

/// A number that depends on the swept parameter.
pub(super) type Law = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// One repetition: for each value of the swept parameter in turn, one number for each curve, whose mean the curve's law is.
pub(super) type Trial = Box<dyn Fn(&[f64], &mut Stream, &mut Scratch) -> anyhow::Result<Vec<f64>> + Send + Sync>;

/// One way of failing.
pub(super) struct Mode {
    /// Its name everywhere.
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    /// The swept parameter.
    pub(super) x: Axis,
    /// What is read.
    pub(super) y: Axis,
    /// What should be read, with its name, where that is not 1 everywhere.
    pub(super) truth: Option<(&'static str, Law)>,
    /// True if the laws hold between the swept values too.
    pub(super) between: bool,
    pub(super) curves: Vec<Curve>,
    pub(super) trial: Trial,
}

/// What one estimate reads.
pub(super) struct Curve {
    pub(super) label: String,
    /// True if this is the method with a remedy.
    pub(super) remedy: bool,
    pub(super) law: Law,
    /// Where the law comes from.
    pub(super) source: &'static str,
}

impl Curve {
    /// The method as it fails.
    pub(super) fn off(
        label: impl Into<String>,
        source: &'static str,
        law: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self { label: label.into(), remedy: false, law: Box::new(law), source }
    }

    /// The method with a remedy.
    pub(super) fn on(
        label: impl Into<String>,
        source: &'static str,
        law: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self { remedy: true, ..Self::off(label, source, law) }
    }
}

/// A trial that does the same for each value on its own.
pub(super) fn each<const N: usize>(
    one: impl Fn(f64, &mut Stream, &mut Scratch) -> anyhow::Result<[f64; N]> + Send + Sync + 'static,
) -> Trial {
    Box::new(move |sweep, stream, scratch| {
        let mut values = Vec::with_capacity(N * sweep.len());
        for &x in sweep {
            values.extend(one(x, stream, scratch)?);
        }
        Ok(values)
    })
}

/// A mode that was measured.
pub(super) struct Measured {
    pub(super) mode: Mode,
    pub(super) part: Part,
    pub(super) replicates: u64,
    /// For each curve its readings along the sweep.
    pub(super) readings: Vec<Vec<Replicates>>,
}

impl Mode {
    /// Measures it with random numbers of its own.
    pub(super) fn measure(self, part: Part, seed: u64, group: u64, times: u64) -> anyhow::Result<Measured> {
        let replicates = part.replicates * times;
        let columns =
            Trials { seed, group, replicates }.run(|stream, scratch| (self.trial)(&part.sweep, stream, scratch))?;
        let curves = self.curves.len();
        anyhow::ensure!(
            columns.len() == curves * part.sweep.len(),
            "{}: a trial gives {} numbers for {curves} curves of {} points",
            self.id,
            columns.len(),
            part.sweep.len()
        );
        let readings = (0..curves).map(|curve| columns.iter().skip(curve).step_by(curves).copied().collect()).collect();
        Ok(Measured { mode: self, part, replicates, readings })
    }
}
