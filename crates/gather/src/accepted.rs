//! Which photons count at a point, a block of sixteen at a time.

use photonlab_kdtree::BLOCK;
use photonlab_photometry::{PackedDirection, Photon};

use crate::{GatherPoint, SAME_SURFACE, Tests, facing::Facing};

/// Which photons count at a point.
#[derive(Clone, Copy)]
pub(crate) struct Accepted<'a, const C: usize> {
    pub(crate) at: &'a GatherPoint,
    pub(crate) tests: &'a Tests,
    /// In the order of their tree.
    pub(crate) photons: &'a [Photon<C>],
    facing: &'a Facing,
    /// The point's normal as photons have theirs.
    normal: PackedDirection,
}

impl<'a, const C: usize> Accepted<'a, C> {
    pub(crate) fn new(at: &'a GatherPoint, tests: &'a Tests, photons: &'a [Photon<C>], facing: &'a Facing) -> Self {
        let normal = PackedDirection::pack(at.normal.map(f64::from));
        Self { at, tests, photons, facing, normal }
    }

    /// The photons of a block that count, of those in question, as bits.
    #[inline(always)]
    pub(crate) fn in_block(&self, first: usize, mask: u16) -> u16 {
        let common = self.facing.of_block(first);
        if common.is_some_and(|normal| self.has_none(normal)) {
            return 0;
        }
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
