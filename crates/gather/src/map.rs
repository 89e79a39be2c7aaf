//! The photon map: photons in a tree, and the density estimates read from it.

use photonlab_kdtree::{BuildError, KdTree, Neighbours, SplitRule};
use photonlab_photometry::{Colour, Photon};

use crate::{
    AreaModel, Bandwidth, Estimate, Estimator, Kernel, OpenPlane, Surroundings, Tests,
    accepted::Accepted,
    ball_sum::{BallSum, seen},
    boundary::{Correction, Corrections},
    facing::Facing,
};

/// Cosine of the largest angle between normals that count as one surface.
pub const SAME_SURFACE: f32 = 0.5;

/// The ball that checks a fixed radius is this many times wider. The bias is a third of the difference, known with 0.29
/// of the relative noise 1 / sqrt(n) of the estimate itself; a smaller second ball would know it six times worse.
pub const CHECK: f64 = 2.0;

/// Photons ready for queries; immutable.
pub struct PhotonMap<const C: usize> {
    tree: KdTree<Photon<C>>,
    facing: Facing,
}

/// Where to gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherPoint {
    /// Metres.
    pub position: [f32; 3],
    /// Unit normal on the side that is read.
    pub normal: [f32; 3],
}

/// Memory that queries reuse.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    found: Neighbours,
}

impl Scratch {
    pub(crate) fn neighbours(&mut self) -> &mut Neighbours {
        &mut self.found
    }
}

impl<const C: usize> PhotonMap<C> {
    /// Builds the map.
    pub fn build(positions: Vec<[f32; 3]>, photons: Vec<Photon<C>>, rule: SplitRule) -> Result<Self, BuildError> {
        let tree = KdTree::build(positions, photons, rule)?;
        Ok(Self { facing: Facing::of(tree.payloads()), tree })
    }

    /// Stored photons.
    pub fn len(&self) -> usize {
        self.tree.len()
    }

    /// True without photons.
    pub fn is_empty(&self) -> bool {
        self.tree.is_empty()
    }

    /// The tree, for experiments that count its work.
    pub fn tree(&self) -> &KdTree<Photon<C>> {
        &self.tree
    }

    /// Irradiance at a point, on a plane without an end for all that the estimate knows.
    pub fn gather(
        &self,
        at: &GatherPoint,
        bandwidth: Bandwidth,
        estimator: impl Into<Estimator>,
        tests: &Tests,
        scratch: &mut Scratch,
    ) -> Estimate<C> {
        self.gather_among(at, bandwidth, estimator.into(), tests, &OpenPlane, scratch)
    }

    /// The same among surfaces that the caller knows.
    pub fn gather_among(
        &self,
        at: &GatherPoint,
        bandwidth: Bandwidth,
        estimator: Estimator,
        tests: &Tests,
        around: &impl Surroundings<Photon<C>>,
        scratch: &mut Scratch,
    ) -> Estimate<C> {
        match bandwidth {
            Bandwidth::Radius(radius) => self.within(at, radius, estimator, tests, around),
            Bandwidth::Nearest { k, max_radius } => {
                self.nearest(at, (k, max_radius), estimator, tests, around, scratch)
            }
        }
    }

    fn accepted<'a>(&'a self, at: &'a GatherPoint, tests: &'a Tests, area: AreaModel) -> Accepted<'a, C> {
        Accepted::new((at, tests, area), &self.tree, &self.facing)
    }

    /// All photons in the closed ball over its area (catalogue A1): unbiased where the irradiance is even, with any kernel.
    fn within(
        &self,
        at: &GatherPoint,
        radius: f64,
        estimator: Estimator,
        tests: &Tests,
        around: &impl Surroundings<Photon<C>>,
    ) -> Estimate<C> {
        let corrections = Correction::pair(estimator, at.normal, [CHECK * radius, radius], around);
        let mut sum = BallSum::new(
            &self.tree,
            self.accepted(at, tests, estimator.area),
            around,
            (radius, estimator),
            corrections,
        );
        let (sums, photons) = (sum.sums(), sum.photons);
        let per_area = 1.0 / estimator.area.area(radius * radius);
        let irradiance = sums.weighed * per_area;
        let narrow = if corrections.is_some() { irradiance } else { sums.disc * per_area };
        let bias = bias(estimator, corrections, sums.wide * (per_area / (CHECK * CHECK)), narrow);
        Estimate { irradiance, bias, photons, radius, remedied: corrections.is_some_and(|pair| pair.tells) }
    }

    /// A photon's offset from a point, in radii.
    fn offset(&self, index: usize, at: &GatherPoint, radius: f64) -> [f64; 3] {
        let point = self.tree.point(index);
        std::array::from_fn(|axis| f64::from(point[axis] - at.position[axis]) / radius)
    }

    /// The k nearest: the flux of the k - 1 nearest over the area of the k-th one's radius (catalogue A2), unbiased where
    /// the irradiance is even. With fewer than k within a finite largest radius, all of them over that radius' area (A6).
    /// Given that radius the others lie evenly in its disc, so that this holds with any kernel, and no other factor is due:
    /// one that vanishes at the rim gives the k-th no weight anyhow (A5; Garcia, Urena and Sbert, "Description and solution
    /// of an unreported intrinsic bias in photon mapping density estimation with constant kernel", 2012).
    fn nearest(
        &self,
        at: &GatherPoint,
        (k, max_radius): (usize, f64),
        estimator: Estimator,
        tests: &Tests,
        around: &impl Surroundings<Photon<C>>,
        scratch: &mut Scratch,
    ) -> Estimate<C> {
        let found = &mut scratch.found;
        let accepted = self.accepted(at, tests, estimator.area);
        let in_block = |first, mask| {
            let counted = accepted.in_block(first, mask);
            if estimator.area.hides() { seen(&self.tree, around, first, counted) } else { counted }
        };
        self.tree.nearest_of_blocks(at.position, k, max_radius as f32, in_block, found);
        let starved = found.len() < k;
        if starved && max_radius.is_finite() {
            return self.sum(at, (found, None), max_radius * max_radius, estimator, tests, around);
        }
        let Some(last) = found.pop().filter(|last| last.distance_squared > 0.0) else {
            return Estimate::nothing(0.0);
        };
        self.sum(at, (found, Some(last.index)), f64::from(last.distance_squared), estimator, tests, around)
    }

    /// The flux of the photons found over the area of a radius. The bias is told as [`PhotonMap::within`] tells it; the photon that has set
    /// the radius counts in neither ball.
    fn sum(
        &self,
        at: &GatherPoint,
        (found, last): (&Neighbours, Option<usize>),
        radius_squared: f64,
        estimator: Estimator,
        tests: &Tests,
        around: &impl Surroundings<Photon<C>>,
    ) -> Estimate<C> {
        let (radius, kernel) = (radius_squared.sqrt(), estimator.kernel);
        let corrections = Correction::pair(estimator, at.normal, [CHECK * radius, radius], around);
        let flux = |index: usize| {
            let photon = &self.tree.payloads()[index];
            photon.flux() * around.weigh(photon)
        };
        let (mut all, mut weighed) = (Colour::ZERO, Colour::ZERO);
        for neighbour in found.iter() {
            let flux = flux(neighbour.index);
            let mut weight = kernel.weight(f64::from(neighbour.distance_squared) / radius_squared);
            if let Some(pair) = &corrections {
                weight *= pair.narrow.at(self.offset(neighbour.index, at, radius));
            }
            all += flux;
            weighed += flux * weight;
        }
        let per_area = 1.0 / estimator.area.area(radius_squared);
        let irradiance = weighed * per_area;
        let mut told = Colour::ZERO;
        if estimator.tells_bias {
            let accepted = self.accepted(at, tests, estimator.area);
            let mut wide = BallSum::new(&self.tree, accepted, around, (radius, estimator), corrections).sums().wide;
            if let Some(last) = last {
                let of_rim = corrections.map_or(1.0, |pair| {
                    let offset = self.offset(last, at, CHECK * radius);
                    kernel.weight(1.0 / (CHECK * CHECK)) * pair.wide.at(offset)
                });
                wide = wide - flux(last) * of_rim;
            }
            let narrow = if corrections.is_some() { irradiance } else { all * per_area };
            told = bias(estimator, corrections, wide * (per_area / (CHECK * CHECK)), narrow);
        }
        let remedied = corrections.is_some_and(|pair| pair.tells);
        Estimate { irradiance, bias: told, photons: found.len(), radius, remedied }
    }

    /// Shows each of the nearest few photons that count at a point.
    pub fn each_nearest(&self, at: &GatherPoint, k: usize, scratch: &mut Scratch, mut show: impl FnMut(&Photon<C>)) {
        let tests = Tests::default();
        let accepted = self.accepted(at, &tests, AreaModel::Disc);
        let in_block = |first, mask| accepted.in_block(first, mask);
        self.tree.nearest_of_blocks(at.position, k, f32::INFINITY, in_block, &mut scratch.found);
        scratch.found.iter().for_each(|neighbour| show(&self.tree.payloads()[neighbour.index]));
    }

    /// Median, over up to `probes` photons spread evenly through the map, of the distance to the k-th nearest photon that
    /// counts there: the radius that holds about k photons where photons are. `None` for a map of fewer than k photons.
    pub fn typical_radius(&self, k: usize, probes: usize, scratch: &mut Scratch) -> Option<f64> {
        let tests = Tests::default();
        let step = (self.len() / probes.max(1)).max(1);
        let mut radii: Vec<f32> = (0..self.len())
            .step_by(step)
            .filter_map(|index| {
                let at = GatherPoint {
                    position: self.tree.point(index),
                    normal: self.tree.payloads()[index].normal.unpack(),
                };
                let accepted = self.accepted(&at, &tests, AreaModel::Disc);
                let in_block = |first, mask| accepted.in_block(first, mask);
                self.tree.nearest_of_blocks(at.position, k, f32::INFINITY, in_block, &mut scratch.found);
                let full = scratch.found.len() == k;
                scratch.found.farthest_squared().filter(|_| full).map(f32::sqrt)
            })
            .collect();
        radii.sort_by(f32::total_cmp);
        radii.get(radii.len() / 2).map(|&r| f64::from(r)).filter(|&r| r > 0.0)
    }
}

/// The bias of an irradiance from what the wide ball and the ball itself read: by the disc where the surface fills it, and there by
/// the square of the radius; else what it would be if it grew with the radius, or with its square where a slope is taken out.
fn bias<const C: usize>(
    estimator: Estimator,
    corrections: Option<Corrections>,
    wide: Colour<C>,
    narrow: Colour<C>,
) -> Colour<C> {
    if !estimator.tells_bias {
        return Colour::ZERO;
    }
    let scale = match corrections {
        None => bias_over_disc(estimator.kernel) / (CHECK * CHECK - 1.0),
        Some(_) => 1.0 / (estimator.area.growth_of_bias(CHECK) - 1.0),
    };
    (wide - narrow) * scale
}

/// The bias of a kernel where the irradiance is smooth, over that of the disc with the same radius. Discs tell it with less
/// noise than the kernel itself would, whose photons near the rim say little.
fn bias_over_disc(kernel: Kernel) -> f64 {
    kernel.second_moment() / Kernel::Disc.second_moment()
}
