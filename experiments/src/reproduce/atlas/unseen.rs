//! Photons that land where nobody looks, and lamps that no path finds.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{Bandwidth, Scratch, Tests};
use photonlab_measure::Axis;
use photonlab_reference::{
    atlas::{disc_by_cosine, keyhole as through},
    fixed_radius_law::binomial_variance,
};
use photonlab_sampling::{Stream, warp};

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{facing_up, map, read},
};
use crate::reproduce::field::Field;

const COUNT: &str = "count of a share p of n photons, (1 - p) / (n p) (catalogue A1)";
const NOISE: &str = "squared error over the irradiance squared";

/// Squared error of a count whose mean is known, over that mean.
fn squared_error(count: f64, mean: f64) -> f64 {
    (count / mean - 1.0).powi(2)
}

/// What a disc of radius 1 m reads over what it should, if that many of `all` photons hit it.
fn error_of_disc(hits: u64, share: f64, all: f64, stream: &mut Stream, scratch: &mut Scratch) -> anyhow::Result<f64> {
    let mut field = Field::default();
    for _ in 0..hits {
        let [u, v] = stream.next2();
        let (radius, angle) = (u.sqrt(), 2.0 * PI * v);
        field.push([radius * angle.cos(), radius * angle.sin(), 0.0], [0.0, 0.0, 1.0], PI / (all * share));
    }
    // The disc's rim is in the ball for all roundings.
    let ball = 1.000_001;
    let value = read(&map(field)?, &facing_up([0.0; 3]), Bandwidth::Radius(ball), &Tests::default(), scratch);
    Ok(squared_error(value * ball * ball, 1.0))
}

fn binomial(all: f64, share: f64, stream: &mut Stream) -> u64 {
    (0..all as u64).map(|_| u64::from(stream.next() < share)).sum()
}

/// A receiver in a field that is lit as a whole.
pub(super) fn open_field(part: &Part) -> anyhow::Result<Mode> {
    let all = part.photons;
    // Light aimed at four times the receiver's area.
    let aimed = |ratio: f64| (0.25f64).max(1.0 / ratio);
    Ok(Mode {
        id: "open-field",
        title: "Small receiver in a large lit field",
        x: Axis::log("lit area over the receiver's area"),
        y: Axis::log(NOISE),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("photons over the whole field", COUNT, move |ratio| binomial_variance(all as u64, 1.0 / ratio)),
            Curve::on("photons aimed at four times the receiver", COUNT, move |ratio| {
                binomial_variance(all as u64, aimed(ratio))
            }),
        ],
        trial: each(move |ratio, stream, scratch| {
            let mut with = |share| {
                let hits = binomial(all, share, stream);
                error_of_disc(hits, share, all, stream, scratch)
            };
            Ok([with(1.0 / ratio)?, with(aimed(ratio))?])
        }),
    })
}

/// A lamp's light that leaves its room through a keyhole.
pub(super) fn keyhole(part: &Part) -> anyhow::Result<Mode> {
    let all = part.photons;
    let aimed = |angle: f64| through(angle) / through((2.0 * angle).min(PI));
    Ok(Mode {
        id: "keyhole",
        title: "Light through a keyhole",
        x: Axis::log("half-angle of the hole, degrees"),
        y: Axis::log(NOISE),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("photons all around", COUNT, move |degrees: f64| {
                binomial_variance(all as u64, through(degrees.to_radians()))
            }),
            Curve::on("photons into twice the half-angle", COUNT, move |degrees: f64| {
                binomial_variance(all as u64, aimed(degrees.to_radians()))
            }),
        ],
        trial: each(move |degrees, stream, _| {
            let angle = degrees.to_radians();
            let hole = 2.0 * through(angle);
            let cone = 2.0 * through((2.0 * angle).min(PI));
            let mut count = |one_minus_cos: f64| {
                let one = |stream: &mut Stream| warp::square_to_uniform_cone(stream.next2(), DVec3::Z, one_minus_cos);
                (0..all as u64).map(|_| f64::from(u8::from(1.0 - one(stream).z < hole))).sum::<f64>()
            };
            Ok([squared_error(count(2.0), all * 0.5 * hole), squared_error(count(cone), all * hole / cone)])
        }),
    })
}

/// One lamp of many lights a small caustic.
pub(super) fn many_lamps(part: &Part) -> anyhow::Result<Mode> {
    let all = part.photons;
    /// Share of its lamp's photons that the lens sends into the caustic.
    const CAUGHT: f64 = 0.05;
    let law = move |lamps: f64| binomial_variance((all / lamps) as u64, CAUGHT);
    Ok(Mode {
        id: "many-lamps",
        title: "Many lamps, one small caustic",
        x: Axis::log("lamps"),
        y: Axis::log("squared error over the caustic's irradiance squared"),
        truth: None,
        between: false,
        curves: vec![Curve::off("photons shared among the lamps", COUNT, law)],
        trial: each(move |lamps, stream, scratch| {
            let own = (all / lamps).floor();
            let hits = binomial(own, CAUGHT, stream);
            Ok([error_of_disc(hits, CAUGHT, own, stream, scratch)?])
        }),
    })
}

/// A lamp behind glass, as the light on a matte surface under the glass finds it, or its photons find the surface.
pub(super) fn behind_glass(part: &Part) -> anyhow::Result<Mode> {
    let all = part.photons;
    Ok(Mode {
        id: "specular-diffuse-specular",
        title: "Lamp seen only through glass: paths and photons",
        x: Axis::log("radius of the lamp over its distance"),
        y: Axis::log(NOISE),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("paths from the surface", COUNT, move |a| binomial_variance(all as u64, disc_by_cosine(a, 1.0))),
            // An even field ten times the receiver's area, whatever the lamp.
            Curve::on("photons from the lamp", COUNT, move |_| binomial_variance(all as u64, 0.1)),
        ],
        trial: each(move |radius, stream, scratch| {
            let share = disc_by_cosine(radius, 1.0);
            let mut found = 0.0;
            for _ in 0..all as u64 {
                let d = warp::square_to_cosine_hemisphere(stream.next2(), DVec3::Z);
                found += f64::from(u8::from(d.x.hypot(d.y) <= radius * d.z));
            }
            let hits = binomial(all, 0.1, stream);
            Ok([squared_error(found, all * share), error_of_disc(hits, 0.1, all, stream, scratch)?])
        }),
    })
}
