//! Independent repetitions of one measurement.

use crate::{Interval, student_t_quantile};

/// Streaming mean and variance of independent replicate values with equal weights (Welford 1962).
///
/// A replicate is a whole measurement with its own random numbers (its own seed and map), never one photon:
/// photons of one path are correlated. All results carry the unit of the values.
///
/// *Numerics:* the running mean keeps its digits when the spread is small against the mean. A NaN or infinite value
/// makes every later result NaN; [`Reading`](crate::Reading) and [`Record`](crate::Record) then refuse it by name.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Replicates {
    count: u64,
    mean: f64,
    /// Sum of squared deviations from the mean.
    squares: f64,
}

impl Replicates {
    /// No replicates yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one replicate's value.
    pub fn push(&mut self, value: f64) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
    }

    /// Adds the replicates of `other` after one's own (Chan, Golub and LeVeque 1979).
    ///
    /// The last bits depend on the order: merge by replicate number, not in the order in which threads finish.
    pub fn merge(&mut self, other: &Replicates) {
        if other.count == 0 {
            return;
        }
        let (own, theirs) = (self.count as f64, other.count as f64);
        let apart = other.mean - self.mean;
        self.count += other.count;
        self.mean += apart * theirs / (own + theirs);
        self.squares += other.squares + apart * apart * own * theirs / (own + theirs);
    }

    /// The number of replicates.
    pub fn len(&self) -> u64 {
        self.count
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The mean; `None` without replicates, since nothing measured is not zero.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then_some(self.mean)
    }

    /// The unbiased variance of one replicate (divisor n - 1), in squared units; `None` below two replicates.
    pub fn variance(&self) -> Option<f64> {
        (self.count > 1).then(|| self.squares / (self.count - 1) as f64)
    }

    /// The standard error of the mean; `None` below two replicates.
    pub fn std_error(&self) -> Option<f64> {
        Some((self.variance()? / self.count as f64).sqrt())
    }

    /// n - 1; zero without replicates.
    pub fn degrees_of_freedom(&self) -> f64 {
        self.count.saturating_sub(1) as f64
    }

    /// Half the length of the mean's interval, by Student's t with n - 1 degrees; `None` below two replicates.
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn half_width(&self, confidence: f64) -> Option<f64> {
        let std_error = self.std_error()?;
        Some(student_t_quantile(confidence, self.degrees_of_freedom()) * std_error)
    }

    /// The mean with its interval; `None` below two replicates.
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn interval(&self, confidence: f64) -> Option<Interval> {
        Some(Interval::around(self.mean()?, self.half_width(confidence)?, confidence))
    }
}

impl FromIterator<f64> for Replicates {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut replicates = Replicates::new();
        replicates.extend(values);
        replicates
    }
}

impl Extend<f64> for Replicates {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        values.into_iter().for_each(|value| self.push(value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_set_by_hand() {
        let r: Replicates = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0].into_iter().collect();
        assert_eq!(r.mean(), Some(5.0));
        assert!((r.variance().unwrap() - 32.0 / 7.0).abs() < 1e-14);
        let half = 2.3646242510103 * (32.0f64 / 56.0).sqrt(); // t(0.975, 7)
        assert!((r.half_width(0.95).unwrap() - half).abs() < 1e-9);
    }

    /// A stratified uniform on [0, 1): variance 1/12 up to 1/(12 n^2), and merged thirds equal the whole.
    #[test]
    fn the_uniform_has_variance_one_twelfth_and_parts_make_the_whole() {
        let n = 3000;
        let values: Vec<f64> = (0..n).map(|i| (f64::from(i * 1117 % n) + 0.5) / f64::from(n)).collect();
        let whole: Replicates = values.iter().copied().collect();
        let mut parts = Replicates::new();
        for part in values.chunks(1000) {
            parts.merge(&part.iter().copied().collect());
        }
        assert!((whole.variance().unwrap() * 12.0 * f64::from(n - 1) / f64::from(n) - 1.0).abs() < 1e-6);
        assert_eq!(parts.len(), whole.len());
        assert!((parts.mean().unwrap() - whole.mean().unwrap()).abs() < 1e-14);
        assert!((parts.variance().unwrap() / whole.variance().unwrap() - 1.0).abs() < 1e-13);
    }

    #[test]
    fn digits_survive_a_large_offset() {
        let r: Replicates = [1e9 + 4.0, 1e9 + 7.0, 1e9 + 13.0, 1e9 + 16.0].into_iter().collect();
        assert_eq!(r.variance(), Some(30.0));
    }

    #[test]
    fn too_few_say_nothing() {
        let mut r = Replicates::new();
        assert_eq!((r.mean(), r.std_error(), r.half_width(0.95)), (None, None, None));
        r.push(3.0);
        assert_eq!((r.mean(), r.std_error(), r.interval(0.95)), (Some(3.0), None, None));
        r.merge(&Replicates::new());
        assert_eq!(r.len(), 1);
    }
}
