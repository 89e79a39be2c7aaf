//! Scattering laws as functions, to be compared with an implementation's draws and densities.
//!
//! They stand for the catalogue's section G; its G6 is [`chi_square_critical`].

pub mod fresnel;
pub mod ggx;
pub mod lambert;
pub mod phong;
pub mod rough_dielectric;

/// The value that a chi-square statistic with this many degrees of freedom exceeds with the probability `alpha`.
///
/// Pearson's test of `n` draws against their density, in bins: expected counts `n` times the density's integral over the bin,
/// bins that expect fewer than 5 pooled, one degree less than bins; for several tests `alpha` is divided by
/// their number (Sidak). By bisection of the incomplete gamma function, 1e-9 relative.
pub fn chi_square_critical(degrees: u32, alpha: f64) -> f64 {
    let half = 0.5 * f64::from(degrees);
    let (mut low, mut high) = (0.0, 100.0 + 4.0 * f64::from(degrees));
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if statrs::function::gamma::gamma_ur(half, 0.5 * middle) > alpha { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::chi_square_critical;
    use crate::random::Random;

    /// Catalogue G6; textbook tables for 1 and 10 degrees; and two degrees, which are exponential.
    #[test]
    fn critical_values() {
        for (degrees, alpha, want) in [(799, 0.01, 894.92607), (1, 0.05, 3.8414588), (10, 0.01, 23.209251)] {
            assert!((chi_square_critical(degrees, alpha) - want).abs() < 1e-5, "{degrees}");
        }
        assert!((chi_square_critical(2, 0.001) + 2.0 * 0.001f64.ln()).abs() < 1e-9);
    }

    /// Uniform draws in 50 bins are rejected as often as said: 10 % of 2000 trials, within 4.5 standard errors.
    #[test]
    fn a_true_law_is_rejected_as_often_as_said() {
        let (mut random, mut rejected) = (Random::new(61), crate::random::Moments::default());
        let critical = chi_square_critical(49, 0.1);
        for _ in 0..2000 {
            let mut counts = [0.0f64; 50];
            (0..5000).for_each(|_| counts[(random.unit() * 50.0) as usize] += 1.0);
            let statistic: f64 = counts.iter().map(|n| (n - 100.0).powi(2) / 100.0).sum();
            rejected.add(f64::from(statistic > critical));
        }
        rejected.must_agree("rate of rejection", 0.1);
    }
}
