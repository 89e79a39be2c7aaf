//! The radius of a cell, chosen from what earlier passes have found of its bias and its noise.

use photonlab_final_gather::Light;

/// A radius grows by at most this factor from one pass to the next: what reaches over an edge is to reach over by little.
const LARGEST_GROWTH: f64 = 1.5;
/// And shrinks by at most this one.
const LARGEST_SHRINKAGE: f64 = 3.0;

/// The share of what all cells show that is taken for any one: the mean of squares is ruled by the few with the most.
const OF_COMMON: f64 = 0.3;

/// The squared bias that is believed of a cell alone, over its variance: beyond three standard errors.
const HEARD: f64 = 9.0;

/// What all cells have shown: where each begins, and what it believes until it knows better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Common {
    /// Metres.
    pub(crate) radius: f64,
    /// Photons in its ball, where photons are.
    pub(crate) photons: f64,
    /// Sum over the cells of the squared bias over the radius to the fourth, over that of the squared light.
    pub(crate) bend_squared: f64,
    /// True if the cells themselves have shown it; else places all over the scene.
    pub(crate) is_of_cells: bool,
    /// Variance over that of independent photons.
    pub(crate) spread: f64,
}

impl Default for Common {
    fn default() -> Self {
        Self { radius: 0.0, photons: 0.0, bend_squared: 0.0, is_of_cells: false, spread: 1.0 }
    }
}

/// One cell's radius and what it rests on.
///
/// Where the irradiance is smooth the bias of a density estimate is `b r^2` and its variance `v / r^2`; the mean of `n` passes
/// has the least mean squared error at `r^6 = v / (2 n b^2)` (Silverman 1986, chapter 4; Kaplanyan and Dachsbacher,
/// "Adaptive progressive photon mapping", 2013, who estimate `b` by derivatives of a kernel instead of by a
/// second ball). A pass's radius depends on the photons of pilots and earlier passes alone, so that no pass is read with a radius
/// that its own photons' noise has chosen: choosing the ball that looks best favours bright ones.
///
/// What all cells have shown of `b` over their light stands in for what a cell does not know yet (empirical Bayes estimation, the
/// posterior mean of `b^2`): a cell's own `b` counts the more, the less its noise is beside what is expected of it, and beside what it
/// is itself where it stands out of its noise, as it does at the few folds and peaks that all others say nothing about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CellRadius {
    /// Metres; `None` before any photons were read, those of pilots included.
    radius: Option<f64>,
    /// Sums over passes of the weight of each, and of it times the pass's light, `b` and `v`.
    weight: f64,
    light: f64,
    bend: f64,
    noise: f64,
    /// Sum of the squared weights times the variance of each pass's `b`.
    noise_of_bend: f64,
}

impl CellRadius {
    /// The radius for the next pass, metres; `first` if none has been read, pilots included.
    pub(crate) fn get(&self, first: f64) -> f64 {
        self.radius.unwrap_or(first)
    }

    /// The share of the bias told by the next pass, read with `radius`, that is to be taken off its light.
    ///
    /// Light less the bias that the ball of twice the radius tells is an estimate of fourth order. Its noise is larger: of discs the
    /// difference has a twelfth of their variance and is bound to it by minus a quarter, so that a share `w` leaves
    /// `(1 - w)^2 B^2 + s^2 (1 + w / 2 + w^2 / 12)`, least at `w = (B^2 - s^2 / 4) / (B^2 + s^2 / 12)`, for a bias `B` and a variance `s^2` of the
    /// mean of all passes. The share goes by earlier passes alone; that of the first pass by what the two looks
    /// that tuned have shown, one of which is a picture's first pass itself; and by no less a bias than all cells show together, if they were looked at: taken off where it is large alone, at peaks, and left between them, it would move
    /// the mean over the cells, which balls of one radius keep.
    pub(crate) fn correction(&self, radius: f64, passes: u64, common: &Common) -> f64 {
        let (bend_squared, noise) = if self.weight > 0.0 {
            let light = self.light / self.weight;
            let of_all = if common.is_of_cells { common.bend_squared * light * light } else { 0.0 };
            (self.bend_squared(common).max(of_all), self.noise / (self.weight * radius * radius))
        } else {
            // Of a light of 1, if nothing of this cell is known.
            (common.bend_squared, common.spread / common.photons)
        };
        let (variance, bias_squared) = (noise / passes as f64, bend_squared * radius.powi(4));
        let share = (bias_squared - variance / 4.0) / (bias_squared + variance / 12.0);
        if share.is_finite() { share.max(0.0) } else { 0.0 }
    }

    /// Takes in the density estimates of a pass that was read with `radius`, and chooses the next for the mean of `passes`: those that are expected, or those done
    /// if they are more, so that noise and bias both go to zero.
    pub(crate) fn learn<const C: usize>(
        &mut self,
        mean: &Light<C>,
        radius: f64,
        passes: u64,
        common: &Common,
        largest: f64,
    ) {
        let next = if mean.noise > 0.0 {
            // The variance of a pass's b is proportional to v / r^6.
            let weight = radius.powi(6);
            self.weight += weight;
            self.light += weight * mean.irradiance.mean();
            self.bend += weight * mean.bias.mean() / (radius * radius);
            self.noise += weight * common.spread * mean.noise * radius * radius;
            self.noise_of_bend += (weight / (radius * radius)).powi(2) * common.spread * mean.noise_of_bias;
            let variance = self.noise / self.weight;
            (variance / (2.0 * passes as f64 * self.bend_squared(common))).powf(1.0 / 6.0)
        } else {
            // Nothing was found.
            f64::INFINITY
        };
        let within = next.clamp(radius / LARGEST_SHRINKAGE, radius * LARGEST_GROWTH);
        self.radius = Some(within.min(largest.max(radius)));
    }

    /// What is expected of the squared `b`.
    fn bend_squared(&self, common: &Common) -> f64 {
        let (light, own) = (self.light / self.weight, self.bend / self.weight);
        let noise = self.noise_of_bend / (self.weight * self.weight);
        let of_all = OF_COMMON * common.bend_squared * light * light;
        let expected = of_all + (own * own - HEARD * noise).max(0.0);
        let trust = if noise > 0.0 { 1.0 / (1.0 + noise / expected) } else { 1.0 };
        trust * trust * own * own + trust * noise
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use photonlab_photometry::Colour;

    fn found(bias: f64, noise: f64) -> Light<1> {
        Light { irradiance: Colour([1.0]), bias: Colour([bias]), noise, ..Light::default() }
    }

    /// With the true bias and variance at every radius the choice stays where the mean squared error is least.
    #[test]
    fn it_settles_where_the_mean_squared_error_is_least() {
        let (b, v, passes) = (3.0, 0.002, 20u64);
        let error = |r: f64| (b * r * r).powi(2) + v / (r * r * passes as f64);
        let mut cell = CellRadius::default();
        for _ in 0..30 {
            let r = cell.get(0.01);
            cell.learn(&found(b * r * r, v / (r * r)), r, passes, &Common::default(), 10.0);
        }
        let r = cell.get(0.01);
        assert!(error(r) < error(1.01 * r) && error(r) < error(0.99 * r), "{r}");
    }

    /// Of biases and variances in pairs, the share leaves less squared error than a little more or less of it.
    #[test]
    fn the_bias_is_taken_off_as_far_as_its_noise_lets_it() {
        let common = Common::default();
        let mut cell = CellRadius::default();
        assert_eq!(cell.correction(0.1, 10, &common), 0.0, "nothing is known of any cell");
        let (b, v, passes) = (3.0, 0.002, 20);
        for _ in 0..30 {
            cell.learn(&found(b * 0.01, v / 0.01), 0.1, passes, &common, 10.0);
        }
        for r in [0.05f64, 0.1, 0.2, 0.4] {
            let (bias, variance) = (b * r * r, v / (r * r * passes as f64));
            let error = |w: f64| ((1.0 - w) * bias).powi(2) + variance * (1.0 + w / 2.0 + w * w / 12.0);
            let w = cell.correction(r, passes, &common);
            assert!(error(w) <= error((w - 0.01).max(0.0)) && error(w) < error(w + 0.01), "{r}: {w}");
        }
    }

    /// A cell that surely shows no bias of its own loses what all cells show, if they were looked at, and not what places all over the
    /// scene show.
    #[test]
    fn no_bias_is_taken_for_less_than_that_of_all_cells() {
        let common = Common { bend_squared: 100.0, is_of_cells: true, ..Common::default() };
        let share = |common: &Common| {
            let mut cell = CellRadius::default();
            (0..9).for_each(|_| cell.learn(&found(0.0, 0.01), 0.1, 10, common, 10.0));
            cell.correction(0.1, 10, common)
        };
        assert!(share(&common) > 0.8 && share(&Common { is_of_cells: false, ..common }) < 0.5 * share(&common));
    }

    #[test]
    fn it_grows_where_nothing_is_found_and_stays_in_the_scene() {
        let mut cell = CellRadius::default();
        cell.learn(&found(0.0, 0.0), 0.1, 10, &Common::default(), 0.7);
        assert_eq!(cell.get(1.0), 0.1 * LARGEST_GROWTH);
        cell.learn(&found(0.0, 1.0), 0.6, 10, &Common::default(), 0.7);
        assert_eq!(cell.get(1.0), 0.7);
    }
}
