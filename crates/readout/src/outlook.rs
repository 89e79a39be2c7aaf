//! What a run's error will be after more passes.

use photonlab_measure::Replicates;

use crate::{Method, Session, maps::SHRINK};

/// How the parts of an error fall from the passes done to more of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Laws {
    /// Passes to come to, in all.
    pub(crate) passes: u64,
    /// Of the values' standard error.
    noise: f64,
    /// Of the bias.
    bias: f64,
    /// Of a mean of passes that share nothing.
    mean: f64,
}

impl Laws {
    /// The squared radius shrinks as pass^(-2 SHRINK), and so does the bias of a pass; its variance grows as much where the map is read at the
    /// point itself, and hardly at all where many rays read it (Knaus and Zwicker 2011, section 4).
    pub(crate) fn of<const C: usize>(session: &Session<'_, C>, done: u64, passes: u64) -> Self {
        let (noise_power, bias_power) = match session.settings.method {
            Method::FinalGather { .. } if session.caches() => (0.5, 0.0),
            Method::FinalGather { radius: None } => (0.5, 2.0 * SHRINK),
            Method::Radius { radius: None } | Method::Nearest { k: None } | Method::Adaptive => {
                (0.5 - SHRINK, 2.0 * SHRINK)
            }
            Method::FinalGather { .. } | Method::Radius { .. } | Method::Nearest { .. } => (0.5, 0.0),
            Method::Path | Method::Bins => (0.5, 0.0),
        };
        let fewer = done as f64 / passes as f64;
        Self { passes, noise: fewer.powf(noise_power), bias: fewer.powf(bias_power), mean: fewer.sqrt() }
    }

    /// A value's standard error.
    pub(crate) fn noise(&self, of: &Replicates) -> f64 {
        self.noise * of.std_error().unwrap_or(0.0)
    }

    /// The standard error of a bias, whose size alone follows the radius.
    pub(crate) fn noise_of_bias(&self, of: &Replicates) -> f64 {
        self.mean * of.std_error().unwrap_or(0.0)
    }

    /// The size of a bias: of what it is now, noise has its part, which falls as a mean's.
    pub(crate) fn size_of_bias(&self, of: &Replicates) -> f64 {
        let (mean, noise) = (of.mean().unwrap_or(0.0), of.std_error().unwrap_or(0.0));
        let true_square = (mean * mean - noise * noise).max(0.0);
        (true_square * self.bias * self.bias + (noise * self.mean).powi(2)).sqrt()
    }

    /// A bound that falls with the number of samples.
    pub(crate) fn by_count(&self, bound: f64) -> f64 {
        self.mean * self.mean * bound
    }
}
