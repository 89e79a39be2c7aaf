//! Russian roulette whose probability is not the reflectance.

/// The light in an enclosure of this reflectance, over the truth `1 / (1 - reflectance)`, if paths survive each bounce with the
/// probability `survival` and keep their flux: `(1 - reflectance) / (1 - survival)`. Exact.
pub fn unweighted_total(reflectance: f64, survival: f64) -> f64 {
    (1.0 - reflectance) / (1.0 - survival)
}

/// Relative variance of the light that one path brings if survivors weigh `reflectance / survival`; the mean is then right.
///
/// A path brings `T = 1 + B w T'` with `B` true with the probability of survival, so that `E[T^2] = (1 + 2 rho E[T]) / (1 -
/// rho^2 / q)`. Infinite from `q = rho^2` downwards: rare survivors weigh too much. Exact.
pub fn weighted_variance(reflectance: f64, survival: f64) -> f64 {
    let mean = 1.0 / (1.0 - reflectance);
    let left = 1.0 - reflectance * reflectance / survival;
    if left > 0.0 { (1.0 + 2.0 * reflectance * mean) / (left * mean * mean) - 1.0 } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// 6 comparisons at 4.5 standard errors.
    #[test]
    fn walks_agree() {
        let mut random = Random::new(106);
        let rho = 0.6;
        for q in [0.5, 0.6, 0.8] {
            let (mut plain, mut weighed, mut square) = (Moments::default(), Moments::default(), Moments::default());
            for _ in 0..300_000 {
                let (mut total, mut count, mut weight) = (1.0, 1.0, 1.0);
                while random.unit() < q {
                    weight *= rho / q;
                    total += weight;
                    count += 1.0;
                }
                let read = |x: f64| x * (1.0 - rho);
                plain.add(read(count));
                weighed.add(read(total));
                square.add((read(total) - 1.0).powi(2));
            }
            plain.must_agree("unweighted", unweighted_total(rho, q));
            weighed.must_agree("weighted", 1.0);
            square.must_agree("weighted variance", weighted_variance(rho, q));
        }
        assert_eq!(weighted_variance(0.6, 0.36), f64::INFINITY);
    }
}
