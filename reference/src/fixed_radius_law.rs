//! The fixed-radius estimate in uniform flux: mean and variance.
//!
//! Photons of equal flux fall on a plane with number density `lambda`; the estimate is the flux within `r` over
//! `pi r^2`, so it is proportional to a count of mean `mu = lambda pi r^2`: unbiased, with the count's relative variance.
//! (Campbell's theorem for unequal flux; catalogue entry A1.) Exact. All results are relative to the true irradiance.

/// Relative variance with a Poisson count of mean `mu`: `1 / mu`.
pub fn poisson_variance(mu: f64) -> f64 {
    1.0 / mu
}

/// Relative variance when exactly `n` photons land, each inside the disc with probability `p`: `(1 - p) / (n p)`.
pub fn binomial_variance(n: u64, p: f64) -> f64 {
    (1.0 - p) / (n as f64 * p)
}

/// Relative variance with a Poisson count of mean `mu` and photons of unequal flux: `E[f^2] / (E[f]^2 mu)`.
pub fn unequal_flux_variance(mu: f64, mean_flux: f64, mean_square_flux: f64) -> f64 {
    mean_square_flux / (mean_flux * mean_flux * mu)
}

/// Probability of finding no photon at all: `exp(-mu)`.
pub fn empty_probability(mu: f64) -> f64 {
    (-mu).exp()
}

/// Weight of the photons inside the disc, for a kernel proportional to `(1 - rho^2)^n`: its relative variance is this
/// times `1 / mu`, namely `(n + 1)^2 / (2 n + 1)` (catalogue entry A3).
pub fn kernel_variance_factor(n: u32) -> f64 {
    let n = f64::from(n);
    (n + 1.0) * (n + 1.0) / (2.0 * n + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Photons thrown on the unit square, counted in a disc in its middle; 7 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let (mut random, photons, r) = (Random::new(7), 200u64, 0.2);
        let p = std::f64::consts::PI * r * r;
        let mut count: [Moments; 3] = Default::default();
        let mut square: [Moments; 3] = Default::default();
        let mut empty = Moments::default();
        let mu = photons as f64 * p;
        for _ in 0..20_000 {
            // Exactly n photons; then a Poisson number of them, by gaps, with equal and with unequal flux.
            let inside = |random: &mut Random| {
                let (x, y) = (random.unit() - 0.5, random.unit() - 0.5);
                f64::from(x * x + y * y < r * r)
            };
            let exactly: f64 = (0..photons).map(|_| inside(&mut random)).sum();
            let (mut equal, mut unequal, mut clock) = (0.0, 0.0, random.gap());
            while clock < photons as f64 {
                let hit = inside(&mut random);
                (equal, unequal) = (equal + hit, unequal + 2.0 * hit * random.unit());
                clock += random.gap();
            }
            for (i, x) in [exactly, equal, unequal].into_iter().enumerate() {
                count[i].add(x / mu);
                square[i].add((x / mu - 1.0).powi(2));
            }
            // The small disc of mean count 2 is empty as often as the law says.
            let mut arrivals = 0.0;
            let mut clock = random.gap();
            while clock < 2.0 {
                (arrivals, clock) = (arrivals + 1.0, clock + random.gap());
            }
            empty.add(f64::from(arrivals == 0.0));
        }
        count.iter().for_each(|c| c.must_agree("mean of the estimate", 1.0));
        square[0].must_agree("binomial variance", binomial_variance(photons, p));
        square[1].must_agree("Poisson variance", poisson_variance(mu));
        square[2].must_agree("unequal flux", unequal_flux_variance(mu, 1.0, 4.0 / 3.0));
        empty.must_agree("empty", empty_probability(2.0));
    }

    /// `c = int w^2 2 rho d rho / (int w 2 rho d rho)^2` by quadrature, exact for polynomials.
    #[test]
    fn kernel_factors_are_their_integrals() {
        let rule = crate::quadrature::Gauss::new(12);
        for n in 0..5 {
            let moment = |power: i32| rule.integrate(0.0, 1.0, |x| 2.0 * x * (1.0 - x * x).powi(n * power));
            let c = moment(2) / moment(1).powi(2);
            assert!((kernel_variance_factor(n as u32) - c).abs() < 1e-12, "{n}");
        }
    }
}
