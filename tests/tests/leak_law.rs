//! Light that leaks from other surfaces, and the tests that keep it out (catalogue B4, B5, B6).

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimate, Tests};
use photonlab_measure::Replicates;
use photonlab_reference::{
    edge_laws,
    nearest_law::{self, Counted},
};
use photonlab_sampling::Stream;
use photonlab_tests::{Family, Field, column, replicates, seed};

/// Photons per square metre; the search radius is 1 m.
const DENSITY: f64 = 16.0;
const NONE: Tests = Tests { normal: false, side: false, max_segments: None };
const NORMAL: Tests = Tests { normal: true, ..NONE };
const SIDE: Tests = Tests { side: true, ..NONE };

/// Two evenly lit half-planes that meet along the y axis at a dihedral angle, the first in z = 0, x > 0.
fn crease(theta: f64, reach: f64, stream: &mut Stream) -> Field {
    let (sine, cosine) = theta.sin_cos();
    let corner = DVec3::new(0.0, -reach, 0.0);
    let along = DVec3::Y * (2.0 * reach);
    let other = DVec3::new(cosine, 0.0, sine);
    let facing = DVec3::new(sine, 0.0, -cosine);
    let first = Field::default().lit(DENSITY, corner, [DVec3::X * reach, along], DVec3::Z, stream);
    first.lit(DENSITY, corner, [other * reach, along], facing, stream)
}

fn gather<const N: usize>(field: Field, at: [f64; N], bandwidth: Bandwidth, tests: &Tests) -> [Estimate<1>; N] {
    field.gather(at.map(|x| (DVec3::new(x, 0.0, 0.0), DVec3::Z)), bandwidth, AreaModel::Disc, tests)
}

/// B4: darkening and leak together; at 90 degrees 18 % too much at 0.537 radii from the edge.
#[test]
fn without_a_normal_test_a_crease_follows_its_law() {
    let mut family = Family::new("crease");
    let places = [0.0, 0.25, edge_laws::right_angle_maximum().0, 0.9];
    for degrees in [60.0, 90.0, 120.0, 270.0_f64] {
        let theta = degrees.to_radians();
        let rows = replicates(4000, seed(200 + degrees as u32), |stream| {
            gather(crease(theta, 2.5, stream), places, Bandwidth::Radius(1.0), &NONE)
        });
        for (i, t) in places.into_iter().enumerate() {
            let law = edge_laws::crease(t, theta, 1.0, 1.0).total();
            family.mean(format!("{degrees} degrees, t = {t:.3}"), &column(&rows, i), law);
        }
    }
    family.decide();
}

/// B4 with the normal test: the leak goes and the darkening stays, unless the crease is so flat that both planes count as
/// one surface (normals within 60 degrees).
#[test]
fn the_normal_test_leaves_the_planes_own_light() {
    let mut family = Family::new("crease, normal test");
    for (degrees, t, both) in
        [(60.0_f64, 0.25, false), (90.0, 0.0, false), (90.0, 0.537, false), (110.0, 0.5, false), (150.0, 0.5, true)]
    {
        let theta = degrees.to_radians();
        let rows = replicates(4000, seed(210), |stream| {
            gather(crease(theta, 2.5, stream), [t], Bandwidth::Radius(1.0), &NORMAL)
        });
        let law = edge_laws::crease(t, theta, 1.0, 1.0);
        let expected = if both { law.total() } else { law.own };
        family.mean(format!("{degrees} degrees, t = {t}"), &column(&rows, 0), expected);
    }
    family.decide();
}

/// B4 for the k nearest.
#[test]
fn without_a_normal_test_the_nearest_follow_the_creases_law() {
    let mut family = Family::new("crease, nearest");
    let k = 20;
    let r0 = (f64::from(k) / (PI * DENSITY)).sqrt();
    for (degrees, d) in [(90.0_f64, 0.0), (90.0, 0.5), (60.0, 0.25), (120.0, 0.75)] {
        let theta = degrees.to_radians();
        let bandwidth = Bandwidth::Nearest { k: k as usize, max_radius: f64::INFINITY };
        let rows =
            replicates(10_000, seed(220), |stream| gather(crease(theta, 4.5 * r0, stream), [d * r0], bandwidth, &NONE));
        let law = nearest_law::crease(k, d, theta, Counted::AllButLast);
        family.mean(format!("{degrees} degrees, d = {d}"), &column(&rows, 0), law.mean);
    }
    family.decide();
}

/// The lit far face of a wall of thickness `h`, whose dark near face holds the query.
fn wall(h: f64, reach: f64, stream: &mut Stream) -> Field {
    let corner = DVec3::new(-reach, -reach, -h);
    let edges = [DVec3::X * (2.0 * reach), DVec3::Y * (2.0 * reach)];
    Field::default().lit(DENSITY, corner, edges, -DVec3::Z, stream)
}

/// B5: without tests light leaks by the law, and the k nearest always find some.
#[test]
fn without_tests_a_thin_wall_leaks_by_its_law() {
    let mut family = Family::new("thin wall");
    for h in [0.1, 0.5, 0.75, 0.9] {
        let rows =
            replicates(8000, seed(230), |stream| gather(wall(h, 2.5, stream), [0.0], Bandwidth::Radius(1.0), &NONE));
        family.mean(format!("h = {h}"), &column(&rows, 0), edge_laws::thin_wall(h));
    }
    let k = 20;
    let r0 = (f64::from(k) / (PI * DENSITY)).sqrt();
    let bandwidth = Bandwidth::Nearest { k: k as usize, max_radius: f64::INFINITY };
    for h in [0.5, 1.0, 2.0] {
        let rows =
            replicates(10_000, seed(231), |stream| gather(wall(h * r0, 5.0 * r0, stream), [0.0], bandwidth, &NONE));
        let law = nearest_law::thin_wall(k, h, Counted::AllButLast);
        family.mean(format!("k = {k}, h = {h}"), &column(&rows, 0), law.mean);
    }
    family.decide();
}

/// B5: either test alone keeps all of it out, at any thickness, and says that nothing was found.
#[test]
fn with_either_test_nothing_leaks_through_a_wall() {
    let nearest = Bandwidth::Nearest { k: 20, max_radius: 10.0 };
    for tests in [NORMAL, SIDE, Tests::default()] {
        for (h, bandwidth) in [(1e-4, Bandwidth::Radius(1.0)), (0.5, Bandwidth::Radius(1.0)), (0.1, nearest)] {
            let rows = replicates(50, seed(240), |stream| gather(wall(h, 2.5, stream), [0.0], bandwidth, &tests));
            for [found] in &rows {
                assert_eq!((found.irradiance[0], found.photons), (0.0, 0), "h = {h}, {bandwidth:?}, {tests:?}");
            }
        }
    }
}

/// B5's other wall: light on the same floor beyond an infinitely thin wall leaks whatever the tests, which is why
/// readings near other surfaces are not certified.
#[test]
fn no_test_keeps_out_light_beyond_a_wall_on_the_same_floor() {
    let mut family = Family::new("wall on a floor");
    let places = [0.1, 0.5];
    let rows = replicates(8000, seed(250), |stream| {
        let beyond = Field::default().floor(DENSITY, [-2.5, -2.5], [0.0, 2.5], stream);
        gather(beyond, places, Bandwidth::Radius(1.0), &Tests::default())
    });
    for (i, t) in places.into_iter().enumerate() {
        family.mean(format!("t = {t}"), &column(&rows, i), edge_laws::wall_on_floor(t));
    }
    family.decide();
}

/// B6: a ball centred on a sphere cuts out exactly pi r^2 of it, and the normal test must not spoil that up to r = R.
#[test]
fn on_a_sphere_a_ball_has_no_bias() {
    let mut family = Family::new("gather on a sphere");
    let top = DVec3::new(0.36, -0.48, 0.8);
    for (radius, density) in [(0.2, 200.0), (0.5, 40.0), (0.98, 16.0)] {
        let rows = replicates(4000, seed(260), |stream| {
            let field = Field::default().inside_of_sphere(density, stream);
            field.gather([(top, -top)], Bandwidth::Radius(radius), AreaModel::Disc, &Tests::default())
        });
        let estimate: Replicates = column(&rows, 0);
        family.mean(format!("r = {radius} R"), &estimate, 1.0);
    }
    family.decide();
}
