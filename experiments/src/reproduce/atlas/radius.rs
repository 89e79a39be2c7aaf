//! A radius that does not suit the light.

use photonlab_gather::{AreaModel, Bandwidth, Tests};
use photonlab_measure::Axis;
use photonlab_reference::atlas::BentField;

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{density, facing_up, map},
};
use crate::reproduce::field::{Field, poisson};

/// How far photons reach, in metres: beyond the ball that tells the bias of the widest radius.
const REACH: f64 = 2.05;

/// A fixed radius, swept from too small to too large, where the irradiance doubles within 1 m.
pub(super) fn wrong(part: &Part) -> anyhow::Result<Mode> {
    let field = BentField { density: density(part.photons), bend: 1.0 };
    Ok(Mode {
        id: "wrong-radius",
        title: "Bad starting radius",
        x: Axis::log("search radius over the length in which the irradiance doubles"),
        y: Axis::log("squared error over the irradiance squared"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("fixed radius", "bias and noise of a disc (catalogue A3)", move |r| field.squared_error(r)),
            Curve::on("less the bias that two radii tell", "noise of two discs", move |r| {
                field.squared_error_of_corrected(r)
            }),
        ],
        trial: each(move |radius, stream, scratch| {
            let half = (2.0 * radius * 1.01).min(REACH);
            let most = 1.0 + 2.0 * field.bend * half * half;
            let mut photons = Field::default();
            for _ in 0..poisson(field.density * most * 4.0 * half * half, stream) {
                let [x, y] = stream.next2().map(|u| (2.0 * u - 1.0) * half);
                if stream.next() * most < 1.0 + field.bend * (x * x + y * y) {
                    photons.push([x, y, 0.0], [0.0, 0.0, 1.0], 1.0 / field.density);
                }
            }
            let ball = Bandwidth::Radius(radius);
            let map = map(photons)?;
            let read = map.gather(&facing_up([0.0; 3]), ball, AreaModel::Disc, &Tests::default(), scratch);
            let corrected = read.irradiance[0] - read.bias[0];
            Ok([read.irradiance[0], corrected].map(|value| (value - 1.0).powi(2)))
        }),
    })
}
