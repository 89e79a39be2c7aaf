//! The volume photon map: photons where they met a medium's matter, and the density estimates read from it.
//!
//! In a volume V collides the flux `int_V sigma_t phi dV`, with the fluence rate phi and the extinction coefficient sigma_t; so
//! the flux of the photons in a ball over the ball's volume and sigma_t is phi (Jensen and Christensen, "Efficient
//! simulation of light transport in scenes with participating media using photon maps", 1998, equation 14; there photons
//! are stored where they are scattered, and sigma_s stands for sigma_t). Of a photon that collides with the flux Phi, the
//! share `albedo p(cos)` per solid angle is scattered towards an eye, with the phase function p. A length dt of a ray scatters
//! `albedo sum(Phi p) / volume dt` towards its start, of which the transmittance reaches it: integrated along the ray, the volume
//! becomes the area across it, and the radiance is `sum(albedo Phi p tau) / (pi r^2)` over the photons within r of the ray
//! (Jarosz, Zwicker and Jensen, "The beam radiance estimate for volumetric photon mapping", 2008, equation 12). No extinction
//! coefficient is divided by: thin media need no care.

use std::f64::consts::PI;

use photonlab_kdtree::{BuildError, KdTree, SplitRule};
use photonlab_photometry::{Colour, VolumePhoton};

use crate::{CHECK, Scratch};

/// Photons in media, ready for queries; immutable.
pub struct VolumeMap<const C: usize> {
    tree: KdTree<VolumePhoton<C>>,
}

/// A piece of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Where it starts, metres, in the coordinates of the photons.
    pub origin: [f64; 3],
    /// Unit vector.
    pub direction: [f64; 3],
    /// Metres.
    pub length: f64,
}

/// What of a photon's flux is counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered<const C: usize> {
    /// Share of its flux per steradian that goes the wanted way and arrives.
    pub share: Colour<C>,
    /// True if all that is within reach of the kernel around the photon's place is medium.
    pub resolved: bool,
}

/// A density estimate in a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeEstimate<const C: usize> {
    /// Along a ray, its radiance in W/(m^2 sr) or cd/m^2; at a point, that per metre.
    pub radiance: Colour<C>,
    /// Estimate of the kernel's bias in the part of `radiance` that is resolved, from a kernel of [`CHECK`] times the radius.
    pub bias: Colour<C>,
    /// The part of `radiance` that is not resolved, of whose bias nothing is known.
    pub unresolved: Colour<C>,
    /// Photons that the estimate rests on.
    pub photons: usize,
}

impl<const C: usize> VolumeMap<C> {
    /// Builds the map.
    pub fn build(positions: Vec<[f32; 3]>, photons: Vec<VolumePhoton<C>>, rule: SplitRule) -> Result<Self, BuildError> {
        Ok(Self { tree: KdTree::build(positions, photons, rule)? })
    }

    /// Stored photons.
    pub fn len(&self) -> usize {
        self.tree.len()
    }

    /// True without photons.
    pub fn is_empty(&self) -> bool {
        self.tree.is_empty()
    }

    /// The beam radiance estimate: what is scattered along a piece of a ray towards its start, from all photons within a radius
    /// of it. `scatter` says, for a photon and the distance along the ray to where that is nearest, what counts.
    pub fn along(
        &self,
        beam: &Beam,
        radius: f64,
        mut scatter: impl FnMut(&VolumePhoton<C>, f64) -> Option<Scattered<C>>,
    ) -> VolumeEstimate<C> {
        let end: [f64; 3] = std::array::from_fn(|axis| beam.origin[axis] + beam.length * beam.direction[axis]);
        let ends = [beam.origin, end].map(|end| end.map(|c| c as f32));
        let mut sums = Sums::new(radius);
        self.tree.near_segment(ends, (CHECK * radius) as f32, |index, distance_squared| {
            let point = self.tree.point(index);
            let along = (0..3).map(|axis| (f64::from(point[axis]) - beam.origin[axis]) * beam.direction[axis]).sum();
            if (0.0..=beam.length).contains(&along) {
                let photon = &self.tree.payloads()[index];
                if let Some(scattered) = scatter(photon, along) {
                    sums.add(photon.flux(), scattered, distance_squared);
                }
            }
        });
        // The kernel is a disc across the ray.
        sums.over(PI * radius * radius, CHECK * CHECK)
    }

    /// What is scattered at a point, per metre of a ray there, from all photons in a ball. `scatter` says what counts of each.
    pub fn at(
        &self,
        point: [f32; 3],
        radius: f64,
        mut scatter: impl FnMut(&VolumePhoton<C>) -> Option<Scattered<C>>,
    ) -> VolumeEstimate<C> {
        let mut sums = Sums::new(radius);
        self.tree.within(point, (CHECK * radius) as f32, |index, distance_squared| {
            let photon = &self.tree.payloads()[index];
            if let Some(scattered) = scatter(photon) {
                sums.add(photon.flux(), scattered, f64::from(distance_squared));
            }
        });
        sums.over(4.0 / 3.0 * PI * radius.powi(3), CHECK.powi(3))
    }

    /// Radius of the cylinder around a ray that holds about `count` photons along a length in metres, told for each medium: the
    /// median of what the distances to the `count`-th nearest neighbours of up to `probes` photons, spread evenly through the
    /// map, say of the photons' density. `None` for a map of fewer than `count` photons.
    pub fn typical_radius(
        &self,
        count: usize,
        length: impl Fn(u32) -> f64,
        probes: usize,
        scratch: &mut Scratch,
    ) -> Option<f64> {
        let step = (self.len() / probes.max(1)).max(1);
        let found = scratch.neighbours();
        let mut radii: Vec<f64> = (0..self.len())
            .step_by(step)
            .filter_map(|index| {
                self.tree.nearest(self.tree.point(index), count, f32::INFINITY, found);
                let full = found.len() == count;
                let ball = f64::from(found.farthest_squared().filter(|_| full)?).sqrt();
                // A ball and a cylinder of like volume hold as many.
                Some((4.0 / 3.0 * ball.powi(3) / length(self.tree.payloads()[index].medium)).sqrt())
            })
            .collect();
        radii.sort_by(f64::total_cmp);
        radii.get(radii.len() / 2).copied().filter(|&radius| radius > 0.0)
    }
}

/// Flux times share, in the kernel and in what a wider one has around it.
struct Sums<const C: usize> {
    inside: f64,
    resolved: Colour<C>,
    unresolved: Colour<C>,
    ring: Colour<C>,
    photons: usize,
}

impl<const C: usize> Sums<C> {
    fn new(radius: f64) -> Self {
        let none = Colour::ZERO;
        Self { inside: radius * radius, resolved: none, unresolved: none, ring: none, photons: 0 }
    }

    fn add(&mut self, flux: Colour<C>, scattered: Scattered<C>, distance_squared: f64) {
        let light = flux * scattered.share;
        match (distance_squared <= self.inside, scattered.resolved) {
            (true, true) => self.resolved += light,
            (true, false) => self.unresolved += light,
            (false, true) => self.ring += light,
            (false, false) => {}
        }
        self.photons += usize::from(distance_squared <= self.inside);
    }

    /// Divided by the kernel's size, and checked against one that is `wider` times as large. Whatever its dimension, the bias of
    /// a kernel grows with its radius squared where light is smooth.
    fn over(self, size: f64, wider: f64) -> VolumeEstimate<C> {
        let resolved = self.resolved * (1.0 / size);
        let of_wider = (self.resolved + self.ring) * (1.0 / (size * wider));
        let unresolved = self.unresolved * (1.0 / size);
        VolumeEstimate {
            radiance: resolved + unresolved,
            bias: (of_wider - resolved) * (1.0 / (CHECK * CHECK - 1.0)),
            unresolved,
            photons: self.photons,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use photonlab_photometry::{PackedDirection, PathClass};

    fn photon(flux: f32, medium: u32) -> VolumePhoton<1> {
        let direction = PackedDirection::pack([0.0, 0.0, 1.0]);
        VolumePhoton { flux: [flux], direction, medium, class: PathClass::Indirect, segments: 1 }
    }

    fn all(_: &VolumePhoton<1>) -> Option<Scattered<1>> {
        Some(Scattered { share: Colour::ONE, resolved: true })
    }

    /// One photon near a ray counts over the disc, one before its start not at all, one in the ring for the bias alone.
    #[test]
    fn a_beam_divides_by_its_disc() {
        let positions = vec![[0.05, 0.0, 1.0], [0.0, 0.0, -0.01], [0.15, 0.0, 0.5], [0.3, 0.0, 0.5]];
        let photons = vec![photon(2.0, 0), photon(10.0, 0), photon(4.0, 0), photon(8.0, 0)];
        let map = VolumeMap::build(positions, photons, SplitRule::Median).expect("finite");
        let beam = Beam { origin: [0.0; 3], direction: [0.0, 0.0, 1.0], length: 1.0 + 1e-6 };
        let mut places = vec![];
        let found = map.along(&beam, 0.1, |photon, along| {
            places.push(along);
            all(photon)
        });
        let disc = PI * 0.01;
        assert!((found.radiance[0] - 2.0 / disc).abs() < 1e-9);
        assert!((found.bias[0] - ((2.0 + 4.0) / (4.0 * disc) - 2.0 / disc) / 3.0).abs() < 1e-9);
        assert_eq!((found.photons, found.unresolved[0]), (1, 0.0));
        places.sort_by(f64::total_cmp);
        assert!((places[0] - 0.5).abs() < 1e-6 && (places[1] - 1.0).abs() < 1e-6 && places.len() == 2);
    }

    /// A ball divides by its volume; photons of another medium are the caller's to leave out; what is unresolved says so.
    #[test]
    fn a_ball_divides_by_its_volume() {
        let positions = vec![[0.05, 0.0, 0.0], [0.0, 0.05, 0.0], [0.0, 0.0, 0.15]];
        let photons = vec![photon(2.0, 0), photon(16.0, 1), photon(6.0, 0)];
        let map = VolumeMap::build(positions, photons, SplitRule::Median).expect("finite");
        let ball = 4.0 / 3.0 * PI * 0.001;
        let found = map.at([0.0; 3], 0.1, |photon| all(photon).filter(|_| photon.medium == 0));
        assert!((found.radiance[0] - 2.0 / ball).abs() < 1e-9 / ball);
        assert!((found.bias[0] - ((2.0 + 6.0) / 8.0 - 2.0) / (3.0 * ball)).abs() < 1e-9 / ball);
        let doubtful = map.at([0.0; 3], 0.1, |_| Some(Scattered { share: Colour::ONE, resolved: false }));
        assert_eq!((doubtful.radiance, doubtful.bias), (doubtful.unresolved, Colour::ZERO));
    }
}
