//! A dark place beside a bright one.

use photonlab_gather::{Bandwidth, Tests};
use photonlab_measure::Axis;

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{density, facing_up, map, nearest, read},
};
use crate::reproduce::uneven::{Shape, Uneven};

/// Distance of the bright light, in metres; k photons would reach twice as far in the dark.
const DISTANCE: f64 = 1.0;

/// The k nearest of a dark place are found where it is bright.
pub(super) fn dark_place(part: &Part) -> anyhow::Result<Mode> {
    let k = part.photons;
    let beside = move |ratio| Uneven { density: density(k / 4.0), shape: Shape::Step { distance: DISTANCE, ratio } };
    let within = Bandwidth::Nearest { k: k as usize, max_radius: DISTANCE };
    Ok(Mode {
        id: "dark-place",
        title: "Dark place beside a bright one",
        x: Axis::log("irradiance of the bright place over that of the dark one"),
        y: Axis::linear("reading over the dark place's irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("k nearest", "k nearest beside a step (catalogue A7, B3)", move |ratio| {
                beside(ratio).law(nearest(k)).mean
            }),
            Curve::on("k nearest up to the bright light", "capped query (catalogue A6)", |_| 1.0),
        ],
        trial: each(move |ratio, stream, scratch| {
            let field = beside(ratio);
            let map = map(field.field(field.half(nearest(k)), stream))?;
            let at = facing_up([0.0; 3]);
            Ok([nearest(k), within].map(|search| read(&map, &at, search, &Tests::default(), scratch)))
        }),
    })
}
