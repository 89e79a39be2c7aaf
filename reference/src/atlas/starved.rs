//! Fewer than k photons within the largest radius.

use statrs::function::gamma::{gamma_lr, ln_gamma};

/// Mean of a query for the `k` nearest within a radius that holds `mu` photons in the mean, if one that finds fewer than `k` but at
/// least `least` divides all it found by the disc of the furthest, one that finds fewer by the whole disc, and full ones count all `k`.
///
/// Of `n` photons even in a disc of area 1 the furthest's has `E[1 / area] = n / (n - 1)`. Below five found the readings over it have no
/// fourth moment, below three no variance, so that no interval holds: [`starved_by_furthest`](crate::nearest_law::starved_by_furthest), which starts from two,
/// cannot be measured. Good to 1e-12.
pub fn starved_from(k: u32, mu: f64, least: u32) -> f64 {
    let probability = |n: f64| (n * mu.ln() - mu - ln_gamma(n + 1.0)).exp();
    let over = |n: u32| {
        let count = f64::from(n);
        let too_much = if n >= least { count / (count - 1.0) } else { 1.0 };
        count * too_much * probability(count) / mu
    };
    let shape = f64::from(k) - 1.0;
    (1..k).map(over).sum::<f64>() + f64::from(k) / shape * gamma_lr(shape, mu)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nearest_law::{Counted, capped, starved_by_furthest};
    use crate::random::{Moments, Random};

    /// Never by the furthest is the capped law with all k counted; from two on, less what single photons bring, the older law.
    #[test]
    fn its_ends_are_the_other_laws() {
        for mu in [1.0, 5.0, 20.0] {
            assert!((starved_from(20, mu, 20) - capped(20, mu, Counted::All)).abs() < 1e-12);
            let single = (-mu).exp();
            assert!((starved_from(20, mu, 2) - single - starved_by_furthest(20, mu)).abs() < 1e-12);
        }
    }

    /// 3 comparisons at 4.5 standard errors.
    #[test]
    fn processes_agree() {
        let mut random = Random::new(112);
        for mu in [2.0, 6.0, 15.0] {
            let mut read = Moments::default();
            for _ in 0..200_000 {
                // Areas of the discs up to each photon, the whole one's is 1.
                let (mut area, mut last, mut found) = (random.gap() / mu, 1.0, 0);
                while area < 1.0 && found < 20 {
                    (last, found) = (area, found + 1);
                    area += random.gap() / mu;
                }
                let over = if found >= 5 { last } else { 1.0 };
                read.add(f64::from(found) / (mu * over));
            }
            read.must_agree("starved", starved_from(20, mu, 5));
        }
    }
}
