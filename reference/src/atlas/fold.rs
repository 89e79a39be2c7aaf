//! A caustic's fold: light that grows as one over the square root of the distance up to a line and ends there.

use std::f64::consts::PI;

use statrs::function::gamma::ln_gamma;

use crate::quadrature::Gauss;

/// What a kernel proportional to `(1 - rho^2)^n` reads at the signed distance `t` (in search radii, positive on the lit side)
/// from the fold of the irradiance `x^(-1/2)`, `x` in search radii: finite on the fold, where the light is not.
///
/// The kernel's marginal is `c (1 - u^2)^(n + 1/2)` with `c = Gamma(n + 2) / (sqrt(pi) Gamma(n + 3/2))`; with `x = s^2` the
/// reading is the integral of `2 c (1 - (s^2 - t)^2)^(n + 1/2)` over `s`. Quadrature, good to 1e-6.
pub fn fold(t: f64, n: u32) -> f64 {
    if t <= -1.0 {
        return 0.0;
    }
    let shape = f64::from(n);
    let c = (ln_gamma(shape + 2.0) - ln_gamma(shape + 1.5)).exp() / PI.sqrt();
    let (low, high) = ((t - 1.0).max(0.0).sqrt(), (t + 1.0).sqrt());
    // Both ends may have a root: a cosine's step is smooth there.
    let at = |phi: f64| {
        let s = 0.5 * (low + high) - 0.5 * (high - low) * phi.cos();
        let inside = (1.0 - (s * s - t).powi(2)).max(0.0);
        2.0 * c * inside.powf(shape + 0.5) * 0.5 * (high - low) * phi.sin()
    };
    Gauss::new(16).composite(0.0, PI, 8, at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn far_from_the_fold_it_is_the_light_itself() {
        // The second order: m2 / 4 times the second derivative.
        for n in 0..3 {
            let t = 40.0_f64;
            let bend = 0.25 / (f64::from(n) + 2.0) * 0.75 * t.powf(-2.5);
            assert!((fold(t, n) - t.powf(-0.5) - bend).abs() < 1e-7, "{n}");
        }
        assert_eq!(fold(-1.0, 0), 0.0);
    }

    /// Points thrown on the disc, weighed; 12 comparisons at 4.5 standard errors. Where the disc reaches the fold the weight's
    /// variance is infinite, so the places are thrown there with the light's own density instead.
    #[test]
    fn thrown_photons_agree() {
        let mut random = Random::new(102);
        for n in 0..3u32 {
            for t in [-0.6, 0.0, 0.4, 1.5_f64] {
                let (low, high) = ((t - 1.0).max(0.0).sqrt(), (t + 1.0).sqrt());
                let mut read = Moments::default();
                for _ in 0..200_000 {
                    let x = random.between(low, high).powi(2) - t;
                    let y = random.between(-1.0, 1.0);
                    let inside = (1.0 - x * x - y * y).max(0.0);
                    let weight = if inside > 0.0 { inside.powi(n as i32) * (f64::from(n) + 1.0) / PI } else { 0.0 };
                    read.add(weight * 2.0 * (high - low) * 2.0);
                }
                read.must_agree(&format!("fold n = {n}, t = {t}"), fold(t, n));
            }
        }
    }
}
