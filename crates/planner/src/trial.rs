//! A candidate that runs.

use photonlab_readout::{Cell, Ends, ErrorOver, Ongoing, PASSES_BEFORE_STOPPING, ReadError, Schedule, Session};

use crate::{Candidate, Forecast};

/// Passes beyond which nothing is foretold.
const FARTHEST: u64 = 1 << 24;
/// So many cells of an image tell its noise as if they were independent: near each other they share photons.
const INDEPENDENT_CELLS: usize = 16;

/// A candidate and the passes that it has run.
pub(crate) struct Trial<'c, const C: usize> {
    pub(crate) candidate: Candidate,
    /// Its number among all that entered.
    pub(crate) number: usize,
    /// How many times as long its passes are as the shortest.
    pub(crate) scale: f64,
    pub(crate) ongoing: Ongoing<'c, C>,
    /// Wall time of each pass, seconds.
    seconds: Vec<f64>,
    cells: usize,
}

impl<'c, const C: usize> Trial<'c, C> {
    pub(crate) fn new(
        session: &Session<'c, C>,
        cells: &'c [Cell],
        (number, candidate): (usize, Candidate),
        scale: f64,
        ends: Ends,
    ) -> Result<Self, ReadError> {
        let session = Session { settings: candidate.settings, ..*session };
        let schedule = candidate.schedule(cells.len(), &session.demands(), scale, ends);
        let ongoing = session.begin(cells, &schedule)?;
        Ok(Self { candidate, number, scale, ongoing, seconds: Vec::new(), cells: cells.len() })
    }

    /// One more pass.
    pub(crate) fn pass(&mut self) -> Result<(), ReadError> {
        self.seconds.push(self.ongoing.pass()?.as_secs_f64());
        Ok(())
    }

    /// Seconds of a pass that is not the first: the median, which one that was interrupted does not move.
    pub(crate) fn seconds_of_pass(&self) -> f64 {
        let mut later: Vec<f64> = self.seconds.iter().skip(1).copied().collect();
        later.sort_by(f64::total_cmp);
        later.get(later.len() / 2).or(self.seconds.first()).copied().unwrap_or(0.0)
    }

    /// How many times as much a pass of another run does.
    pub(crate) fn times_as_much(&self, of: &Schedule) -> f64 {
        let work = |schedule: &Schedule| (schedule.photons(0) + schedule.samples(0) * self.cells as u64) as f64;
        work(of) / work(self.ongoing.schedule())
    }

    /// The passes of the same candidate that are so many times as long, or as long as they may be; and how much longer that is.
    pub(crate) fn longer(&self, by: f64) -> (f64, f64) {
        let (session, schedule) = (self.ongoing.session(), self.ongoing.schedule());
        let scale = self.scale * by;
        let longer = self.candidate.schedule(self.cells, &session.demands(), scale, schedule.ends);
        (scale, self.times_as_much(&longer))
    }

    /// Seconds of all passes so far.
    pub(crate) fn spent(&self) -> f64 {
        self.seconds.iter().sum()
    }

    /// Cells in which something has been found, or that are proved dark.
    pub(crate) fn found(&self) -> usize {
        self.ongoing.cells().iter().filter(|cell| !cell.found_nothing()).count()
    }

    /// True if more may be known of it after more of the same: in some cells nothing has been found.
    pub(crate) fn is_in_the_dark(&self) -> bool {
        self.found() < self.cells
    }

    /// True if the run may end for its error now.
    pub(crate) fn has_reached(&self, target: f64) -> bool {
        self.ongoing.passes() >= PASSES_BEFORE_STOPPING && self.ongoing.error().is_some_and(|error| error <= target)
    }

    /// When the wanted error will be reached; `None` if no number of passes does, or nothing has been found to tell by.
    pub(crate) fn forecast(&self, target: f64) -> Option<Forecast> {
        let reaches = |passes: u64| self.ongoing.error_after(passes).is_some_and(|error| error <= target);
        let mut enough = PASSES_BEFORE_STOPPING.max(self.ongoing.passes());
        let mut few = enough;
        while !reaches(enough) {
            few = enough;
            enough = enough.checked_mul(2).filter(|&passes| passes <= FARTHEST)?;
        }
        while enough - few > 1 {
            let middle = few.midpoint(enough);
            *if reaches(middle) { &mut enough } else { &mut few } = middle;
        }
        let independent = match self.ongoing.session().error_over {
            ErrorOver::Worst => 1,
            ErrorOver::Image => self.cells.min(INDEPENDENT_CELLS),
        };
        let degrees = (self.ongoing.passes().saturating_sub(1) * independent as u64) as f64;
        let each = self.seconds_of_pass();
        let first = self.seconds.first().copied().unwrap_or(each).max(each);
        Some(Forecast::new(enough, first, each, degrees))
    }
}
