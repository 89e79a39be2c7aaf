//! Photons that no reading of a pass can reach, which need not stand in its map.

use photonlab_gather::CHECK;
use photonlab_sampling::Optics;
use rayon::prelude::*;

use crate::{
    Cell, Method, PassPhotons, Schedule, Session,
    caustic_cells::CausticCells,
    look::Look,
    maps::{PassMaps, shrinkage},
    run::Run,
};

/// A pass is sifted if it emits at least so many photons for each point that it reads: fewer points cost less than what they spare a map.
const PHOTONS_PER_POINT: u64 = 64;
/// Bits of the table for each voxel near a point, so that few others share one.
const BITS_PER_VOXEL: usize = 64;
/// Voxels are so much wider than what the readings reach, for rounding.
const MARGIN: f64 = 1.001;

/// The voxels near the points that a pass reads. It may take a far place for a near one, never the reverse.
pub(crate) struct Near {
    /// Voxels per metre.
    scale: f64,
    bits: Vec<u64>,
}

impl Near {
    /// All that is within `reach` metres of some place.
    fn new(places: &[[f32; 3]], reach: f64) -> Self {
        let bits = (places.len() * 27 * BITS_PER_VOXEL).next_power_of_two().max(64);
        let mut near = Self { scale: 1.0 / (MARGIN * reach), bits: vec![0; bits / 64] };
        for &place in places {
            let voxel = near.voxel(place);
            for step in 0..27 {
                let offset = [step % 3, step / 3 % 3, step / 9].map(|x| x - 1);
                let bit = near.bit(std::array::from_fn(|axis| voxel[axis].saturating_add(offset[axis])));
                near.bits[bit / 64] |= 1 << (bit % 64);
            }
        }
        near
    }

    /// False if a place is out of reach.
    fn has(&self, place: [f32; 3]) -> bool {
        let bit = self.bit(self.voxel(place));
        self.bits[bit / 64] >> (bit % 64) & 1 != 0
    }

    fn voxel(&self, place: [f32; 3]) -> [i32; 3] {
        place.map(|x| (f64::from(x) * self.scale).floor() as i32)
    }

    /// Which bit stands for a voxel (Teschner et al., "Optimized spatial hashing", 2003).
    fn bit(&self, voxel: [i32; 3]) -> usize {
        let hashed = voxel
            .iter()
            .zip([73_856_093u32, 19_349_663, 83_492_791])
            .fold(0, |hashed: u32, (&x, prime)| hashed ^ (x as u32).wrapping_mul(prime));
        // The best bits of a product are its upper ones.
        let spread = u64::from(hashed).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 20;
        spread as usize & (64 * self.bits.len() - 1)
    }

    /// Leaves out what lies out of reach.
    pub(crate) fn sift<const C: usize>(&self, photons: &mut PassPhotons<C>) {
        let kept = photons.positions.iter().zip(&photons.photons).filter(|(place, _)| self.has(**place));
        (photons.positions, photons.photons) = kept.map(|(place, photon)| (*place, *photon)).unzip();
    }
}

impl<const C: usize> Session<'_, C> {
    /// What the readings of the next pass reach, if they are few and their radii are known before its photons are; `None` where
    /// all photons are wanted.
    pub(crate) fn near(
        &self,
        run: &Run<C>,
        cells: &[Cell],
        optics: &Optics<C>,
        number: u64,
        schedule: &Schedule,
    ) -> Option<Near> {
        let shrunken = || Some(run.radii.surface? * shrinkage(number as u32));
        let radius = match self.settings.method {
            Method::Radius { radius } => radius.or_else(shrunken),
            Method::Adaptive => shrunken(),
            _ => None,
        }?;
        let samples = schedule.samples(number);
        let few = samples * cells.len() as u64 * PHOTONS_PER_POINT <= schedule.photons(number);
        // In media a point depends on more than the eye's own numbers.
        if !few || !self.world.scene.media.is_empty() {
            return None;
        }
        let (maps, caustics, shares) = (PassMaps::none(), CausticCells::none(), vec![1.0; cells.len()]);
        let look = Look {
            world: self.world,
            optics,
            settings: &self.settings,
            maps: &maps,
            looks_around: false,
            pass: number as u32,
            samples,
            k: 0,
            told_of: 0,
            shares: &shares,
            caustics: &caustics,
            guides: &[],
            cache: None,
        };
        let of_cell = |index: usize| {
            let shift = look.shift(index);
            let spots = (0..samples).filter_map(|sample| look.spot(&cells[index], index, sample, &shift));
            spots.map(|spot| self.world.stored(spot.at.position)).collect::<Vec<_>>()
        };
        let places = (0..cells.len()).into_par_iter().map(of_cell).collect::<Vec<_>>().concat();
        let widest = run.of_cells.iter().map(|cell| self.radius_of(cell, radius)).fold(radius, f64::max);
        Some(Near::new(&places, CHECK * widest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_near_is_left_out_and_most_of_the_rest_is() {
        let unit = |i: u32, by: f64| (f64::from(i) * by).fract() as f32;
        let place = |i: u32| [unit(i, 0.618_034), unit(i, 0.414_214), unit(i, 0.732_051)].map(|x| 20.0 * x - 10.0);
        let points: Vec<_> = (0..40).map(place).collect();
        let near = Near::new(&points, 0.3);
        let distance = |a: [f32; 3], b: [f32; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt();
        let (mut within, mut kept) = (0, 0);
        for i in 40..200_000 {
            let is_near = points.iter().any(|&point| distance(point, place(i)) <= 0.3);
            within += usize::from(is_near);
            kept += usize::from(near.has(place(i)));
            assert!(near.has(place(i)) || !is_near);
        }
        assert!(within > 50 && kept < 8000, "{within} {kept}");
    }
}
