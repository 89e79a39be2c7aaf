//! Light of other surfaces that face the same way: no test of normals or sides keeps it out.

use photonlab_gather::{AreaModel, Bandwidth, Estimator, Kernel, SAME_SURFACE};
use photonlab_measure::Axis;
use photonlab_reference::edge_laws;

use super::{
    ground::Ground,
    mode::{Curve, Law, Mode, Part, Trial, each},
    photons::{NORMAL_TEST, density, facing_up, map},
};
use crate::reproduce::faces::{Face, lit};

/// How far the surfaces reach, in search radii.
const REACH: f64 = 3.0;
const BALL: Bandwidth = Bandwidth::Radius(1.0);
/// What photons may lie off the tangent plane with the flattened ball, over their distance.
const FLATNESS: f64 = 0.1;

const LEAK: &str = "half-plane on the other side of a wall (catalogue B5)";
const SHEET: &str = "a plane beside the centre of a ball (catalogue B5)";

/// The part of the plane z = `height` between two values of x.
fn floor(height: f64, [from, to]: [f64; 2]) -> Face {
    Face {
        corner: [from, -REACH, height],
        sides: [[to - from, 0.0, 0.0], [0.0, 2.0 * REACH, 0.0]],
        normal: [0.0, 0.0, 1.0],
    }
}

/// A place that no light reaches, whatever is swept.
fn dark((id, title): (&'static str, &'static str), x: Axis, y: &str, curves: Vec<Curve>, trial: Trial) -> Mode {
    Mode {
        id,
        title,
        x,
        y: Axis::linear(y),
        truth: Some(("truth", Box::new(|_| 0.0) as Law)),
        between: true,
        curves,
        trial,
    }
}

/// Beside a wall that stands on a floor, of which the other side is lit.
pub(super) fn wall_on_floor(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    let wall = Face {
        corner: [0.0, -REACH, 0.0],
        sides: [[0.0, 2.0 * REACH, 0.0], [0.0, 0.0, REACH]],
        normal: [1.0, 0.0, 0.0],
    };
    let ground = Ground::of_faces(&[floor(0.0, [-REACH, REACH]), wall], f64::from(SAME_SURFACE))?;
    Ok(dark(
        ("wall-on-floor", "Wall on a floor, lit on its other side"),
        Axis::linear("distance from the wall over the search radius"),
        "reading over the irradiance of the other side",
        vec![
            Curve::off("normal test", LEAK, edge_laws::wall_on_floor),
            Curve::on("what the point sees", "nothing of it", |_| 0.0),
        ],
        each(move |t, stream, scratch| {
            let map = map(lit(&[floor(0.0, [-REACH, 0.0])], density(photons), stream))?;
            let at = facing_up([t, 0.0, 0.0]);
            let around = ground.around(&at);
            let mut read = |area| {
                let estimator = Estimator::new(Kernel::Disc, area);
                map.gather_among(&at, BALL, estimator, &NORMAL_TEST, &around, scratch).irradiance[0]
            };
            Ok([read(AreaModel::Disc), read(AreaModel::Visible)])
        }),
    ))
}

/// On a dark floor under a sheet that is lit from above.
pub(super) fn sheet_over_floor(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    Ok(dark(
        ("sheet-over-floor", "Lit sheet over a dark floor"),
        Axis::log("height of the sheet over the search radius"),
        "reading over the sheet's irradiance",
        vec![
            Curve::off("normal test", SHEET, edge_laws::thin_wall),
            Curve::on("flattened ball", "the same beyond its height over a tenth", |h| {
                edge_laws::sheet_over_floor(h, FLATNESS)
            }),
        ],
        each(move |h, stream, scratch| {
            let map = map(lit(&[floor(h, [-REACH, REACH])], density(photons), stream))?;
            let at = facing_up([0.0; 3]);
            let mut read = |area: AreaModel| map.gather(&at, BALL, area, &NORMAL_TEST, scratch).irradiance[0];
            Ok([read(AreaModel::Disc), read(AreaModel::Flattened)])
        }),
    ))
}
