//! The fixed way to read a scene that would have been best.

use photonlab_planner::Candidate;
use photonlab_readout::{Cell, Ends, Observer, Outcome, Session, Settings, Source};

use super::{covered::Truth, cpu_clock::CpuClock};

/// Passes of a fixed run: those of a run that nobody asks anything else of.
const PASSES: u64 = 16;
/// The next length of passes over the last, and how many lengths there are.
const LONGER: f64 = 4.0;
const LENGTHS: i32 = 8;
/// Share of the seeds that must meet a target.
const MET: f64 = 0.95;
/// How error falls with time: no faster than evenly spread points have it, no slower than a biased estimate.
const POWERS: [f64; 2] = [0.25, 1.0];

/// Watches nothing.
pub(super) struct Silent;

impl Observer for Silent {
    fn pass_done(&self, _: u64, _: std::time::Duration, _: Option<f64>) {}
}

/// One fixed way at rising lengths of its passes.
pub(super) struct Ladder {
    pub(super) candidate: Candidate,
    rungs: Vec<Rung>,
}

/// One length.
#[derive(Clone, Copy, Debug)]
struct Rung {
    /// Mean CPU time.
    seconds: f64,
    /// The error that 95 % of the seeds do not exceed.
    error: f64,
}

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
    let error = |(value, truth): (Option<f64>, &Truth)| {
        let apart = (value.unwrap_or(f64::INFINITY) - truth.value).abs() - truth.uncertainty;
        apart.max(0.0) / truth.value
    };
    readings.zip(truths).filter(|(_, truth)| truth.value > 0.0).map(error).fold(0.0, f64::max)
}

impl Ladder {
    /// Longer and longer runs, by each seed, until one takes so many seconds.
    pub(super) fn climb<const C: usize>(
        session: &Session<'_, C>,
        cells: &[Cell],
        truths: &[Truth],
        candidate: Candidate,
        seeds: std::ops::Range<u64>,
        most_seconds: f64,
    ) -> Self {
        let mut rungs = Vec::new();
        for length in 0..LENGTHS {
            let ends = Ends { passes: Some(PASSES), target_error: None, time_limit: None };
            let (mut errors, mut seconds) = (Vec::new(), 0.0);
            for seed in seeds.clone() {
                let session = Session { settings: Settings { seed, ..candidate.settings }, ..*session };
                let schedule = candidate.schedule(cells.len(), &session.demands(), LONGER.powi(length), ends);
                let clock = CpuClock::start();
                let error = match session.run(cells, &schedule, &Source::Trace, &Silent) {
                    Ok(outcome) => largest_error(&outcome, truths),
                    Err(_) => f64::INFINITY,
                };
                seconds += clock.seconds();
                errors.push(error);
            }
            errors.sort_by(f64::total_cmp);
            let place = ((MET * errors.len() as f64).ceil() as usize).clamp(1, errors.len()) - 1;
            rungs.push(Rung { seconds: seconds / errors.len() as f64, error: errors[place] });
            if rungs[length as usize].seconds > most_seconds {
                break;
            }
        }
        Self { candidate, rungs }
    }

    /// The time to a target, and whether that is extrapolated.
    fn seconds_to(&self, target: f64) -> Option<(f64, bool)> {
        let Some(reached) = self.rungs.iter().position(|rung| rung.error <= target) else {
            let [.., before, last] = self.rungs[..] else { return None };
            let power = power(before, last)?;
            return Some((last.seconds * (last.error / target).powf(1.0 / power), true));
        };
        let after = self.rungs[reached];
        let before = reached.checked_sub(1).map(|before| self.rungs[before]);
        let between = before.filter(|before| before.error.is_finite()).map(|before| {
            let share = (before.error / target).ln() / (before.error / after.error).ln();
            before.seconds * (after.seconds / before.seconds).powf(share)
        });
        Some((between.unwrap_or(after.seconds), false))
    }

    /// The best of several.
    pub(super) fn best(ladders: &[Self], target: f64) -> Option<Best> {
        let times = ladders.iter().filter_map(|ladder| {
            let (seconds, extrapolated) = ladder.seconds_to(target)?;
            Some(Best { seconds, candidate: ladder.candidate, extrapolated })
        });
        times.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }
}

fn power(before: Rung, last: Rung) -> Option<f64> {
    let power = (before.error / last.error).ln() / (last.seconds / before.seconds).ln();
    power.is_finite().then(|| power.clamp(POWERS[0], POWERS[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use photonlab_planner::Balance;

    #[test]
    fn time_to_an_error_follows_the_slope() {
        let settings = crate::reproduce::strategy::Strategy::PATH.settings(0);
        let rung = |seconds: f64| Rung { seconds, error: 0.1 / seconds.sqrt() };
        let candidate = Candidate { settings, balance: Balance::Even };
        let ladder = Ladder { candidate, rungs: [1.0, 4.0, 16.0].map(rung).to_vec() };
        let to = |target: f64| ladder.seconds_to(target).expect("a slope");
        assert_eq!(to(0.2), (1.0, false), "the shortest is the least");
        assert!((to(0.04).0 - 6.25).abs() < 1e-9 && !to(0.04).1);
        assert!((to(0.01).0 - 100.0).abs() < 1e-9 && to(0.01).1);
    }
}
