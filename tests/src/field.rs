//! Synthetic photons: Poisson fields on flat patches and spheres, whose estimates are known without any tracing.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use photonlab_gather::{
    Bandwidth, Estimate, Estimator, GatherPoint, Inside, Kernel, PhotonMap, Scratch, Surroundings, Tests,
};
use photonlab_kdtree::SplitRule;
use photonlab_measure::Replicates;
use photonlab_photometry::{PackedDirection, PathClass, Photon};
use photonlab_sampling::{Purpose, Stream, warp};
use rayon::prelude::*;

/// Photons of one replicate, in coordinates that are turned and moved before the map sees them, so that no law holds
/// because a plane happens to lie along the axes.
pub struct Field {
    frame: DAffine3,
    positions: Vec<[f32; 3]>,
    photons: Vec<Photon<1>>,
}

impl Default for Field {
    fn default() -> Self {
        let turn = DQuat::from_axis_angle(DVec3::new(0.48, -0.6, 0.64), 1.1);
        let frame = DAffine3::from_rotation_translation(turn, DVec3::new(0.7, -0.4, 1.9));
        Self { frame, positions: Vec::new(), photons: Vec::new() }
    }
}

impl Field {
    /// Adds a homogeneous Poisson field of `density` photons per square metre on the parallelogram from `corner` along
    /// two `edges`; each photon has flux 1 / `density`, so that the irradiance is 1, and arrives against `normal`.
    pub fn lit(mut self, density: f64, corner: DVec3, edges: [DVec3; 2], normal: DVec3, stream: &mut Stream) -> Self {
        for _ in 0..poisson(density * edges[0].cross(edges[1]).length(), stream) {
            let [u, v] = stream.next2();
            self.push(corner + u * edges[0] + v * edges[1], normal, -normal, 1.0 / density);
        }
        self
    }

    /// The same on the rectangle `low` to `high` of the plane z = 0, normal +z.
    pub fn floor(self, density: f64, low: [f64; 2], high: [f64; 2], stream: &mut Stream) -> Self {
        let edges = [DVec3::X * (high[0] - low[0]), DVec3::Y * (high[1] - low[1])];
        self.lit(density, DVec3::new(low[0], low[1], 0.0), edges, DVec3::Z, stream)
    }

    /// The same on the inside of the unit sphere.
    pub fn inside_of_sphere(mut self, density: f64, stream: &mut Stream) -> Self {
        for _ in 0..poisson(density * 4.0 * std::f64::consts::PI, stream) {
            let position = warp::square_to_uniform_sphere(stream.next2());
            self.push(position, -position, position, 1.0 / density);
        }
        self
    }

    /// Adds one photon.
    pub fn push(&mut self, position: DVec3, normal: DVec3, direction: DVec3, flux: f64) {
        self.positions.push(self.frame.transform_point3(position).as_vec3().to_array());
        self.photons.push(Photon {
            flux: [flux as f32],
            direction: PackedDirection::pack(self.frame.transform_vector3(direction).to_array()),
            normal: PackedDirection::pack(self.frame.transform_vector3(normal).to_array()),
            class: PathClass::Direct,
            segments: 1,
        });
    }

    /// Multiplies every photon's flux by a factor of its place: uneven irradiance from an even field.
    pub fn shaded(mut self, factor: impl Fn(DVec3) -> f64) -> Self {
        let back = self.frame.inverse();
        for (position, photon) in self.positions.iter().zip(&mut self.photons) {
            photon.flux[0] *= factor(back.transform_point3(DVec3::from(position.map(f64::from)))) as f32;
        }
        self
    }

    /// Builds the map and gathers at points with their normals.
    pub fn gather<const N: usize>(
        self,
        at: [(DVec3, DVec3); N],
        bandwidth: Bandwidth,
        estimator: impl Into<Estimator>,
        tests: &Tests,
    ) -> [Estimate<1>; N] {
        self.gather_among(at, bandwidth, estimator, tests, |_, _| None)
    }

    /// The same where `inside` tells what of the surface a ball around a query, told by its number, holds.
    pub fn gather_among<const N: usize>(
        self,
        at: [(DVec3, DVec3); N],
        bandwidth: Bandwidth,
        estimator: impl Into<Estimator>,
        tests: &Tests,
        inside: impl Fn(usize, f64) -> Option<Inside>,
    ) -> [Estimate<1>; N] {
        let (frame, estimator) = (self.frame, estimator.into());
        let map = PhotonMap::build(self.positions, self.photons, SplitRule::Median).expect("finite photons");
        let mut scratch = Scratch::default();
        let mut query = 0;
        at.map(|(position, normal)| {
            let around = Around { frame, inside: |radius| inside(query, radius) };
            let point = GatherPoint {
                position: frame.transform_point3(position).as_vec3().to_array(),
                normal: frame.transform_vector3(normal).as_vec3().to_array(),
            };
            let estimate = map.gather_among(&point, bandwidth, estimator, tests, &around, &mut scratch);
            query += 1;
            estimate
        })
    }
}

/// The surface around a query, turned as the field is.
struct Around<F> {
    frame: DAffine3,
    inside: F,
}

impl<P, F: Fn(f64) -> Option<Inside>> Surroundings<P> for Around<F> {
    fn inside(&self, radius: f64, _: Kernel) -> Option<Inside> {
        let Inside { area, first, second, open } = (self.inside)(radius)?;
        let turn = self.frame.matrix3;
        let second = turn * DMat3::from_cols_array_2d(&second) * turn.transpose();
        Some(Inside { area, first: (turn * DVec3::from(first)).to_array(), second: second.to_cols_array_2d(), open })
    }
}

/// Runs independent replicates, each with a stream of its own, and collects what they return in their order.
pub fn replicates<T: Send>(count: u64, seed: u64, one: impl Fn(&mut Stream) -> T + Sync) -> Vec<T> {
    let run = |index| one(&mut Stream::new(seed, Purpose::Synthetic, 0, index));
    (0..count).into_par_iter().map(run).collect()
}

/// The irradiance of one query over replicates of several queries.
pub fn column<const N: usize>(rows: &[[Estimate<1>; N]], query: usize) -> Replicates {
    rows.iter().map(|row| row[query].irradiance[0]).collect()
}

/// A Poisson number: by waiting times for small means, by halving large ones into independent parts, which is exact.
fn poisson(mean: f64, stream: &mut Stream) -> u64 {
    if mean > 30.0 {
        return poisson(0.5 * mean, stream) + poisson(0.5 * mean, stream);
    }
    let (mut count, mut elapsed) = (0, -stream.next().ln());
    while elapsed < mean {
        count += 1;
        elapsed -= stream.next().ln();
    }
    count
}
