//! Evidence: the published table, energy, and random paths.

use super::*;
use crate::random::{Moments, Random};

/// Values of the catalogue (precision vouched there: 1e-6): a point, then its irradiance for reflectance 0.2, 0.5 and 0.9.
const TABLE: [(Face, [f64; 2], [f64; 3]); 12] = [
    (Face::Floor, [0.5, 0.5], [0.2760573, 0.39520882, 1.7238971]),
    (Face::Floor, [0.25, 0.25], [0.24147173, 0.35506422, 1.6724601]),
    (Face::Floor, [0.1, 0.5], [0.2318875, 0.34358158, 1.6583649]),
    (Face::Floor, [0.001, 0.001], [0.15892017, 0.23980176, 1.448512]),
    (Face::Wall, [0.5, 0.5], [0.23115116, 0.35529522, 1.6877063]),
    (Face::Wall, [0.5, 0.1], [0.1257957, 0.24558021, 1.5644949]),
    (Face::Wall, [0.5, 0.999], [0.53619368, 0.6660356, 2.0337601]),
    (Face::Wall, [0.01, 0.5], [0.16286917, 0.27823386, 1.5939448]),
    (Face::Wall, [0.01, 0.01], [0.085214001, 0.17775558, 1.4175121]),
    (Face::Wall, [0.001, 0.999], [0.42596367, 0.58113335, 2.0269132]),
    (Face::Ceiling, [0.5, 0.5], [0.049338069, 0.1836103, 1.5252775]),
    (Face::Ceiling, [0.001, 0.001], [0.073664046, 0.25586934, 1.7274178]),
];

/// Means of ceiling, wall and floor for reflectance 0.2, 0.5 and 0.9.
const MEANS: [[f64; 3]; 3] =
    [[0.058930423, 0.23980426, 0.23185255], [0.20872324, 0.36221117, 0.34243208], [1.5770774, 1.692429, 1.6532068]];

#[test]
fn catalogue_energy_and_random_paths() {
    let cube = EmittingCube::new();
    for (i, rho) in [0.2, 0.5, 0.9].into_iter().enumerate() {
        let solution = cube.solve(rho).expect("valid");
        println!("reflectance {rho}: the meshes differ by {:e}", solution.error_bound());
        for (face, [x, y], values) in TABLE {
            let got = solution.irradiance(face, x, y);
            assert!((got - values[i]).abs() < 2e-5, "{rho} {face:?} {x} {y}: {got} {}", values[i]);
        }
        let means = [Face::Ceiling, Face::Wall, Face::Floor].map(|face| solution.mean(face));
        for (got, want) in means.into_iter().zip(MEANS[i]) {
            assert!((got - want).abs() < 2e-5, "{rho}: {means:?}");
        }
        let energy = (1.0 - rho) * (means[0] + 4.0 * means[1] + means[2]);
        println!("energy - 1 = {:e}", energy - 1.0);
        assert!((energy - 1.0).abs() < 2e-5);
        assert!(solution.error_bound() < 1e-4);
    }
    random_paths(&cube);
}

/// Paths backwards from three points, weighted by the reflectance: 3 comparisons at 4.5 standard errors.
fn random_paths(cube: &EmittingCube) {
    let (rho, mut random) = (0.5, Random::new(41));
    let solution = cube.solve(rho).expect("valid");
    for (face, [x, y], start, normal) in [
        (Face::Floor, [0.25, 0.25], [0.25, 0.25, 0.0], [0.0, 0.0, 1.0]),
        (Face::Wall, [0.5, 0.9], [0.5, 0.0, 0.9], [0.0, 1.0, 0.0]),
        (Face::Ceiling, [0.1, 0.5], [0.1, 0.5, 1.0], [0.0, 0.0, -1.0]),
    ] {
        let mut moments = Moments::default();
        for _ in 0..200_000 {
            let (mut p, mut n, mut weight, mut sum) = (start, normal, 1.0, 0.0);
            for _ in 0..40 {
                let d = random.cosine_around(n);
                let distance = |i: usize| if d[i] > 0.0 { (1.0 - p[i]) / d[i] } else { -p[i] / d[i] };
                let leaves = (0..3).filter(|&i| n[i] == 0.0 || distance(i) > 1e-9);
                let axis = leaves.min_by(|&i, &j| distance(i).total_cmp(&distance(j))).expect("closed");
                let t = distance(axis);
                p = [0, 1, 2].map(|i| (p[i] + t * d[i]).clamp(0.0, 1.0));
                n = [0.0; 3];
                n[axis] = -d[axis].signum();
                p[axis] = if d[axis] > 0.0 { 1.0 } else { 0.0 };
                sum += if axis == 2 && d[2] > 0.0 { weight } else { 0.0 };
                weight *= rho;
            }
            moments.add(sum);
        }
        moments.must_agree("irradiance", solution.irradiance(face, x, y));
    }
}
