//! Independent checks of the ball lens: rays traced in space, with vectors instead of angles.

use std::f64::consts::{PI, TAU};

use super::BallLens;
use super::ray_map::Order;
use crate::mitsuba::assert_balanced;
use crate::random::{Moments, Random};

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The unit vector along `a`: rounding grows exponentially over many reflections unless it is taken off.
fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// `a + t b`.
fn along(a: Vector, t: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + t * b[i])
}

/// Follows a ray through the ball (centre at the origin, radius 1) with random choice between reflection and refraction;
/// returns where and how it leaves, or the ray itself if it misses.
pub(super) fn through_ball(index: f64, mut p: Vector, mut d: Vector, random: &mut Random) -> (Vector, Vector) {
    let b = dot(p, d);
    let discriminant = b * b - dot(p, p) + 1.0;
    if discriminant <= 0.0 || b > 0.0 {
        return (p, d);
    }
    p = along(p, -b - discriminant.sqrt(), d);
    let mut inside = false;
    loop {
        let normal = if inside { p.map(|x| -x) } else { p };
        let eta = if inside { index } else { 1.0 / index };
        let cosine = -dot(d, normal);
        let sine2 = eta * eta * (1.0 - cosine * cosine);
        let refracted = (1.0 - sine2).max(0.0).sqrt();
        // Amplitudes with the relative index 1 / eta.
        let s = (eta * cosine - refracted) / (eta * cosine + refracted);
        let q = (cosine - eta * refracted) / (cosine + eta * refracted);
        if sine2 >= 1.0 || random.unit() < 0.5 * (s * s + q * q) {
            d = along(d, 2.0 * cosine, normal);
        } else {
            d = [0, 1, 2].map(|i| eta * d[i] + (eta * cosine - refracted) * normal[i]);
            inside = !inside;
        }
        if !inside {
            return (p, d);
        }
        d = unit(d);
        p = unit(along(p, -2.0 * dot(p, d), d));
    }
}

/// Distance from the axis where a ray meets the floor `h` below the centre, if it comes down.
fn on_floor(h: f64, p: Vector, d: Vector) -> Option<f64> {
    let q = along(p, (-h - p[2]) / d[2], d);
    (d[2] < 0.0).then(|| q[0].hypot(q[1]))
}

/// 16 comparisons at 4.5 standard errors: two balls, radii inside and outside the shadow and the folds.
#[test]
fn flux_agrees_with_rays_in_space() {
    let mut random = Random::new(12);
    for (lens, seen) in [(BallLens::BENCHMARK, 0.75), (BallLens::new(0.3, 1.8, 0.4).expect("valid"), 0.8)] {
        let radii = [0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7];
        let mut found: [Moments; 8] = Default::default();
        let beam = PI * seen * seen;
        for _ in 0..1_000_000 {
            let (r, phi) = (seen * random.unit().sqrt() / lens.radius, random.between(0.0, TAU));
            let start = [r * phi.cos(), r * phi.sin(), 10.0];
            let (p, d) = through_ball(lens.index, start, [0.0, 0.0, -1.0], &mut random);
            let landed = on_floor(lens.height_in_radii(), p, d).map(|x| x * lens.radius);
            for (moments, radius) in found.iter_mut().zip(radii) {
                moments.add(if landed.is_some_and(|x| x < radius) { beam } else { 0.0 });
            }
        }
        for (moments, radius) in found.iter().zip(radii) {
            moments.must_agree(&format!("flux within {radius}"), lens.flux_within(radius));
        }
    }
}

/// The catalogue's E2 has the straight order alone, in ball radii at H = 2.
#[test]
fn catalogue_values_of_the_straight_order() {
    let lens = BallLens::new(1.0, 1.5, 2.0).expect("valid");
    let order = Order { p: 1, n: 1.5, h: 2.0 };
    for (radius, flux) in [(0.02, 0.010324396), (0.1, 0.21384871), (0.3, 0.94716278), (0.8, 1.9355209)] {
        let got = lens.order_flux(order, radius);
        assert!((got / flux - 1.0).abs() < 1e-7, "{radius}: {got}");
    }
}

#[test]
fn all_the_light_on_the_ball_is_accounted_for() {
    let lens = BallLens::BENCHMARK;
    let all = |order: Order| super::flux::integrate_where(order, |_| true, &mut [0.0, 0.5 * PI]);
    let sum: f64 = PI * 0.25 * lens.orders().map(all).sum::<f64>();
    println!("on the ball {}, orders {sum}, remainder {:e}", PI * 0.25, lens.order_remainder());
    assert!((sum + lens.order_remainder() - PI * 0.25).abs() < 1e-9);
    assert!(lens.order_remainder() < 5e-7);
}

#[test]
fn irradiance_is_the_derivative_of_flux() {
    let lens = BallLens::BENCHMARK;
    let folds = lens.folds(12, 1.0);
    println!("folds {folds:?}");
    let mut compared = 0;
    for r in [0.05, 0.12, 0.2, 0.31, 0.42, 0.47, 0.55, 0.8] {
        let step = 2e-4;
        if folds.iter().any(|fold| (fold.radius - r).abs() < 20.0 * step) {
            continue;
        }
        compared += 1;
        // Simpson's mean of the closed form against the flux through the ring.
        let at = |x: f64| lens.irradiance(x) * x;
        let simpson = (at(r - step) + 4.0 * at(r) + at(r + step)) / (6.0 * r);
        let ring = lens.mean_irradiance(r - step, r + step);
        println!("E({r}) = {simpson}, ring {ring}");
        assert!((simpson / ring - 1.0).abs() < 1e-4, "{r}: {simpson} {ring}");
    }
    assert!(compared >= 6, "{compared} radii are away from folds");
}

/// Rays sent up from the floor: on the axis the law, elsewhere less. 1 comparison at 4.5 standard errors.
#[test]
fn the_floor_gets_back_what_the_law_says_and_most_on_the_axis() {
    let (lens, mut random) = (BallLens::BENCHMARK, Random::new(13));
    let h = lens.height_in_radii();
    let most = lens.floor_return();
    for y in [0.0, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 9.0] {
        let mut back = Moments::default();
        for _ in 0..400_000 {
            let d = random.cosine_around([0.0, 0.0, 1.0]);
            let (p, d) = through_ball(lens.index, [y, 0.0, -h], d, &mut random);
            back.add(f64::from(on_floor(h, p, d).is_some()));
        }
        println!("from {y} radii: {} +- {}, on the axis {most}", back.mean(), back.error());
        if y == 0.0 {
            back.must_agree("return on the axis", most);
        } else {
            assert!(back.mean() < most + 4.5 * back.error(), "{y}: {} {most}", back.mean());
        }
    }
    println!("bound at 0.4 m, reflectance 0.01: {:e}", lens.floor_return_bound(0.4, 0.01));
}

#[test]
fn the_scene_file_carries_the_parameters() {
    let xml = BallLens::BENCHMARK.xml(0.01, 0.6, 128);
    assert_balanced(&xml);
    for part in ["112.61986", "name=\"int_ior\" value=\"1.5\"", "radius\" value=\"0.5\"", "z=\"-1\""] {
        assert!(xml.contains(part), "{part} not in {xml}");
    }
    assert!(BallLens::new(0.5, 1.0, 1.0).is_err() && BallLens::new(0.5, 1.5, 0.4).is_err());
}
