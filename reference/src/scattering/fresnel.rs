//! Fresnel's reflectance of a smooth dielectric interface.
//!
//! With `mu` the cosine of incidence, `n` the index of the far side over that of the near one, and
//! `mu_t = sqrt(1 - (1 - mu^2) / n^2)`: `R_s = ((mu - n mu_t) / (mu + n mu_t))^2`,
//! `R_p = ((n mu - mu_t) / (n mu + mu_t))^2`, both 1 if `mu_t` is imaginary (Born and Wolf, section 1.5; catalogue entries
//! E1, G2). The mean over diffuse incidence is `F = 2 int mu R(mu) dmu`; reversibility and etendue tie its two
//! sides: `1 - F_inside = (1 - F_outside) / n^2`.

use crate::quadrature::Gauss;

/// Reflectances for light polarised perpendicular (s) and parallel (p) to the plane of incidence, for the cosine of
/// incidence in `[0, 1]` and the relative `index` (far over near side). Exact to rounding.
pub fn polarised(cosine: f64, index: f64) -> [f64; 2] {
    let sine2 = (1.0 - cosine * cosine) / (index * index);
    if sine2 >= 1.0 {
        return [1.0; 2];
    }
    let far = (1.0 - sine2).sqrt();
    let s = (cosine - index * far) / (cosine + index * far);
    let p = (index * cosine - far) / (index * cosine + far);
    [s * s, p * p]
}

/// Reflectance for unpolarised light: the mean of both.
pub fn unpolarised(cosine: f64, index: f64) -> f64 {
    let [s, p] = polarised(cosine, index);
    0.5 * (s + p)
}

/// Mean reflectance for diffuse (Lambertian) incidence from the near side, total reflection included.
///
/// Gauss quadrature in the cosine inside the interface, where the square root at the critical angle or at grazing
/// incidence is smooth: 1e-12 for indices from 0.3 to 4.
pub fn diffuse(index: f64) -> f64 {
    let rule = Gauss::new(40);
    if index >= 1.0 {
        return 2.0 * rule.composite(0.0, 1.0, 8, |mu| mu * unpolarised(mu, index));
    }
    // mu^2 = 1 - n^2 (1 - mu_t^2) beyond the critical angle, so mu dmu = n^2 mu_t dmu_t.
    let refracted = |far: f64| {
        let mu = (1.0 - index * index * (1.0 - far * far)).sqrt();
        index * index * far * unpolarised(mu, index)
    };
    1.0 - index * index + 2.0 * rule.composite(0.0, 1.0, 8, refracted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Catalogue G2: normal incidence, outside, inside.
    #[test]
    fn catalogue_values_and_the_identity() {
        for (n, normal, outside, inside) in [
            (1.33f64, 0.020059312, 0.065930849, 0.47194915),
            (1.5, 0.04, 0.091777959, 0.59634576),
            (1.8, 0.081632653, 0.13405445, 0.73273285),
            (2.4, 0.16955017, 0.2101813, 0.8628787),
        ] {
            assert!((unpolarised(1.0, n) - normal).abs() < 1e-8);
            assert!((diffuse(n) - outside).abs() < 1e-8);
            assert!((diffuse(1.0 / n) - inside).abs() < 1e-8);
            let residual = 1.0 - diffuse(1.0 / n) - (1.0 - diffuse(n)) / (n * n);
            assert!(residual.abs() < 1e-12, "{n}: {residual:e}");
        }
    }

    /// Fresnel's own form with angles, Brewster's angle, and reversibility.
    #[test]
    fn the_angles_say_the_same() {
        let n = 1.5f64;
        for i in [0.2f64, 0.7, 1.1, 1.5] {
            let t = (i.sin() / n).asin();
            let s = ((i - t).sin() / (i + t).sin()).powi(2);
            let p = ((i - t).tan() / (i + t).tan()).powi(2);
            let [got_s, got_p] = polarised(i.cos(), n);
            assert!((got_s - s).abs() < 1e-14 && (got_p - p).abs() < 1e-14, "{i}");
            let [back_s, back_p] = polarised(t.cos(), 1.0 / n);
            assert!((got_s - back_s).abs() < 1e-14 && (got_p - back_p).abs() < 1e-14, "{i}");
        }
        assert!(polarised((n.atan()).cos(), n)[1] < 1e-30);
        assert_eq!(unpolarised(0.5, 1.0 / n), 1.0);
    }

    /// Diffuse incidence drawn from a sphere's normal: 2 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_incidence_agrees() {
        let mut random = Random::new(21);
        let mut sums: [Moments; 2] = Default::default();
        for _ in 0..300_000 {
            let mu = random.cosine_around([0.0, 0.0, 1.0])[2];
            for (moments, n) in sums.iter_mut().zip([1.5, 1.0 / 1.5]) {
                moments.add(unpolarised(mu, n));
            }
        }
        sums[0].must_agree("diffuse reflectance from outside", diffuse(1.5));
        sums[1].must_agree("diffuse reflectance from inside", diffuse(1.0 / 1.5));
    }
}
