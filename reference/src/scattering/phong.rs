//! Phong's lobe around the mirror direction, cut off at the horizon.
//!
//! With the BSDF `rho (n + 2)/(2 pi) cos^n`, of the angle from the mirror direction, the share reflected at the angle `theta`
//! from the normal is `rho A(theta)`, `A = (n + 2)/(2 pi) int cos^n(a) max(0, cos) dw`: 1 at normal incidence and less
//! elsewhere, since part of the lobe is below the horizon and cosines are small. At 90 degrees
//! `A = (n + 2)/(2 pi) Beta((n + 1)/2, 3/2)`. Around the lobe's axis the cosine is `p + q cos phi`, whose positive part is
//! integrated in closed form. (Lafortune and Willems 1994; catalogue entry G5.) Quadrature 1e-10.
//!
//! The older factor `(n + 1)/(2 pi)` normalises the lobe without the cosine: `A` times `(n + 1)/(n + 2)`.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::quadrature::Gauss;

/// `A(theta)` for the exponent `n >= 0` and the angle of incidence in radians, up to 90 degrees.
pub fn albedo(n: f64, theta: f64) -> f64 {
    let (sine, cosine) = theta.sin_cos();
    let ring = |a: f64| {
        let (p, q) = (a.cos() * cosine, a.sin() * sine);
        let end = if q > 0.0 { (-p / q).clamp(-1.0, 1.0).acos() } else { PI };
        2.0 * (p * end + q * end.sin()) * a.sin()
    };
    (n + 2.0) / (2.0 * PI) * over_lobe(n, theta, ring)
}

/// Share of directions drawn with the density `(n + 1)/(2 pi) cos^n` that are above the horizon: what a tracer reflects that
/// draws so and throws the others away.
pub fn share_above_horizon(n: f64, theta: f64) -> f64 {
    let (sine, cosine) = theta.sin_cos();
    let ring = |a: f64| {
        let (p, q) = (a.cos() * cosine, a.sin() * sine);
        let end = if q > 0.0 { (-p / q).clamp(-1.0, 1.0).acos() } else { PI };
        2.0 * end * a.sin()
    };
    (n + 1.0) / (2.0 * PI) * over_lobe(n, theta, ring)
}

/// The integral of `cos^n` times `ring` over the lobe: cut where its rings begin to dip below the horizon, with nodes that
/// crowd to that end, since the dip begins like a square root.
fn over_lobe(n: f64, theta: f64, ring: impl Fn(f64) -> f64) -> f64 {
    let (rule, dip) = (Gauss::new(40), FRAC_PI_2 - theta);
    let lobe = |a: f64| a.cos().powf(n) * ring(a);
    let piece = |from: f64, to: f64| {
        rule.composite(0.0, 1.0, 12, |x| 3.0 * (to - from) * x * x * lobe(from + (to - from) * x.powi(3)))
    };
    piece(dip, FRAC_PI_2) - piece(dip, 0.0)
}

#[cfg(test)]
mod tests {
    use statrs::function::beta::beta;

    use super::*;
    use crate::random::{Moments, Random};

    /// Catalogue G5: exponent, degrees, A.
    #[test]
    fn catalogue_values() {
        for (n, degrees, want) in [
            (1.0, 0.0f64, 1.0),
            (1.0, 30.0, 0.88084278),
            (1.0, 89.99, 0.31839716),
            (10.0, 60.0, 0.50473595),
            (10.0, 80.0, 0.22805629),
            (100.0, 30.0, 0.8660254),
            (100.0, 80.0, 0.17523262),
            (1000.0, 80.0, 0.17364818),
            (1000.0, 89.99, 0.012699968),
        ] {
            let got = albedo(n, degrees.to_radians());
            assert!((got - want).abs() < 1e-8, "{n} {degrees}: {got}");
        }
    }

    #[test]
    fn grazing_and_normal_incidence() {
        for n in [1.0, 7.0, 50.0] {
            let grazing = (n + 2.0) / (2.0 * PI) * beta(0.5 * (n + 1.0), 1.5);
            assert!((albedo(n, FRAC_PI_2) - grazing).abs() < 1e-10, "{n}");
            assert!((albedo(n, 0.0) - 1.0).abs() < 1e-10 && (share_above_horizon(n, 0.0) - 1.0).abs() < 1e-10);
            assert!((share_above_horizon(n, FRAC_PI_2) - 0.5).abs() < 1e-10, "{n}");
        }
    }

    /// Directions drawn from the lobe: 4 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_lobes_agree() {
        let mut random = Random::new(65);
        for (n, degrees) in [(1.0, 60f64), (10.0, 80.0)] {
            let theta = degrees.to_radians();
            let [mut reflected, mut above]: [Moments; 2] = Default::default();
            for _ in 0..200_000 {
                let a = random.unit().powf(1.0 / (n + 1.0)).acos();
                let cosine = a.cos() * theta.cos() + a.sin() * theta.sin() * random.between(0.0, PI).cos();
                reflected.add((n + 2.0) / (n + 1.0) * cosine.max(0.0));
                above.add(f64::from(cosine > 0.0));
            }
            reflected.must_agree("albedo", albedo(n, theta));
            above.must_agree("share above the horizon", share_above_horizon(n, theta));
        }
    }
}
