//! Synthetic photons and how they are read. The search radius is 1 m unless it is what is swept.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimator, GatherPoint, Kernel, PhotonMap, Scratch, Surroundings, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_photometry::{PackedDirection, Photon};
use photonlab_sampling::{Stream, warp};

use crate::reproduce::field::Field;

/// Every photon in the ball counts.
pub(super) const NO_TEST: Tests = Tests { normal: false, side: false, max_segments: None };
/// Those on surfaces turned like the query's.
pub(super) const NORMAL_TEST: Tests = Tests { normal: true, side: false, max_segments: None };
/// Those that travelled towards the query's front.
pub(super) const SIDE_TEST: Tests = Tests { normal: false, side: true, max_segments: None };

/// Photons of irradiance 1 over what is inside the ball.
pub(super) const CLIPPED: Estimator = Estimator::new(Kernel::Disc, AreaModel::Clipped);

/// Photons to the square metre if the disc of radius 1 m holds this many.
pub(super) fn density(photons: f64) -> f64 {
    photons / PI
}

/// A query on a plane z, facing up.
pub(super) fn facing_up(position: [f64; 3]) -> GatherPoint {
    GatherPoint { position: position.map(|x| x as f32), normal: [0.0, 0.0, 1.0] }
}

/// The `k` nearest, however far.
pub(super) fn nearest(k: f64) -> Bandwidth {
    Bandwidth::Nearest { k: k as usize, max_radius: f64::INFINITY }
}

/// The photons in a map.
pub(super) fn map(field: Field) -> anyhow::Result<PhotonMap<1>> {
    Ok(PhotonMap::build(field.positions, field.photons, SplitRule::Median)?)
}

/// What a disc reads.
pub(super) fn read(
    map: &PhotonMap<1>,
    at: &GatherPoint,
    bandwidth: Bandwidth,
    tests: &Tests,
    scratch: &mut Scratch,
) -> f64 {
    map.gather(at, bandwidth, AreaModel::Disc, tests, scratch).irradiance[0]
}

/// What an estimate that knows the surfaces around the query reads.
pub(super) fn read_among(
    map: &PhotonMap<1>,
    at: &GatherPoint,
    bandwidth: Bandwidth,
    tests: &Tests,
    around: &impl Surroundings<Photon<1>>,
    scratch: &mut Scratch,
) -> f64 {
    map.gather_among(at, bandwidth, CLIPPED, tests, around, scratch).irradiance[0]
}

/// Lets every photon arrive from a random direction of diffuse light instead of straight against its normal.
pub(super) fn diffuse(field: &mut Field, stream: &mut Stream) {
    for photon in &mut field.photons {
        let normal = DVec3::from(photon.normal.unpack().map(f64::from)).normalize();
        let from = warp::square_to_cosine_hemisphere(stream.next2(), normal);
        photon.direction = PackedDirection::pack((-from).to_array());
    }
}

/// A square of irradiance 1 around the origin of the plane z = 0 that reaches `half` metres each way.
pub(super) fn square(photons: f64, half: f64, stream: &mut Stream) -> Field {
    Field::uniform(density(photons), [-half; 2], [half; 2], stream)
}

/// Half the side, in metres, of a square that holds the k nearest of a field with k photons to the disc of radius 1 m (but once in
/// 10^12 fields).
pub(super) fn reach_of_nearest(k: f64) -> f64 {
    ((k + 8.0 * k.sqrt() + 30.0) / k).sqrt()
}
