//! What a variance found by few repetitions says of the true one, on a logarithmic scale.

use statrs::function::gamma::digamma;

use crate::Replicates;

/// From here on the trigamma function's series at infinity is good to 1e-9.
const SERIES_FROM: f64 = 8.0;

/// The mean and the variance of ln(s^2 / sigma^2), where s^2 is the variance of normal values with so many degrees of freedom: those of
/// ln(chi^2 / degrees) (Smyth 2004, section 4).
///
/// # Panics
///
/// If `degrees` is not above zero.
pub fn log_variance_error(degrees: f64) -> (f64, f64) {
    assert!(degrees > 0.0, "degrees of freedom must be above zero, not {degrees}");
    let half = 0.5 * degrees;
    (digamma(half) - half.ln(), trigamma(half))
}

/// True variances behind many that few repetitions found: each found one is drawn towards the mean of all logarithms, as far as their scatter is
/// what chance alone makes of equal ones (empirical Bayes, as in Smyth 2004). Values above zero; also the variance of each logarithm about its
/// truth.
pub fn shrunken_variances(found: &[f64], degrees: f64) -> (Vec<f64>, f64) {
    let (bias, chance) = log_variance_error(degrees);
    let logarithms: Replicates = found.iter().map(|variance| variance.ln() - bias).collect();
    let (centre, scatter) = (logarithms.mean().unwrap_or(0.0), logarithms.variance().unwrap_or(f64::INFINITY));
    // The share of the scatter that is not chance.
    let kept = if scatter > 0.0 { (1.0 - chance / scatter).max(0.0) } else { 0.0 };
    let shrunken = |variance: &f64| (centre + kept * (variance.ln() - bias - centre)).exp();
    (found.iter().map(shrunken).collect(), kept * chance)
}

/// The second derivative of ln Gamma, for x > 0: by recurrence up to where the series serves (Abramowitz and Stegun 6.4.6 and 6.4.12).
fn trigamma(mut x: f64) -> f64 {
    let mut below = 0.0;
    while x < SERIES_FROM {
        below += 1.0 / (x * x);
        x += 1.0;
    }
    let square = 1.0 / (x * x);
    let series = 1.0 / x
        + 0.5 * square
        + square / x * (1.0 / 6.0 - square * (1.0 / 30.0 - square * (1.0 / 42.0 - square / 30.0)));
    below + series
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Trigamma of one half and one is pi^2 / 2 and pi^2 / 6; the logarithm of an exponential variable has the mean -gamma.
    #[test]
    fn known_values() {
        let square = std::f64::consts::PI.powi(2);
        assert!((log_variance_error(1.0).1 - square / 2.0).abs() < 1e-8);
        let (mean, variance) = log_variance_error(2.0);
        assert!((mean + 0.577_215_664_901_532_9).abs() < 1e-9 && (variance - square / 6.0).abs() < 1e-8);
        let (mean, variance) = log_variance_error(1e6);
        assert!((mean * 1e6 + 1.0).abs() < 1e-3 && (variance * 5e5 - 1.0).abs() < 1e-4);
    }

    /// Of equal true variances all become much the same; of very different ones each stays.
    #[test]
    fn scatter_by_chance_goes_and_other_scatter_stays() {
        // The quantiles of chi^2 / 3 at 10, 30, 50, 70 and 90 %.
        let by_chance = [0.1948, 0.4746, 0.7887, 1.2216, 2.0838];
        let (shrunken, left) = shrunken_variances(&by_chance, 3.0);
        let [least, .., most] = shrunken[..] else { unreachable!() };
        assert!(most / least < 1.3 && (0.8..1.25).contains(&shrunken[2]) && left < 0.1, "{shrunken:?} {left}");
        let (shrunken, left) = shrunken_variances(&[1e-8, 1e-4, 1.0], 3.0);
        assert!(shrunken[2] / shrunken[0] > 1e7 && left > 0.9, "{shrunken:?} {left}");
        let (alone, left) = shrunken_variances(&[2.0], 3.0);
        assert!((alone[0] / 2.0 - 0.369f64.exp()).abs() < 1e-3 && (left - 0.9348).abs() < 1e-4, "{alone:?} {left}");
    }

    /// By adding up the density of chi-squared with three degrees of freedom.
    #[test]
    fn three_degrees_by_quadrature() {
        let steps = 400_000;
        let (mut mass, mut first, mut second) = (0.0, 0.0, 0.0);
        for step in 0..steps {
            let log = -25.0 + 30.0 * (f64::from(step) + 0.5) / f64::from(steps);
            let x = log.exp();
            let weight = x.powf(1.5) * (-0.5 * x).exp();
            let value = (x / 3.0).ln();
            (mass, first, second) = (mass + weight, first + weight * value, second + weight * value * value);
        }
        let mean = first / mass;
        let (told, variance) = log_variance_error(3.0);
        assert!((told - mean).abs() < 1e-6, "{told} {mean}");
        assert!((variance - (second / mass - mean * mean)).abs() < 1e-6);
    }
}
