//! Evidence: the published table, energy, another mesh, and random paths.

use super::*;
use crate::random::{Moments, Random};

/// Catalogue D6: degrees, reflectance, E at 0.01, 0.1, 0.5 and 0.9, apparent exitance.
const TABLE: [(f64, f64, [f64; 4], f64); 8] = [
    (30.0, 0.5, [1.7391784, 1.6683042, 1.2781938, 0.68496425], 1.4978261),
    (30.0, 0.9, [5.3803292, 4.4405297, 2.5889194, 1.2234097], 2.8122394),
    (60.0, 0.5, [1.1751897, 1.0544947, 0.6670116, 0.37350834], 1.3081966),
    (60.0, 0.9, [2.1012257, 1.6838361, 0.92924566, 0.49984984], 1.7965844),
    (90.0, 0.5, [0.64839267, 0.56080954, 0.32409548, 0.19095917], 1.1657288),
    (90.0, 0.9, [0.85290552, 0.69456611, 0.3780864, 0.21935221], 1.3547918),
    (120.0, 0.5, [0.27843666, 0.23684224, 0.1308995, 0.079698887], 1.0708679),
    (120.0, 0.9, [0.31029903, 0.25733837, 0.13910447, 0.084227022], 1.1367157),
];

#[test]
fn catalogue_values_energy_and_meshes() {
    for (degrees, rho, values, exitance) in TABLE {
        let groove = Groove::new(degrees.to_radians(), rho).expect("valid");
        let finer = Groove::on_mesh(degrees.to_radians(), rho, 12);
        for (x, want) in [0.01, 0.1, 0.5, 0.9].into_iter().zip(values) {
            let (got, other) = (groove.irradiance(x), finer.irradiance(x));
            println!(
                "{degrees} {rho} {x}: {got} ({:e} from the finer mesh, {:e} from the table)",
                got - other,
                got - want
            );
            assert!((got - other).abs() < 1e-6 && (got - want).abs() < 1e-6);
        }
        assert!((groove.apparent_exitance() - exitance).abs() < 1e-6);
        // What both faces send out and do not absorb leaves through the top; by the face, not by the kernel.
        let face = groove.weights.iter().zip(&groove.irradiance);
        let kept: f64 = face.map(|(w, e)| w * (1.0 - rho) * e).sum();
        let out = groove.apparent_exitance() * (0.5 * groove.angle).sin();
        assert!((out + kept - 1.0).abs() < 1e-6, "{degrees} {rho}: {out} {kept}");
    }
    assert!(Groove::new(4.0, 0.5).is_err() && Groove::new(1.0, 1.0).is_err());
}

#[test]
fn the_symbol_and_the_exponent() {
    for (a, want) in [(-0.5, 0.42360654), (0.0, 0.5), (0.25, 0.62973176), (0.75, 1.8891953)] {
        assert!((right_angle_symbol(a) - want).abs() < 1e-7, "{a}");
        // The definition with x = 1, z = exp(t).
        let kernel = |t: f64| 0.5 * (t * (2.0 + a)).exp() / (1.0 + (2.0 * t).exp()).powf(1.5);
        let brute = Gauss::new(12).composite(-40.0, 120.0, 400, kernel);
        assert!((right_angle_symbol(a) / brute - 1.0).abs() < 1e-10, "{a}: {brute}");
    }
    for (rho, want) in [(0.2, 0.90264878), (0.5, 0.76336208), (0.9, 0.58199259)] {
        assert!((right_angle_exponent(rho) - want).abs() < 1e-7, "{rho}");
    }
    // The solved groove bends towards its apex with that exponent.
    let groove = Groove::new(0.5 * PI, 0.9).expect("valid");
    let limit = 0.5 / (1.0 - 0.45);
    let slope = ((limit - groove.irradiance(2e-4)) / (limit - groove.irradiance(1e-4))).log2();
    assert!((slope - right_angle_exponent(0.9)).abs() < 0.01, "{slope}");
}

/// Paths in space backwards from two points of a face, weighted by the reflectance: 4 comparisons at 4.5 standard errors.
#[test]
fn random_paths_agree() {
    let mut random = Random::new(43);
    for (degrees, rho) in [(60f64, 0.9), (120.0, 0.5)] {
        let groove = Groove::new(degrees.to_radians(), rho).expect("valid");
        for start in [0.1, 0.9] {
            let mut moments = Moments::default();
            for _ in 0..200_000 {
                let (mut x, mut weight, mut sum) = (start, 1.0, 0.0);
                loop {
                    // In the cross-section only the direction along and away from the face matters; both are
                    // measured from the present face, towards the apex negative.
                    let d = random.cosine_around([0.0, 0.0, 1.0]);
                    // The other face is z (cos, sin): x + t d0 = z cos, t d2 = z sin.
                    let (sine, cosine) = groove.angle.sin_cos();
                    let z = x * d[2] / (d[2] * cosine - d[0] * sine);
                    if !(0.0..1.0).contains(&z) {
                        break;
                    }
                    sum += weight;
                    weight *= rho;
                    x = z;
                }
                moments.add(sum);
            }
            moments.must_agree("groove", groove.irradiance(start));
        }
    }
}
