//! Thin sheets and receivers that no photon lands on.

use photonlab_gather::Bandwidth;
use photonlab_measure::Axis;
use photonlab_reference::{
    atlas::both_sides,
    edge_laws,
    nearest_law::{self, Counted},
};

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{NO_TEST, NORMAL_TEST, SIDE_TEST, density, facing_up, map, nearest, reach_of_nearest, read, square},
};
use crate::reproduce::field::Field;

const BALL: Bandwidth = Bandwidth::Radius(1.0);

/// A sheet without thickness, its two sides lit unlike; the dark one is read.
pub(super) fn one_sided(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    let at = facing_up([0.0; 3]);
    const SIDE: &str = "the read side's own light";
    Ok(Mode {
        id: "one-sided-sheet",
        title: "Sheet lit on one side",
        x: Axis::log("irradiance of the other side over that of the side that is read"),
        y: Axis::log("reading over the irradiance of the side that is read"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("no test", "sum over both sides", both_sides),
            Curve::on("side test", SIDE, |_| 1.0),
            Curve::on("normal test", SIDE, |_| 1.0),
        ],
        trial: each(move |ratio, stream, scratch| {
            let mut field = square(photons, 1.01, stream);
            for position in square(photons, 1.01, stream).positions {
                field.push(position.map(f64::from), [0.0, 0.0, -1.0], ratio / density(photons));
            }
            let map = map(field)?;
            Ok([NO_TEST, SIDE_TEST, NORMAL_TEST].map(|tests| read(&map, &at, BALL, &tests, scratch)))
        }),
    })
}

/// A receiver in the air over a floor, in parallel light.
pub(super) fn mid_air(part: &Part) -> anyhow::Result<Mode> {
    let k = part.photons;
    let reach = 3.0 * reach_of_nearest(k);
    Ok(Mode {
        id: "mid-air",
        title: "Receiver in mid-air",
        x: Axis::linear("height over the search radius"),
        y: Axis::linear("reading over the receiver's irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("fixed radius", "disc cut out of the floor (catalogue B5)", edge_laws::thin_wall),
            Curve::off("k nearest", "k nearest behind a gap (catalogue B5)", move |h| {
                nearest_law::thin_wall(k as u32, h, Counted::AllButLast).mean
            }),
            Curve::on("receiver as a surface, fixed radius", "photons that land on it", |_| 1.0),
            Curve::on("receiver as a surface, k nearest", "photons that land on it", |_| 1.0),
        ],
        trial: Box::new(move |sweep, stream, scratch| {
            let floor = map(square(k, reach, stream))?;
            let mut values = Vec::new();
            for &h in sweep {
                let at = facing_up([0.0, 0.0, h]);
                // The receiver keeps the light from the floor below it.
                let mut own = Field::default();
                for [x, y, _] in square(k, reach_of_nearest(k), stream).positions {
                    own.push([f64::from(x), f64::from(y), h], [0.0, 0.0, 1.0], 1.0 / density(k));
                }
                let own = map(own)?;
                for map in [&floor, &own] {
                    values.extend([BALL, nearest(k)].map(|search| read(map, &at, search, &NO_TEST, scratch)));
                }
            }
            Ok(values)
        }),
    })
}
