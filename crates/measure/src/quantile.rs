//! Two-sided quantiles: how many standard errors an interval reaches to either side.

use statrs::distribution::{ContinuousCDF, Normal};

use crate::incomplete_beta::{beta_tails, bisect};

/// From this many degrees of freedom on Student's t is read from the normal law; the two differ by less than 1e-6.
const NORMAL_FROM: f64 = 1e8;

/// The t with P(|T| <= t) = `confidence` for Student's T with `dof` degrees of freedom; dimensionless.
///
/// `dof` need not be whole (Welch's is not); infinite `dof` gives [`normal_quantile`].
///
/// # Panics
///
/// If `confidence` is outside (0, 1), or `dof` is not above zero.
///
/// *Numerics:* inverts the distribution function by bisection, good to about 1e-9 of itself. Compute it once per number
/// of replicates, not once per pixel.
pub fn student_t_quantile(confidence: f64, dof: f64) -> f64 {
    check(confidence);
    assert!(dof > 0.0, "degrees of freedom must be above zero, not {dof}");
    if dof >= NORMAL_FROM {
        return normal_quantile(confidence);
    }
    let outside = 1.0 - confidence;
    let mut high = 1.0;
    while student_t_outside(high, dof) > outside {
        high *= 2.0;
    }
    bisect(0.0, high, |t| student_t_outside(t, dof) > outside)
}

/// P(|T| > t) for Student's T with `dof` degrees of freedom and t >= 0: the two-sided p-value.
pub(crate) fn student_t_outside(t: f64, dof: f64) -> f64 {
    let square = t * t;
    beta_tails(0.5 * dof, 0.5, dof / (dof + square), square / (dof + square)).0
}

/// The z with P(|Z| <= z) = `confidence` for a standard normal Z; dimensionless.
///
/// # Panics
///
/// If `confidence` is outside (0, 1).
pub fn normal_quantile(confidence: f64) -> f64 {
    check(confidence);
    -Normal::standard().inverse_cdf(0.5 * (1.0 - confidence))
}

/// Confidences come from our own code or from options checked at the command line: a wrong one is a bug.
pub(crate) fn check(confidence: f64) {
    assert!(confidence > 0.0 && confidence < 1.0, "a confidence lies strictly between 0 and 1, not {confidence}");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values as in any printed table; the last is the normal quantile plus (z^3 + z) / (4 dof).
    #[test]
    fn student_t_agrees_with_tables() {
        let table = [
            (0.95, 1.0, 12.706204736432095),
            (0.95, 2.0, 4.302652729911275),
            (0.95, 15.0, 2.131449545559323),
            (0.99, 7.0, 3.4994832973505026),
            (0.999, 29.0, 3.6594050194663736),
            (0.95, 1e6, 1.9599663569),
        ];
        for (confidence, dof, t) in table {
            let ours = student_t_quantile(confidence, dof);
            assert!((ours / t - 1.0).abs() < 1e-9, "{confidence} {dof}: {ours}");
        }
    }

    #[test]
    fn normal_is_the_limit_of_student_t() {
        assert!((normal_quantile(0.95) - 1.959963984540054).abs() < 1e-9);
        assert!((student_t_quantile(0.95, 9.9e7) - normal_quantile(0.95)).abs() < 1e-6);
        assert_eq!(student_t_quantile(0.99, f64::INFINITY), normal_quantile(0.99));
    }

    /// One degree of freedom is Cauchy's law, two have a closed form; far into the tail too.
    #[test]
    fn closed_forms_hold_far_into_the_tail() {
        for tail in [0.2f64, 1e-3, 1e-6, 1e-9] {
            let cauchy = 1.0 / (0.5 * std::f64::consts::PI * tail).tan();
            assert!((student_t_quantile(1.0 - tail, 1.0) / cauchy - 1.0).abs() < 1e-6, "{tail}");
            let two = (1.0 - tail) * (2.0 / (tail * (2.0 - tail))).sqrt();
            assert!((student_t_quantile(1.0 - tail, 2.0) / two - 1.0).abs() < 1e-6, "{tail}");
        }
    }

    #[test]
    #[should_panic(expected = "strictly between 0 and 1")]
    fn a_percentage_is_refused() {
        normal_quantile(95.0);
    }
}
