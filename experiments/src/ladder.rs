//! One way to read a scene, at rising lengths of its passes.

use std::ops::Range;

use photonlab_planner::Candidate;
use photonlab_readout::{Cell, Ends, Outcome, Session, Settings, Silent, Source};

use crate::cpu_clock::CpuClock;

/// Passes of each run: those of a run that nobody asks anything else of.
pub(crate) const PASSES: u64 = 16;
/// The next length of passes over the last, and how many lengths there are at most.
const LONGER: f64 = 4.0;
const LENGTHS: i32 = 10;

/// No run is told to take less: the system books time in ticks.
const SHORTEST: f64 = 1e-5;

/// Runs of one candidate, shortest first, each by several seeds; `T` is what is kept of a run.
pub(crate) struct Ladder<T> {
    pub(crate) candidate: Candidate,
    pub(crate) rungs: Vec<Rung<T>>,
}

/// Runs of one length.
pub(crate) struct Rung<T> {
    /// Mean CPU time.
    pub(crate) seconds: f64,
    /// By seed; `None` where a run failed.
    pub(crate) runs: Vec<Option<T>>,
}

impl<T> Ladder<T> {
    /// Longer and longer runs until one is long enough, or its passes hold all they may.
    pub(crate) fn climb<const C: usize>(
        session: &Session<'_, C>,
        cells: &[Cell],
        candidate: Candidate,
        seeds: Range<u64>,
        is_enough: &dyn Fn(&Rung<T>) -> bool,
        keep: &dyn Fn(Outcome<C>) -> T,
    ) -> Self {
        let (mut rungs, mut last) = (Vec::new(), None);
        for length in 0..LENGTHS {
            let ends = Ends { passes: Some(PASSES), target_error: None, time_limit: None };
            let demands = Session { settings: candidate.settings, ..*session }.demands();
            let schedule = candidate.schedule(cells.len(), &demands, LONGER.powi(length), ends);
            // A pass that holds all it may hold grows no more.
            if last.replace(schedule) == Some(schedule) {
                break;
            }
            let (mut runs, mut seconds) = (Vec::new(), 0.0);
            for seed in seeds.clone() {
                let session = Session { settings: Settings { seed, ..candidate.settings }, ..*session };
                let clock = CpuClock::start();
                let outcome = session.run(cells, &schedule, &Source::Trace, &Silent);
                seconds += clock.seconds();
                runs.push(outcome.ok().map(keep));
            }
            seconds /= runs.len() as f64;
            let rung = Rung { seconds: seconds.max(SHORTEST), runs };
            let enough = is_enough(&rung);
            rungs.push(rung);
            if enough {
                break;
            }
        }
        Self { candidate, rungs }
    }
}
