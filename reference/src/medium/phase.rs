//! Henyey and Greenstein's phase function.
//!
//! `p(mu) = (1 - g^2) / (4 pi (1 + g^2 - 2 g mu)^(3/2))` per steradian, `mu` the cosine of the angle by which the light is
//! turned (1 straight on). Its moments are `<P_l> = g^l`, so the mean cosine is `g`. (Henyey and Greenstein 1941; catalogue
//! entry F5.) Exact to rounding.

use std::f64::consts::PI;

use crate::out_of_range::{OutOfRange, require};

/// The phase function with one asymmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HenyeyGreenstein {
    g: f64,
}

impl HenyeyGreenstein {
    /// The function with the mean cosine `g`, in `(-1, 1)`.
    pub fn new(g: f64) -> Result<Self, OutOfRange> {
        require(g > -1.0 && g < 1.0, "g", g, "above -1 and below 1")?;
        Ok(HenyeyGreenstein { g })
    }

    /// Density per steradian at this cosine.
    pub fn density(&self, mu: f64) -> f64 {
        let g = self.g;
        (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * mu).powf(1.5))
    }

    /// Probability that the cosine is at most `mu`: `(1 - g^2)/(2g) [(1 + g^2 - 2 g mu)^(-1/2) - 1/(1 + g)]`, written so
    /// that it holds for `g = 0` too.
    pub fn cumulative(&self, mu: f64) -> f64 {
        let g = self.g;
        let root = (1.0 + g * g - 2.0 * g * mu).sqrt();
        (1.0 - g) * (1.0 + mu) / (root * (1.0 + g + root))
    }

    /// The cosine below which the share `u` of the light falls: the inverse of [`HenyeyGreenstein::cumulative`].
    pub fn quantile(&self, u: f64) -> f64 {
        let g = self.g;
        if g.abs() < 1e-6 {
            return 2.0 * u - 1.0;
        }
        let s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
        (1.0 + g * g - s * s) / (2.0 * g)
    }

    /// The mean of the Legendre polynomial of this degree: `g^degree`.
    pub fn moment(&self, degree: u32) -> f64 {
        self.g.powi(degree as i32)
    }

    /// The density averaged over the azimuth between directions with these cosines from the normal, times `4 pi`:
    /// `sum (2l + 1) g^l P_l(mu) P_l(nu)` up to the given degree.
    pub(crate) fn azimuthal_mean(&self, mu: f64, nu: f64, degree: usize) -> f64 {
        let (mut a, mut b, mut power, mut sum) = ([1.0, mu], [1.0, nu], 1.0, 0.0);
        for l in 0..=degree {
            let l = l as f64;
            sum += (2.0 * l + 1.0) * power * a[0] * b[0];
            power *= self.g;
            let next = |p: [f64; 2], x: f64| [p[1], ((2.0 * l + 3.0) * x * p[1] - (l + 1.0) * p[0]) / (l + 2.0)];
            (a, b) = (next(a, mu), next(b, nu));
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::random::{Moments, Random};

    #[test]
    fn density_moments_and_cumulative_agree() {
        let rule = Gauss::new(24);
        for g in [-0.5, 0.0, 0.3, 0.75, 0.9] {
            let hg = HenyeyGreenstein::new(g).expect("valid");
            let moment = |p: &dyn Fn(f64) -> f64| rule.composite(-1.0, 1.0, 60, |mu| 2.0 * PI * hg.density(mu) * p(mu));
            let legendre: [&dyn Fn(f64) -> f64; 4] =
                [&|_| 1.0, &|x| x, &|x| 1.5 * x * x - 0.5, &|x| x * (2.5 * x * x - 1.5)];
            for (degree, p) in legendre.into_iter().enumerate() {
                assert!((moment(p) - hg.moment(degree as u32)).abs() < 1e-12, "{g} {degree}");
            }
            let below = rule.composite(-1.0, 0.4, 60, |mu| 2.0 * PI * hg.density(mu));
            assert!((hg.cumulative(0.4) - below).abs() < 1e-12, "{g}");
            assert!((hg.cumulative(hg.quantile(0.3)) - 0.3).abs() < 1e-12, "{g}");
        }
        assert!(HenyeyGreenstein::new(1.0).is_err());
    }

    /// The mean over the azimuth, by summing over it.
    #[test]
    fn the_series_is_the_azimuthal_mean() {
        let hg = HenyeyGreenstein::new(0.75).expect("valid");
        for (mu, nu) in [(0.3f64, 0.8f64), (-0.9, 0.2), (0.5, 1.0)] {
            let sine = ((1.0 - mu * mu) * (1.0 - nu * nu)).sqrt();
            let at = |k: usize| hg.density(mu * nu + sine * (2.0 * PI * k as f64 / 400.0).cos());
            let brute = 4.0 * PI * (0..400).map(at).sum::<f64>() / 400.0;
            assert!((hg.azimuthal_mean(mu, nu, 120) - brute).abs() < 1e-12, "{mu} {nu}");
        }
    }

    /// Drawn by the quantile, moments against the catalogue's: 4 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_moments_agree() {
        let mut random = Random::new(52);
        for (g, second) in [(-0.5, 0.25), (0.9, 0.81)] {
            let hg = HenyeyGreenstein::new(g).expect("valid");
            let [mut first, mut square]: [Moments; 2] = Default::default();
            for _ in 0..100_000 {
                let mu = hg.quantile(random.unit());
                first.add(mu);
                square.add(1.5 * mu * mu - 0.5);
            }
            first.must_agree("mean cosine", g);
            square.must_agree("second moment", second);
        }
    }
}
