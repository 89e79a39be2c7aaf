//! A colour that few of the photons carry.

/// Relative variance of the k-nearest estimate of a colour carried by the share `share` of the photons, each of which carries one colour
/// alone: `1 / (share (k - 2))`. The other colours' photons set its radius, and it is unbiased.
///
/// Of the `k - 1` photons inside, binomially many carry it, whatever the radius: `E[B^2] E[1 / G^2] / share^2 - 1`. Exact.
pub fn rare_by_nearest(k: u32, share: f64) -> f64 {
    1.0 / (share * (f64::from(k) - 2.0))
}

/// Relative variance of the same with a radius that holds `mu` photons of all colours in the mean: `1 / (share mu)`. Exact.
pub fn rare_by_radius(mu: f64, share: f64) -> f64 {
    1.0 / (share * mu)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Distances as the times of a Poisson process; 2 comparisons at 4.5 standard errors.
    #[test]
    fn coloured_processes_agree() {
        let mut random = Random::new(108);
        for (k, share) in [(30u32, 0.2), (50, 0.05)] {
            let mut square = Moments::default();
            for _ in 0..100_000 {
                let (mut area, mut rare) = (0.0, 0.0);
                for place in 1..=k {
                    area += random.gap();
                    rare += f64::from(random.unit() < share && place < k);
                }
                square.add((rare / (share * area) - 1.0).powi(2));
            }
            square.must_agree("rare colour", rare_by_nearest(k, share));
        }
        assert_eq!(rare_by_radius(50.0, 0.1), 0.2);
    }
}
