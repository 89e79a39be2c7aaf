//! The emission plan: photons per lamp, flux per photon.

use photonlab_photometry::Colour;

use crate::{Lamp, Lamps};

/// No lamp gets less than this share of an even division, so that a weak lamp is not starved.
const FLOOR: f64 = 0.1;

/// How many photons each lamp emits and what flux each photon carries.
///
/// Promise: the sum of all photons' flux is the sum of all lamps' flux, in every channel.
#[derive(Clone, Debug, PartialEq)]
pub struct EmissionPlan<const C: usize> {
    /// First photon index of each lamp, and the total at the end.
    first: Vec<u64>,
    /// Flux of each photon of each lamp.
    flux: Vec<Colour<C>>,
}

/// Why photons cannot be shared out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// Nothing emits.
    #[error("the scene has no lamp that emits")]
    NoLamp,
    /// Some lamp would emit nothing.
    #[error("{photons} photons cannot be shared among {lamps} lamps; ask for at least one photon per lamp and pass")]
    TooFewPhotons {
        /// Photons asked for.
        photons: u64,
        /// Lamps of the scene.
        lamps: usize,
    },
}

impl<const C: usize> EmissionPlan<C> {
    /// Shares photons among lamps by [`Lamp::importance`], with a floor of a tenth of an even share.
    pub fn new(lamps: &Lamps<C>, photons: u64) -> Result<Self, PlanError> {
        let count = lamps.lamps.len();
        if count == 0 {
            return Err(PlanError::NoLamp);
        }
        if photons < count as u64 {
            return Err(PlanError::TooFewPhotons { photons, lamps: count });
        }
        let total: f64 = lamps.lamps.iter().map(Lamp::importance).sum();
        let even = 1.0 / count as f64;
        let weight = |flux: f64| (flux / total).max(FLOOR * even);
        let weights: Vec<f64> = lamps.lamps.iter().map(|lamp| weight(lamp.importance())).collect();
        let sum: f64 = weights.iter().sum();
        // Each lamp gets one photon, the rest are rounded cumulatively so that they add up.
        let spare = photons - count as u64;
        let mut first = vec![0];
        let mut running = 0.0;
        for (index, w) in weights.iter().enumerate() {
            running += w;
            let end = if index + 1 == count { spare } else { ((running / sum) * spare as f64).round() as u64 };
            first.push(end + index as u64 + 1);
        }
        let flux =
            lamps.lamps.iter().zip(first.windows(2)).map(|(l, w)| l.flux * (1.0 / (w[1] - w[0]) as f64)).collect();
        Ok(Self { first, flux })
    }

    /// Photons in all.
    pub fn photons(&self) -> u64 {
        self.first.last().copied().unwrap_or(0)
    }

    /// The lamp of a photon and the flux it carries.
    pub fn photon(&self, index: u64) -> (usize, Colour<C>) {
        let lamp = self.first.partition_point(|&first| first <= index) - 1;
        (lamp, self.flux[lamp])
    }
}
