//! Lambert's law: the identities that a diffuse surface must keep.
//!
//! BSDF `rho / pi`, density of the outgoing direction `cos / pi`, so `E = pi L` under uniform radiance and
//! `<cos^k> = 2 / (k + 2)`. Reciprocity: `f(i, o) = f(o, i)`; across an interface `f(i, o) / n_o^2 = f(o, i) / n_i^2`,
//! radiance being divided by `n^2` and flux not at all. (Definitions; catalogue entry G1.) Exact.

use std::f64::consts::PI;

/// The BSDF of a diffuse surface of this reflectance, per steradian.
pub fn bsdf(reflectance: f64) -> f64 {
    reflectance / PI
}

/// Density per steradian of a direction drawn in proportion to its cosine; 0 below the surface.
pub fn density(cosine: f64) -> f64 {
    cosine.max(0.0) / PI
}

/// Mean of the `k`-th power of the cosine of such a direction.
pub fn cosine_moment(k: f64) -> f64 {
    2.0 / (k + 2.0)
}

/// The factor by which radiance grows on the way from index `from` into index `to`, apart from what is reflected; the flux
/// of a photon does not change.
pub fn radiance_factor(from: f64, to: f64) -> f64 {
    (to / from).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::random::{Moments, Random};
    use crate::scattering::fresnel;

    #[test]
    fn the_moments_are_integrals_of_the_density() {
        let rule = Gauss::new(12);
        for k in 0..5 {
            let brute = rule.integrate(0.0, 1.0, |mu: f64| 2.0 * PI * density(mu) * mu.powi(k));
            assert!((brute - cosine_moment(f64::from(k))).abs() < 1e-14, "{k}");
        }
        let albedo = rule.integrate(0.0, 1.0, |mu| 2.0 * PI * mu * bsdf(0.7));
        assert!((albedo - 0.7).abs() < 1e-14);
        assert_eq!(density(-0.5), 0.0);
    }

    /// Catalogue G1, drawn: 4 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_moments_agree() {
        let (mut random, mut moments) = (Random::new(62), <[Moments; 4]>::default());
        for _ in 0..100_000 {
            let mu = random.cosine_around([0.0, 0.0, 1.0])[2];
            moments.iter_mut().enumerate().for_each(|(k, m)| m.add(mu.powi(k as i32 + 1)));
        }
        for (m, want) in moments.iter().zip([2.0 / 3.0, 0.5, 0.4, 1.0 / 3.0]) {
            m.must_agree("moment of the cosine", want);
        }
    }

    /// Uniform radiance 1 above glass: the flux that enters, spread over the cone inside, has the radiance
    /// `n^2 (1 - R)`, so that flux is conserved without any factor.
    #[test]
    fn radiance_grows_and_flux_does_not() {
        let (n, rule) = (1.5, Gauss::new(40));
        let entering = rule.composite(0.0, 1.0, 8, |mu| 2.0 * PI * mu * (1.0 - fresnel::unpolarised(mu, n)));
        let critical = (1.0 - 1.0 / (n * n)).sqrt();
        // From the critical cosine on, graded since 1 - R starts there like a square root.
        let inside = |x: f64| {
            let mu = critical + (1.0 - critical) * x * x;
            let radiance = radiance_factor(1.0, n) * (1.0 - fresnel::unpolarised(mu, 1.0 / n));
            2.0 * PI * mu * radiance * 2.0 * (1.0 - critical) * x
        };
        let below = rule.composite(0.0, 1.0, 8, inside);
        assert!((entering / below - 1.0).abs() < 1e-10, "{entering} {below}");
    }
}
