//! All comparisons of the suite, counted in one place, with one false-alarm rate.

use std::fmt::Display;

use photonlab_measure::{
    Replicates, binomial_upper_tail, chi_square_test, kolmogorov_smirnov_test, sidak_level, welch_test,
};
use photonlab_readout::CellResult;

/// Probability that the whole suite, on a set of seeds never tried before, fails although nothing is wrong.
pub const FALSE_ALARM: f64 = 1e-4;

/// Every family of comparisons and how many it makes. One test, one family; a test that makes another number fails.
pub const SUITE: &[(&str, usize)] = &[
    ("fixed radius, even field", 5),
    ("fixed radius, unequal flux", 2),
    ("sphere's area", 2),
    ("half-plane", 8),
    ("corner, strip, rectangle", 11),
    ("kernels, even field", 10),
    ("kernels, curved field", 10),
    ("kernels, nearest", 15),
    ("kernels, half-plane", 12),
    ("nearest, even field", 12),
    ("nearest, starved", 2),
    ("nearest, half-plane", 10),
    ("clipped at an edge", 16),
    ("clipped at an edge, nearest", 8),
    ("clipped in a furnace", 24),
    ("clipped at free edges", 18),
    ("crease", 16),
    ("crease, normal test", 5),
    ("crease, nearest", 4),
    ("thin wall", 7),
    ("wall on a floor", 2),
    ("wall on a floor, seen", 2),
    ("gather on a sphere", 3),
    ("point lamp", 1),
    ("cosine lamp", 2),
    ("spot lamp", 2),
    ("even environment", 3),
    ("overcast sky", 2),
    ("area lamp", 2),
    ("sphere lamp", 1),
    ("parallel light", 2),
    ("rough surfaces, densities", 120),
    ("rough surfaces, shares", 60),
    ("smooth glass", 12),
    ("matte bodies", 14),
    ("phase functions", 6),
    ("table lamp", 1),
    ("meters below a table lamp", 14),
    ("goniometer, round trip", 1),
    ("luminaire by wavelength", 3),
    ("thin lens", 3),
    ("distant meters", 3),
    ("aimed and spread photons", 189),
    ("nearest, as drawn", 3),
    ("portal, sky component", 24),
    ("mask before a lamp", 1),
    ("glazed opening", 8),
    ("near lamp behind glass", 3),
    ("portal, photons", 3),
    ("portal, one over another", 8),
    ("portal, placed badly", 12),
    ("portal, interreflection", 16),
    ("integrating sphere", 8),
    ("integrating sphere, colour", 6),
    ("integrating sphere, bounces", 5),
    ("integrating sphere, bounces in colour", 2),
    ("reflected flux, cube", 1),
    ("reflected flux, sphere", 3),
    ("reflected flux, Cornell box", 21),
    ("reflected flux, ball lens", 1),
    ("roulette", 8),
    ("books of every scene", 203),
    ("books of hard scenes", 7),
    ("light guide", 1),
    ("trapped light", 3),
    ("slab", 2),
    ("furnace, final gather", 8),
    ("furnace, edge darkening", 4),
    ("cube, six meters", 6),
    ("cube, mean", 1),
    ("ball lens, transport", 5),
    ("ball lens, flux on discs", 12),
    ("white furnace, eye", 27),
    ("white furnace, photons", 9),
    ("coloured sphere", 4),
    ("prism", 14),
    ("dispersive furnace", 2),
    ("white furnace, media", 18),
    ("absorbing slab", 3),
    ("lamp above fog", 2),
    ("hazy room", 6),
    ("forward slab", 6),
    ("fluence in balls", 3),
    ("rays past a lamp in fog", 12),
    ("focus in haze", 2),
    ("disc lamp", 4),
    ("mesh lamp", 8),
    ("paraboloid", 4),
    ("light guide, lamp before it", 2),
    ("port sphere", 4),
    ("condenser", 4),
    ("spectrograph", 11),
    ("reflector", 4),
    ("tilted squares", 10),
    ("lamp through a wall", 2),
    ("smooth ball", 3),
    ("cached cube", 8),
    ("cached furnace", 6),
    ("cached room", 8),
    ("cached floor with a wall", 6),
    ("aided cube", 4),
    ("aided room", 4),
    ("raced to a target", 1),
    ("needs, everything switched on", 36),
];

/// The comparisons of one test. They are judged together by [`Family::decide`].
pub struct Family {
    name: &'static str,
    declared: usize,
    made: Vec<Comparison>,
    decided: bool,
}

struct Comparison {
    what: String,
    detail: String,
    p_value: f64,
}

impl Family {
    /// A family of [`SUITE`].
    ///
    /// # Panics
    /// If it is not declared there.
    pub fn new(name: &'static str) -> Self {
        let declared = SUITE.iter().find(|(known, _)| *known == name);
        let &(_, declared) = declared.unwrap_or_else(|| panic!("the family `{name}` is not declared in SUITE"));
        Self { name, declared, made: Vec::new(), decided: false }
    }

    /// The level of one comparison (Sidak over the whole suite).
    pub fn level() -> f64 {
        sidak_level(FALSE_ALARM, SUITE.iter().map(|(_, comparisons)| comparisons).sum())
    }

    /// A comparison by its p-value; `detail` tells the numbers.
    pub fn compare(&mut self, what: impl Display, p_value: f64, detail: impl Display) {
        self.made.push(Comparison { what: what.to_string(), detail: detail.to_string(), p_value });
    }

    /// Is the mean of independent replicates what it should be? By Student's t.
    pub fn mean(&mut self, what: impl Display, measured: &Replicates, expected: f64) {
        // Against a set without spread Welch's test is Student's for one sample.
        let exact: Replicates = [expected, expected].into_iter().collect();
        let p_value = welch_test(measured, &exact).map_or(f64::NAN, |test| test.p_value);
        let (mean, error) = (measured.mean().unwrap_or(f64::NAN), measured.std_error().unwrap_or(f64::NAN));
        self.compare(
            what,
            p_value,
            format!("expected {expected:.8}, measured {mean:.8} with standard error {error:.2e}"),
        );
    }

    /// Do counts follow expected counts of the same total? By chi-square.
    pub fn counts(&mut self, what: impl Display, observed: &[u64], expected: &[f64]) {
        let test = chi_square_test(observed, expected).unwrap_or_else(|error| panic!("{what}: {error}"));
        let shown: Vec<_> = observed.iter().zip(expected).take(6).map(|(o, e)| format!("{o} ({e:.1})")).collect();
        self.compare(
            what,
            test.p_value,
            format!(
                "chi-square {:.1} with {} degrees; observed (expected): {} ..",
                test.statistic,
                test.degrees_of_freedom,
                shown.join(", ")
            ),
        );
    }

    /// Do independent values follow a distribution? By Kolmogorov and Smirnov.
    pub fn distribution(&mut self, what: impl Display, values: &[f64], cdf: impl Fn(f64) -> f64) {
        let test = kolmogorov_smirnov_test(values, cdf).unwrap_or_else(|error| panic!("{what}: {error}"));
        self.compare(
            what,
            test.p_value,
            format!("largest distance {:.5} over {} values", test.statistic, values.len()),
        );
    }

    /// Do independent trials succeed with a probability? By the exact binomial law, two-sided.
    pub fn proportion(&mut self, what: impl Display, successes: u64, trials: u64, probability: f64) {
        let above = binomial_upper_tail(successes, trials, probability);
        let below = binomial_upper_tail(trials - successes, trials, 1.0 - probability);
        let measured = successes as f64 / trials as f64;
        self.compare(
            what,
            (2.0 * above.min(below)).min(1.0),
            format!("expected {probability:.6}, measured {measured:.6} = {successes} of {trials}"),
        );
    }

    /// The same against a control by paths, which has to be finer, of a reading that says something: its 99 % half-width is less than a share
    /// of the light.
    ///
    /// # Panics
    /// If the control is not finer, or the reading says nothing.
    pub fn beside_control<const C: usize>(
        &mut self,
        what: impl Display,
        cell: &CellResult<C>,
        by_paths: &CellResult<C>,
        widest: f64,
    ) {
        let truth = by_paths.value[0].mean().expect("light");
        let noise = by_paths.value[0].std_error().expect("passes");
        let half = cell.half_width(0, 0.99).expect("light");
        // The half-width is 2.9 standard errors and more: the control's noise is one of them at most.
        assert!(noise < 0.35 * half, "{what}: the control is finer: {noise} {half}");
        assert!(half < widest * truth, "{what}: it says something: {half} of {truth}");
        self.reading(what, cell, 0, truth);
    }

    /// Does a reading's own interval, bias bound included, hold the truth at the suite's confidence?
    pub fn reading<const C: usize>(&mut self, what: impl Display, cell: &CellResult<C>, channel: usize, truth: f64) {
        let value = cell.value[channel].mean().unwrap_or(f64::NAN);
        let reach = |outside: f64| cell.half_width(channel, 1.0 - outside).unwrap_or(f64::NAN);
        let apart = (value - truth).abs();
        // The interval grows as less may lie outside; the p-value is where it just holds the truth.
        let (mut low, mut high) = (1e-12f64.ln(), 0.0f64);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if reach(middle.exp().min(1.0 - 1e-12)) > apart { low = middle } else { high = middle }
        }
        let p_value = if value.is_finite() { high.exp() } else { f64::NAN };
        let relative = 100.0 * (value / truth - 1.0);
        let half = reach(1e-4);
        let detail = format!("expected {truth:.6}, read {value:.6} ({relative:+.4} %) +- {half:.6} at 99.99 %");
        self.compare(what, p_value, detail);
    }

    /// Fails if any comparison is below its level (or is not a number), or if their number is not the declared one.
    pub fn decide(mut self) {
        self.decided = true;
        let level = Self::level();
        let wrong: Vec<_> = self.made.iter().filter(|c| c.p_value.is_nan() || c.p_value < level).map(report).collect();
        let least = self.made.iter().min_by(|a, b| a.p_value.total_cmp(&b.p_value)).map_or(String::new(), report);
        println!("{}: {} comparisons at level {level:.1e}; least likely: {least}", self.name, self.made.len());
        assert!(wrong.is_empty(), "{}: at level {level:.1e} these fail:\n  {}", self.name, wrong.join("\n  "));
        assert_eq!(self.made.len(), self.declared, "{}: comparisons made, and declared in SUITE", self.name);
    }
}

fn report(comparison: &Comparison) -> String {
    format!("{}: {} (p = {:.2e})", comparison.what, comparison.detail, comparison.p_value)
}

impl Drop for Family {
    /// A family that nobody judged is a test that cannot fail.
    fn drop(&mut self) {
        assert!(self.decided || std::thread::panicking(), "the family `{}` was never decided", self.name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two families of one name would share a number of comparisons.
    #[test]
    fn no_family_is_named_twice() {
        let mut names: Vec<_> = SUITE.iter().map(|(name, _)| name).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    }
}
