//! The candidates that are still in the race.

use std::time::Instant;

use photonlab_readout::{CellResult, ReadError};

use crate::{
    Forecast,
    plan::{Standing, Why},
    trial::Trial,
};

/// Passes that a candidate enters with.
const FIRST_PASSES: u64 = 4;
/// Passes after which the slow are dropped, and how many of the rest go on.
const ROUNDS: [(u64, usize); 4] = [(FIRST_PASSES, 6), (8, 3), (16, 2), (32, 1)];
/// A round of all that are left may cost this share of what the best still needs.
const WORTH: f64 = 0.1;
/// No other enters where the best is done within so many seconds, or first passes would take more than this share of what it needs.
const SOON: f64 = 0.1;
const MOST_LOST: f64 = 0.25;

/// Candidates at one length of passes.
pub(crate) struct Field<'p, 'c, const C: usize> {
    /// Once ranked, the best first.
    pub(crate) trials: Vec<Trial<'c, C>>,
    pub(crate) target: f64,
    /// True for what a cell has found if its error bar can be signed.
    pub(crate) trusts: &'p dyn Fn(&CellResult<C>) -> bool,
    /// When pilots end, whatever is known by then.
    pub(crate) deadline: Option<Instant>,
    /// How each candidate stood last.
    pub(crate) standings: Vec<Standing>,
    /// How many have entered, and what their first passes took, seconds.
    pub(crate) entered: f64,
    pub(crate) spent: f64,
    /// Why one of them could not run.
    pub(crate) failure: Option<ReadError>,
}

impl<'c, const C: usize> Field<'_, 'c, C> {
    /// Lets one more run its first passes.
    pub(crate) fn enter(&mut self, number: usize, trial: Result<Trial<'c, C>, ReadError>) {
        match trial.and_then(|mut trial| self.run_to(&mut trial, FIRST_PASSES).map(|()| trial)) {
            Ok(trial) => {
                self.entered += 1.0;
                self.spent += trial.spent();
                self.foretell(&trial);
                self.trials.push(trial);
                self.drop_the_hopeless();
            }
            Err(error) => self.fail(number, error),
        }
    }

    fn fail(&mut self, number: usize, error: ReadError) {
        self.standings[number] = Standing::NotRaced(Why::Failed);
        self.failure.get_or_insert(error);
    }

    /// What has been found by many is much to keep: those that can hardly be the soonest are dropped as soon as that is known.
    fn drop_the_hopeless(&mut self) {
        let Some(best) = self.soonest() else { return };
        let standings = &self.standings;
        self.trials.retain(|trial| standings[trial.number].forecast().is_none_or(|forecast| forecast.low <= best.high));
    }

    /// Runs all in rounds until one is left, or is done, or more rounds cost more than they are worth.
    pub(crate) fn halve(&mut self) {
        for (passes, kept) in ROUNDS {
            for mut trial in std::mem::take(&mut self.trials) {
                // One that fails is out.
                match self.run_to(&mut trial, passes) {
                    Ok(()) => self.trials.push(trial),
                    Err(error) => self.fail(trial.number, error),
                }
            }
            self.rank();
            self.keep(kept);
            // Where nothing is foretold more of the same tells little.
            if self.trials.len() < 2
                || self.best().is_none()
                || self.is_late()
                || self.trials[0].has_reached(self.target)
            {
                return;
            }
            let next: f64 = self.trials.iter().map(|trial| trial.seconds_of_pass() * passes as f64).sum();
            let left = self.best().map_or(0.0, |best| best.seconds - self.trials[0].spent());
            if next > WORTH * left {
                return;
            }
        }
    }

    /// What is foretold of the first in the field.
    pub(crate) fn best(&self) -> Option<Forecast> {
        self.standings[self.trials.first()?.number].forecast()
    }

    /// What is foretold of the soonest, whether they have been ranked or not.
    pub(crate) fn soonest(&self) -> Option<Forecast> {
        Some(self.soonest_trial()?.1)
    }

    fn soonest_trial(&self) -> Option<(&Trial<'c, C>, Forecast)> {
        let forecasts = self.trials.iter().filter_map(|trial| Some((trial, self.standings[trial.number].forecast()?)));
        forecasts.min_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds))
    }

    /// True if another would cost more than it may: the best is nearly done, or the first passes of all but the best, with those of one more,
    /// take too large a share of what the best needs.
    pub(crate) fn is_decided(&self) -> bool {
        self.soonest_trial().is_some_and(|(best, forecast)| {
            let lost = self.spent - best.spent() + self.spent / self.entered;
            forecast.high <= SOON || lost > MOST_LOST * forecast.seconds
        })
    }

    pub(crate) fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    fn run_to(&self, trial: &mut Trial<'c, C>, passes: u64) -> Result<(), ReadError> {
        while trial.ongoing.passes() < passes && !(self.is_late() && trial.ongoing.passes() >= 2) {
            trial.pass()?;
        }
        Ok(())
    }

    fn foretell(&mut self, trial: &Trial<'c, C>) {
        self.standings[trial.number] = trial.forecast(self.target).map_or(Standing::OutOfReach, Standing::Foretold);
    }

    /// The best first: whose error bars can be signed before others, of these the soonest, and of those of which nothing is foretold who has found
    /// most.
    pub(crate) fn rank(&mut self) {
        let trials = std::mem::take(&mut self.trials);
        trials.iter().for_each(|trial| self.foretell(trial));
        let key = |trial: &Trial<'c, C>| {
            let is_trusted = trial.ongoing.cells().iter().all(self.trusts);
            let seconds = self.standings[trial.number].forecast().map_or(f64::INFINITY, |forecast| forecast.seconds);
            (!is_trusted, seconds, std::cmp::Reverse(trial.found()))
        };
        let mut keyed: Vec<_> = trials.into_iter().map(|trial| (key(&trial), trial)).collect();
        keyed.sort_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then_with(|| a.2.cmp(&b.2)));
        self.trials = keyed.into_iter().map(|(_, trial)| trial).collect();
    }

    /// Lets the first do some of the passes that count if it goes on, before its time is told; true if it is still the first, and hardly slower
    /// than it was thought to be.
    pub(crate) fn settle(&mut self, most: u64) -> bool {
        let Some(before) = self.best() else { return true };
        let mut first = self.trials.remove(0);
        let number = first.number;
        let done = self.run_to(&mut first, most.min(before.passes / 2));
        match done {
            Ok(()) => self.trials.insert(0, first),
            Err(error) => self.fail(number, error),
        }
        self.rank();
        let is_first = self.trials.first().is_some_and(|trial| trial.number == number);
        is_first && self.best().is_some_and(|now| now.seconds <= before.high)
    }

    /// The winner: where nothing is foretold of the first, the first of which something is, if there is one.
    pub(crate) fn winner(self, standings: &[Standing]) -> (Option<Trial<'c, C>>, Option<Forecast>) {
        let foretold = |trial: &Trial<'c, C>| standings[trial.number].forecast();
        let place = self.trials.iter().position(|trial| foretold(trial).is_some()).unwrap_or(0);
        let forecast = self.trials.get(place).and_then(foretold);
        (self.trials.into_iter().nth(place), forecast)
    }

    /// Drops those that can hardly be the soonest, and the last beyond a number. Where nothing is foretold of the first, all stay; and who is
    /// still in the dark while that costs little.
    fn keep(&mut self, most: usize) {
        let Some(best) = self.best() else { return };
        let (mut kept, mut on_those_in_the_dark) = (0, 0.0);
        let standings = &self.standings;
        self.trials.retain(|trial| match standings[trial.number].forecast() {
            Some(forecast) => {
                let may_win = kept < most && (kept == 0 || forecast.low <= best.high);
                kept += usize::from(may_win);
                may_win
            }
            None => {
                let with_it = on_those_in_the_dark + trial.spent();
                let stays = trial.is_in_the_dark() && with_it <= WORTH * best.seconds;
                on_those_in_the_dark += if stays { trial.spent() } else { 0.0 };
                stays
            }
        });
    }
}
