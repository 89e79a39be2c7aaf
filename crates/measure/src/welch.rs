//! Do two sets of replicates have the same mean?

use crate::quantile::student_t_outside;
use crate::{Interval, Replicates, student_t_quantile};

/// The result of Welch's test: the variances need not be equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Welch {
    /// Mean of the first minus mean of the second, in their unit.
    pub difference: f64,
    /// Standard error of the difference, same unit.
    pub std_error: f64,
    /// Degrees of freedom by Welch and Satterthwaite; not whole.
    pub degrees_of_freedom: f64,
    /// Two-sided p-value of "the means are equal".
    pub p_value: f64,
}

impl Welch {
    /// The difference with its interval.
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn interval(&self, confidence: f64) -> Interval {
        let t = student_t_quantile(confidence, self.degrees_of_freedom);
        Interval::around(self.difference, t * self.std_error, confidence)
    }
}

/// Welch's t-test (1947) of equal means; `None` if either set has fewer than two replicates.
///
/// Two sets without any spread have p-value 1 if they agree and 0 if not.
pub fn welch_test(first: &Replicates, second: &Replicates) -> Option<Welch> {
    let difference = first.mean()? - second.mean()?;
    let (a, b) = (first.std_error()?.powi(2), second.std_error()?.powi(2));
    let std_error = (a + b).sqrt();
    if std_error == 0.0 {
        let p_value = if difference == 0.0 { 1.0 } else { 0.0 };
        return Some(Welch { difference, std_error, degrees_of_freedom: f64::INFINITY, p_value });
    }
    // Shares of the variance, so that tiny values do not underflow when squared.
    let (share_a, share_b) = (a / (a + b), b / (a + b));
    let inverse = share_a.powi(2) / first.degrees_of_freedom() + share_b.powi(2) / second.degrees_of_freedom();
    let degrees_of_freedom = 1.0 / inverse;
    let p_value = student_t_outside((difference / std_error).abs(), degrees_of_freedom);
    Some(Welch { difference, std_error, degrees_of_freedom, p_value })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The third worked example of Wikipedia's article "Welch's t-test": t = -2.22, 24.5 degrees, p = 0.036.
    #[test]
    fn agrees_with_a_published_example() {
        let a: Replicates = [19.8, 20.4, 19.6, 17.8, 18.5, 18.9, 18.3, 18.9, 19.5, 22.0].into_iter().collect();
        let b: Replicates = [
            28.2, 26.6, 20.1, 23.3, 25.2, 22.1, 17.7, 27.6, 20.6, 13.7, 23.2, 17.5, 20.6, 18.0, 23.9, 21.6, 24.3, 20.4,
            24.0, 13.2,
        ]
        .into_iter()
        .collect();
        let w = welch_test(&a, &b).unwrap();
        assert!((w.difference / w.std_error + 2.22).abs() < 0.01, "{w:?}");
        assert!((w.degrees_of_freedom - 24.5).abs() < 0.1, "{w:?}");
        assert!((w.p_value - 0.036).abs() < 0.001, "{w:?}");
        assert!(w.interval(0.95).high < 0.0 && w.interval(0.99).high > 0.0);
    }

    #[test]
    fn sets_without_spread() {
        let a: Replicates = [1.0, 1.0].into_iter().collect();
        let b: Replicates = [2.0, 2.0].into_iter().collect();
        assert_eq!(welch_test(&a, &a).unwrap().p_value, 1.0);
        assert_eq!(welch_test(&a, &b).unwrap().p_value, 0.0);
        assert_eq!(welch_test(&a, &Replicates::new()), None);
    }
}
