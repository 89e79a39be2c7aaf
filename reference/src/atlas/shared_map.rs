//! Many gather rays that read one map: their readings share photons.

use std::f64::consts::PI;

use crate::quadrature::Gauss;

/// Share of a disc's area that a disc of the same radius covers at the distance `d` in radii.
fn overlap(d: f64) -> f64 {
    let half = (0.5 * d).min(1.0);
    2.0 / PI * (half.acos() - half * (1.0 - half * half).sqrt())
}

/// Mean of the share of its disc that one of two random points of a square shares with the other's; the square's side in
/// search radii, at least 2.
///
/// Of the square's set covariance `(L - |x|) (L - |y|)` the mean over the direction is `L^2 - 4 L d / pi + d^2 / pi`. Quadrature,
/// good to 1e-9.
///
/// # Panics
/// If the side is below 2.
pub fn mean_overlap(side: f64) -> f64 {
    assert!(side >= 2.0, "a square of {side} radii is too small");
    let at = |angle: f64| {
        // d = 2 cos(angle) takes the root out.
        let d = 2.0 * angle.cos();
        let covariance = side * side - 4.0 * side * d / PI + d * d / PI;
        2.0 * PI * d * covariance * overlap(d) * 2.0 * angle.sin()
    };
    Gauss::new(24).integrate(0.0, 0.5 * PI, at) / side.powi(4)
}

/// Relative variance of the mean reading of `rays` random points of a square, all read from one map of even light with `mu` photons in the
/// mean in each disc: `1 / (mu rays) + (1 - 1 / rays) mean_overlap / mu`. However many rays, the map's own noise stays.
///
/// Readings with counts in common have the covariance of the common photons, `overlap / mu` (Campbell's theorem). Exact.
pub fn shared_map_variance(mu: f64, rays: f64, side: f64) -> f64 {
    (1.0 + (rays - 1.0) * mean_overlap(side)) / (mu * rays)
}

/// What the spread of the same readings makes of it if they are taken for independent, `s^2 / rays`, in the mean:
/// `(1 - mean_overlap) / (mu rays)`. Exact.
pub fn ray_variance(mu: f64, rays: f64, side: f64) -> f64 {
    (1.0 - mean_overlap(side)) / (mu * rays)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn a_large_square_shares_its_part_of_the_area() {
        // The overlap integrated over the plane is the disc's area.
        assert!((mean_overlap(1e4) * 1e8 / PI - 1.0).abs() < 1e-3);
    }

    /// 2 comparisons at 4.5 standard errors.
    #[test]
    fn random_pairs_agree() {
        let mut random = Random::new(107);
        for side in [2.0, 5.0] {
            let mut share = Moments::default();
            for _ in 0..400_000 {
                let [x, y, u, v] = [0; 4].map(|_| random.between(0.0, side));
                // A random point of the first disc, and whether the second has it.
                let (s, phi) = (random.unit().sqrt(), random.between(0.0, 2.0 * PI));
                let at = [x + s * phi.cos() - u, y + s * phi.sin() - v];
                share.add(f64::from(at[0] * at[0] + at[1] * at[1] < 1.0));
            }
            share.must_agree("overlap", mean_overlap(side));
        }
    }
}
