//! The run that is gone on with.

use std::time::Instant;

use photonlab_readout::{ErrorOver, ReadError};

use crate::{
    Forecast, Planner,
    planner::{LONGEST_IN_THE_DARK, MOST_PASSES, SETTLED},
    trial::Trial,
};

/// Passes of such a run: of meters many tell the error bar well; of an image's pixels, which are many themselves, fewer and longer ones have
/// more evenly spread points.
const METERS_PASSES: f64 = 56.0;
const FEW_PASSES: f64 = 20.0;
/// Fewer passes of a run tell less of its noise than shorter ones told before.
const FEWEST_TELLING: u64 = 4;
/// Nobody waits longer than so many seconds for the time to be told, once it can be.
const LONGEST_SETTLING: f64 = 2.0;
/// Passes are so many times more where each draws wavelengths of its own.
const FINER: f64 = 4.0;
/// Passes that a time limit should hold at least.
const PASSES_IN_TIME: f64 = 20.0;
/// Longer passes that need fewer photons and rays in all by such a power of their length should be few.
const STEEP: f64 = 0.4;
/// A run of longer passes begins anew if it needs less than this share of what is left of the winner's own.
const ANEW: f64 = 0.8;

impl<'c, const C: usize> Planner<'_, 'c, C> {
    /// The run that is gone on with: the winner's own, or one of longer passes if it would need too many.
    pub(crate) fn go_on_with(
        &self,
        winner: Trial<'c, C>,
        (forecast, gain): (Option<Forecast>, f64),
        start: Instant,
    ) -> Result<(Trial<'c, C>, Option<Forecast>), ReadError> {
        let gain = gain.max(0.0);
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

    /// Lets the run that goes on do some of its passes, which count, before its time is told: four of them know their noise within a factor of two.
    pub(crate) fn settle(
        &self,
        mut winner: Trial<'c, C>,
        forecast: Option<Forecast>,
        start: Instant,
    ) -> Result<(Trial<'c, C>, Option<Forecast>), ReadError> {
        let Some(before) = forecast else { return Ok((winner, None)) };
        let deadline = self.deadline(start);
        let enough = SETTLED.min(before.passes / 2);
        let begun = Instant::now();
        let is_late = |passes: u64| {
            let too_long = passes >= FEWEST_TELLING && begun.elapsed().as_secs_f64() > LONGEST_SETTLING;
            too_long || deadline.is_some_and(|deadline| Instant::now() >= deadline)
        };
        while winner.ongoing.passes() < enough && !is_late(winner.ongoing.passes()) {
            winner.pass()?;
        }
        // A first pass tells no noise.
        let known = winner.ongoing.passes() >= FEWEST_TELLING;
        let now = if known { winner.forecast(self.target) } else { None };
        Ok((winner, if known { now } else { forecast }))
    }
}
