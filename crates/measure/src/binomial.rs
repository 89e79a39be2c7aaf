//! How often did it happen, and how often would it?

use crate::Interval;
use crate::incomplete_beta::{beta_quantile, beta_tails};

/// The Clopper-Pearson interval of a probability after `successes` of `trials` independent trials.
///
/// It covers the truth with at least `confidence`, for any probability and any number of trials. Without trials it
/// is [0, 1] around 1/2.
///
/// # Panics
///
/// If `confidence` is outside (0, 1) or there are more successes than trials.
pub fn binomial_interval(successes: u64, trials: u64, confidence: f64) -> Interval {
    crate::quantile::check(confidence);
    assert!(successes <= trials, "{successes} successes in {trials} trials");
    if trials == 0 {
        return Interval { value: 0.5, low: 0.0, high: 1.0, confidence };
    }
    let (k, n, tail) = (successes as f64, trials as f64, 0.5 * (1.0 - confidence));
    let low = if successes == 0 { 0.0 } else { beta_quantile(k, n - k + 1.0, tail) };
    // By symmetry from the failures' lower end: a quantile near 1 would lose its digits.
    let high = if successes == trials { 1.0 } else { 1.0 - beta_quantile(n - k, k + 1.0, tail) };
    Interval { value: k / n, low, high, confidence }
}

/// P(X >= `successes`) for X binomial with `trials` trials of the given `probability`.
///
/// # Panics
///
/// If `probability` is outside [0, 1].
pub fn binomial_upper_tail(successes: u64, trials: u64, probability: f64) -> f64 {
    assert!((0.0..=1.0).contains(&probability), "a probability lies in [0, 1], not {probability}");
    if successes == 0 {
        return 1.0;
    }
    if successes > trials {
        return 0.0;
    }
    beta_tails(successes as f64, (trials - successes) as f64 + 1.0, probability, 1.0 - probability).0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `scipy.stats.binomtest(7, 50).proportion_ci(0.95)`: 0.0581917, 0.2673961.
    #[test]
    fn agrees_with_a_published_interval() {
        let i = binomial_interval(7, 50, 0.95);
        assert!((i.low - 0.0581917).abs() < 1e-6 && (i.high - 0.2673961).abs() < 1e-6, "{i:?}");
    }

    /// Nothing in n trials: the upper end is 1 - (alpha/2)^(1/n), "the rule of three" for one-sided 95 %.
    #[test]
    fn nothing_seen_is_not_impossible() {
        let i = binomial_interval(0, 100, 0.9);
        assert_eq!(i.low, 0.0);
        assert!((i.high - (1.0 - 0.05f64.powf(0.01))).abs() < 1e-9);
        let all = binomial_interval(100, 100, 0.9);
        assert!((all.low - 0.05f64.powf(0.01)).abs() < 1e-9 && all.high == 1.0);
    }

    #[test]
    fn the_tail_is_the_sum_of_its_terms() {
        // Three or more heads of five: 16/32.
        assert!((binomial_upper_tail(3, 5, 0.5) - 0.5).abs() < 1e-12);
        assert!((binomial_upper_tail(5, 5, 0.1) - 1e-5).abs() < 1e-16);
        assert_eq!(binomial_upper_tail(0, 5, 0.1), 1.0);
        assert_eq!(binomial_upper_tail(6, 5, 0.1), 0.0);
    }

    /// Photon counts are large: a million trials agree with the normal approximation.
    #[test]
    fn a_million_trials() {
        let i = binomial_interval(300_000, 1_000_000, 0.95);
        let half = 1.959964 * (0.3f64 * 0.7 / 1e6).sqrt();
        assert!((i.half_width() / half - 1.0).abs() < 1e-3, "{i:?}");
    }

    /// The ends are where the tails have the stated size.
    #[test]
    fn the_interval_inverts_the_tail() {
        let i = binomial_interval(950, 1000, 0.99);
        assert!((binomial_upper_tail(950, 1000, i.low) - 0.005).abs() < 1e-8);
        assert!((1.0 - binomial_upper_tail(951, 1000, i.high) - 0.005).abs() < 1e-8);
    }
}
