//! The race.

use std::time::{Duration, Instant};

use photonlab_readout::{Cell, CellResult, Ends, ReadError, Session};

use crate::{
    Candidate,
    field::Field,
    gain::Gain,
    plan::{Entrant, Plan, Standing, Why},
    trial::Trial,
};

/// Passes up to which a run goes on as it has begun; where more would be needed, longer passes spare what each costs by itself.
pub(crate) const MOST_PASSES: u64 = 160;
/// Passes of the run that goes on after which its time is told, if that is no more than half of them.
pub(crate) const SETTLED: u64 = 24;
/// How often others enter after all.
const MOST_ROUNDS: u32 = 4;
/// The next length of passes over the last: the error of evenly spread points falls faster within a pass than over passes, and not of every method
/// alike.
const LONGER: f64 = 4.0;
/// Passes that longer ones are tried by.
const TRIED_BY: f64 = 4.0;
/// Longer passes may be foretold to be slower by this factor, by chance.
const HARDLY_SLOWER: f64 = 1.2;
/// What longer passes may cost of what the best still needs.
const WORTH: f64 = 0.1;
/// Passes are no longer than this many times the shortest while nothing has been found to foretell by, nor tried for so many seconds.
pub(crate) const LONGEST_IN_THE_DARK: f64 = 256.0;
const SECONDS_IN_THE_DARK: f64 = 5.0;
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

impl<'p, 'c, const C: usize> Planner<'p, 'c, C> {
    /// Lets candidates run until one is chosen.
    pub fn race(&self, candidates: &[Candidate]) -> Result<Plan<'c, C>, PlanningError> {
        let start = Instant::now();
        let mut field = self.field(start, candidates.len());
        let mut gain = Gain::default();
        // Few passes may agree by luck, and seem to be done: others enter then after all.
        for _ in 0..MOST_ROUNDS {
            self.enter_all(&mut field, candidates, start);
            self.lengthen(&mut field, &mut gain, start);
            let begins_anew = field.best().is_some_and(|best| best.passes > MOST_PASSES);
            if begins_anew || field.is_late() || field.settle(SETTLED) {
                break;
            }
        }
        let pilots = start.elapsed();
        let (standings, failure) = (std::mem::take(&mut field.standings), field.failure.take());
        let (Some(winner), forecast) = field.winner(&standings) else {
            return Err(failure.map_or(PlanningError::NoCandidate, PlanningError::Read));
        };
        let standings = candidates.iter().zip(standings);
        let entrants = standings.map(|(&candidate, standing)| Entrant { candidate, standing }).collect();
        let chosen = winner.number;
        let (winner, forecast) = self.go_on_with(winner, (forecast, gain.expected()), start)?;
        let (winner, forecast) = self.settle(winner, forecast, start)?;
        Ok(Plan { entrants, chosen, forecast, pilots, winner })
    }

    /// Lets those that are left run longer passes as long as that is worth a try.
    fn lengthen(&self, field: &mut Field<'p, 'c, C>, gain: &mut Gain, start: Instant) {
        loop {
            field.halve();
            let Some((scale, by)) = self.next_scale(field, start) else { return };
            let (before, standings) = (field.best(), field.standings.clone());
            let mut shorter = std::mem::take(&mut field.trials);
            let number = shorter.first().map(|trial| trial.number);
            let mut tried = 0;
            for trial in &shorter {
                let is_long_dark = before.is_none() && start.elapsed().as_secs_f64() > SECONDS_IN_THE_DARK;
                if field.is_decided() || field.is_late() || is_long_dark {
                    break;
                }
                field.enter(trial.number, self.trial((trial.number, trial.candidate), scale, start));
                tried += 1;
            }
            field.rank();
            match (before, field.best()) {
                (Some(before), Some(now)) if now.seconds <= HARDLY_SLOWER * before.seconds => {
                    // What longer passes gain is told by one candidate's, not by two.
                    match field.trials.first().map(|trial| trial.number) == number {
                        true => gain.add(before, now, by),
                        false => *gain = Gain::default(),
                    }
                }
                (None, _) if !field.trials.is_empty() => {}
                // Longer passes are slower, or foretell nothing.
                _ => {
                    (field.trials, field.standings) = (shorter, standings);
                    return;
                }
            }
            // Who was not tried at this length stays with shorter passes.
            field.trials.extend(shorter.drain(tried..));
            field.rank();
        }
    }

    fn field(&self, start: Instant, candidates: usize) -> Field<'p, 'c, C> {
        Field {
            trials: Vec::new(),
            target: self.target,
            trusts: self.trusts,
            deadline: self.deadline(start),
            standings: vec![Standing::NotRaced(Why::DoneSoon); candidates],
            entered: 0.0,
            spent: 0.0,
            failure: None,
        }
    }

    /// When pilots end, whatever is known by then.
    pub(crate) fn deadline(&self, start: Instant) -> Option<Instant> {
        let of_limit = self.time_limit.map(|limit| limit.mul_f64(OF_LIMIT));
        self.patience.into_iter().chain(of_limit).min().map(|patience| start + patience)
    }

    pub(crate) fn trial(
        &self,
        entrant: (usize, Candidate),
        scale: f64,
        start: Instant,
    ) -> Result<Trial<'c, C>, ReadError> {
        let ends = Ends { passes: None, target_error: Some(self.target), time_limit: self.time_left(start) };
        Trial::new(&self.session, self.cells, entrant, scale, ends)
    }

    pub(crate) fn time_left(&self, start: Instant) -> Option<Duration> {
        self.time_limit.map(|limit| limit.saturating_sub(start.elapsed()))
    }

    /// The length of longer passes, and by how much they are longer, if they are worth a try: they say more of how long the best takes, and cost
    /// little of that. Where nothing could be foretold, longer passes may find something.
    fn next_scale(&self, field: &Field<'p, 'c, C>, start: Instant) -> Option<(f64, f64)> {
        let first = field.trials.first()?;
        let (scale, by) = first.longer(LONGER);
        // Others are tried after it as long as that is worth it.
        let cost = TRIED_BY * by * first.seconds_of_pass();
        let left = field.deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()).as_secs_f64());
        let in_time = left.is_none_or(|left| cost <= left);
        // Passes that hold all they may hold do not grow.
        if by < 2.0 || !in_time {
            return None;
        }
        let is_worth = match field.best() {
            Some(best) => best.passes > MOST_PASSES && cost <= WORTH * best.seconds,
            None => scale <= LONGEST_IN_THE_DARK && start.elapsed().as_secs_f64() + cost <= SECONDS_IN_THE_DARK,
        };
        is_worth.then_some((scale, by))
    }
}
