//! Uniform flux: closed forms.

use super::{Counted, RelativeMoments};

/// The area by which the gathered flux is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AreaUsed {
    /// The disc `pi r^2`: right for photons on a plane.
    Disc,
    /// The surface of the sphere `4 pi r^2`, the paper's words taken literally.
    Sphere,
    /// The hemisphere `2 pi r^2`.
    Hemisphere,
}

impl AreaUsed {
    /// The constant factor on the irradiance: 1, 1/4, 1/2. It changes no ratio, slope or relative noise, so only an
    /// absolute test sees it.
    pub fn factor(self) -> f64 {
        match self {
            AreaUsed::Disc => 1.0,
            AreaUsed::Sphere => 0.25,
            AreaUsed::Hemisphere => 0.5,
        }
    }
}

/// Moments of the estimate in an unbounded Poisson field: with `m` counted, mean `m / (k - 1)` and second moment
/// `m^2 / ((k - 1)(k - 2))`. Exact; for `k = 1` the mean, for `k = 2` the variance is infinite.
pub fn uniform(k: u32, counted: Counted) -> RelativeMoments {
    moments(k, counted, 1.0)
}

/// The same when exactly `n >= k` photons fall on the area whose share within `r_k` is Beta(k, n - k + 1): the second
/// moment is `m^2 (n - 1) / (n (k - 1)(k - 2))`. Exact while the disc stays on the area.
pub fn uniform_finite(k: u32, n: u64, counted: Counted) -> RelativeMoments {
    moments(k, counted, (n as f64 - 1.0) / n as f64)
}

fn moments(k: u32, counted: Counted, second_factor: f64) -> RelativeMoments {
    let (k, m) = (f64::from(k), counted.of(k));
    let mean = if k > 1.0 { m / (k - 1.0) } else { f64::INFINITY };
    let variance = if k > 2.0 { m * m / ((k - 1.0) * (k - 2.0)) * second_factor - mean * mean } else { f64::INFINITY };
    RelativeMoments { mean, variance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn catalogue_values() {
        let naive = uniform(20, Counted::All);
        assert!((naive.mean - 1.0526316).abs() < 1e-7);
        assert!((naive.variance - 0.061557402).abs() < 1e-9);
        assert!((naive.mean_squared_error() - 0.064327485).abs() < 1e-9);
        assert!((uniform(50, Counted::AllButLast).variance - 0.020833333).abs() < 1e-9);
        // Finite n: (n - k + 1) / (n (k - 2)) about the unbiased mean.
        let finite = uniform_finite(20, 100, Counted::AllButLast);
        assert!((finite.variance - 81.0 / 1800.0).abs() < 1e-15 && finite.mean == 1.0);
        assert_eq!(uniform(2, Counted::All).variance, f64::INFINITY);
    }

    /// Photons thrown on a torus, found by sorting; 8 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let mut random = Random::new(8);
        for (k, n) in [(10usize, 150u64), (30, 400)] {
            for counted in [Counted::All, Counted::AllButLast] {
                let law = uniform_finite(k as u32, n, counted);
                let (mut mean, mut square) = (Moments::default(), Moments::default());
                for _ in 0..8_000 {
                    let mut d2: Vec<f64> =
                        (0..n).map(|_| (random.unit() - 0.5).powi(2) + (random.unit() - 0.5).powi(2)).collect();
                    let (_, &mut rk2, _) = d2.select_nth_unstable_by(k - 1, f64::total_cmp);
                    assert!(rk2 < 0.25, "the disc stays on the square");
                    let x = counted.of(k as u32) / (std::f64::consts::PI * rk2 * n as f64);
                    mean.add(x);
                    square.add((x - law.mean).powi(2));
                }
                mean.must_agree("k-nearest mean", law.mean);
                square.must_agree("k-nearest variance", law.variance);
            }
        }
    }

    /// Photons on a plane through the centre of a ball: `n` in the disc are `n` in the ball, so the sphere's area reads a
    /// quarter. 3 comparisons at 4.5 standard errors.
    #[test]
    fn the_wrong_area_is_a_constant_factor() {
        let mut random = Random::new(9);
        let (r, density) = (0.3, 100.0);
        for area in [AreaUsed::Disc, AreaUsed::Sphere, AreaUsed::Hemisphere] {
            let divisor = std::f64::consts::PI * r * r / area.factor();
            let mut estimate = Moments::default();
            for _ in 0..20_000 {
                let (mut found, mut clock) = (0.0, random.gap());
                while clock < density {
                    let (x, y) = (random.unit() - 0.5, random.unit() - 0.5);
                    found += f64::from(x * x + y * y < r * r);
                    clock += random.gap();
                }
                estimate.add(found / (divisor * density));
            }
            estimate.must_agree("area factor", area.factor());
        }
    }
}
