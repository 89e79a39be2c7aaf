//! What longer passes spare.

use crate::Forecast;

/// Photons and rays in all that an error needs fall with the passes' length by no more than this power of it: counts of evenly spread photons err
/// as 1 / n within a pass.
const MOST: f64 = 1.0;
/// What is expected of a method before any of its lengths were compared, and how unsure that is.
const USUAL: f64 = 0.2;
const UNSURE: f64 = 0.3;
/// A forecast's interval in standard errors of its logarithm.
const NORMAL: f64 = 1.645;

/// Forecasts at one length of passes and at longer ones.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Gain {
    compared: Option<Compared>,
}

#[derive(Clone, Copy, Debug)]
struct Compared {
    shortest: Forecast,
    longest: Forecast,
    /// The length of the passes of one over those of the other.
    longer: f64,
}

impl Gain {
    /// Takes in what passes that are so many times as long foretell.
    pub(crate) fn add(&mut self, shorter: Forecast, longer: Forecast, by: f64) {
        let before = self.compared.map_or((shorter, 1.0), |compared| (compared.shortest, compared.longer));
        self.compared = Some(Compared { shortest: before.0, longest: longer, longer: before.1 * by });
    }

    /// By what power of the passes' length the photons and rays in all fall that an error needs: what two forecasts say, and what is usual, each
    /// with the weight that its uncertainty leaves it. Below zero where longer passes need more.
    pub(crate) fn expected(&self) -> f64 {
        let Some(Compared { shortest, longest, longer }) = self.compared.filter(|compared| compared.longer > 1.0)
        else {
            return 0.0;
        };
        let error = |forecast: Forecast| (forecast.high / forecast.seconds).ln() / NORMAL;
        let length = longer.ln();
        let (told, unsure) =
            ((shortest.seconds / longest.seconds).ln() / length, error(shortest).hypot(error(longest)) / length);
        let (of_told, of_usual) = (unsure.powi(-2), UNSURE.powi(-2));
        ((told * of_told + USUAL * of_usual) / (of_told + of_usual)).clamp(-MOST, MOST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_sure_counts_and_what_is_not_leaves_what_is_usual() {
        let of = |passes: u64, degrees: f64| Forecast::new(passes, 0.01, 0.01, degrees);
        let told = |shorter: Forecast, longer: Forecast, by: f64| {
            let mut gain = Gain::default();
            gain.add(shorter, longer, by);
            gain.expected()
        };
        assert_eq!(Gain::default().expected(), 0.0);
        let sure = told(of(1000, 1e6), of(100, 1e6), 16.0);
        assert!((sure - 10f64.ln() / 16f64.ln()).abs() < 0.03, "{sure}");
        let by_chance = told(of(1000, 3.0), of(250, 3.0), 4.0);
        assert!(by_chance > USUAL && by_chance < 0.45, "{by_chance}");
        assert_eq!(told(of(1000, 1e6), of(1, 1e6), 16.0), MOST);
    }

    #[test]
    fn steps_are_taken_together() {
        let of = |passes: u64| Forecast::new(passes, 0.01, 0.01, 1e6);
        let mut gain = Gain::default();
        gain.add(of(1600), of(800), 4.0);
        gain.add(of(800), of(400), 4.0);
        assert!((gain.expected() - 0.5).abs() < 0.03, "{}", gain.expected());
    }
}
