//! Independent checks of the solved cube: directions instead of areas, and random paths instead of equations.

use std::f64::consts::{PI, TAU};

use super::Cube;
use crate::mitsuba::assert_balanced;
use crate::random::{Moments, Random};

/// Where the ray from inside the cube `[-1, 1]^3` leaves it.
fn exit(p: [f64; 3], d: [f64; 3]) -> ([f64; 3], usize) {
    let distance = |i: usize| (d[i].signum() - p[i]) / d[i];
    let axis = (0..3).min_by(|&i, &j| distance(i).total_cmp(&distance(j))).expect("three axes");
    let t = distance(axis);
    let mut q = [0, 1, 2].map(|i| (p[i] + t * d[i]).clamp(-1.0, 1.0));
    q[axis] = d[axis].signum();
    (q, axis)
}

/// Irradiance from the lamp at a point of the wall: the inverse-square law, written without the face's coordinates.
fn lamp(cube: &Cube, q: [f64; 3]) -> f64 {
    let r2: f64 = q.iter().map(|x| x * x).sum();
    cube.intensity() / (cube.half_edge() * cube.half_edge()) / (r2 * r2.sqrt())
}

#[test]
fn one_bounce_agrees_with_brute_force_over_directions() {
    let cube = Cube::BENCHMARK;
    let solution = cube.solve();
    for [u, v] in [[0.0, 0.0], [0.5, 0.3], [0.9, 0.2], [0.998, 0.5], [0.998, 0.998]] {
        // E = E[E_lamp] over cosine-distributed directions: midpoints of the polar angle, and of the azimuth crowded
        // towards the four azimuths along the edges, where a face begins within `1 - u`.
        let n = 2000; // The error falls like n^-2; at 4000 it is below 1e-6 at every point.
        let mut sum = 0.0;
        for i in 0..n {
            let (s, c) = (TAU / 4.0 * (i as f64 + 0.5) / n as f64).sin_cos();
            let weight = 2.0 * s * c * TAU / 4.0 / (n * n) as f64;
            for j in 0..n {
                let quarters = 4.0 * (j as f64 + 0.5) / n as f64;
                let (quarter, x) = (quarters.floor(), 2.0 * quarters.fract() - 1.0);
                let phi = TAU / 4.0 * (quarter + 0.5 + 0.25 * x * (3.0 - x * x));
                let d = [-c, s * phi.cos(), s * phi.sin()];
                sum += weight * 1.5 * (1.0 - x * x) * lamp(&cube, exit([1.0, u, v], d).0);
            }
        }
        let brute = cube.reflectance() * sum;
        let got = solution.first_bounce(u, v);
        println!("({u}, {v}): operator {got}, brute force {brute}, {:+e}", got / brute - 1.0);
        assert!((got / brute - 1.0).abs() < 1e-5, "({u}, {v}): {got} against {brute}");
    }
}

/// 8 comparisons, each rejected at 4.5 standard errors of at most 0.1 %.
#[test]
fn all_bounces_agree_with_path_tracing() {
    let mut random = Random::new(20_250_601);
    for (reflectance, points) in [
        (2.0 / 3.0, &[[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.998, 0.0], [0.998, 0.5], [0.998, 0.998]][..]),
        (0.9, &[[0.0, 0.0], [0.99, 0.99]][..]),
    ] {
        let cube = Cube::new(5.0, 50_000.0, reflectance).expect("valid");
        let solution = cube.solve();
        assert!(solution.error_bound() < 1e-5, "{reflectance}: {}", solution.error_bound());
        for &[u, v] in points {
            let mut paths = Moments::default();
            for _ in 0..200_000 {
                paths.add(path(&cube, [1.0, u, v], &mut random));
            }
            assert!(paths.error() < 1e-3 * paths.mean());
            paths.must_agree(&format!("rho {reflectance:.3}, ({u}, {v})"), solution.illuminance(u, v));
        }
    }
}

/// One random path from the face +x: the lamp's light is added at every vertex, weighted with all reflections before.
/// The tail below 1e-7 of the first term is left off.
fn path(cube: &Cube, start: [f64; 3], random: &mut Random) -> f64 {
    let (mut p, mut axis, mut weight) = (start, 0, 1.0);
    let mut sum = 0.0;
    while weight > 1e-7 {
        sum += weight * lamp(cube, p);
        let mut inward = [0.0; 3];
        inward[axis] = -p[axis];
        (p, axis) = exit(p, random.cosine_around(inward));
        weight *= cube.reflectance();
    }
    sum
}

#[test]
fn without_reflection_only_direct_light_is_left() {
    let cube = Cube::new(2.0, 3.0, 0.0).expect("valid");
    let solution = cube.solve();
    assert_eq!(solution.illuminance(0.3, 0.6), cube.direct(0.3, 0.6));
    assert!((cube.direct(0.0, 0.0) - 0.75).abs() < 1e-15);
    // Flux through all six faces is 4 pi I.
    let rule = crate::quadrature::Gauss::new(20);
    let mean = rule.integrate(0.0, 1.0, |u| rule.integrate(0.0, 1.0, |v| cube.direct(u, v)));
    assert!((mean * 6.0 * 16.0 / (4.0 * PI * 3.0) - 1.0).abs() < 1e-12);
}

#[test]
fn impossible_cubes_are_refused() {
    assert!(Cube::new(0.0, 1.0, 0.5).is_err());
    assert!(Cube::new(1.0, f64::NAN, 0.5).is_err());
    assert!(Cube::new(1.0, 1.0, 1.0).is_err());
    assert!(Cube::new(1.0, 1.0, f64::NAN).is_err());
}

#[test]
fn the_scene_file_carries_the_parameters() {
    let xml = Cube::BENCHMARK.xml(&[[0.0, 0.0], [0.998, 0.5]]);
    assert_balanced(&xml);
    for part in ["value=\"50000\"", "<scale value=\"5\"/>", "0.6666666666666666", "target=\"5 4.99 2.5\""] {
        assert!(xml.contains(part), "{part} not in {xml}");
    }
}
