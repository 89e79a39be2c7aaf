//! Is a mean with a known standard error what it should be?

use statrs::function::erf::erfc;

/// The two-sided p-value of `value` against `expected` when the value is normal with `std_error`; all in one unit.
///
/// Use it where the standard error is known or rests on many replicates; with few, judge by the interval of
/// [`Replicates`](crate::Replicates). A zero standard error gives 1 for equality and 0 otherwise; a NaN gives NaN.
pub fn z_test(value: f64, expected: f64, std_error: f64) -> f64 {
    let apart = (value - expected).abs();
    if apart == 0.0 && std_error == 0.0 {
        return 1.0;
    }
    erfc(apart / std_error * std::f64::consts::FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p_values_agree_with_the_normal_table() {
        assert!((z_test(10.0, 10.0 + 1.959963984540054 * 0.5, 0.5) - 0.05).abs() < 1e-9);
        assert!((z_test(4.5, 0.0, 1.0) / 6.795346249460121e-06 - 1.0).abs() < 1e-6);
        assert_eq!(z_test(1.0, 1.0, 0.0), 1.0);
        assert_eq!(z_test(1.0, 2.0, 0.0), 0.0);
        assert!(z_test(f64::NAN, 2.0, 1.0).is_nan());
    }
}
