//! What a run found.

use photonlab_final_gather::Light;
use photonlab_measure::{Replicates, Stopped, student_t_quantile};
use photonlab_photometry::{Channels, Colour};
use photonlab_trace::Ledger;

use crate::ErrorOver;

/// A ball at the corner of a flat surface holds a quarter of its disc, so an estimate made there lacks up to three times
/// itself (catalogue B2). Narrower pieces of surface can lack more: readings that rest on such estimates for more than a
/// trifle are not certified.
pub(crate) const MISSING_AT_MOST: f64 = 3.0;

/// This share of the bias's own confidence interval is added to its size. With noise s of the value and s_b of the bias, their
/// correlation c, and a true bias far from zero, a reading is missed on one side alone, where the value's noise less the bias's
/// is beyond t (s + share s_b): 5 % of the normal distribution at 95 % need 0.84 sqrt(s^2 + s_b^2 - 2 c s s_b) of that sum. A
/// disc's check has s_b = 0.29 s and c = -0.87, one at an edge 0.87 s and -0.87: shares of 0.20 and 0.59. One of four samples tells it: where
/// four samples of a cell share no photon s_b is twice that and c half, and the shares are 0.24 and 0.56.
pub(crate) const OF_BIAS_NOISE: f64 = 0.6;

/// One cell's values over the passes.
#[derive(Clone, Debug)]
pub struct CellResult<const C: usize> {
    /// The cell's value in each pass, per channel.
    pub value: [Replicates; C],
    /// The kernel bias of a plain reading in each pass, per channel: what bounds it. Of a radius that the program chooses some of it is taken off
    /// `value` already.
    pub bias: [Replicates; C],
    /// Mean of the part gathered across an edge or onto another surface.
    pub unresolved: [Replicates; C],
    /// Photons behind the value, over all passes.
    pub photons: f64,
    /// Share of the readings of the map at the point itself whose ball reached over an edge or onto another surface, over the passes.
    /// A ball far wider than its surface reads next to nothing of what it lacks, so that [`CellResult::unresolved`] is small.
    pub astray: Replicates,
    /// True if a map was read at all.
    pub asked_photons: bool,
    /// True if every sample proved that there can be no light.
    pub dark: bool,
    /// Rays from diffuse points that met a lamp behind specular surfaces, by chance, of all [`CellResult::rays`].
    pub glints: f64,
    /// Paths from the cell.
    pub rays: f64,
    /// The most that one such ray can add to a value, per channel: the brightest lamp all around. `None` where the method or the
    /// scene knows no such light, or a lamp has no extent, which no ray meets.
    pub brightest_glint: Option<Colour<C>>,
    /// Sum over the passes of what one photon more or less would change a pass's value by, per channel, in the value's unit; zero where
    /// photons are not counted.
    pub grain: [f64; C],
}

/// Of n passes whose counts agree, one photon more or less may be due in 1 - 0.0001^(1/n) < 9.21 / n of all (as in the rule of three). It is
/// always added, for a spread that counts show in few passes is hardly known better; it falls faster than the noise.
const GRAIN: f64 = 9.21;

/// Glints, or photons, from which on their own spread says how many more there may be.
pub(crate) const ENOUGH: f64 = 30.0;
/// -ln of the probability with which a Poisson variable may exceed the bound of [`CellResult::rare_bound`]: 99 %.
const RARE: f64 = 4.6;

impl<const C: usize> Default for CellResult<C> {
    fn default() -> Self {
        let none = [Replicates::new(); C];
        Self {
            value: none,
            bias: none,
            unresolved: none,
            photons: 0.0,
            astray: Replicates::new(),
            asked_photons: false,
            dark: true,
            glints: 0.0,
            rays: 0.0,
            brightest_glint: None,
            grain: [0.0; C],
        }
    }
}

impl<const C: usize> CellResult<C> {
    /// Adds one pass: the mean over its samples and whether all were proved dark. `photons` is the number gathered.
    pub(crate) fn push(&mut self, mean: &Light<C>, photons: f64, dark: bool) {
        for channel in 0..C {
            self.value[channel].push(mean.irradiance[channel]);
            self.bias[channel].push(mean.bias[channel]);
            self.unresolved[channel].push(mean.unresolved[channel]);
        }
        self.photons += photons;
        if mean.reads > 0.0 {
            self.astray.push(mean.astray / mean.reads);
        }
        self.asked_photons |= mean.reads > 0.0;
        self.dark &= dark;
    }

    /// Takes in what one counted photon is worth in a pass.
    pub(crate) fn add_grain(&mut self, one: Colour<C>) {
        self.grain.iter_mut().zip(one.0).for_each(|(sum, value)| *sum += value.abs());
    }

    /// True if what light comes by way of specular surfaces is known by its own spread: enough photons or glints were found.
    fn knows_glints(&self) -> bool {
        self.glints >= ENOUGH || (self.asked_photons && self.photons >= ENOUGH)
    }

    /// Bound on light of a channel that comes by way of specular surfaces and that too few rays have met to show it in their
    /// spread: of `rays` of which h met a lamp, 4.6 + sqrt(9.2 h) more may have been due (Chernoff; three for h = 0 at 95 % is
    /// the rule of three), each of which brings at most the brightest lamp's radiance from all around.
    pub fn rare_bound(&self, channel: usize) -> f64 {
        match self.brightest_glint {
            Some(brightest) if self.rays > 0.0 && !self.knows_glints() => {
                (RARE + (2.0 * RARE * self.glints).sqrt()) / self.rays * brightest[channel]
            }
            _ => 0.0,
        }
    }

    /// Bound on what all passes can miss together where evenly spread photons are counted: the count of a cell that has nearly a whole
    /// number of them hardly ever varies, and then its spread says nothing of the rest.
    pub(crate) fn grain_bound(&self, channel: usize) -> f64 {
        let passes = self.value[channel].len() as f64;
        if passes > 0.0 { GRAIN * self.grain[channel] / (passes * passes) } else { 0.0 }
    }

    /// True if no light was found and darkness was not proved. A bias that balls twice as wide tell may be taken off where none of the photons
    /// that were asked for came.
    pub fn found_nothing(&self) -> bool {
        let none_came = self.asked_photons && self.photons == 0.0;
        let is_nothing = |mean: f64| mean == 0.0 || none_came && mean < 0.0;
        !self.dark && self.value.iter().all(|v| v.mean().is_none_or(is_nothing))
    }

    /// Bound on the bias of a channel at a confidence: the estimated kernel bias with as much of its own uncertainty as the reading's
    /// interval needs, three times what was gathered across edges, [`CellResult::rare_bound`], and what counts can hide that all agree.
    pub fn bias_bound(&self, channel: usize, confidence: f64) -> f64 {
        let degrees = self.bias[channel].degrees_of_freedom();
        self.bias_bound_within(channel, if degrees > 0.0 { student_t_quantile(confidence, degrees) } else { 0.0 })
    }

    /// The same from a quantile of Student's t, which one search finds for all cells of an image.
    pub fn bias_bound_within(&self, channel: usize, quantile: f64) -> f64 {
        self.lasting_bias_within(channel, quantile) + self.rare_bound(channel) + self.grain_bound(channel)
    }

    /// The part of it that more rays of the same do not mend.
    pub fn lasting_bias_within(&self, channel: usize, quantile: f64) -> f64 {
        let bias = &self.bias[channel];
        bias.mean().unwrap_or(0.0).abs()
            + OF_BIAS_NOISE * quantile * bias.std_error().unwrap_or(0.0)
            + MISSING_AT_MOST * self.unresolved[channel].mean().unwrap_or(0.0).abs()
    }

    /// Kernel bias of a channel beyond chance, as a share of the value: what two radii say of it is its leading order, good
    /// only where it is small. A caustic's peak that is narrower than the ball shows 25 % here and lacks far more.
    pub fn bend(&self, channel: usize, quantile: f64) -> f64 {
        let bias = &self.bias[channel];
        let sure = bias.mean().unwrap_or(0.0).abs() - quantile * bias.std_error().unwrap_or(0.0);
        let value = self.value[channel].mean().unwrap_or(0.0).abs();
        if value > 0.0 { sure.max(0.0) / value } else { 0.0 }
    }

    /// Half the interval's length of a channel; `None` below two passes.
    pub fn half_width(&self, channel: usize, confidence: f64) -> Option<f64> {
        Some(self.value[channel].half_width(confidence)? + self.bias_bound(channel, confidence))
    }

    /// Share of the value that was gathered across an edge or onto another surface.
    pub fn unresolved_share(&self, channel: usize) -> f64 {
        let value = self.value[channel].mean().unwrap_or(0.0).abs();
        if value == 0.0 { 0.0 } else { self.unresolved[channel].mean().unwrap_or(0.0) / value }
    }
}

/// What a run found.
#[derive(Clone, Debug)]
pub struct Outcome<const C: usize> {
    /// One per cell, in the order given.
    pub cells: Vec<CellResult<C>>,
    /// Mean over the passes; `None` if no photon was traced.
    pub ledger: Option<Ledger<C>>,
    /// Emitted paths in all.
    pub photons: u64,
    /// Passes done.
    pub passes: u64,
    /// Samples per cell in all.
    pub samples: u64,
    /// What ended the run.
    pub stopped: Stopped,
    /// True if the run ended because no number of further passes would have reached the wanted error.
    pub out_of_reach: bool,
    /// Channels that hold results, the first ones; as many as `C` but for scenes with wavelengths.
    pub results: usize,
    /// Flux of all lamps; of some pass, where wavelengths are drawn for each.
    pub lamp_flux: Colour<C>,
    /// Mean radius averaged over, metres; `None` without a fixed-radius gather.
    pub radius: Option<f64>,
    /// The channels' meaning.
    pub channels: Channels,
}

impl<const C: usize> Outcome<C> {
    /// The relative half-width of the cells' intervals; `None` below two passes or where nothing was found anywhere.
    pub fn error(&self, over: ErrorOver, confidence: f64) -> Option<f64> {
        over.of(&self.cells, self.results, confidence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is taken off where no photon came leaves less than nothing, which is no light found.
    #[test]
    fn less_than_nothing_without_a_photon_is_nothing() {
        let mut cell = CellResult::<1> { dark: false, asked_photons: true, ..CellResult::default() };
        cell.value[0].push(-0.1);
        assert!(cell.found_nothing());
        cell.photons = 3.0;
        assert!(!cell.found_nothing());
    }
}
