//! Progressive photon mapping at a smooth point: the mean of many passes with few photons each, whose radius shrinks.
//!
//! Passes are independent and their radii are given beforehand, so that the bias is the mean of the passes' biases and the
//! variance the sum of their variances over `n^2`, each that of [`cosine_torus::fixed_radius`]. With `r_(i+1)^2 / r_i^2 = (i + alpha) / (i + 1)`
//! (Knaus and Zwicker, "Progressive photon mapping: a probabilistic approach", 2011) `r_n^2 / r_1^2 = Gamma(n + alpha) / (Gamma(1 + alpha) Gamma(n + 1))`,
//! asymptotically `n^(alpha - 1) / Gamma(1 + alpha)`: bias `n^(alpha - 1)`, variance `n^(-alpha)`, and the least error, `n^(-2/3)`, at
//! `alpha = 2/3` (Kaplanyan and Dachsbacher, "Adaptive progressive photon mapping", 2013). (Catalogue entry H3.)

use statrs::function::gamma::ln_gamma;

use super::{Error, cosine_torus};

/// How the squared radius falls with the pass, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shrinking {
    /// From pass `i` to the next by the factor `(i + alpha) / (i + 1)`.
    Ratio {
        /// In (0, 1).
        alpha: f64,
    },
    /// As `i^(alpha - 1)`.
    Power {
        /// In (0, 1).
        alpha: f64,
    },
}

impl Shrinking {
    /// `r_i^2 / r_1^2` of a pass, counted from 1; good to 1e-12.
    pub fn square(self, pass: u32) -> f64 {
        let i = f64::from(pass);
        match self {
            Shrinking::Ratio { alpha } => (ln_gamma(i + alpha) - ln_gamma(1.0 + alpha) - ln_gamma(i + 1.0)).exp(),
            Shrinking::Power { alpha } => i.powf(alpha - 1.0),
        }
    }
}

/// Photons and radii of every pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progression {
    /// Photons of each pass.
    pub photons: f64,
    /// Of the first pass, m, up to 1/2.
    pub radius: f64,
    /// How it goes on.
    pub shrinking: Shrinking,
}

impl Progression {
    /// The radius of a pass, counted from 1.
    pub fn radius_of(&self, pass: u32) -> f64 {
        self.radius * self.shrinking.square(pass).sqrt()
    }

    /// The error of the mean of the first `passes` passes, at the brightest point of the cosines' torus.
    pub fn error(&self, passes: u32) -> Error {
        let n = f64::from(passes);
        let of_pass = (1..=passes).map(|pass| cosine_torus::fixed_radius(self.photons, self.radius_of(pass)));
        of_pass.fold(Error { bias: 0.0, variance: 0.0 }, |sum, one| Error {
            bias: sum.bias + one.bias / n,
            variance: sum.variance + one.variance / (n * n),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    fn catalogues(alpha: f64) -> Progression {
        Progression { photons: 1000.0, radius: 0.2, shrinking: Shrinking::Ratio { alpha } }
    }

    /// The Gamma functions against the recursion, and their mean against its own closed form.
    #[test]
    fn radii_follow_the_recursion() {
        for alpha in [0.5, 2.0 / 3.0, 0.9] {
            let shrinking = Shrinking::Ratio { alpha };
            let (mut square, mut sum) = (1.0, 0.0);
            for pass in 1..=1000 {
                assert!((shrinking.square(pass) / square - 1.0).abs() < 1e-11, "{alpha} {pass}");
                sum += square;
                square *= (f64::from(pass) + alpha) / (f64::from(pass) + 1.0);
            }
            let first = ln_gamma(1.0 + alpha);
            let ratio = (ln_gamma(1001.0 + alpha) - ln_gamma(1001.0) - first).exp();
            assert!((sum / ((ratio - 1.0) / alpha) - 1.0).abs() < 1e-11, "{alpha}");
        }
    }

    /// The catalogue's table H3.
    #[test]
    fn catalogue_values() {
        for (alpha, passes, radius, bias, variance) in [
            (0.5, 10, 0.11872558, -0.098428668, 0.0021013315),
            (2.0 / 3.0, 10, 0.14262059, -0.11954891, 0.0015422819),
            (2.0 / 3.0, 100, 0.097650148, -0.064665708, 0.00034307912),
            (2.0 / 3.0, 1000, 0.066561523, -0.031671838, 7.7208422e-05),
            (0.9, 100, 0.16195626, -0.1298304, 0.00013310512),
        ] {
            let (progression, error) = (catalogues(alpha), catalogues(alpha).error(passes));
            assert!((progression.radius_of(passes) / radius - 1.0).abs() < 1e-7, "{alpha} {passes}");
            assert!((error.bias / bias - 1.0).abs() < 1e-7, "{alpha} {passes}");
            assert!((error.variance / variance - 1.0).abs() < 1e-7, "{alpha} {passes}");
        }
    }

    /// A power of the pass shrinks as the ratio does, but for a factor.
    #[test]
    fn both_ways_of_shrinking_have_one_exponent() {
        let alpha = 2.0 / 3.0;
        let over = |pass| Shrinking::Power { alpha }.square(pass) / Shrinking::Ratio { alpha }.square(pass);
        assert!((over(100_000) / ln_gamma(1.0 + alpha).exp() - 1.0).abs() < 1e-5);
    }

    /// Photons thrown anew in each pass; 2 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let mut random = Random::new(143);
        let progression = Progression { photons: 60.0, radius: 0.3, shrinking: Shrinking::Power { alpha: 2.0 / 3.0 } };
        let law = progression.error(5);
        let (mut mean, mut square) = (Moments::default(), Moments::default());
        for _ in 0..20_000 {
            let mut value = 0.0;
            for pass in 1..=5 {
                let radius = progression.radius_of(pass);
                let share = cosine_torus::share(radius);
                let held: f64 = (0..60).map(|_| f64::from(random.unit() < share)).sum();
                value += held / (5.0 * 60.0 * std::f64::consts::PI * radius * radius);
            }
            let off = value - cosine_torus::TRUTH;
            mean.add(off);
            square.add((off - law.bias).powi(2));
        }
        mean.must_agree("bias", law.bias);
        square.must_agree("variance", law.variance);
    }
}
