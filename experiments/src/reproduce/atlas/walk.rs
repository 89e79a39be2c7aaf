//! Paths that end too early, weigh too much, or lose their way.

use glam::DVec3;
use photonlab_measure::Axis;
use photonlab_reference::atlas::{lost_per_bounce, total_with_losses, unweighted_total, weighted_variance};
use photonlab_sampling::{Stream, warp};

use super::{
    enclosure::Enclosure,
    mode::{Curve, Mode, Part, each},
};

/// Paths that are cut after so many segments, in a room that swallows one part in a hundred.
pub(super) fn cut_paths(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons as u64;
    let room = Enclosure::new(1.0, 0.99)?;
    let share = room.clone();
    Ok(Mode {
        id: "cut-paths",
        title: "Albedo 0.99 and paths that are cut",
        x: Axis::log("longest path in segments"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("cut", "sum over bounces (catalogue D1)", move |segments| share.up_to(segments)),
            Curve::on("until absorbed", "integrating sphere (catalogue D1)", |_| 1.0),
        ],
        trial: Box::new(move |sweep, stream, _| {
            let traced = room.trace(photons, stream)?;
            let sum = |most: f64| {
                let kept = traced.photons.iter().filter(|photon| f64::from(photon.segments) <= most);
                kept.map(|photon| f64::from(photon.flux[0])).sum::<f64>() / room.flux_on_wall()
            };
            let all = sum(f64::INFINITY);
            Ok(sweep.iter().flat_map(|&segments| [sum(segments), all]).collect())
        }),
    })
}

/// Bounces of a path whose weight changes by `factor` at each, as the sum of its weights.
fn total(survival: f64, factor: f64, stream: &mut Stream) -> f64 {
    let (mut weight, mut sum) = (1.0, 1.0);
    while stream.next() < survival {
        weight *= factor;
        sum += weight;
    }
    sum
}

/// Reflectance of the walls where roulette is played.
const REFLECTANCE: f64 = 0.8;

/// Survivors that keep their flux although they did not survive with the reflectance's probability.
pub(super) fn roulette_weight(part: &Part) -> anyhow::Result<Mode> {
    let paths = part.photons as u32;
    Ok(Mode {
        id: "roulette-weight",
        title: "Roulette without its weight",
        x: Axis::linear("probability to survive a bounce (reflectance 0.8)"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("survivors keep their flux", "geometric sum", |q| unweighted_total(REFLECTANCE, q)),
            Curve::on("survivors weigh reflectance over probability", "geometric sum", |_| 1.0),
        ],
        trial: each(move |q, stream, _| {
            let mut read = |factor| {
                let sum: f64 = (0..paths).map(|_| total(q, factor, stream)).sum();
                sum * (1.0 - REFLECTANCE) / f64::from(paths)
            };
            Ok([read(1.0), read(REFLECTANCE / q)])
        }),
    })
}

/// Survivors that weigh more and more.
pub(super) fn roulette_variance(part: &Part) -> anyhow::Result<Mode> {
    let paths = part.photons as u32;
    Ok(Mode {
        id: "roulette-variance",
        title: "Roulette that kills too often",
        x: Axis::linear("probability to survive a bounce (reflectance 0.8; no variance at 0.64)"),
        y: Axis::linear("squared error of one path over the irradiance squared"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("weighed by reflectance over probability", "second moment of a walk", |q| {
                weighted_variance(REFLECTANCE, q)
            }),
            Curve::on("probability equal to the reflectance", "second moment of a walk", |_| {
                weighted_variance(REFLECTANCE, REFLECTANCE)
            }),
        ],
        trial: each(move |q, stream, _| {
            let mut error = |q: f64| {
                let one = |stream: &mut Stream| total(q, REFLECTANCE / q, stream) * (1.0 - REFLECTANCE) - 1.0;
                (0..paths).map(|_| one(stream).powi(2)).sum::<f64>() / f64::from(paths)
            };
            Ok([error(q), error(REFLECTANCE)])
        }),
    })
}

/// Rays that start a fixed length off the surface, in rooms of all sizes.
pub(super) fn self_intersection(part: &Part) -> anyhow::Result<Mode> {
    /// Metres.
    const START: f64 = 1e-3;
    const ROOM: f64 = 0.9;
    let photons = part.photons as u64;
    let rooms = part.sweep.iter().map(|&radius| Enclosure::new(radius, ROOM)).collect::<Result<Vec<_>, _>>()?;
    Ok(Mode {
        id: "self-intersection",
        title: "Rays that start a millimetre off the surface",
        x: Axis::log("radius of the room, m"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("start after 1 mm", "chords shorter than the start", |radius| {
                total_with_losses(ROOM, lost_per_bounce(START / radius))
            }),
            Curve::on("start relative to scale", "integrating sphere (catalogue D1)", |_| 1.0),
        ],
        trial: Box::new(move |sweep, stream, _| {
            let mut values = Vec::new();
            for (&radius, room) in sweep.iter().zip(&rooms) {
                let mut hits = 0.0;
                for _ in 0..photons {
                    hits += 1.0;
                    while stream.next() < ROOM && 2.0 * radius * cosine(stream) >= START {
                        hits += 1.0;
                    }
                }
                let traced = room.trace(photons, stream)?;
                let flux = traced.photons.iter().map(|photon| f64::from(photon.flux[0])).sum::<f64>();
                values.extend([hits * (1.0 - ROOM) / photons as f64, flux / room.flux_on_wall()]);
            }
            Ok(values)
        }),
    })
}

/// Of a diffuse ray to the wall's normal.
fn cosine(stream: &mut Stream) -> f64 {
    warp::square_to_cosine_hemisphere(stream.next2(), DVec3::Z).z
}
