//! What balls of one radius show of bias and noise, by the photons of two independent passes.

use photonlab_final_gather::Light;

/// The least and greatest power of the radius with which a bias is taken to grow: at a step of light it does not grow at all, in smooth
/// light with the square.
const SLOWEST: f64 = 0.25;
const SMOOTH: f64 = 2.0;

/// The least and greatest power with which a variance is taken to fall: the mean over a cell much wider than the ball hardly depends on
/// it; independent photons give 2, evenly spread ones up to 3, where only those at the ball's edge are up to chance.
const LEAST_FALL: f64 = 0.5;
const FASTEST_FALL: f64 = 3.0;

/// Sums over the cells of one look: squares and variances in the square of the cells' unit. What two passes agree on is there; what
/// they differ in is noise. Nothing is presumed of how photons vary, which evenly spread ones do less than independent ones.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seen {
    /// Squared bias, without its noise.
    pub(crate) bias_squared: f64,
    /// Variance of one pass's bias.
    pub(crate) of_noise: f64,
    /// Variance of one pass's value.
    pub(crate) variance: f64,
    /// What independent photons would give.
    pub(crate) poisson: f64,
    /// Squared light, without its noise.
    pub(crate) light_squared: f64,
    pub(crate) photons: f64,
    pub(crate) reads: f64,
    pub(crate) astray: f64,
    pub(crate) cells: f64,
}

impl Seen {
    /// Of the sums of samples at the same points of one cell, from two passes' photons.
    pub(crate) fn new<const C: usize>(sums: &[Light<C>; 2], points: f64) -> Self {
        let of_channels = |colour: &[f64; C]| colour.iter().sum::<f64>() / C as f64;
        let [one, other] = sums.each_ref().map(|sum| sum.over(points));
        let [bias, light] =
            [[one.bias, other.bias], [one.irradiance, other.irradiance]].map(|two| two.map(|c| of_channels(&c.0)));
        Self {
            bias_squared: bias[0] * bias[1],
            of_noise: 0.5 * (bias[0] - bias[1]).powi(2),
            variance: 0.5 * (light[0] - light[1]).powi(2),
            poisson: 0.5 * (one.noise + other.noise),
            light_squared: light[0] * light[1],
            photons: sums[0].photons + sums[1].photons,
            reads: sums[0].reads + sums[1].reads,
            astray: sums[0].astray + sums[1].astray,
            cells: 1.0,
        }
    }

    pub(crate) fn add(mut self, other: &Seen) -> Self {
        self.bias_squared += other.bias_squared;
        self.of_noise += other.of_noise;
        self.variance += other.variance;
        self.poisson += other.poisson;
        self.light_squared += other.light_squared;
        self.photons += other.photons;
        self.reads += other.reads;
        self.astray += other.astray;
        self.cells += other.cells;
        self
    }

    /// Share of the balls that reach over edges.
    pub(crate) fn share_astray(&self) -> f64 {
        self.astray / self.reads.max(1.0)
    }

    /// True if the bias stands above what its noise makes by a share of that which can be told from chance: of few cells' squared noise
    /// the sum varies much.
    pub(crate) fn is_loud(&self, share: f64) -> bool {
        self.bias_squared >= share * (1.0 + 12.0 / self.cells.sqrt()) * self.of_noise
    }

    /// The power of the radius with which the bias has grown since a look at half of it: 2 where light is smooth, less beside folds
    /// and shadows.
    pub(crate) fn growth_since(&self, before: &Seen) -> f64 {
        if self.is_loud(0.2) && before.is_loud(0.2) {
            (0.5 * (self.bias_squared / before.bias_squared).log2()).clamp(SLOWEST, SMOOTH)
        } else {
            SMOOTH
        }
    }

    /// The power of the radius with which the variance has fallen since a look at half of it.
    pub(crate) fn fall_since(&self, before: &Seen) -> f64 {
        (before.variance / self.variance).log2().clamp(LEAST_FALL, FASTEST_FALL)
    }
}
