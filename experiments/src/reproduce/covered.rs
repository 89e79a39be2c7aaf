//! Readings of one scene by many seeds, and how often their intervals hold what they should.

use photonlab_measure::{Replicates, student_t_quantile};
use photonlab_readout::Cell;
use photonlab_reference::catalogue::Case;

use super::lab::Lab;

/// Two-sided confidences at which coverage is looked at.
pub(super) const LEVELS: [f64; 4] = [0.5, 0.9, 0.95, 0.99];
/// The place of 95 % among them.
pub(super) const USUAL: usize = 2;
/// Fewest seeds whose mean stands for the estimator's.
const FEWEST_SEEDS: usize = 3;
/// Spread below this share of the value is rounding: such a reading has no noise to cover.
const ROUNDING: f64 = 1e-9;

/// One reading of one run.
pub(super) struct Made {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) degrees: f64,
    /// Half the whole interval's length at each level.
    pub(super) half_widths: [f64; LEVELS.len()],
    pub(super) certified: bool,
}

/// The readings of one run; `None` where nothing was found.
pub(super) type Run = Vec<Option<Made>>;

/// The answer to a reading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Truth {
    pub(super) value: f64,
    pub(super) uncertainty: f64,
}

impl Truth {
    /// The error of a reading relative to the answer, beyond what is not known of that.
    pub(super) fn relative_error(&self, value: f64) -> f64 {
        ((value - self.value).abs() - self.uncertainty).max(0.0) / self.value
    }
}

/// The answer to each reading of some cells, channel by channel.
pub(super) fn truths(lab: &Lab, case: &Case, cells: &[Cell], results: usize) -> anyhow::Result<Vec<Truth>> {
    let mut truths = Vec::new();
    for cell in cells {
        let id = &lab.world.scene.sensors[cell.sensor].id;
        let answer = case.expected.iter().find(|answer| &answer.sensor == id);
        let answer = answer.ok_or_else(|| anyhow::anyhow!("no answer for {id}"))?;
        let value = |channel: usize| answer.value[channel.min(answer.value.len() - 1)];
        truths.extend((0..results).map(|c| Truth { value: value(c), uncertainty: answer.uncertainty }));
    }
    Ok(truths)
}

/// What intervals held, over scenes. A run is one replicate: readings of one run have photons in common.
#[derive(Default)]
pub(super) struct Covered {
    /// Share of a run's readings whose interval of the noise alone holds the estimator's mean, by level.
    pub(super) noise: [Replicates; LEVELS.len()],
    /// Share of a run's certified readings whose whole interval holds the answer, by level.
    pub(super) whole: [Replicates; LEVELS.len()],
    pub(super) certified: usize,
    pub(super) readings: usize,
    /// Half-width at 95 % over the RMS error, of each reading that every seed certifies.
    pub(super) ratios: Vec<f64>,
}

impl Covered {
    /// Adds a scene's runs: by seed.
    pub(super) fn add(&mut self, runs: &[Run], truths: &[Truth]) {
        for (number, run) in runs.iter().enumerate() {
            self.readings += run.len();
            self.certified += run.iter().flatten().filter(|made| made.certified).count();
            for level in 0..LEVELS.len() {
                let of_noise = (0..run.len()).filter_map(|i| noise_holds(runs, number, i, level));
                push_share(&mut self.noise[level], of_noise);
                let certified = run.iter().zip(truths).filter_map(|(made, truth)| Some((made.as_ref()?, truth)));
                let of_whole =
                    certified.filter(|(made, _)| made.certified).map(|(made, truth)| made.holds(*truth, level));
                push_share(&mut self.whole[level], of_whole);
            }
        }
        self.ratios.extend((0..truths.len()).filter_map(|i| width_over_error(runs, i, truths[i])));
    }

    /// The median of the ratios.
    pub(super) fn median_ratio(&self) -> Option<f64> {
        let mut ratios = self.ratios.clone();
        ratios.sort_by(f64::total_cmp);
        ratios.get(ratios.len() / 2).copied()
    }

    pub(super) fn certified_share(&self) -> f64 {
        self.certified as f64 / self.readings.max(1) as f64
    }
}

impl Made {
    fn holds(&self, truth: Truth, level: usize) -> bool {
        let slack = truth.uncertainty.max(ROUNDING * truth.value.abs());
        (self.value - truth.value).abs() <= self.half_widths[level] + slack
    }
}

fn push_share(shares: &mut Replicates, held: impl Iterator<Item = bool>) {
    let (mut yes, mut all) = (0, 0);
    for held in held {
        yes += usize::from(held);
        all += 1;
    }
    if all > 0 {
        shares.push(yes as f64 / all as f64);
    }
}

/// Does a reading's interval of the noise alone hold the estimator's mean? That is known from the other seeds, whose own scatter
/// widens the distance.
fn noise_holds(runs: &[Run], number: usize, reading: usize, level: usize) -> Option<bool> {
    let made = runs[number][reading].as_ref()?;
    let others = runs.iter().enumerate().filter(|(other, _)| *other != number);
    let others: Replicates = others.filter_map(|(_, run)| Some(run[reading].as_ref()?.value)).collect();
    if others.len() < FEWEST_SEEDS as u64 - 1 || made.degrees <= 0.0 || made.error <= ROUNDING * made.value.abs() {
        return None;
    }
    let apart = (made.value - others.mean()?).abs() / (1.0 + 1.0 / others.len() as f64).sqrt();
    Some(apart <= student_t_quantile(LEVELS[level], made.degrees) * made.error)
}

fn width_over_error(runs: &[Run], reading: usize, truth: Truth) -> Option<f64> {
    let made: Vec<&Made> = runs.iter().filter_map(|run| run[reading].as_ref().filter(|made| made.certified)).collect();
    if made.len() < runs.len() {
        return None;
    }
    let mean = |of: &dyn Fn(&Made) -> f64| made.iter().map(|made| of(made)).sum::<f64>() / made.len() as f64;
    let error = mean(&|made| (made.value - truth.value).powi(2)).sqrt();
    (error > ROUNDING * truth.value.abs()).then(|| mean(&|made| made.half_widths[USUAL]) / error)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Normal scatter by Box and Muller, with an error bar that is `bar` times the right one and a bias.
    fn runs(seeds: usize, readings: usize, bar: f64, bias: f64) -> Vec<Run> {
        let mut state = 7_u64;
        let mut uniform = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
        };
        let mut one = || {
            let normal = (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
            let degrees = 1e6;
            let half_widths = LEVELS.map(|level| bar * student_t_quantile(level, degrees));
            Some(Made { value: 10.0 + bias + normal, error: bar, degrees, half_widths, certified: true })
        };
        (0..seeds).map(|_| (0..readings).map(|_| one()).collect()).collect()
    }

    fn covered(bar: f64, bias: f64) -> Covered {
        let mut covered = Covered::default();
        covered.add(&runs(200, 20, bar, bias), &vec![Truth { value: 10.0, uncertainty: 0.0 }; 20]);
        covered
    }

    #[test]
    fn right_error_bars_cover_as_often_as_they_say() {
        let covered = covered(1.0, 0.0);
        for (level, nominal) in LEVELS.into_iter().enumerate() {
            for of in [&covered.noise[level], &covered.whole[level]] {
                assert!((of.mean().expect("runs") - nominal).abs() < 0.025, "{nominal}: {of:?}");
            }
        }
        assert!((covered.median_ratio().expect("ratios") - 1.96).abs() < 0.15);
    }

    #[test]
    fn short_bars_and_biased_values_are_noticed() {
        assert!(covered(0.7, 0.0).noise[USUAL].mean().expect("runs") < 0.9);
        let biased = covered(1.0, 1.0);
        assert!((biased.noise[USUAL].mean().expect("runs") - 0.95).abs() < 0.025);
        assert!(biased.whole[USUAL].mean().expect("runs") < 0.9);
    }
}
