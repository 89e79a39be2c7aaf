//! At most k photons within a largest radius.

use statrs::function::gamma::{gamma_lr, gamma_ur, ln_gamma};

use super::Counted;

/// Mean of a capped query in uniform flux: of the photons within a radius that holds `mu` in the mean, the k nearest are
/// taken; if fewer than `k` are there, all of them over the whole disc.
///
/// `P(Pois(mu) <= k - 2)` from starved queries plus `m / (k - 1) P(Gamma(k - 1) < mu)` from full ones, `m` the number
/// counted: exactly 1 with `k - 1` counted. Good to 1e-12.
pub fn capped(k: u32, mu: f64, counted: Counted) -> f64 {
    let shape = f64::from(k) - 1.0;
    gamma_ur(shape, mu) + counted.of(k) / shape * gamma_lr(shape, mu)
}

/// Mean of the same query if a starved one divides by the disc of its furthest photon instead of the whole disc, full
/// ones counting all `k`; queries that find one photon only are left out, since their mean is infinite.
///
/// `n` photons uniform in a disc of area 1 have `E[1 / largest] = n / (n - 1)`, hence
/// `sum_{n=2}^{k-1} n^2 / (n - 1) P(Pois(mu) = n) / mu` plus the full part. Good to 1e-12.
pub fn starved_by_furthest(k: u32, mu: f64) -> f64 {
    let probability = |n: f64| (n * mu.ln() - mu - ln_gamma(n + 1.0)).exp();
    let starved = (2..k).map(f64::from).map(|n| n * n / (n - 1.0) * probability(n) / mu);
    let shape = f64::from(k) - 1.0;
    starved.sum::<f64>() + f64::from(k) / shape * gamma_lr(shape, mu)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn catalogue_values() {
        for (mu, naive, furthest) in
            [(5.0, 1.0000001, 1.2492948), (20.0, 1.0325567, 1.0576636), (100.0, 1.0526316, 1.0526316)]
        {
            assert!((capped(20, mu, Counted::AllButLast) - 1.0).abs() < 1e-12);
            assert!((capped(20, mu, Counted::All) - naive).abs() < 1e-7);
            assert!((starved_by_furthest(20, mu) - furthest).abs() < 1e-7);
        }
    }

    /// Areas of discs around the query grow by exponential gaps; 9 comparisons at 4.5 standard errors.
    #[test]
    fn simulated_queries_agree() {
        let (mut random, k) = (Random::new(10), 20);
        for mu in [8.0, 20.0, 40.0] {
            let mut estimates: [Moments; 3] = Default::default();
            for _ in 0..60_000 {
                let (mut found, mut area, mut next) = (0, 0.0, random.gap());
                while next < mu && found < k {
                    (found, area) = (found + 1, next);
                    next += random.gap();
                }
                let n = f64::from(found);
                let full = found == k;
                estimates[0].add(if full { (n - 1.0) / area } else { n / mu });
                estimates[1].add(if full { n / area } else { n / mu });
                estimates[2].add(if found >= 2 { n / area } else { 0.0 });
            }
            estimates[0].must_agree("capped", capped(k, mu, Counted::AllButLast));
            estimates[1].must_agree("capped, naive", capped(k, mu, Counted::All));
            estimates[2].must_agree("furthest photon", starved_by_furthest(k, mu));
        }
    }
}
