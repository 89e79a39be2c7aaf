//! Round levels for isolux lines.

/// Evenly spaced levels from one end of a scale to the other, all of them whole multiples of the step.
pub(crate) struct Levels {
    /// 1, 2 or 5 times a power of ten.
    pub(crate) step: f64,
    /// In steps.
    first: i64,
    last: i64,
}

impl Levels {
    /// The finest round step of which at most `most` fit between two numbers, and the scale that holds both.
    pub(crate) fn between(low: f64, high: f64, most: usize) -> Self {
        let least = ((high - low) / most as f64).max(f64::MIN_POSITIVE);
        let power = 10f64.powf(least.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|round| round * power).into_iter().find(|&step| step >= least);
        let step = step.unwrap_or(10.0 * power);
        Self { step, first: (low / step).floor() as i64, last: (high / step).ceil() as i64 }
    }

    /// The scale's lower end.
    pub(crate) fn low(&self) -> f64 {
        self.first as f64 * self.step
    }

    /// The scale's upper end.
    pub(crate) fn high(&self) -> f64 {
        self.last as f64 * self.step
    }

    /// Place of a value on the scale, 0 and 1 at its ends.
    pub(crate) fn share(&self, value: f64) -> f64 {
        (value - self.low()) / (self.high() - self.low())
    }

    /// The levels between the ends, each of which has lines.
    pub(crate) fn inner(&self) -> impl Iterator<Item = f64> {
        let step = self.step;
        (self.first + 1..self.last).map(move |number| number as f64 * step)
    }

    /// True if some level with lines lies within `half` of a value.
    pub(crate) fn is_near(&self, value: f64, half: f64) -> bool {
        self.inner().any(|level| (level - value).abs() <= half)
    }

    /// True if a level with lines parts a value from the truth though it lies farther than `half` from the value: nothing
    /// tells that its line is on the wrong side.
    pub(crate) fn is_missed(&self, value: f64, half: f64, truth: f64) -> bool {
        self.inner().any(|level| (value < level) != (truth < level) && (level - value).abs() > half)
    }

    /// A level in as many digits as the step needs.
    pub(crate) fn text(&self, level: f64) -> String {
        let digits = (-self.step.log10().floor()).max(0.0) as usize;
        format!("{level:.digits$}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_the_scale_holds_both_ends() {
        let levels = Levels::between(1830.0, 4207.0, 8);
        assert_eq!((levels.step, levels.low(), levels.high()), (500.0, 1500.0, 4500.0));
        assert_eq!(levels.inner().collect::<Vec<_>>(), [2000.0, 2500.0, 3000.0, 3500.0, 4000.0]);
        assert!(levels.is_missed(1990.0, 5.0, 2000.0) && !levels.is_missed(1990.0, 10.0, 2000.0));
        assert!(!levels.is_missed(2001.0, 0.0, 2499.0));
        assert!(levels.is_near(2100.0, 100.0) && !levels.is_near(2200.0, 100.0));
        let fine = Levels::between(0.11, 0.32, 8);
        assert_eq!(fine.text(fine.low()), "0.10");
    }
}
