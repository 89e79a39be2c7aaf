//! The fixed way to read a scene that would have been best.

use photonlab_planner::Candidate;
use photonlab_readout::Outcome;

use super::covered::Truth;
use crate::ladder::{Ladder, Rung};

/// Share of the seeds that must meet a target.
const MET: f64 = 0.95;
/// What takes so many times as long as the best by few seeds is not the best by many.
const FAR_BEHIND: f64 = 3.0;
/// How error falls with time: no faster than evenly spread points have it, no slower than a biased estimate.
const POWERS: [f64; 2] = [0.25, 1.0];

/// The least time to a target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    pub(super) seconds: f64,
    pub(super) candidate: Candidate,
    /// True if it lies beyond the longest run.
    pub(super) extrapolated: bool,
}

/// The largest error of a run's readings relative to their answers, which themselves are uncertain; infinite where nothing was found.
pub(super) fn largest_error<const C: usize>(outcome: &Outcome<C>, truths: &[Truth]) -> f64 {
    let channels = 0..outcome.results;
    let readings = outcome.cells.iter().flat_map(|cell| channels.clone().map(|channel| cell.value[channel].mean()));
    let error = |(value, truth): (Option<f64>, &Truth)| truth.relative_error(value.unwrap_or(f64::INFINITY));
    readings.zip(truths).filter(|(_, truth)| truth.value > 0.0).map(error).fold(0.0, f64::max)
}

impl Best {
    /// The best of several ways by the errors of their runs.
    pub(super) fn of(ladders: &[Ladder<f64>], target: f64) -> Option<Self> {
        let times = ladders.iter().filter_map(|ladder| {
            let (seconds, extrapolated) = seconds_to(&levels(ladder), target)?;
            Some(Best { seconds, candidate: ladder.candidate, extrapolated })
        });
        times.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }
}

/// Those that may be the best for some target, as few seeds have it.
pub(super) fn contenders(scouted: &[Ladder<f64>], targets: &[f64]) -> Vec<Candidate> {
    let may_be = |ladder: &&Ladder<f64>| {
        targets.iter().any(|&target| {
            let best = Best::of(scouted, target).map_or(f64::INFINITY, |best| best.seconds);
            seconds_to(&levels(ladder), target).is_some_and(|(seconds, _)| seconds <= FAR_BEHIND * best)
        })
    };
    scouted.iter().filter(may_be).map(|ladder| ladder.candidate).collect()
}

/// Each length's mean time, and the error that 95 % of its seeds do not exceed.
fn levels(ladder: &Ladder<f64>) -> Vec<(f64, f64)> {
    let of = |rung: &Rung<f64>| (rung.seconds, within(rung.runs.iter().copied()));
    ladder.rungs.iter().map(of).collect()
}

/// What 95 % of some errors do not exceed; a run that failed has none.
pub(super) fn within(errors: impl Iterator<Item = Option<f64>>) -> f64 {
    let mut errors: Vec<f64> = errors.map(|error| error.unwrap_or(f64::INFINITY)).collect();
    errors.sort_by(f64::total_cmp);
    let place = ((MET * errors.len() as f64).ceil() as usize).clamp(1, errors.len()) - 1;
    errors[place]
}

/// The time to a target by pairs of time and error, shortest first, and whether that is extrapolated.
pub(super) fn seconds_to(levels: &[(f64, f64)], target: f64) -> Option<(f64, bool)> {
    let Some(reached) = levels.iter().position(|&(_, error)| error <= target) else {
        let [.., before, last] = levels else { return None };
        let power = (before.1 / last.1).ln() / (last.0 / before.0).ln();
        let power = power.is_finite().then(|| power.clamp(POWERS[0], POWERS[1]))?;
        return Some((last.0 * (last.1 / target).powf(1.0 / power), true));
    };
    let after = levels[reached];
    let before = reached.checked_sub(1).map(|before| levels[before]).filter(|before| before.1.is_finite());
    let between = before.filter(|_| after.1 > 0.0).map(|before| {
        let share = (before.1 / target).ln() / (before.1 / after.1).ln();
        before.0 * (after.0 / before.0).powf(share)
    });
    Some((between.unwrap_or(after.0), false))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_to_an_error_follows_the_slope() {
        let levels = [1.0_f64, 4.0, 16.0].map(|seconds| (seconds, 0.1 / seconds.sqrt()));
        let to = |target: f64| seconds_to(&levels, target).expect("a slope");
        assert_eq!(to(0.2), (1.0, false), "the shortest is the least");
        assert!((to(0.04).0 - 6.25).abs() < 1e-9 && !to(0.04).1);
        assert!((to(0.01).0 - 100.0).abs() < 1e-9 && to(0.01).1);
        assert!(seconds_to(&[(1.0, f64::INFINITY)], 0.2).is_none());
    }

    #[test]
    fn one_of_two_runs_is_no_95_percent() {
        assert_eq!(within([None, Some(0.1)].into_iter()), f64::INFINITY);
        assert_eq!(within((0..20).map(|run| (run > 0).then_some(0.1))), 0.1);
    }
}
