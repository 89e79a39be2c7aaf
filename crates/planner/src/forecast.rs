//! When a candidate will be done.

/// Half-width of the interval of a logarithm, in standard errors: 90 %.
const NORMAL: f64 = 1.645;
/// What the time of a pass varies by on a machine with other work.
const OF_TIME: f64 = 0.1;

/// Passes and time to a wanted error, as the passes so far foretell them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Passes in all.
    pub passes: u64,
    /// Wall time in all, seconds.
    pub seconds: f64,
    /// The ends of its interval at 90 %, seconds.
    pub low: f64,
    /// See `low`.
    pub high: f64,
}

impl Forecast {
    /// By the time of the first pass, which does what is done once, and of each other; `degrees` of freedom know the noise, to whose square passes
    /// are in proportion.
    pub(crate) fn new(passes: u64, first: f64, each: f64, degrees: f64) -> Self {
        let seconds = first + (passes - 1) as f64 * each;
        let spread = NORMAL * (2.0 / degrees.max(1.0) + OF_TIME * OF_TIME).sqrt();
        Self { passes, seconds, low: seconds * (-spread).exp(), high: seconds * spread.exp() }
    }

    /// For so many times as many cells.
    pub fn times(&self, more: f64) -> Self {
        Self { seconds: self.seconds * more, low: self.low * more, high: self.high * more, ..*self }
    }

    /// In passes that are so many times as long, which need fewer photons and rays in all by a power of that.
    pub(crate) fn in_longer_passes(&self, longer: f64, gain: f64) -> Self {
        let less = longer.powf(-gain);
        Self {
            passes: (self.passes as f64 * less / longer).ceil() as u64,
            seconds: self.seconds * less,
            low: self.low * less,
            high: self.high * less,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_passes_foretell_better() {
        let [few, many] = [3.0, 300.0].map(|degrees| Forecast::new(100, 0.5, 0.01, degrees));
        assert!((few.seconds - 1.49).abs() < 1e-12 && few.seconds == many.seconds);
        let longer = many.in_longer_passes(4.0, 0.5);
        assert_eq!((longer.passes, longer.seconds), (13, 0.5 * many.seconds));
        assert!(few.low < many.low && many.high < few.high && many.low < many.seconds && many.seconds < many.high);
    }
}
