//! Where a function is least.

/// Golden-section steps: each leaves 0.618 of the range, so that 50 leave 4e-11 of it.
const STEPS: u32 = 50;

/// Where a function with a single minimum in `[low, high]`, both above 0, is least, by a golden section of the logarithm
/// (Kiefer, "Sequential minimax search for a maximum", 1953). The place is good to the root of the function's own precision,
/// about 1e-7 of itself, and the function there to that precision.
pub(super) fn least(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let golden = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut low, mut high) = (low.ln(), high.ln());
    let inner = |low: f64, high: f64| [high - golden * (high - low), low + golden * (high - low)];
    let [mut left, mut right] = inner(low, high);
    let [mut at_left, mut at_right] = [f(left.exp()), f(right.exp())];
    for _ in 0..STEPS {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = inner(low, high)[0];
            at_left = f(left.exp());
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = inner(low, high)[1];
            at_right = f(right.exp());
        }
    }
    (0.5 * (low + high)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squared_bias_and_variance_balance() {
        let (b, a, n) = (1.5, 5.0, 1e5);
        let found = least(1e-4, 1.0, |r| b / (n * r * r) + a * a * r.powi(4));
        assert!((found / (b / (2.0 * a * a * n)).powf(1.0 / 6.0) - 1.0).abs() < 1e-6);
    }
}
