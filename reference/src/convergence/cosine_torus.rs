//! A smooth field, read at its brightest point.
//!
//! The irradiance is `1 + cos(2 pi x) cos(2 pi y) / 2` on the unit torus. The product of cosines is the mean of two waves of the
//! wave number `K = 2 pi sqrt 2`, so that the disc around the origin reads `1 + J_1(K r) / (K r)` in the mean, where the
//! irradiance is 3/2. Asymptotically the bias is `-a r^2`, `a = K^2 / 16`, and the variance `b / (N r^2)`, `b = 3 / (2 pi)`: the least
//! error is `3 a^2 r^4` at `r = (b / (2 a^2 N))^(1/6)`. (Catalogue entries H1 and H2.)

use std::f64::consts::{PI, SQRT_2};

use super::{Error, least::least};
use crate::{disc_response::disc_response, quadrature::Gauss};

/// The irradiance at the origin.
pub const TRUTH: f64 = 1.5;

/// A disc wider than this meets itself around the torus.
const WIDEST: f64 = 0.5;

/// Mean irradiance over the disc of a radius (m, up to 1/2) around the origin. Exact.
pub fn mean(radius: f64) -> f64 {
    1.0 + 0.5 * disc_response(2.0 * PI * SQRT_2 * radius)
}

/// Share of the light in that disc.
pub fn share(radius: f64) -> f64 {
    PI * radius * radius * mean(radius)
}

/// The radius of the disc that holds a share of the light; at most 1/2. Good to 1e-13.
pub fn radius_of(share: f64) -> f64 {
    let missing = |square: f64| PI * square * mean(square.sqrt()) - share;
    let widest = WIDEST * WIDEST;
    // The share grows nearly in proportion to the square of the radius: a few secants reach rounding, where they may take turns.
    let (mut before, mut square) = (share / (PI * TRUTH), share / PI);
    let mut of_before = missing(before);
    for _ in 0..20 {
        let here = missing(square);
        let step = here * (square - before) / (here - of_before);
        (before, of_before) = (square, here);
        if !step.is_finite() {
            break;
        }
        square = (square - step).clamp(0.0, 2.0 * widest);
        if step.abs() < 1e-14 * square {
            break;
        }
    }
    square.min(widest).sqrt()
}

/// The estimate with a fixed radius (m, up to 1/2) from this many photons. Exact.
pub fn fixed_radius(photons: f64, radius: f64) -> Error {
    let mean = mean(radius);
    let variance = mean * (1.0 - share(radius)) / (photons * PI * radius * radius);
    Error { bias: mean - TRUTH, variance }
}

/// The radius with the least mean squared error.
pub fn best_radius(photons: f64) -> f64 {
    least(1e-3, WIDEST, |radius| fixed_radius(photons, radius).mean_squared())
}

/// The estimate `(k - 1) / (N pi r_k^2)` of the k nearest, `k` above 2.
///
/// The share of the light within `r_k` is Beta(k, N - k + 1), whatever the field (probability integral transform); the two
/// moments are integrals over it, good to 1e-9 while the disc stays below half the torus' width.
pub fn nearest(photons: f64, k: f64) -> Error {
    let (mean, count) = (k / (photons + 1.0), k - 1.0);
    let deviation = (mean * (1.0 - mean) / (photons + 2.0)).sqrt();
    // The law's tail is a Gamma law's where few photons are looked for.
    let (low, high) =
        ((mean - 12.0 * deviation).max(0.0), (mean + 14.0 * deviation + 40.0 / photons).min(share(WIDEST)));
    let log_density = |u: f64| (k - 1.0) * u.ln() + (photons - k) * (-u).ln_1p();
    let most = log_density((k - 1.0) / (photons - 1.0));
    let rule = Gauss::new(12);
    let mean_of = |of: &dyn Fn(f64) -> f64| {
        let integral =
            |of: &dyn Fn(f64) -> f64| rule.composite(low, high, 28, |u| (log_density(u) - most).exp() * of(u));
        integral(of) / integral(&|_| 1.0)
    };
    let estimate = |u: f64| count / (photons * PI * radius_of(u).powi(2));
    let mean = mean_of(&estimate);
    Error { bias: mean - TRUTH, variance: mean_of(&|u| (estimate(u) - mean).powi(2)) }
}

/// The k with the least mean squared error.
pub fn best_count(photons: f64) -> f64 {
    let error = |k: f64| nearest(photons, k).mean_squared();
    let best = least(4.0, 0.25 * photons, error);
    if error(best.floor()) < error(best.ceil()) { best.floor() } else { best.ceil() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    fn irradiance(x: f64, y: f64) -> f64 {
        1.0 + 0.5 * (2.0 * PI * x).cos() * (2.0 * PI * y).cos()
    }

    /// The disc's mean by integrating the field itself in polar coordinates.
    #[test]
    fn the_mean_is_the_fields() {
        let rule = Gauss::new(20);
        for radius in [0.02, 0.15, 0.5] {
            let ring = |rho: f64| rule.composite(0.0, 2.0 * PI, 8, |phi| irradiance(rho * phi.cos(), rho * phi.sin()));
            let integral = rule.integrate(0.0, radius, |rho| rho * ring(rho));
            assert!((share(radius) / integral - 1.0).abs() < 1e-12, "{radius}");
            assert!((radius_of(integral) / radius - 1.0).abs() < 1e-12, "{radius}");
        }
    }

    /// The catalogue's tables H1 and H2.
    #[test]
    fn catalogue_values() {
        for (photons, radius, error) in [
            (1e3, 0.15153358, 0.028430871),
            (1e4, 0.10130756, 0.0066873953),
            (1e6, 0.046425478, 0.00032928357),
            (1e8, 0.021489419, 1.5478688e-05),
        ] {
            let best = best_radius(photons);
            assert!((best / radius - 1.0).abs() < 1e-6, "{best}");
            // Half a unit of the eighth digit, the last one printed, is up to 5e-8.
            assert!((fixed_radius(photons, best).mean_squared() / error - 1.0).abs() < 5e-8, "{photons}");
        }
        for (photons, k, error) in [
            (1e3, 103.0, 0.031325249),
            (1e4, 470.0, 0.0069911853),
            (1e5, 2178.0, 0.0015310906),
            (1e6, 10082.0, 0.00033240429),
        ] {
            // The least is flat: three photons of two thousand change it in the seventh digit.
            let best = best_count(photons);
            assert!((best / k - 1.0).abs() < 5e-3, "{photons}: {best}");
            assert!(nearest(photons, best).mean_squared() < error * (1.0 + 1e-6), "{photons}: {best}");
            assert!((nearest(photons, k).mean_squared() / error - 1.0).abs() < 1e-6, "{photons}");
        }
        assert!((nearest(1e3, 103.0).bias + TRUTH - 1.393516).abs() < 1e-6);
    }

    /// Few of very many photons lie in even light: the variance is 1 / (k - 2) of the irradiance squared.
    #[test]
    fn few_nearest_stop_converging() {
        for k in [5.0, 20.0, 50.0] {
            let error = nearest(1e9, k);
            assert!((error.variance * (k - 2.0) / (TRUTH * TRUTH) - 1.0).abs() < 1e-5, "{k}: {error:?}");
            assert!(error.bias.abs() < 1e-5);
        }
    }

    /// Photons thrown on the torus; 4 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let (mut random, photons, k, radius) = (Random::new(141), 300usize, 25usize, 0.17);
        let laws = [fixed_radius(photons as f64, radius), nearest(photons as f64, k as f64)];
        let mut moments: [Moments; 4] = Default::default();
        for _ in 0..6000 {
            let mut squares: Vec<f64> = Vec::with_capacity(photons);
            while squares.len() < photons {
                let (x, y) = (random.between(-0.5, 0.5), random.between(-0.5, 0.5));
                if random.unit() * TRUTH < irradiance(x, y) {
                    squares.push(x * x + y * y);
                }
            }
            let held = squares.iter().filter(|&&square| square < radius * radius).count() as f64;
            let (_, &mut last, _) = squares.select_nth_unstable_by(k - 1, f64::total_cmp);
            let area = photons as f64 * PI;
            for (i, found) in
                [held / (area * radius * radius), (k as f64 - 1.0) / (area * last)].into_iter().enumerate()
            {
                moments[2 * i].add(found - TRUTH);
                moments[2 * i + 1].add((found - TRUTH).powi(2));
            }
        }
        for (i, law) in laws.iter().enumerate() {
            moments[2 * i].must_agree("bias", law.bias);
            moments[2 * i + 1].must_agree("mean squared error", law.mean_squared());
        }
    }
}
