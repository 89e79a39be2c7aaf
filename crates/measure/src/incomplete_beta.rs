//! The regularised incomplete beta function, behind Student's t and the binomial.
//!
//! statrs 0.19 stops its continued fraction after 140 steps, too early for shapes above about 1e4, loses a small tail
//! next to 1, and its inverse is wrong far in the tail (10 times off at 1e-9) and never returns for large shapes.

use statrs::function::beta::ln_beta;

/// I_x(a, b) and 1 - I_x(a, b), each with its own digits; `y` is 1 - x, given apart so that it keeps its digits.
pub(crate) fn beta_tails(a: f64, b: f64, x: f64, y: f64) -> (f64, f64) {
    if x <= 0.0 {
        return (0.0, 1.0);
    }
    if y <= 0.0 {
        return (1.0, 0.0);
    }
    let front = (a * x.ln() + b * y.ln() - ln_beta(a, b)).exp();
    // The fraction converges fast on the short side of the mean; there the tail is also the smaller one, nearly.
    if x < (a + 1.0) / (a + b + 2.0) {
        let lower = front * fraction(a, b, x) / a;
        (lower, 1.0 - lower)
    } else {
        let upper = front * fraction(b, a, y) / b;
        (1.0 - upper, upper)
    }
}

/// The x with I_x(a, b) = `p`, by bisection: slow, and right for any shapes.
pub(crate) fn beta_quantile(a: f64, b: f64, p: f64) -> f64 {
    bisect(0.0, 1.0, |x| beta_tails(a, b, x, 1.0 - x).0 < p)
}

/// The point where `below` turns false, between `low` and `high`, to about the last bit.
pub(crate) fn bisect(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    while high - low > 2.0 * f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The continued fraction of I_x(a, b) (DLMF 8.17.22) by Lentz's method; takes about sqrt(max(a, b)) steps.
fn fraction(a: f64, b: f64, x: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let away_from_zero = |v: f64| if v.abs() < TINY { TINY } else { v };
    let mut c = 1.0;
    let mut d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut value = d;
    for m in 1..100_000 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = value;
        for coefficient in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + coefficient * d);
            c = away_from_zero(1.0 + coefficient / c);
            value *= c * d;
        }
        if (value - before).abs() <= f64::EPSILON * value.abs() {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    /// I_x(a, 1) = x^a and I_x(1, b) = 1 - (1 - x)^b.
    #[test]
    fn closed_forms() {
        for x in [1e-6, 0.1, 0.5, 0.9, 0.999] {
            for shape in [0.5, 1.0, 3.0, 40.0] {
                let lower = beta_tails(shape, 1.0, x, 1.0 - x).0;
                assert!((lower / x.powf(shape) - 1.0).abs() < 1e-12, "{x} {shape}: {lower}");
                let upper = beta_tails(1.0, shape, x, 1.0 - x).1;
                assert!((upper / (1.0 - x).powf(shape) - 1.0).abs() < 1e-12, "{x} {shape}: {upper}");
            }
        }
    }

    /// By symmetry I_1/2(a, a) = 1/2; shapes far above where 140 steps suffice.
    #[test]
    fn large_shapes() {
        for shape in [1e3, 1e5, 1e7] {
            assert!((beta_tails(shape, shape, 0.5, 0.5).0 - 0.5).abs() < 1e-7, "{shape}");
            assert!((beta_quantile(shape, shape, 0.5) - 0.5).abs() < 1e-9, "{shape}");
        }
    }

    #[test]
    fn the_quantile_inverts_far_in_the_tail() {
        for (a, b) in [(0.5, 0.5), (3.0, 40.0), (2e4, 5.0)] {
            for p in [1e-12, 1e-4, 0.3, 0.99] {
                let x = beta_quantile(a, b, p);
                assert!((beta_tails(a, b, x, 1.0 - x).0 / p - 1.0).abs() < 1e-7, "{a} {b} {p}");
            }
        }
    }
}
