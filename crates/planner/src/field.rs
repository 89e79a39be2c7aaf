//! The candidates that are still in the race.

use std::time::Instant;

use photonlab_readout::{CellResult, ReadError};

use crate::{Forecast, trial::Trial};

/// Passes after which the slow are dropped, and how many of the rest go on.
const ROUNDS: [(u64, usize); 4] = [(4, 6), (8, 3), (16, 2), (32, 1)];
/// A round of all that are left may cost this share of what the best still needs.
const WORTH: f64 = 0.1;

/// Candidates at one length of passes.
pub(crate) struct Field<'p, 'c, const C: usize> {
    /// The best first.
    pub(crate) trials: Vec<Trial<'c, C>>,
    pub(crate) target: f64,
    /// True for what a cell has found if its error bar can be signed.
    pub(crate) trusts: &'p dyn Fn(&CellResult<C>) -> bool,
    /// When pilots end, whatever is known by then.
    pub(crate) deadline: Option<Instant>,
    /// What has been foretold of each candidate last.
    pub(crate) foretold: &'p mut [Option<Forecast>],
    /// Seconds that those have spent which are out.
    pub(crate) lost: f64,
    /// Why one of them could not run.
    pub(crate) failure: Option<ReadError>,
}

impl<const C: usize> Field<'_, '_, C> {
    /// Runs all in rounds until one is left, or is done, or more rounds cost more than they are worth.
    pub(crate) fn halve(&mut self) {
        for (passes, kept) in ROUNDS {
            self.run_to(passes);
            self.rank();
            self.keep(kept);
            if self.trials.len() < 2 || self.is_late() || self.trials[0].has_reached(self.target) {
                return;
            }
            let next: f64 = self.trials.iter().map(|trial| trial.seconds_of_pass() * passes as f64).sum();
            let left = self.best().map_or(f64::INFINITY, |best| best.seconds - self.trials[0].spent());
            if next > WORTH * left {
                return;
            }
        }
    }

    /// What is foretold of the best.
    pub(crate) fn best(&self) -> Option<Forecast> {
        self.foretold[self.trials.first()?.number]
    }

    pub(crate) fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// A candidate that fails is out.
    fn run_to(&mut self, passes: u64) {
        let mut running = std::mem::take(&mut self.trials);
        running.retain_mut(|trial| {
            while trial.ongoing.passes() < passes && !(self.is_late() && trial.ongoing.passes() >= 2) {
                if let Err(error) = trial.pass() {
                    self.lost += trial.spent();
                    self.failure.get_or_insert(error);
                    return false;
                }
            }
            true
        });
        self.trials = running;
    }

    /// The best first: whose error bars can be signed before others, and of these the soonest.
    fn rank(&mut self) {
        for trial in &self.trials {
            self.foretold[trial.number] = trial.forecast(self.target);
        }
        let key = |trial: &Trial<'_, C>| {
            let is_trusted = trial.ongoing.cells().iter().all(self.trusts);
            let seconds = self.foretold[trial.number].map_or(f64::INFINITY, |forecast| forecast.seconds);
            (!is_trusted, seconds)
        };
        let mut keyed: Vec<_> =
            std::mem::take(&mut self.trials).into_iter().map(|trial| (key(&trial), trial)).collect();
        keyed.sort_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        self.trials = keyed.into_iter().map(|(_, trial)| trial).collect();
    }

    /// Drops those that can hardly be the soonest, and the last beyond a number. Where nothing is foretold of any, all stay.
    fn keep(&mut self, most: usize) {
        let Some(best) = self.best() else { return };
        let may_win = |trial: &Trial<'_, C>| self.foretold[trial.number].is_some_and(|it| it.low <= best.high);
        let stay = self.trials.iter().take(most).take_while(|trial| may_win(trial)).count().max(1);
        self.lost += self.trials.drain(stay..).map(|trial| trial.spent()).sum::<f64>();
    }
}
