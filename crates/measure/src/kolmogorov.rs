//! Do values follow a given distribution?

use std::f64::consts::PI;

/// The result of a one-sample Kolmogorov-Smirnov test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KolmogorovSmirnov {
    /// Largest distance between the empirical and the given distribution function, in [0, 1].
    pub statistic: f64,
    /// Probability of a distance at least as large if the distribution is right.
    pub p_value: f64,
}

/// Why values cannot be tested.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum KolmogorovSmirnovError {
    /// There are no values.
    #[error("no values to test")]
    Empty,
    /// A value is NaN, or the distribution function left [0, 1] there.
    #[error("the distribution function is {cdf} at {value}")]
    BadCdf {
        /// The value.
        value: f64,
        /// The distribution function there.
        cdf: f64,
    },
}

/// Tests independent `values` against the continuous distribution function `cdf`, fully specified beforehand.
///
/// *Numerics:* the p-value is Kolmogorov's limit with the finite-n correction of Stephens (1970), good to a few
/// percent of itself from about 20 values on.
pub fn kolmogorov_smirnov_test(
    values: &[f64],
    cdf: impl Fn(f64) -> f64,
) -> Result<KolmogorovSmirnov, KolmogorovSmirnovError> {
    if values.is_empty() {
        return Err(KolmogorovSmirnovError::Empty);
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let mut statistic = 0.0f64;
    for (i, &value) in sorted.iter().enumerate() {
        let f = cdf(value);
        if !(0.0..=1.0).contains(&f) {
            return Err(KolmogorovSmirnovError::BadCdf { value, cdf: f });
        }
        // The empirical function jumps here from i/n to (i + 1)/n.
        statistic = statistic.max(f - i as f64 / n).max((i + 1) as f64 / n - f);
    }
    let scaled = (n.sqrt() + 0.12 + 0.11 / n.sqrt()) * statistic;
    Ok(KolmogorovSmirnov { statistic, p_value: kolmogorov_survival(scaled) })
}

/// P(K > x) of Kolmogorov's limit distribution; each of the two series is used where it converges at once.
fn kolmogorov_survival(x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    if x < 1.18 {
        let sum: f64 = (0..4).map(|k| (-(f64::from(2 * k + 1) * PI / x).powi(2) / 8.0).exp()).sum();
        return 1.0 - (2.0 * PI).sqrt() / x * sum;
    }
    let term = |k: i32| (-2.0 * (f64::from(k) * x).powi(2)).exp();
    (2.0 * (term(1) - term(2) + term(3) - term(4))).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Critical values of the limit distribution: K(1.35810) = 0.95, K(1.62762) = 0.99; median 0.82757.
    #[test]
    fn the_limit_agrees_with_tables() {
        for (x, p) in [(0.82757, 0.5), (1.35810, 0.05), (1.62762, 0.01)] {
            assert!((kolmogorov_survival(x) - p).abs() < 2e-5, "{x}: {}", kolmogorov_survival(x));
        }
    }

    #[test]
    fn the_two_series_meet() {
        let (below, above) = (kolmogorov_survival(1.18 - 1e-9), kolmogorov_survival(1.18));
        assert!((below - above).abs() < 1e-7);
    }

    #[test]
    fn an_even_grid_is_uniform_and_its_square_is_not() {
        let grid: Vec<f64> = (0..1000).map(|i| (f64::from(i) + 0.5) / 1000.0).collect();
        let even = kolmogorov_smirnov_test(&grid, |x| x).unwrap();
        assert!((even.statistic - 0.0005).abs() < 1e-12 && even.p_value > 0.999_999);
        let bent = kolmogorov_smirnov_test(&grid, |x| x * x).unwrap();
        assert!((bent.statistic - 0.25).abs() < 1e-3 && bent.p_value < 1e-50);
    }

    #[test]
    fn what_cannot_be_tested_is_refused() {
        assert_eq!(kolmogorov_smirnov_test(&[], |x| x), Err(KolmogorovSmirnovError::Empty));
        assert!(kolmogorov_smirnov_test(&[f64::NAN], |x| x).is_err());
        assert!(kolmogorov_smirnov_test(&[0.5], |_| 1.5).is_err());
    }
}
