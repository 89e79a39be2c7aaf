//! The race.

use std::time::{Duration, Instant};

use photonlab_readout::{Cell, CellResult, Ends, ErrorOver, ReadError, Session};

use crate::{
    Candidate, Forecast,
    candidate::Heat,
    field::Field,
    gain::Gain,
    plan::{Entrant, Plan, Standing, Why},
    trial::Trial,
};

/// Passes up to which a run goes on as it has begun; where more would be needed, longer passes spare what each costs by itself.
const MOST_PASSES: u64 = 160;
/// Passes of such a run: of meters many tell the error bar well; of an image's pixels, which are many themselves, fewer and longer ones have
/// more evenly spread points.
const METERS_PASSES: f64 = 56.0;
const FEW_PASSES: f64 = 20.0;
/// Passes of the run that goes on after which its time is told, if that is no more than half of them.
const SETTLED: u64 = 24;
/// How often others enter after all.
const MOST_ROUNDS: u32 = 4;
/// Fewer passes of a run tell less of its noise than shorter ones told before.
const FEWEST_TELLING: u64 = 4;
/// The next length of passes over the last: the error of evenly spread points falls faster within a pass than over passes, and not of every method
/// alike.
const LONGER: f64 = 4.0;
/// Passes that longer ones are tried by.
const TRIED_BY: f64 = 4.0;
/// What longer passes may cost of what the best still needs.
const WORTH: f64 = 0.1;
/// Passes are no longer than this many times the shortest while nothing has been found to foretell by, nor tried for so many seconds.
const LONGEST_IN_THE_DARK: f64 = 256.0;
const SECONDS_IN_THE_DARK: f64 = 5.0;
/// Passes are so many times more where each draws wavelengths of its own.
const FINER: f64 = 4.0;
/// Passes that a time limit should hold at least.
const PASSES_IN_TIME: f64 = 20.0;
/// What starts slowly enters where the best of the others still needs so many seconds.
const LATE: f64 = 5.0;
/// Of a time limit pilots take this share at most.
const OF_LIMIT: f64 = 0.2;
/// Longer passes that need fewer photons and rays in all by such a power of their length should be few.
const STEEP: f64 = 0.4;
/// A run of longer passes begins anew if it needs less than this share of what is left of the winner's own.
const ANEW: f64 = 0.8;

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
            let shorter = std::mem::take(&mut field.trials);
            for trial in &shorter {
                if field.is_decided() {
                    break;
                }
                field.enter(trial.number, self.trial((trial.number, trial.candidate), scale, start));
            }
            field.rank();
            match (before, field.best()) {
                (Some(before), Some(now)) if now.low <= before.high => gain.add(before, now, by),
                (None, _) if !field.trials.is_empty() => {}
                // Longer passes are slower, or foretell nothing.
                _ => {
                    (field.trials, field.standings) = (shorter, standings);
                    return;
                }
            }
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
    fn deadline(&self, start: Instant) -> Option<Instant> {
        let of_limit = self.time_limit.map(|limit| limit.mul_f64(OF_LIMIT));
        self.patience.into_iter().chain(of_limit).min().map(|patience| start + patience)
    }

    /// Lets the run that goes on do some of its passes, which count, before its time is told: four of them know their noise within a factor of two.
    fn settle(
        &self,
        mut winner: Trial<'c, C>,
        forecast: Option<Forecast>,
        start: Instant,
    ) -> Result<(Trial<'c, C>, Option<Forecast>), ReadError> {
        let Some(before) = forecast else { return Ok((winner, None)) };
        let deadline = self.deadline(start);
        let enough = SETTLED.min(before.passes / 2);
        while winner.ongoing.passes() < enough && deadline.is_none_or(|deadline| Instant::now() < deadline) {
            winner.pass()?;
        }
        // A first pass tells no noise.
        let known = winner.ongoing.passes() >= FEWEST_TELLING;
        let now = if known { winner.forecast(self.target) } else { None };
        Ok((winner, now.or(forecast)))
    }

    /// Lets candidates run their first passes: at once, or after a look at those before them, if they enter at all.
    fn enter_all(&self, field: &mut Field<'p, 'c, C>, candidates: &[Candidate], start: Instant) {
        let waits = |standing: &Standing| {
            matches!(standing, Standing::NotRaced(Why::DoneSoon | Why::KinIsBehind | Why::StartsSlowly))
        };
        let waiting: Vec<bool> = field.standings.iter().map(waits).collect();
        let in_heat = |heat: Heat| {
            let all = candidates.iter().copied().enumerate();
            all.filter(|(number, it)| waiting[*number] && it.heat() == heat).collect::<Vec<_>>()
        };
        let mut slow_ones_entered = false;
        for (number, candidate) in in_heat(Heat::First) {
            if field.is_decided() {
                return;
            }
            self.enter_unless_late(field, (number, candidate), start);
            // What starts slowly and then is quick is tried before what hardly ever wins.
            if !slow_ones_entered && field.soonest().is_some_and(|best| best.low > LATE) {
                in_heat(Heat::IfTimeIsLeft)
                    .into_iter()
                    .for_each(|entrant| self.enter_unless_late(field, entrant, start));
                slow_ones_entered = true;
            }
        }
        field.halve();
        let kin_is_left = field.trials.is_empty()
            || field.trials.iter().any(|trial| trial.candidate.settings.method.is_direct_view());
        let time_is_left = field.best().is_none_or(|best| best.seconds > LATE);
        let kin = (Heat::IfKinIsLeft, kin_is_left, Why::KinIsBehind);
        let slow = (Heat::IfTimeIsLeft, time_is_left, Why::StartsSlowly);
        for (heat, enters, why_not) in [kin].into_iter().chain((!slow_ones_entered).then_some(slow)) {
            for (number, candidate) in in_heat(heat) {
                if enters {
                    self.enter_unless_late(field, (number, candidate), start);
                } else {
                    field.standings[number] = Standing::NotRaced(why_not);
                }
            }
        }
    }

    /// One runs however late it is.
    fn enter_unless_late(&self, field: &mut Field<'p, 'c, C>, entrant: (usize, Candidate), start: Instant) {
        if field.is_late() && !field.trials.is_empty() {
            field.standings[entrant.0] = Standing::NotRaced(Why::NoTimeLeft);
        } else {
            field.enter(entrant.0, self.trial(entrant, 1.0, start));
        }
    }

    fn trial(&self, entrant: (usize, Candidate), scale: f64, start: Instant) -> Result<Trial<'c, C>, ReadError> {
        let ends = Ends { passes: None, target_error: Some(self.target), time_limit: self.time_left(start) };
        Trial::new(&self.session, self.cells, entrant, scale, ends)
    }

    fn time_left(&self, start: Instant) -> Option<Duration> {
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

    /// The run that is gone on with: the winner's own, or one of longer passes if it would need too many.
    fn go_on_with(
        &self,
        winner: Trial<'c, C>,
        (forecast, gain): (Option<Forecast>, f64),
        start: Instant,
    ) -> Result<(Trial<'c, C>, Option<Forecast>), ReadError> {
        let passes = forecast.map_or(u64::MAX, |forecast| forecast.passes);
        let aim = match self.session.error_over {
            ErrorOver::Worst if gain < STEEP => METERS_PASSES,
            ErrorOver::Worst | ErrorOver::Image => FEW_PASSES,
        };
        let aim = if self.session.demands().draws_wavelengths { FINER * aim } else { aim };
        let for_target = match forecast {
            Some(_) => (passes as f64 / aim).powf(1.0 / (1.0 + gain)),
            None => LONGEST_IN_THE_DARK / winner.scale,
        };
        let left = self.time_left(start).map_or(f64::INFINITY, |left| left.as_secs_f64());
        let in_time = left / (PASSES_IN_TIME * winner.seconds_of_pass());
        let (scale, by) = winner.longer(for_target.min(in_time));
        let anew = forecast.map(|forecast| forecast.in_longer_passes(by, gain));
        let pays = forecast.zip(anew).is_none_or(|(own, anew)| anew.seconds < ANEW * (own.seconds - winner.spent()));
        if by <= 1.0 || passes <= MOST_PASSES && !pays {
            return Ok((winner, forecast));
        }
        let trial = self.trial((winner.number, winner.candidate), scale, start)?;
        Ok((trial, anew))
    }
}
