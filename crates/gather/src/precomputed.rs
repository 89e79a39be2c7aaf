//! Density estimates made once, at places of their own, and told to all that land near them.

use photonlab_kdtree::{BuildError, KdTree, SplitRule};
use photonlab_photometry::PackedDirection;

use crate::{CHECK, Estimate, GatherPoint, Kernel, SAME_SURFACE, Scratch};

/// Estimates in a tree by their places (Christensen, "Faster photon map global illumination", 1999).
///
/// A place is to be chosen without the photons that are gathered there: one that is a photon itself counts itself, and reads
/// a sixteenth too much where sixteen are gathered. Places that are photons of another map stand closer where it is brighter, so that the nearest
/// is brighter on average: by `d^2 |grad E|^2 / (2 E)`, which nothing tells. A program that signs its readings does not use this.
pub struct Precomputed<const C: usize> {
    tree: KdTree<Known<C>>,
    kernel: Kernel,
}

#[derive(Clone, Copy)]
struct Known<const C: usize> {
    estimate: Estimate<C>,
    normal: PackedDirection,
}

impl<const C: usize> Precomputed<C> {
    /// Of places and what the same kernel has read there; nothing was remedied and no ball may have left its surface.
    pub fn new(known: Vec<(GatherPoint, Estimate<C>)>, kernel: Kernel) -> Result<Self, BuildError> {
        let places = known.iter().map(|(at, _)| at.position).collect();
        let known = known.iter().map(|&(at, estimate)| {
            let normal = PackedDirection::pack(at.normal.map(f64::from));
            Known { estimate, normal }
        });
        Ok(Self { tree: KdTree::build(places, known.collect(), SplitRule::Median)?, kernel })
    }

    /// The estimate of the nearest place within a radius in metres whose normal agrees, if there is one. That it was made a distance d away
    /// adds d^2 to the kernel's second moment, on average over places all around, and so to the bias.
    pub fn near(&self, at: &GatherPoint, radius: f64, scratch: &mut Scratch) -> Option<Estimate<C>> {
        let agrees = |known: &Known<C>| {
            let normal = known.normal.unpack();
            normal.iter().zip(at.normal).map(|(a, b)| a * b).sum::<f32>() >= SAME_SURFACE
        };
        let found = scratch.neighbours();
        self.tree.nearest_accepted(at.position, 1, radius as f32, agrees, found);
        let nearest = found.farthest()?;
        let mut estimate = self.tree.payloads()[nearest.index].estimate;
        let of_kernel = self.kernel.second_moment() * estimate.radius * estimate.radius;
        estimate.bias = estimate.bias * (1.0 + f64::from(nearest.distance_squared) / of_kernel);
        Some(estimate)
    }
}

/// No place farther than this many radii stands for another: the ball that checks the bias around one then holds the ball around the
/// other.
pub const NEAR: f64 = CHECK - 1.0;

#[cfg(test)]
mod tests {
    use photonlab_photometry::Colour;

    use super::*;

    fn place(x: f32, normal: [f32; 3]) -> GatherPoint {
        GatherPoint { position: [x, 0.0, 0.0], normal }
    }

    fn known(x: f32, normal: [f32; 3], irradiance: f64) -> (GatherPoint, Estimate<1>) {
        let estimate =
            Estimate { irradiance: Colour([irradiance]), bias: Colour([0.3]), photons: 9, ..Estimate::nothing(0.5) };
        (place(x, normal), estimate)
    }

    #[test]
    fn the_nearest_place_of_the_same_side_tells_and_its_distance_adds_to_the_bias() {
        let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
        let all = vec![known(0.0, up, 1.0), known(1.0, up, 2.0), known(0.9, down, 3.0)];
        let precomputed = Precomputed::new(all, Kernel::Disc).expect("finite");
        let mut scratch = Scratch::default();
        let mut at = |x, normal| precomputed.near(&place(x, normal), 0.5, &mut scratch);
        assert_eq!(at(0.25, up).map(|e| e.irradiance.0[0]), Some(1.0));
        assert_eq!(at(0.8, up).map(|e| e.irradiance.0[0]), Some(2.0));
        assert_eq!(at(0.8, down).map(|e| e.irradiance.0[0]), Some(3.0));
        assert!(at(0.2, down).is_none() && at(1.6, up).is_none());
        // A quarter metre beside a disc of half a metre: the second moment is 1/8 + 1/16 instead of 1/8.
        let bias = at(0.25, up).expect("near").bias.0[0];
        assert!((bias - 0.45).abs() < 1e-9, "{bias}");
    }

    #[test]
    fn without_places_nothing_is_told() {
        let precomputed = Precomputed::<1>::new(Vec::new(), Kernel::Disc).expect("empty");
        assert!(precomputed.near(&place(0.0, [0.0, 0.0, 1.0]), 1.0, &mut Scratch::default()).is_none());
    }
}
