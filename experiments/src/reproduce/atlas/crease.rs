//! Two faces that meet in a concave edge.

use std::f64::consts::PI;

use photonlab_gather::{Bandwidth, GatherPoint, PhotonMap, SAME_SURFACE, Scratch, Tests};
use photonlab_measure::Axis;
use photonlab_reference::{atlas::crease_with_side_test, edge_laws};
use photonlab_sampling::Stream;

use super::{
    ground::Ground,
    mode::{Curve, Mode, Part, each},
    photons::{NO_TEST, NORMAL_TEST, SIDE_TEST, density, diffuse, facing_up, map, read, read_among},
};
use crate::reproduce::faces::{Face, lit};

/// How far the faces reach, in search radii: beyond the ball, and beyond the larger one that is asked about its surface.
const REACH: f64 = 3.5;
/// Where the angle is swept the query's distance from the edge, in search radii.
const ASIDE: f64 = 0.5;
const BALL: Bandwidth = Bandwidth::Radius(1.0);

const LAW: &str = "two faces in a ball (catalogue B4)";
const SIDES: &str = "the same with (1 + cos) / 2 of the other face's diffuse light";
const WHOLE: &str = "even light over the surface that is there";

pub(super) fn crease_60(part: &Part) -> anyhow::Result<Mode> {
    at_angle(60.0, "crease-60", "Concave crease of 60 degrees", part)
}

pub(super) fn crease_90(part: &Part) -> anyhow::Result<Mode> {
    at_angle(90.0, "crease-90", "Concave crease of 90 degrees", part)
}

/// At 120 degrees the normals are 60 degrees apart, just as many as the normal test lets through: rounding decides, and the
/// test is left out.
pub(super) fn crease_120(part: &Part) -> anyhow::Result<Mode> {
    at_angle(120.0, "crease-120", "Concave crease of 120 degrees", part)
}

/// The lit faces of a dihedral angle in radians; the first is the query's, in the plane z = 0 with x > 0.
fn faces(angle: f64) -> [Face; 2] {
    let (sine, cosine) = angle.sin_cos();
    let along = [0.0, 2.0 * REACH, 0.0];
    let corner = [0.0, -REACH, 0.0];
    let face = |out: [f64; 3], normal| Face { corner, sides: [out.map(|x| REACH * x), along], normal };
    [face([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]), face([cosine, 0.0, sine], [sine, 0.0, -cosine])]
}

fn diffusely_lit(faces: &[Face], photons: f64, stream: &mut Stream) -> anyhow::Result<PhotonMap<1>> {
    let mut field = lit(faces, density(photons), stream);
    diffuse(&mut field, stream);
    map(field)
}

fn at_angle(degrees: f64, id: &'static str, title: &'static str, part: &Part) -> anyhow::Result<Mode> {
    let (photons, theta) = (part.photons, degrees.to_radians());
    let faces = faces(theta);
    let tested = degrees < 120.0;
    // Without a test of normals all faces are surface.
    let ground = Ground::of_faces(&faces, if tested { f64::from(SAME_SURFACE) } else { -1.0 })?;
    let mut curves = vec![
        Curve::off("no test", LAW, move |t| edge_laws::crease(t, theta, 1.0, 1.0).total()),
        Curve::on("side test", SIDES, move |t| crease_with_side_test(t, theta)),
    ];
    let mut tests = vec![NO_TEST, SIDE_TEST];
    if tested {
        curves.push(Curve::on("normal test", LAW, edge_laws::half_plane));
        tests.push(NORMAL_TEST);
    }
    let over = if tested { NORMAL_TEST } else { NO_TEST };
    let label = if tested { "normal test, surface inside" } else { "no test, surface of both faces inside" };
    curves.push(Curve::on(label, WHOLE, |_| 1.0));
    Ok(Mode {
        id,
        title,
        x: Axis::linear("distance from the edge over the search radius"),
        y: Axis::linear("reading over the faces' irradiance"),
        truth: None,
        between: true,
        curves,
        trial: Box::new(move |sweep, stream, scratch| {
            let map = diffusely_lit(&faces, photons, stream)?;
            let mut values = Vec::new();
            for &t in sweep {
                let at = facing_up([t, 0.0, 0.0]);
                values.extend(tests.iter().map(|tests| read(&map, &at, BALL, tests, scratch)));
                values.push(read_among(&map, &at, BALL, &over, &ground.around(&at), scratch));
            }
            Ok(values)
        }),
    })
}

/// A test of normals sees two faces as one from 120 degrees on.
pub(super) fn crease_angle(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    let total = |degrees: f64| edge_laws::crease(ASIDE, degrees.to_radians(), 1.0, 1.0).total();
    // The normals make 180 degrees less the angle between the faces.
    let passes = |degrees: f64| (PI - degrees.to_radians()).cos() >= f64::from(SAME_SURFACE);
    let with_test = move |degrees: f64| if passes(degrees) { total(degrees) } else { edge_laws::half_plane(ASIDE) };
    let at = facing_up([ASIDE, 0.0, 0.0]);
    Ok(Mode {
        id: "crease-angle",
        title: "Concave crease: where the normal test goes blind",
        x: Axis::linear("angle between the faces, degrees"),
        y: Axis::linear("reading over the faces' irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("no test", LAW, total),
            Curve::on("normal test", LAW, with_test),
            Curve::on("side test", SIDES, |degrees| crease_with_side_test(ASIDE, degrees.to_radians())),
        ],
        trial: each(move |degrees, stream, scratch| by_tests(degrees, photons, &at, stream, scratch)),
    })
}

fn by_tests(
    degrees: f64,
    photons: f64,
    at: &GatherPoint,
    stream: &mut Stream,
    scratch: &mut Scratch,
) -> anyhow::Result<[f64; 3]> {
    let map = diffusely_lit(&faces(degrees.to_radians()), photons, stream)?;
    let mut with = |tests: &Tests| read(&map, at, BALL, tests, scratch);
    Ok([with(&NO_TEST), with(&NORMAL_TEST), with(&SIDE_TEST)])
}
