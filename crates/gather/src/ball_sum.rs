//! Sums over the photons in a ball and in a wider one, a block of sixteen at a time.

use photonlab_kdtree::{BLOCK, KdTree, VisitBlock};
use photonlab_photometry::{Colour, Photon};

use crate::{
    CHECK, Estimator, Kernel, Surroundings,
    accepted::{Accepted, padded_block},
    boundary::{Correction, Corrections},
};

/// The sums may visit this much more than the ball, so that rounding leaves none of its photons out.
const MARGIN: f64 = 1.0 + 1e-6;

/// What is summed over the photons that count in a ball, and in one of [`CHECK`] times the radius where a bias is to be told.
pub(crate) struct BallSum<'a, const C: usize, S> {
    pub(crate) tree: &'a KdTree<Photon<C>>,
    pub(crate) accepted: Accepted<'a, C>,
    pub(crate) around: &'a S,
    pub(crate) radius: f64,
    pub(crate) estimator: Estimator,
    /// `None` where the surface fills the discs.
    pub(crate) corrections: Option<Corrections>,
    /// Photons in the ball itself.
    pub(crate) photons: usize,
    weighed: Lanes<C>,
    disc: Lanes<C>,
    wide: Lanes<C>,
}

/// The sums of flux.
pub(crate) struct Sums<const C: usize> {
    /// In the ball, by kernel and correction.
    pub(crate) weighed: Colour<C>,
    /// In the ball, as it is.
    pub(crate) disc: Colour<C>,
    /// In the wide ball: as it is without corrections, by kernel and correction with them; zero where no bias is to be told.
    pub(crate) wide: Colour<C>,
}

impl<'a, const C: usize, S: Surroundings<Photon<C>>> BallSum<'a, C, S> {
    pub(crate) fn new(
        tree: &'a KdTree<Photon<C>>,
        accepted: Accepted<'a, C>,
        around: &'a S,
        (radius, estimator): (f64, Estimator),
        corrections: Option<Corrections>,
    ) -> Self {
        let none = [Lanes::ZERO; 3];
        let [weighed, disc, wide] = none;
        Self { tree, accepted, around, radius, estimator, corrections, photons: 0, weighed, disc, wide }
    }

    /// Walks the tree.
    pub(crate) fn sums(&mut self) -> Sums<C> {
        let (tree, position) = (self.tree, self.accepted.at.position);
        let reach = if self.estimator.tells_bias { CHECK } else { MARGIN };
        tree.visit_within(position, (reach * self.radius) as f32, &mut *self);
        let (disc, wide) = (self.disc.total(), self.wide.total());
        let plain = self.estimator.kernel == Kernel::Disc && self.corrections.is_none();
        Sums { weighed: if plain { disc } else { self.weighed.total() }, disc, wide }
    }

    /// How much each photon counts in a kernel's sum, at squared distances over that of a radius.
    #[inline(always)]
    fn corrected(&self, of: &Correction, first: usize, radius: f64, shares: &[f64; BLOCK]) -> [f64; BLOCK] {
        let (mut weights, constant) = (self.estimator.kernel.weights(shares), of.at([0.0; 3]));
        if of.is_constant() {
            for weight in &mut weights {
                *weight *= constant;
            }
            return weights;
        }
        let axes = self.tree.block_points(first);
        let slope = of.slope_over(radius);
        let here = self.accepted.at.position;
        let mut slopes = [0.0f32; BLOCK];
        for axis in 0..3 {
            for lane in 0..BLOCK {
                slopes[lane] += slope[axis] * (axes[axis][lane] - here[axis]);
            }
        }
        for lane in 0..BLOCK {
            weights[lane] *= constant + f64::from(slopes[lane]);
        }
        weights
    }
}

impl<const C: usize, S: Surroundings<Photon<C>>> VisitBlock for &mut BallSum<'_, C, S> {
    #[inline(always)]
    fn visit(&mut self, first: usize, mask: u16, distances: &[f32; BLOCK]) {
        let mut counted = self.accepted.in_block(first, mask);
        if self.estimator.area.hides() && self.corrections.is_some() {
            counted = seen(self.tree, self.around, first, counted);
        }
        if counted == 0 {
            return;
        }
        let padded;
        let photons = match self.accepted.photons[first..].first_chunk() {
            Some(photons) => photons,
            None => {
                padded = padded_block(&self.accepted.photons[first..]);
                &padded
            }
        };
        let limit = (self.radius * self.radius) as f32;
        let (mut shares, mut near, mut all) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        let mut inside = [0u32; BLOCK];
        for lane in 0..BLOCK {
            let bit = u32::from(counted) & 1 << lane;
            inside[lane] = if distances[lane] <= limit { bit } else { 0 };
            shares[lane] = f64::from(distances[lane] / limit);
            all[lane] = if bit != 0 { 1.0 } else { 0.0 };
            near[lane] = if inside[lane] != 0 { 1.0 } else { 0.0 };
        }
        let inside = inside.iter().fold(0, |all, bit| all | bit).count_ones() as usize;
        self.photons += inside;
        if self.around.weighs() {
            let mut left = counted;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                let weight = self.around.weigh(&photons[lane]);
                (all[lane], near[lane]) = (all[lane] * weight, near[lane] * weight);
                left &= left - 1;
            }
        }
        let Estimator { kernel, tells_bias, .. } = self.estimator;
        if let Some(corrections) = self.corrections {
            // Most blocks of the wide ball have nothing in the other one.
            if inside > 0 {
                let narrow = self.corrected(&corrections.narrow, first, self.radius, &shares);
                self.weighed.add(photons, &product(&near, &narrow));
            }
            if tells_bias {
                let shares = shares.map(|share| share * (1.0 / (CHECK * CHECK)));
                let wide = self.corrected(&corrections.wide, first, CHECK * self.radius, &shares);
                self.wide.add(photons, &product(&all, &wide));
            }
            return;
        }
        if tells_bias {
            self.wide.add(photons, &all);
            if inside == 0 {
                return;
            }
        }
        if tells_bias || kernel == Kernel::Disc {
            self.disc.add(photons, &near);
        }
        if kernel != Kernel::Disc {
            self.weighed.add(photons, &product(&near, &kernel.weights(&shares)));
        }
    }
}

/// The photons of a block that a point sees, of those in question, as bits.
pub(crate) fn seen<const C: usize>(
    tree: &KdTree<Photon<C>>,
    around: &impl Surroundings<Photon<C>>,
    first: usize,
    mask: u16,
) -> u16 {
    let is_seen = |lane: usize| around.is_seen(tree.point(first + lane), &tree.payloads()[first + lane]);
    let lanes = (0..BLOCK).filter(|lane| mask >> lane & 1 != 0);
    lanes.filter(|&lane| is_seen(lane)).fold(0, |bits, lane| bits | 1 << lane)
}

/// Lane by lane; zero where the first is, whatever the second: lanes without a point have no place.
#[inline(always)]
fn product(a: &[f64; BLOCK], b: &[f64; BLOCK]) -> [f64; BLOCK] {
    let mut product = [0.0; BLOCK];
    for lane in 0..BLOCK {
        product[lane] = if a[lane] != 0.0 { a[lane] * b[lane] } else { 0.0 };
    }
    product
}

/// Sums of flux, in sixteen lanes.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<const C: usize>([[f64; BLOCK]; C]);

impl<const C: usize> Lanes<C> {
    const ZERO: Self = Self([[0.0; BLOCK]; C]);

    /// Adds the flux of each photon times its factor.
    #[inline(always)]
    fn add(&mut self, photons: &[Photon<C>; BLOCK], factors: &[f64; BLOCK]) {
        for channel in 0..C {
            for lane in 0..BLOCK {
                self.0[channel][lane] += f64::from(photons[lane].flux[channel]) * factors[lane];
            }
        }
    }

    fn total(&self) -> Colour<C> {
        Colour(self.0.map(|lanes| lanes.iter().sum()))
    }
}
