//! Which photons count at a point, a block of sixteen at a time.

use photonlab_kdtree::{BLOCK, KdTree};
use photonlab_photometry::{PackedDirection, Photon};

use crate::{AreaModel, GatherPoint, SAME_SURFACE, Tests, facing::Facing};

/// Which photons count at a point.
#[derive(Clone, Copy)]
pub(crate) struct Accepted<'a, const C: usize> {
    pub(crate) at: &'a GatherPoint,
    pub(crate) tests: &'a Tests,
    tree: &'a KdTree<Photon<C>>,
    /// In the order of the tree.
    pub(crate) photons: &'a [Photon<C>],
    /// See [`AreaModel::flatness`].
    flatness: Option<f32>,
    facing: &'a Facing,
    /// The point's normal as photons have theirs.
    normal: PackedDirection,
}

impl<'a, const C: usize> Accepted<'a, C> {
    pub(crate) fn new(
        (at, tests, area): (&'a GatherPoint, &'a Tests, AreaModel),
        tree: &'a KdTree<Photon<C>>,
        facing: &'a Facing,
    ) -> Self {
        let normal = PackedDirection::pack(at.normal.map(f64::from));
        Self { at, tests, tree, photons: tree.payloads(), flatness: area.flatness(), facing, normal }
    }

    /// The photons of a block that count, of those in question, as bits.
    #[inline(always)]
    pub(crate) fn in_block(&self, first: usize, mask: u16) -> u16 {
        let common = self.facing.of_block(first);
        if common.is_some_and(|normal| self.has_none(normal)) {
            return 0;
        }
        let mask = match self.flatness {
            Some(flatness) => mask & self.flat(first, flatness),
            None => mask,
        };
        // On a flat wall the photons of a block have passed the tests when their normal is the point's.
        if common == Some(self.normal) && self.tests.max_segments.is_none() {
            return mask;
        }
        match self.photons[first..].first_chunk() {
            Some(photons) => self.of_block(photons) & mask,
            None => self.of_block(&padded_block(&self.photons[first..])) & mask,
        }
    }

    /// Whether it lies on the point's surface and came to the point's side of it.
    #[inline(always)]
    fn is_here(&self, normal: [f32; 3], direction: [f32; 3]) -> bool {
        let lies_here = self.lies_along(normal) | !self.tests.normal;
        let came_here = (self.cosine(direction) < 0.0) | !self.tests.side;
        lies_here & came_here
    }

    /// The photons of a block that lie near the tangent plane for their distance, as bits.
    fn flat(&self, first: usize, flatness: f32) -> u16 {
        let axes = self.tree.block_points(first);
        let here = self.at.position;
        // A place is known to its last digit.
        let least = here.iter().fold(0.0f32, |most, x| most.max(x.abs())) * 4.0 * f32::EPSILON;
        (0..BLOCK).fold(0, |bits, lane| {
            let offset: [f32; 3] = std::array::from_fn(|axis| axes[axis][lane] - here[axis]);
            let squared: f32 = offset.iter().map(|x| x * x).sum();
            let is_flat = self.cosine(offset).abs() <= flatness * squared.sqrt() + least;
            bits | u16::from(is_flat) << lane
        })
    }

    /// Whether no photon of a normal counts.
    #[inline(always)]
    fn has_none(&self, normal: PackedDirection) -> bool {
        self.tests.normal & !self.lies_along(normal.along())
    }

    /// Along the point's normal, of a vector of any length.
    #[inline(always)]
    fn cosine(&self, a: [f32; 3]) -> f32 {
        a[0] * self.at.normal[0] + a[1] * self.at.normal[1] + a[2] * self.at.normal[2]
    }

    #[inline(always)]
    fn lies_along(&self, normal: [f32; 3]) -> bool {
        let cosine = self.cosine(normal);
        let length_squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
        (cosine > 0.0) & (cosine * cosine >= SAME_SURFACE * SAME_SURFACE * length_squared)
    }

    #[inline(always)]
    fn is_short(&self, photon: &Photon<C>) -> bool {
        self.tests.max_segments.is_none_or(|max| u32::from(photon.segments) <= max)
    }

    /// The photons of a block that count, as bits.
    #[inline(always)]
    fn of_block(&self, photons: &[Photon<C>; BLOCK]) -> u16 {
        // Copied first: of records in a row no vectors are made.
        let (mut normals, mut directions) = ([0; BLOCK], [0; BLOCK]);
        for lane in 0..BLOCK {
            normals[lane] = photons[lane].normal.to_bits();
            directions[lane] = photons[lane].direction.to_bits();
        }
        let mut bits = [0u32; BLOCK];
        for lane in 0..BLOCK {
            let [normal, direction] = [normals[lane], directions[lane]].map(PackedDirection::from_bits);
            bits[lane] = u32::from(self.is_here(normal.along(), direction.along())) << lane;
        }
        let here = bits.iter().fold(0, |all, bit| all | bit) as u16;
        let long = |lane: &usize| !self.is_short(&photons[*lane]);
        match self.tests.max_segments {
            None => here,
            Some(_) => (0..BLOCK).filter(long).fold(here, |all, lane| all & !(1 << lane)),
        }
    }
}

/// The last photons with enough copies of the very last to make a block.
pub(crate) fn padded_block<const C: usize>(photons: &[Photon<C>]) -> [Photon<C>; BLOCK] {
    std::array::from_fn(|lane| photons[lane.min(photons.len() - 1)])
}

#[cfg(test)]
mod tests {
    use photonlab_kdtree::SplitRule;
    use photonlab_photometry::PathClass;

    use super::*;
    use crate::{Bandwidth, PhotonMap, Scratch};

    /// Even photons on a floor and on a shelf a quarter of the radius above it, both facing up, and on a slope of 1 in 20.
    #[test]
    fn flattened_balls_leave_out_what_is_over_the_plane() {
        let photon = Photon {
            flux: [1.0],
            direction: PackedDirection::pack([0.0, 0.0, -1.0]),
            normal: PackedDirection::pack([0.0, 0.0, 1.0]),
            class: PathClass::Direct,
            segments: 1,
        };
        let even = |i: usize| ((i % 64) as f32 / 32.0 - 1.0, (i / 64) as f32 / 32.0 - 1.0);
        let layers: [fn(f32) -> f32; 2] = [|x| 0.05 * x, |_| 0.25];
        let place = |i: usize, height: fn(f32) -> f32| [even(i).0, even(i).1, height(even(i).0)];
        let all: Vec<_> = layers.iter().flat_map(|&layer| (0..64 * 64).map(move |i| place(i, layer))).collect();
        let map = PhotonMap::<1>::build(all.clone(), vec![photon; all.len()], SplitRule::Median).expect("finite");
        let at = GatherPoint { position: [0.0; 3], normal: [0.0, 0.0, 1.0] };
        let mut scratch = Scratch::default();
        for tests in [Tests::default(), Tests { max_segments: Some(1), ..Tests::default() }] {
            let mut count = |bandwidth, area: AreaModel| map.gather(&at, bandwidth, area, &tests, &mut scratch).photons;
            let on_slope = all.iter().take(64 * 64).filter(|p| p.iter().map(|x| x * x).sum::<f32>() <= 0.64).count();
            let ball = Bandwidth::Radius(0.8);
            assert_eq!(count(ball, AreaModel::Flattened), on_slope);
            assert!(count(ball, AreaModel::Disc) > on_slope + on_slope / 2);
            // The k-th photon is as far as the k-th on the slope alone.
            let nearest = Bandwidth::Nearest { k: 500, max_radius: f64::INFINITY };
            let radius = map.gather(&at, nearest, AreaModel::Flattened, &tests, &mut scratch).radius;
            let nearer =
                all.iter().take(64 * 64).filter(|p| f64::from(p.iter().map(|x| x * x).sum::<f32>()).sqrt() <= radius);
            assert!(nearer.count() >= 500);
        }
    }
}
