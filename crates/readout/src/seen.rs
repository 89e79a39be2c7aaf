//! What balls of one radius show of light and noise, by the photons of two independent passes.

use photonlab_final_gather::Light;

/// The least and greatest power of the radius with which a bias is taken to grow: summed over cells beside a step of light its square
/// grows with the width of the blurred strip, in smooth light with the fourth power.
const SLOWEST: f64 = 0.5;
const SMOOTH: f64 = 2.0;

/// The least and greatest power with which a variance is taken to fall: the mean over a cell much wider than the ball hardly depends on
/// it; independent photons give 2, evenly spread ones up to 3, where only those at the ball's edge are up to chance.
const LEAST_FALL: f64 = 0.5;
const FASTEST_FALL: f64 = 3.0;

/// Cells read with balls of one radius. What two passes agree on is there; what they differ in is noise: nothing is presumed of how
/// photons vary, which evenly spread ones do less than independent ones.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    /// Each cell's light in the two passes, mean over the channels, in the cells' unit.
    light: Vec<[f64; 2]>,
    /// Sum over the cells of one pass's variance if photons were independent.
    poisson: f64,
    photons: f64,
    reads: f64,
}

impl Seen {
    /// Of the sums of density estimates at the same points of each cell.
    pub(crate) fn new<const C: usize>(sums: &[[Light<C>; 2]], points: f64) -> Self {
        let mut seen = Self::default();
        for pair in sums {
            let means = pair.each_ref().map(|sum| sum.over(points));
            seen.light.push(means.each_ref().map(|mean| mean.irradiance.mean()));
            seen.poisson += 0.5 * (means[0].noise + means[1].noise);
            seen.photons += pair[0].photons + pair[1].photons;
            seen.reads += pair[0].reads + pair[1].reads;
        }
        seen
    }

    /// Photons of a ball, on average.
    pub(crate) fn photons_in_ball(&self) -> f64 {
        self.photons / self.reads.max(1.0)
    }

    /// Sum over the cells of one pass's variance.
    pub(crate) fn variance(&self) -> f64 {
        self.light.iter().map(|[one, other]| 0.5 * (one - other).powi(2)).sum()
    }

    /// Sum over the cells of the squared light, without its noise.
    pub(crate) fn light_squared(&self) -> f64 {
        self.light.iter().map(|[one, other]| one * other).sum()
    }

    /// Variance over that of independent photons.
    pub(crate) fn spread(&self) -> f64 {
        if self.poisson > 0.0 { (self.variance() / self.poisson).min(1.0) } else { 1.0 }
    }

    /// The power of the radius with which the variance falls to that of balls twice as wide.
    pub(crate) fn fall_to(&self, wider: &Seen) -> f64 {
        (self.variance() / wider.variance()).log2().clamp(LEAST_FALL, FASTEST_FALL)
    }

    /// What the light changes by where balls become twice as wide.
    pub(crate) fn step_to(&self, wider: &Seen) -> Step {
        let mut step = Step { cells: self.light.len() as f64, ..Step::default() };
        for (narrow, wide) in self.light.iter().zip(&wider.light) {
            let [one, other] = [wide[0] - narrow[0], wide[1] - narrow[1]];
            step.squared += one * other;
            step.noise += 0.5 * (one - other).powi(2);
        }
        step
    }
}

/// Sums over the cells of a change of light.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Step {
    /// Squared, without its noise.
    pub(crate) squared: f64,
    /// Variance of one pass's.
    pub(crate) noise: f64,
    pub(crate) cells: f64,
}

impl Step {
    /// True if it stands above its noise by a share of what can be told from chance: of few cells' squared noise the sum varies much.
    pub(crate) fn is_loud(&self, share: f64) -> bool {
        self.cells > 0.0 && self.squared >= share * (1.0 + 12.0 / self.cells.sqrt()) * self.noise
    }

    /// The power of the radius with which the bias has grown since the step before: 2 where light is smooth, less beside folds and
    /// shadows.
    pub(crate) fn growth_since(&self, before: &Step) -> f64 {
        if self.is_loud(0.2) && before.is_loud(0.2) {
            (0.5 * (self.squared / before.squared).log2()).clamp(SLOWEST, SMOOTH)
        } else {
            SMOOTH
        }
    }
}
