//! What one sample of a cell found.

use photonlab_final_gather::Light;

/// What one sample of a cell, or the sum of several, found, in the cell's unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample<const C: usize> {
    /// All of it.
    pub(crate) light: Light<C>,
    /// The part of it that density estimates on surfaces found: neither light that was sampled nor what media scatter, of whose bias
    /// such estimates know nothing.
    pub(crate) estimate: Light<C>,
    /// True if there can be no light: the ray left the scene or met something black.
    pub(crate) dark: bool,
}

impl<const C: usize> Default for Sample<C> {
    /// Of no samples: nothing found.
    fn default() -> Self {
        Self { light: Light::default(), estimate: Light::default(), dark: true }
    }
}

impl<const C: usize> Sample<C> {
    pub(crate) fn add(&mut self, other: &Self) {
        self.light.add(&other.light);
        self.estimate.add(&other.estimate);
        self.dark &= other.dark;
    }

    /// Adds what a density estimate on a surface has found.
    pub(crate) fn add_estimate(&mut self, estimate: &Light<C>) {
        self.light.add(estimate);
        self.estimate.add(estimate);
    }
}
