//! Rays that start a fixed length off the surface, so as not to meet it again.

/// Share of the diffuse rays inside a sphere that such a start carries out of it: chords shorter than the length, `(length / (2 R))^2`,
/// since a chord is `2 R cos` and cosines of diffuse rays have the density `2 cos`. Exact; 1 from the diameter on.
pub fn lost_per_bounce(length_over_radius: f64) -> f64 {
    (0.5 * length_over_radius).powi(2).min(1.0)
}

/// All light on the wall of an integrating sphere over the truth, if the share `lost` is lost after each bounce: `(1 - rho) / (1 - rho (1
/// - lost))`. Exact.
pub fn total_with_losses(reflectance: f64, lost: f64) -> f64 {
    (1.0 - reflectance) / (1.0 - reflectance * (1.0 - lost))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// 2 comparisons at 4.5 standard errors.
    #[test]
    fn chords_and_walks_agree() {
        let mut random = Random::new(111);
        let (start, rho) = (0.7, 0.8);
        let lost = lost_per_bounce(start);
        let (mut share, mut total) = (Moments::default(), Moments::default());
        for _ in 0..200_000 {
            share.add(f64::from(2.0 * random.cosine_around([0.0, 0.0, 1.0])[2] < start));
            let mut hits = 1.0;
            while random.unit() < rho && 2.0 * random.cosine_around([0.0, 0.0, 1.0])[2] >= start {
                hits += 1.0;
            }
            total.add(hits * (1.0 - rho));
        }
        share.must_agree("short chords", lost);
        total.must_agree("walks", total_with_losses(rho, lost));
    }
}
