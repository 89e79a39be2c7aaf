//! Independent repetitions of one experiment.

use photonlab_gather::Scratch;
use photonlab_measure::Replicates;
use photonlab_sampling::Stream;
use rayon::prelude::*;

use super::field::stream;

/// Repetitions run by one task; part of the last bits of a result, since sums run within it first.
const CHUNK: u64 = 256;

/// How often, and with which random numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trials {
    pub(super) seed: u64,
    /// Trials of different groups share no random number; below 2^28.
    pub(super) group: u64,
    pub(super) replicates: u64,
}

impl Trials {
    /// Runs `trial`, which returns the same number of values each time, and collects each value over the repetitions.
    pub(super) fn run(
        &self,
        trial: impl Fn(&mut Stream, &mut Scratch) -> anyhow::Result<Vec<f64>> + Sync,
    ) -> anyhow::Result<Vec<Replicates>> {
        let chunk = |number: u64| -> anyhow::Result<Vec<Replicates>> {
            let mut scratch = Scratch::default();
            let mut columns = Vec::new();
            for replicate in number * CHUNK..((number + 1) * CHUNK).min(self.replicates) {
                let values = trial(&mut stream(self.seed, self.group << 32 | replicate), &mut scratch)?;
                columns.resize(values.len(), Replicates::new());
                columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
            }
            Ok(columns)
        };
        let parts: Vec<_> =
            (0..self.replicates.div_ceil(CHUNK)).into_par_iter().map(chunk).collect::<anyhow::Result<_>>()?;
        let mut parts = parts.into_iter();
        let mut whole = parts.next().unwrap_or_default();
        for part in parts {
            whole.iter_mut().zip(&part).for_each(|(column, more)| column.merge(more));
        }
        Ok(whole)
    }
}
