//! What all photons of a block have in common: on flat walls, their normal.

use photonlab_kdtree::BLOCK;
use photonlab_photometry::{PackedDirection, Photon};

/// The normal that all photons of each block share, every one of which came to that side of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facing {
    of_blocks: Vec<Option<PackedDirection>>,
}

impl Facing {
    /// Of photons in the order of their tree.
    pub(crate) fn of<const C: usize>(photons: &[Photon<C>]) -> Self {
        let common = |photons: &[Photon<C>]| {
            let normal = photons[0].normal;
            let along = normal.along();
            let arrived = |photon: &Photon<C>| {
                let direction = photon.direction.along();
                (0..3).map(|axis| direction[axis] * along[axis]).sum::<f32>() < 0.0
            };
            photons.iter().all(|photon| photon.normal == normal && arrived(photon)).then_some(normal)
        };
        Self { of_blocks: photons.chunks(BLOCK).map(common).collect() }
    }

    /// Of the block whose first photon has this index.
    #[inline(always)]
    pub(crate) fn of_block(&self, first: usize) -> Option<PackedDirection> {
        self.of_blocks[first / BLOCK]
    }
}
