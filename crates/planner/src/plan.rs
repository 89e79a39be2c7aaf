//! What was chosen, and what is expected of it.

use std::time::Duration;

use photonlab_readout::{Observer, Outcome, ReadError, Settings};

use crate::{Candidate, Forecast, trial::Trial};

/// One that could read the cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entrant {
    /// The method and its settings.
    pub candidate: Candidate,
    /// How it stood when it was last seen.
    pub standing: Standing,
}

/// How a candidate stood when it was last seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// In all, from its own start.
    Foretold(Forecast),
    /// Too little was found to foretell by, or no number of passes reaches the wanted error.
    OutOfReach,
    /// It did not run.
    NotRaced(Why),
}

/// Why a candidate did not run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The best is done so soon that more pilots would cost more than they may.
    DoneSoon,
    /// What reads the map at the point itself is far behind.
    KinIsBehind,
    /// It starts slowly, and the best needs little longer than that start.
    StartsSlowly,
    /// No time was left for it.
    NoTimeLeft,
    /// A pass of it failed.
    Failed,
}

impl Standing {
    /// What was foretold.
    pub fn forecast(&self) -> Option<Forecast> {
        match self {
            Standing::Foretold(forecast) => Some(*forecast),
            Standing::OutOfReach | Standing::NotRaced(_) => None,
        }
    }
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
    /// How many of them ran.
    pub fn raced(&self) -> usize {
        self.entrants.iter().filter(|entrant| !matches!(entrant.standing, Standing::NotRaced(_))).count()
    }

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
