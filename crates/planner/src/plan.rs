//! What was chosen, and what is expected of it.

use std::time::Duration;

use photonlab_readout::{Observer, Outcome, ReadError, Settings};

use crate::{Candidate, Forecast, trial::Trial};

/// One that entered, and what its last pass foretold; `None` if no number of its passes reaches the wanted error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entrant {
    /// What entered.
    pub candidate: Candidate,
    /// Of a run without pilots.
    pub forecast: Option<Forecast>,
}

/// A candidate chosen among all, ready to go on.
pub struct Plan<'c, const C: usize> {
    /// In the order given.
    pub entrants: Vec<Entrant>,
    /// The number of the chosen one.
    pub chosen: usize,
    /// Its passes, as long as they will be, and time; `None` if nothing reaches the wanted error.
    pub forecast: Option<Forecast>,
    /// Wall time of the pilots.
    pub pilots: Duration,
    pub(crate) winner: Trial<'c, C>,
}

impl<const C: usize> Plan<'_, C> {
    /// The chosen one's settings.
    pub fn settings(&self) -> Settings {
        self.winner.candidate.settings
    }

    /// Pilot passes that count in the result.
    pub fn counted(&self) -> u64 {
        self.winner.ongoing.passes()
    }

    /// Seconds that are expected from now on.
    pub fn seconds_left(&self) -> Option<f64> {
        Some((self.forecast?.seconds - self.winner.spent()).max(0.0))
    }

    /// Goes on with the winner's passes to the end.
    pub fn go_on(self, observer: &dyn Observer) -> Result<Outcome<C>, ReadError> {
        self.winner.ongoing.go_on(observer)
    }
}
