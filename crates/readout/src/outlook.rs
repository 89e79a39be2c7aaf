//! What a run's error will be after more passes.

use photonlab_measure::Replicates;

use crate::{Method, Session, maps::SHRINK};

/// True if more passes lower a run's bias: radii, or numbers of photons, that the program chooses shrink from pass to pass. Where there is no radius
/// there is no bias to last.
pub(crate) fn bias_falls<const C: usize>(session: &Session<'_, C>) -> bool {
    match session.settings.method {
        // The sites of a cache stay where they are, and what it errs between them with them.
        Method::FinalGather { .. } if session.caches() => false,
        Method::Radius { radius } | Method::FinalGather { radius } => radius.is_none(),
        Method::Nearest { k } => k.is_none(),
        Method::Adaptive | Method::Path | Method::Bins => true,
    }
}

/// How the parts of an error fall from the passes done to more of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Laws {
    /// Passes so far.
    pub(crate) done: u64,
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
        let falls = bias_falls(session);
        let noise_power = if falls && session.settings.method.is_direct_view() { 0.5 - SHRINK } else { 0.5 };
        let bias_power = if falls { 2.0 * SHRINK } else { 0.0 };
        let fewer = done as f64 / passes as f64;
        Self { done, passes, noise: fewer.powf(noise_power), bias: fewer.powf(bias_power), mean: fewer.sqrt() }
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
