//! A sphere about as small as the search ball.

use photonlab_gather::{Bandwidth, SAME_SURFACE};
use photonlab_measure::Axis;
use photonlab_reference::atlas::SmallSphere;
use photonlab_sampling::warp;

use super::{
    ground::Ground,
    mode::{Curve, Mode, Part},
    photons::{NO_TEST, NORMAL_TEST, SIDE_TEST, density, diffuse, facing_up, map, read, read_among},
};
use crate::reproduce::field::{Field, poisson};

const LAW: &str = "sphere in a ball (catalogue B6, with tests)";

/// The sphere has the radius 1 m; the search radius is swept, and the density with it, so that the disc holds as many photons.
pub(super) fn small_sphere(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    let ground = Ground::of_sphere(1.0, f64::from(SAME_SURFACE))?;
    let least = f64::from(SAME_SURFACE);
    Ok(Mode {
        id: "small-sphere",
        title: "Sphere smaller than the search ball",
        x: Axis::log("search radius over the sphere's radius"),
        y: Axis::linear("reading over the sphere's irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("no test", LAW, |ratio| SmallSphere { ratio }.without_test()),
            Curve::on("normal test", LAW, move |ratio| SmallSphere { ratio }.with_normal_test(least)),
            Curve::on("side test", LAW, |ratio| SmallSphere { ratio }.with_side_test()),
            Curve::on("normal test, surface inside", "even light over the surface that is there", |_| 1.0),
        ],
        trial: Box::new(move |sweep, stream, scratch| {
            let mut values = Vec::new();
            let at = facing_up([0.0, 0.0, 1.0]);
            for &ratio in sweep {
                let per_area = density(photons) / (ratio * ratio);
                let mut field = Field::default();
                for _ in 0..poisson(per_area * 4.0 * std::f64::consts::PI, stream) {
                    let place = warp::square_to_uniform_sphere(stream.next2()).to_array();
                    field.push(place, place, 1.0 / per_area);
                }
                diffuse(&mut field, stream);
                let (map, ball) = (map(field)?, Bandwidth::Radius(ratio));
                values.extend([NO_TEST, NORMAL_TEST, SIDE_TEST].map(|test| read(&map, &at, ball, &test, scratch)));
                values.push(read_among(&map, &at, ball, &NORMAL_TEST, &ground.around(&at), scratch));
            }
            Ok(values)
        }),
    })
}
