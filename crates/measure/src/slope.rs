//! Power laws: a straight line through logarithms, with honest intervals.

use crate::{Interval, student_t_quantile};

/// y = C x^slope, fitted as a straight line through (ln x, ln y).
///
/// The line is kept about the mean of ln x, where its level and its slope are independent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogLogFit {
    /// The exponent.
    pub slope: f64,
    /// Standard error of the exponent.
    pub slope_std_error: f64,
    /// Number of points minus two.
    pub degrees_of_freedom: usize,
    /// Scatter about the line over what the given standard errors explain (a ratio of standard deviations, Birge
    /// 1932); `None` for a plain fit. Well above 1: the points do not lie on a power law within their errors.
    pub birge_ratio: Option<f64>,
    centre: f64,
    level: f64,
    level_std_error: f64,
}

/// Why no line can be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SlopeError {
    /// The lists differ in length.
    #[error("the lists of x, y and standard errors differ in length")]
    Length,
    /// Two points always lie on a line and say nothing about its error.
    #[error("{0} points: a slope with an interval needs at least three")]
    TooFew(usize),
    /// A coordinate has no logarithm, or a standard error is not above zero.
    #[error("point {index}: x = {x}, y = {y}: both (and a given standard error) must be finite and above zero")]
    NoLogarithm {
        /// Index of the point.
        index: usize,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
    },
    /// All x are equal.
    #[error("all x are equal: there is no slope")]
    Vertical,
}

/// Fits a power law by plain least squares; the scatter of the points gives the interval.
pub fn fit_log_log(x: &[f64], y: &[f64]) -> Result<LogLogFit, SlopeError> {
    check(x, y, &vec![1.0; x.len()])?;
    let line = Line::through(x, y, &vec![1.0; x.len()])?;
    let scatter = line.chi_square / line.degrees_of_freedom() as f64;
    Ok(line.fit(scatter, None))
}

/// Fits a power law by least squares weighted with the standard errors of y (in y's unit).
///
/// If the points scatter more than their errors explain, the interval is widened by the ratio; it is never narrowed.
///
/// *Numerics:* the error of ln y is taken as std_error / y, good where that is below about a third.
pub fn fit_log_log_weighted(x: &[f64], y: &[f64], std_errors: &[f64]) -> Result<LogLogFit, SlopeError> {
    check(x, y, std_errors)?;
    let weights: Vec<f64> = y.iter().zip(std_errors).map(|(y, s)| (y / s).powi(2)).collect();
    let line = Line::through(x, y, &weights)?;
    let excess = line.chi_square / line.degrees_of_freedom() as f64;
    Ok(line.fit(excess.max(1.0), Some(excess.sqrt())))
}

impl LogLogFit {
    /// The exponent with its interval, by Student's t.
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn slope_interval(&self, confidence: f64) -> Interval {
        Interval::around(self.slope, self.t(confidence) * self.slope_std_error, confidence)
    }

    /// The law at `x` (above zero), in y's unit, with the interval of the law there (not of a further point).
    ///
    /// Outside the fitted range this is an extrapolation: the interval covers the fit's error, not a change of law.
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn predict(&self, x: f64, confidence: f64) -> Interval {
        let from_centre = x.ln() - self.centre;
        let middle = self.level + self.slope * from_centre;
        let half = self.t(confidence) * self.level_std_error.hypot(self.slope_std_error * from_centre);
        Interval { value: middle.exp(), low: (middle - half).exp(), high: (middle + half).exp(), confidence }
    }

    /// The x at which the law reaches `y` (above zero), with Fieller's interval (1954).
    ///
    /// `None` where the slope's own interval reaches zero: the crossing may then be anywhere.
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn solve(&self, y: f64, confidence: f64) -> Option<Interval> {
        let t = self.t(confidence);
        // Where (rise - slope d)^2 = t^2 (level_error^2 + slope_error^2 d^2), d measured from the centre.
        let rise = y.ln() - self.level;
        let a = self.slope.powi(2) - (t * self.slope_std_error).powi(2);
        if a <= 0.0 {
            return None;
        }
        let b = self.slope * rise;
        let c = rise * rise - (t * self.level_std_error).powi(2);
        let root = (b * b - a * c).max(0.0).sqrt();
        let at = |d: f64| (self.centre + d).exp();
        Some(Interval { value: at(rise / self.slope), low: at((b - root) / a), high: at((b + root) / a), confidence })
    }

    fn t(&self, confidence: f64) -> f64 {
        student_t_quantile(confidence, self.degrees_of_freedom as f64)
    }
}

/// A weighted least-squares line through logarithms.
struct Line {
    points: usize,
    weight: f64,
    centre: f64,
    level: f64,
    slope: f64,
    spread: f64,
    chi_square: f64,
}

impl Line {
    fn through(x: &[f64], y: &[f64], weights: &[f64]) -> Result<Self, SlopeError> {
        let (x, y): (Vec<f64>, Vec<f64>) = x.iter().zip(y).map(|(x, y)| (x.ln(), y.ln())).unzip();
        let sum = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(|i| weights[i] * f(i)).sum::<f64>();
        let weight = sum(&|_| 1.0);
        let (centre, level) = (sum(&|i| x[i]) / weight, sum(&|i| y[i]) / weight);
        let spread = sum(&|i| (x[i] - centre).powi(2));
        // Equal x differ by rounding at most.
        if spread <= weight * (1e-12 * centre.abs().max(1.0)).powi(2) {
            return Err(SlopeError::Vertical);
        }
        let slope = sum(&|i| (x[i] - centre) * (y[i] - level)) / spread;
        let chi_square = sum(&|i| (y[i] - level - slope * (x[i] - centre)).powi(2));
        Ok(Line { points: x.len(), weight, centre, level, slope, spread, chi_square })
    }

    fn degrees_of_freedom(&self) -> usize {
        self.points - 2
    }

    /// `variance` scales the weights' inverse to the variance of ln y.
    fn fit(&self, variance: f64, birge_ratio: Option<f64>) -> LogLogFit {
        LogLogFit {
            slope: self.slope,
            slope_std_error: (variance / self.spread).sqrt(),
            degrees_of_freedom: self.degrees_of_freedom(),
            birge_ratio,
            centre: self.centre,
            level: self.level,
            level_std_error: (variance / self.weight).sqrt(),
        }
    }
}

fn check(x: &[f64], y: &[f64], std_errors: &[f64]) -> Result<(), SlopeError> {
    if x.len() != y.len() || x.len() != std_errors.len() {
        return Err(SlopeError::Length);
    }
    if x.len() < 3 {
        return Err(SlopeError::TooFew(x.len()));
    }
    let good = |v: f64| v > 0.0 && v.is_finite();
    match (0..x.len()).find(|&i| !(good(x[i]) && good(y[i]) && good(std_errors[i]))) {
        Some(index) => Err(SlopeError::NoLogarithm { index, x: x[index], y: y[index] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_exactly() {
        let x = [1e3, 1e4, 1e5, 1e6];
        let y = x.map(|x: f64| 7.0 * x.powf(-2.0 / 3.0));
        let fit = fit_log_log(&x, &y).unwrap();
        assert!((fit.slope + 2.0 / 3.0).abs() < 1e-12 && fit.slope_std_error < 1e-12);
        assert!((fit.predict(1e9, 0.95).value / 7e-6 - 1.0).abs() < 1e-10);
        assert!((fit.solve(7e-6, 0.95).unwrap().value / 1e9 - 1.0).abs() < 1e-9);
    }

    /// Four points by hand: ln x = 0, 1, 2, 3 and ln y = 0, 1, 1, 2 give slope 0.6, error sqrt(0.1 / 5).
    #[test]
    fn plain_fit_by_hand() {
        let x = [0.0f64, 1.0, 2.0, 3.0].map(f64::exp);
        let y = [0.0f64, 1.0, 1.0, 2.0].map(f64::exp);
        let fit = fit_log_log(&x, &y).unwrap();
        assert!((fit.slope - 0.6).abs() < 1e-12);
        assert!((fit.slope_std_error - 0.02f64.sqrt()).abs() < 1e-12);
        assert_eq!((fit.degrees_of_freedom, fit.birge_ratio), (2, None));
        assert!((fit.slope_interval(0.95).half_width() - 4.302652729911275 * 0.02f64.sqrt()).abs() < 1e-8);
    }

    /// With equal relative errors s the slope's error is s / sqrt(sum of squared distances), unless points scatter.
    #[test]
    fn weighted_fit_uses_the_given_errors_and_never_narrows() {
        let x = [0.0f64, 1.0, 2.0, 3.0].map(f64::exp);
        let y = [0.0f64, 1.0, 1.0, 2.0].map(f64::exp);
        let wide = fit_log_log_weighted(&x, &y, &y.map(|y| 0.5 * y)).unwrap();
        assert!((wide.slope_std_error - 0.5 / 5.0f64.sqrt()).abs() < 1e-12);
        assert!(wide.birge_ratio.unwrap() < 1.0);
        let narrow = fit_log_log_weighted(&x, &y, &y.map(|y| 0.01 * y)).unwrap();
        assert!((narrow.slope_std_error - 0.02f64.sqrt()).abs() < 1e-12);
        assert!(narrow.birge_ratio.unwrap() > 10.0);
    }

    /// The crossing's ends lie where the prediction's ends cross the level.
    #[test]
    fn fieller_inverts_the_prediction() {
        let x = [1.0, 2.0, 4.0, 8.0, 16.0];
        let y = [10.2, 7.0, 5.1, 3.4, 2.5];
        let fit = fit_log_log(&x, &y).unwrap();
        let crossing = fit.solve(1.0, 0.9).unwrap();
        assert!((fit.predict(crossing.low, 0.9).low - 1.0).abs() < 1e-9);
        assert!((fit.predict(crossing.high, 0.9).high - 1.0).abs() < 1e-9);
        let flat = fit_log_log(&x, &[1.0, 1.1, 0.9, 1.1, 1.0]).unwrap();
        assert_eq!(flat.solve(0.5, 0.95), None);
    }

    #[test]
    fn what_cannot_be_fitted_is_refused() {
        assert_eq!(fit_log_log(&[1.0, 2.0], &[1.0, 2.0]), Err(SlopeError::TooFew(2)));
        assert_eq!(fit_log_log(&[3.0; 4], &[1.0, 2.0, 3.0, 4.0]), Err(SlopeError::Vertical));
        assert_eq!(fit_log_log(&[1.0, 2.0, 3.0], &[1.0]), Err(SlopeError::Length));
        let zero = fit_log_log(&[1.0, 2.0, 3.0], &[1.0, 0.0, f64::NAN]);
        assert_eq!(zero, Err(SlopeError::NoLogarithm { index: 1, x: 2.0, y: 0.0 }));
    }
}
