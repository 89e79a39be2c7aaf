//! Light in media, read by a ball.

use std::f64::consts::PI;

use photonlab_gather::{Scattered, VolumeEstimate, VolumeMap};
use photonlab_kdtree::SplitRule;
use photonlab_measure::Axis;
use photonlab_photometry::{Colour, PackedDirection, PathClass, VolumePhoton};
use photonlab_reference::atlas::{exponential_over_ball, exponential_over_two_balls, share_of_ball};
use photonlab_sampling::Stream;

use super::mode::{Curve, Mode, Part, each};
use crate::reproduce::field::poisson;

/// The ball that tells the bias reaches this far, in search radii.
const REACH: f64 = 2.0;

/// Photons in the box of half the sides [`REACH`] around the origin from a height on, with a density that falls off as `exp(-slope
/// z)` and one photon's flux over the density 1.
fn volume(photons: f64, slope: f64, from: f64, stream: &mut Stream) -> anyhow::Result<VolumeMap<1>> {
    let per_volume = photons / (4.0 / 3.0 * PI);
    // The integral of the fall-off from `from` to the top, and its inverse.
    let (bottom, top) = ((-slope * from).exp(), (-slope * REACH).exp());
    let height = if slope > 0.0 { (bottom - top) / slope } else { REACH - from };
    let mut positions = Vec::new();
    for _ in 0..poisson(per_volume * 4.0 * REACH * REACH * height, stream) {
        let ([u, v], w) = (stream.next2(), stream.next());
        let z = if slope > 0.0 { -(bottom - w * (bottom - top)).ln() / slope } else { from + w * height };
        positions.push([(2.0 * u - 1.0) * REACH, (2.0 * v - 1.0) * REACH, z].map(|x| x as f32));
    }
    let photon = VolumePhoton {
        flux: [(1.0 / per_volume) as f32],
        direction: PackedDirection::pack([0.0, 0.0, -1.0]),
        medium: 0,
        class: PathClass::Indirect,
        segments: 1,
    };
    let photons = vec![photon; positions.len()];
    Ok(VolumeMap::build(positions, photons, SplitRule::Median)?)
}

fn read(map: &VolumeMap<1>, z: f64) -> VolumeEstimate<1> {
    map.at([0.0, 0.0, z as f32], 1.0, |_| Some(Scattered { share: Colour([1.0]), resolved: true }))
}

/// Light that falls off in fog faster than the ball is small.
pub(super) fn blur(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    Ok(Mode {
        id: "fog-blur",
        title: "Blur of light that falls off in fog",
        x: Axis::log("search radius over the length in which light falls to 1 / e"),
        y: Axis::linear("reading over the fluence rate"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("ball", "mean over the ball", exponential_over_ball),
            Curve::on("less the bias that two balls tell", "mean over both balls", exponential_over_two_balls),
        ],
        trial: each(move |slope, stream, _| {
            let estimate = read(&volume(photons, slope, -REACH, stream)?, 0.0);
            Ok([estimate.radiance[0], estimate.radiance[0] - estimate.bias[0]])
        }),
    })
}

/// The boundary of fog: half of the ball is clear air.
pub(super) fn edge(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    Ok(Mode {
        id: "fog-edge",
        title: "Edge of fog",
        x: Axis::linear("depth in the fog over the search radius"),
        y: Axis::linear("reading over the fluence rate"),
        truth: None,
        between: true,
        curves: vec![Curve::off("ball", "share of the ball in the fog", share_of_ball)],
        trial: Box::new(move |sweep, stream, _| {
            let map = volume(photons, 0.0, 0.0, stream)?;
            Ok(sweep.iter().map(|&z| read(&map, z).radiance[0]).collect())
        }),
    })
}
