//! Photons that lie in heaps on the same spot.

use crate::nearest_law::RelativeMoments;

/// The k-nearest estimate over `k - 1` photons if each spot of a Poisson field holds `m` photons of `1 / m` of the flux.
///
/// The k-th photon lies in the j-th nearest heap, `j = ceil(k / m)`, so that `k - 1` photons are divided by the area of the j-th
/// heap: with `lambda pi r_j^2` of a Gamma law of shape j the mean is `(k - 1) / (m (j - 1))` and the variance that squared over `j - 2`.
/// Exact; at the first heap, `j = 1`, the mean is infinite.
pub fn clusters_by_nearest(k: u32, m: u32) -> RelativeMoments {
    let j = f64::from(k.div_ceil(m));
    let counted = (f64::from(k) - 1.0) / f64::from(m);
    let mean = if j > 1.0 { counted / (j - 1.0) } else { f64::INFINITY };
    let variance = if j > 2.0 { mean * mean / (j - 2.0) } else { f64::INFINITY };
    RelativeMoments { mean, variance }
}

/// Relative variance with a fixed radius that holds `mu` photons in the mean, `m` to a heap: `m / mu`. Unbiased. Exact.
pub fn clusters_by_radius(mu: f64, m: u32) -> f64 {
    f64::from(m) / mu
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nearest_law::{Counted, uniform};
    use crate::random::{Moments, Random};

    #[test]
    fn heaps_of_one_are_the_plain_law() {
        let (heaps, plain) = (clusters_by_nearest(20, 1), uniform(20, Counted::AllButLast));
        assert!((heaps.mean - plain.mean).abs() < 1e-15 && (heaps.variance - plain.variance).abs() < 1e-15);
        assert_eq!(clusters_by_nearest(20, 20).mean, f64::INFINITY);
    }

    /// Heaps at the times of a Poisson process; 6 comparisons at 4.5 standard errors.
    #[test]
    fn heaps_of_a_process_agree() {
        let mut random = Random::new(104);
        let k = 60;
        for m in [2u32, 7, 12] {
            let law = clusters_by_nearest(k, m);
            let (mut mean, mut square) = (Moments::default(), Moments::default());
            for _ in 0..40_000 {
                let (mut found, mut area) = (0, 0.0);
                while found < k {
                    area += random.gap();
                    found += m;
                }
                let x = f64::from(k - 1) / f64::from(m) / area;
                mean.add(x);
                square.add((x - law.mean).powi(2));
            }
            mean.must_agree("heaps, mean", law.mean);
            square.must_agree("heaps, variance", law.variance);
        }
    }

    /// One comparison at 4.5 standard errors.
    #[test]
    fn a_fixed_radius_counts_heaps() {
        let mut random = Random::new(105);
        let (mu, m) = (40.0, 5);
        let mut square = Moments::default();
        for _ in 0..40_000 {
            let (mut heaps, mut clock) = (0.0, random.gap());
            while clock < mu / f64::from(m) {
                heaps += 1.0;
                clock += random.gap();
            }
            square.add((heaps * f64::from(m) / mu - 1.0).powi(2));
        }
        square.must_agree("heaps in a disc", clusters_by_radius(mu, m));
    }
}
