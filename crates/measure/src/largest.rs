//! The largest of many uncertain values.

use statrs::function::erf::erfc;

/// Halvings of the bracket: what is uncertain by tens of per cent is found to a thousandth.
const HALVINGS: u32 = 24;
/// Standard deviations beyond which nothing lies.
const FARTHEST: f64 = 6.0;

/// A value above zero, in any unit, of which a part is known; the rest is lognormal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The part that is known, in the value's unit.
    pub known: f64,
    /// Median of the rest, in the value's unit.
    pub median: f64,
    /// Standard deviation of the rest's natural logarithm.
    pub spread: f64,
}

impl Uncertain {
    fn at(&self, deviations: f64) -> f64 {
        self.known + self.median * (deviations * self.spread).exp()
    }

    /// Probability that it lies below a value.
    fn below(&self, value: f64) -> f64 {
        let rest = value - self.known;
        if rest <= 0.0 || self.median <= 0.0 || self.spread <= 0.0 {
            return if value >= self.at(0.0) { 1.0 } else { 0.0 };
        }
        0.5 * erfc(-(rest / self.median).ln() / self.spread * std::f64::consts::FRAC_1_SQRT_2)
    }
}

/// The median of the largest of independent values, in their unit, to a thousandth; `None` of none.
pub fn median_of_largest(values: &[Uncertain]) -> Option<f64> {
    let largest = |deviations: f64| values.iter().map(|value| value.at(deviations)).reduce(f64::max);
    let (mut low, mut high) = (largest(0.0)?, largest(FARTHEST)?);
    if !high.is_finite() {
        return Some(high);
    }
    let matter: Vec<&Uncertain> = values.iter().filter(|value| value.at(FARTHEST) > low).collect();
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let all_below: f64 = matter.iter().map(|value| value.below(middle).ln()).sum();
        *if all_below < 0.5f64.ln() { &mut low } else { &mut high } = middle;
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Uncertain = Uncertain { known: 0.0, median: 1.0, spread: 0.5 };

    #[test]
    fn one_value_has_its_own_median() {
        let shifted = Uncertain { known: 3.0, ..ONE };
        assert!((median_of_largest(&[shifted]).expect("one") - 4.0).abs() < 1e-4);
        assert_eq!(median_of_largest(&[]), None);
        assert_eq!(median_of_largest(&[Uncertain { median: f64::INFINITY, ..ONE }]), Some(f64::INFINITY));
    }

    /// Of a hundred normals the median of the largest is 2.46 standard deviations up (0.5^(1/100) = 0.99309).
    #[test]
    fn of_many_the_largest_lies_higher() {
        let expected = (0.5 * 2.4618_f64).exp();
        let found = median_of_largest(&[ONE; 100]).expect("some");
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
        let with_one_far_above = [vec![ONE; 100], vec![Uncertain { known: 50.0, ..ONE }]].concat();
        assert!((median_of_largest(&with_one_far_above).expect("some") - 51.0).abs() < 1e-3);
    }
}
