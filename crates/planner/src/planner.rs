//! The race.

use std::time::{Duration, Instant};

use photonlab_readout::{Cell, CellResult, Ends, ReadError, Session};

use crate::{
    Candidate, Forecast,
    field::Field,
    plan::{Entrant, Plan},
    trial::Trial,
};

/// Passes up to which a run goes on as it has begun; where more would be needed, longer passes spare what each costs by itself.
const MOST_PASSES: u64 = 160;
/// Passes of such a run: many tell the error bar well.
const AIM: f64 = 56.0;
/// The next length of passes over the last.
const LONGER: f64 = 16.0;
/// Passes that longer ones are tried by.
const TRIED_BY: f64 = 4.0;
/// What longer passes may cost of what the best still needs.
const WORTH: f64 = 0.1;
/// Passes are no longer than this many times the shortest while nothing has been found to foretell by.
const LONGEST_IN_THE_DARK: f64 = 256.0;
/// A candidate that does much before its first pass enters where the best of the others still needs so many seconds.
const LATE: f64 = 5.0;
/// Of a time limit pilots take this share at most.
const OF_LIMIT: f64 = 0.2;

/// What is to be read, and how well.
pub struct Planner<'p, 'c, const C: usize> {
    /// The scene; its settings are those of each candidate in turn.
    pub session: Session<'c, C>,
    /// What is read.
    pub cells: &'c [Cell],
    /// The wanted relative half-width.
    pub target: f64,
    /// Wall time for all, pilots included.
    pub time_limit: Option<Duration>,
    /// Wall time for pilots.
    pub patience: Option<Duration>,
    /// True for what a cell has found if its error bar can be signed.
    pub trusts: &'p dyn Fn(&CellResult<C>) -> bool,
}

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanningError {
    /// No candidate was given.
    #[error("no method reads what is asked for")]
    NoCandidate,
    /// None of them could run.
    #[error(transparent)]
    Read(#[from] ReadError),
}

impl<'c, const C: usize> Planner<'_, 'c, C> {
    /// Lets candidates run until one is chosen.
    pub fn race(&self, candidates: &[Candidate]) -> Result<Plan<'c, C>, PlanningError> {
        let start = Instant::now();
        let of_limit = self.time_limit.map(|limit| limit.mul_f64(OF_LIMIT));
        let deadline = self.patience.into_iter().chain(of_limit).min().map(|patience| start + patience);
        let mut foretold = vec![None; candidates.len()];
        let mut field = Field {
            trials: Vec::new(),
            target: self.target,
            trusts: self.trusts,
            deadline,
            foretold: &mut foretold,
            lost: 0.0,
            failure: None,
        };
        let numbered = || candidates.iter().copied().enumerate();
        self.enter(&mut field, numbered().filter(|(_, candidate)| !candidate.starts_slowly()), 1.0);
        field.halve();
        if field.best().is_none_or(|best| best.seconds > LATE) && !field.is_late() {
            let scale = field.trials.first().map_or(1.0, |best| best.scale);
            self.enter(&mut field, numbered().filter(|(_, candidate)| candidate.starts_slowly()), scale);
        }
        loop {
            field.halve();
            let Some(scale) = self.next_scale(&field) else { break };
            let still: Vec<_> = field.trials.iter().map(|trial| (trial.number, trial.candidate)).collect();
            field.lost += field.trials.drain(..).map(|trial| trial.spent()).sum::<f64>();
            self.enter(&mut field, still.into_iter(), scale);
        }
        let failure = field.failure.take();
        let Some(winner) = field.trials.into_iter().next() else {
            return Err(failure.map_or(PlanningError::NoCandidate, PlanningError::Read));
        };
        let pilots = start.elapsed();
        let entrants = candidates.iter().zip(foretold).map(|(&candidate, forecast)| Entrant { candidate, forecast });
        let forecast = entrants.clone().nth(winner.number).and_then(|entrant| entrant.forecast);
        let (chosen, (winner, forecast)) = (winner.number, self.go_on_with(winner, forecast, start)?);
        Ok(Plan { entrants: entrants.collect(), chosen, forecast, pilots, winner })
    }

    fn enter(&self, field: &mut Field<'_, 'c, C>, candidates: impl Iterator<Item = (usize, Candidate)>, scale: f64) {
        let ends = Ends { passes: None, target_error: Some(self.target), time_limit: self.time_limit };
        for entrant in candidates {
            match Trial::new(&self.session, self.cells, entrant, scale, ends) {
                Ok(trial) => field.trials.push(trial),
                Err(error) => {
                    field.failure.get_or_insert(error);
                }
            }
        }
    }

    /// The length of longer passes, if they are worth a try: several are left, and it costs little of what the best still needs. Where nothing
    /// could be foretold, longer passes may find something.
    fn next_scale(&self, field: &Field<'_, 'c, C>) -> Option<f64> {
        let first = field.trials.first()?;
        let longer = LONGER * first.scale;
        if field.is_late() {
            return None;
        }
        let Some(best) = field.best() else { return (longer <= LONGEST_IN_THE_DARK).then_some(longer) };
        let cost: f64 = field.trials.iter().map(|trial| TRIED_BY * LONGER * trial.seconds_of_pass()).sum();
        let is_worth = field.trials.len() > 1 && best.passes > MOST_PASSES && cost <= WORTH * best.seconds;
        is_worth.then_some(longer)
    }

    /// The run that is gone on with: the winner's own, or one of longer passes if it would need too many.
    fn go_on_with(
        &self,
        winner: Trial<'c, C>,
        forecast: Option<Forecast>,
        start: Instant,
    ) -> Result<(Trial<'c, C>, Option<Forecast>), ReadError> {
        let passes = forecast.map_or(u64::MAX, |forecast| forecast.passes);
        if passes <= MOST_PASSES {
            return Ok((winner, forecast));
        }
        let left = self.time_limit.map(|limit| limit.saturating_sub(start.elapsed()));
        let seconds = forecast.map_or(f64::INFINITY, |forecast| forecast.seconds);
        let in_time = left.map_or(1.0, |left| (left.as_secs_f64() / seconds).min(1.0));
        let usual = LONGEST_IN_THE_DARK / 4.0;
        let longer = if forecast.is_some() { passes as f64 * in_time / AIM } else { usual / winner.scale };
        if longer <= 1.0 {
            return Ok((winner, forecast));
        }
        let ends = Ends { passes: None, target_error: Some(self.target), time_limit: left };
        let entrant = (winner.number, winner.candidate);
        let trial = Trial::new(&self.session, self.cells, entrant, winner.scale * longer, ends)?;
        let shorter = trial.work_of_pass() / winner.work_of_pass();
        Ok((trial, forecast.map(|forecast| forecast.in_passes((passes as f64 / shorter).ceil() as u64))))
    }
}
