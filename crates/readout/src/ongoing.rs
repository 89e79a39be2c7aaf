//! A run that can be looked at between its passes.

use std::time::{Duration, Instant};

use photonlab_measure::Stopped;

use crate::{
    Cell, CellResult, Observer, Outcome, ReadError, Schedule, Session, Source,
    compiled::runner,
    outlook::{Laws, bias_falls},
    run::Run,
    session::passes_at_hand,
};

/// Passes before a run may end for its error: fewer would trust an error bar that is itself uncertain.
pub const PASSES_BEFORE_STOPPING: u64 = 16;
/// Passes before a target is given up as out of reach.
const PASSES_BEFORE_GIVING_UP: u64 = 64;
/// Growth of the number of passes between two looks at the error. Every look is a chance to stop on a lucky error bar.
const LOOK_GROWTH: f64 = 1.1;
/// A run that only its error could end stops here and says so.
const MOST_PASSES: u64 = 100_000;

/// A run between two of its passes. Whoever has looked may go on with it: the passes done count, and the bits are those of a run that nobody
/// looked at.
pub struct Ongoing<'s, const C: usize> {
    session: Session<'s, C>,
    cells: &'s [Cell],
    schedule: Schedule,
    source: Source<'s, C>,
    run: Run<C>,
    start: Instant,
    longest: Duration,
    next_look: u64,
}

impl<'s, const C: usize> Ongoing<'s, C> {
    pub(crate) fn new(
        session: Session<'s, C>,
        cells: &'s [Cell],
        schedule: Schedule,
        source: Source<'s, C>,
        start: Instant,
    ) -> Self {
        let run = Run::new(cells.len());
        let (longest, next_look) = (Duration::ZERO, PASSES_BEFORE_STOPPING);
        Self { session, cells, schedule, source, run, start, longest, next_look }
    }

    /// One more pass; the wall time that it took.
    pub fn pass(&mut self) -> Result<Duration, ReadError> {
        runner().pass(self)
    }

    pub(crate) fn one_pass(&mut self) -> Result<Duration, ReadError> {
        let begun = Instant::now();
        self.session.pass(&mut self.run, self.cells, &self.schedule, &self.source)?;
        let took = begun.elapsed();
        self.longest = self.longest.max(took);
        Ok(took)
    }

    /// Passes done.
    pub fn passes(&self) -> u64 {
        self.run.passes
    }

    /// What they have found, one for each cell.
    pub fn cells(&self) -> &[CellResult<C>] {
        &self.run.cells
    }

    /// Its passes and their end.
    pub fn schedule(&self) -> &Schedule {
        &self.schedule
    }

    /// The run's session.
    pub fn session(&self) -> &Session<'s, C> {
        &self.session
    }

    /// The relative half-width of the intervals, as [`Session::error_over`] has it; `None` below two passes or where nothing was found.
    pub fn error(&self) -> Option<f64> {
        self.session.error_over.of(&self.run.cells, self.session.optics.results(), self.session.confidence)
    }

    /// What [`Ongoing::error`] is expected to be after so many passes in all, if noise and bias fall as the method's laws say.
    pub fn error_after(&self, passes: u64) -> Option<f64> {
        let laws = Laws::of(&self.session, self.run.passes, passes);
        self.session.error_over.expected(&self.run.cells, self.session.optics.results(), self.session.confidence, &laws)
    }

    /// Passes until the error, the clock (which has run since the run began) or the count ends them.
    pub fn go_on(self, observer: &dyn Observer) -> Result<Outcome<C>, ReadError> {
        runner().go_on(self, observer)
    }

    pub(crate) fn go_on_here(mut self, observer: &dyn Observer) -> Result<Outcome<C>, ReadError> {
        loop {
            // A run that others have looked at may be at its end already.
            let stopped = if self.run.passes > 0 { self.stopped(observer) } else { None };
            if let Some(stopped) = stopped {
                return Ok(self.run.finish(&self.session, stopped));
            }
            self.one_pass()?;
        }
    }

    /// What ends the run now, if anything does.
    fn stopped(&mut self, observer: &dyn Observer) -> Option<Stopped> {
        let ends = &self.schedule.ends;
        let done = self.run.passes;
        let looks = done >= self.next_look;
        let error = if looks { self.error() } else { None };
        observer.pass_done(done, self.start.elapsed(), error);
        if looks {
            self.next_look = ((done as f64 * LOOK_GROWTH).ceil() as u64).max(done + 1);
        }
        if ends.target_error.zip(error).is_some_and(|(target, error)| error <= target) {
            Some(Stopped::Target)
        } else if looks && self.target_is_out_of_reach() {
            self.run.out_of_reach = true;
            Some(Stopped::Count)
        } else if passes_at_hand(&self.schedule, &self.source).unwrap_or(MOST_PASSES) <= done {
            Some(Stopped::Count)
        } else if ends.time_limit.is_some_and(|limit| self.start.elapsed() + self.longest > limit) {
            Some(Stopped::Time)
        } else {
            None
        }
    }

    /// True if more passes cannot bring the error down to the target: the bias of a radius that does not shrink, or light
    /// gathered across an edge, or nothing found at all, is beyond it already.
    fn target_is_out_of_reach(&self) -> bool {
        let Some(target) = self.schedule.ends.target_error else { return false };
        let session = &self.session;
        // What shrinks is given more passes before it is given up.
        let patience = if bias_falls(session) { 4 * PASSES_BEFORE_GIVING_UP } else { PASSES_BEFORE_GIVING_UP };
        let floor = || session.error_over.floor_of(&self.run.cells, session.optics.results(), session.confidence);
        self.run.passes >= patience && floor().is_none_or(|floor| floor > target)
    }
}
