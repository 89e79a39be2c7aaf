//! Numbers for readers, rounded to their uncertainty.

/// `value ± half_width`, both to the second significant digit of the half width; a half width of zero is exact.
pub fn uncertain_text(value: f64, half_width: f64) -> String {
    let Some(shape) = Shape::of(value, half_width) else {
        return plain_text(value);
    };
    shape.wrap(&format!("{} ± {}", shape.digits(value), shape.digits(half_width)))
}

/// `value ± half width` for a symmetric interval, `value [low, high]` for another, digits by the half width.
pub fn interval_text(value: f64, low: f64, high: f64) -> String {
    let half = 0.5 * (high - low);
    let lopsided = (high + low - 2.0 * value).abs();
    if lopsided <= 0.05 * half {
        return uncertain_text(value, half);
    }
    let Some(shape) = Shape::of(value, half) else {
        return plain_text(value);
    };
    shape.wrap(&format!("{} [{}, {}]", shape.digits(value), shape.digits(low), shape.digits(high)))
}

/// A number with nothing to round it to: at most six significant digits, no trailing zeros.
pub fn plain_text(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-4..1e6).contains(&magnitude) {
        let text = format!("{value:.5e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return times_power(&trimmed(mantissa), exponent.parse().unwrap_or(0));
    }
    let decimals = (5 - exponent(value)).clamp(0, 12) as usize;
    minus(&trimmed(&format!("{value:.decimals$}")))
}

/// `10^exponent` with raised digits.
pub(crate) fn power_of_ten(exponent: i32) -> String {
    let raised = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + (digit as u32 - '0' as u32)).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

/// `mantissa × 10^exponent`.
pub(crate) fn times_power(mantissa: &str, exponent: i32) -> String {
    format!("{}×{}", minus(mantissa), power_of_ten(exponent))
}

/// Removes the zeros at the end of a decimal fraction.
pub(crate) fn trimmed(text: &str) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text.to_owned() }
}

/// The typographic minus; zero has none.
pub(crate) fn minus(text: &str) -> String {
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "−") }
}

/// How an uncertain number is written: a common power of ten, and where it is rounded.
struct Shape {
    power: i32,
    /// The decimal place of the last digit, after division by the power: -2 for hundredths.
    place: i32,
}

impl Shape {
    /// `None` where the half width is zero against the value: the number is exact.
    fn of(value: f64, half_width: f64) -> Option<Self> {
        if !half_width.is_finite() || half_width <= 1e-13 * value.abs() {
            return None;
        }
        let largest = value.abs().max(half_width);
        let power = if (1e-3..1e6).contains(&largest) { 0 } else { exponent(largest) };
        // The exponent after rounding to two digits: 0.0996 becomes 0.10.
        let rounded: f64 = format!("{half_width:.1e}").parse().unwrap_or(half_width);
        Some(Shape { power, place: exponent(rounded) - 1 - power })
    }

    fn digits(&self, x: f64) -> String {
        let x = x / 10f64.powi(self.power);
        if self.place <= 0 {
            return minus(&format!("{x:.*}", (-self.place) as usize));
        }
        let step = 10f64.powi(self.place);
        minus(&format!("{:.0}", (x / step).round() * step))
    }

    fn wrap(&self, text: &str) -> String {
        match self.power {
            0 => text.to_owned(),
            power => format!("({text})×{}", power_of_ten(power)),
        }
    }
}

/// The power of ten of the first digit.
fn exponent(x: f64) -> i32 {
    let text = format!("{x:e}");
    text.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits_of_the_uncertainty() {
        assert_eq!(uncertain_text(0.250213, 0.00112), "0.2502 ± 0.0011");
        assert_eq!(uncertain_text(892.81, 3.4), "892.8 ± 3.4");
        assert_eq!(uncertain_text(1.0, 0.0996), "1.00 ± 0.10");
        assert_eq!(uncertain_text(123456.0, 2345.0), "123500 ± 2300");
        assert_eq!(uncertain_text(-0.0001, 0.013), "0.000 ± 0.013");
        assert_eq!(uncertain_text(-1.5, 0.2), "−1.50 ± 0.20");
    }

    #[test]
    fn very_large_and_very_small_share_a_power() {
        assert_eq!(uncertain_text(3.2e9, 4.1e8), "(3.20 ± 0.41)×10⁹");
        assert_eq!(uncertain_text(4.5e-6, 1.2e-7), "(4.50 ± 0.12)×10⁻⁶");
    }

    #[test]
    fn exact_numbers_stay_plain() {
        assert_eq!(uncertain_text(0.25, 0.0), "0.25");
        assert_eq!(plain_text(2000.0 / 3.0), "666.667");
        assert_eq!(plain_text(50_000.0), "50000");
        assert_eq!(plain_text(1e6), "1×10⁶");
        assert_eq!(plain_text(-2.5e-7), "−2.5×10⁻⁷");
        assert_eq!(plain_text(0.0), "0");
    }

    #[test]
    fn lopsided_intervals_show_their_ends() {
        assert_eq!(interval_text(1.0, 0.9, 1.1), "1.00 ± 0.10");
        assert_eq!(interval_text(0.14, 0.0581917, 0.2673961), "0.14 [0.06, 0.27]");
        assert_eq!(interval_text(1.0, 1.0, 1.0), "1");
    }
}
