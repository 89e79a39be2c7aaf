//! The error of the direct view against the photons, over replicates.

use std::ops::Range;

use photonlab_measure::{Interval, LogLogFit, Replicates, SlopeError, fit_log_log};
use photonlab_readout::{CellResult, Wanted};

use super::{
    context::Findings,
    cpu_clock::{CpuClock, microseconds},
    picture::{Picture, Region, Spot},
    strategy::Strategy,
    table::row,
};

/// Photons of which a radius is told.
const MILLION: f64 = 1e6;
/// Photons of a pass at most, which bounds memory; enough for the points of all replicates to be few beside them, so that what none can
/// reach is left out of the map.
const PASS: u64 = 2_000_000;

/// How a picture's part is read: its radius is a function of the photons, fixed in advance.
pub(super) struct Course<'p> {
    pub(super) region: Region,
    /// One replicate each.
    pub(super) seeds: Range<u64>,
    /// Emitted in all passes of a run, ascending.
    pub(super) photons: &'p [u64],
    /// Of the gather disc with a million photons, metres.
    pub(super) radius: f64,
    /// The radius falls as photons to minus this power.
    pub(super) power: f64,
    /// Points of the picture.
    pub(super) points: usize,
    /// Runs of so many photons and more serve all replicates at once: their discs are so small that hardly two have a photon in common.
    pub(super) shared_from: u64,
}

/// What a point of a picture shows, and the variance with which that is known.
pub(super) struct Known<const C: usize> {
    pub(super) value: [f64; C],
    pub(super) variance: [f64; C],
}

/// Mean square errors of one part of a picture, relative to the squared mean of what is read.
pub(super) struct Trend {
    pub(super) region: Region,
    photons: Vec<f64>,
    /// By replicate and number of photons.
    squares: Vec<Vec<f64>>,
}

impl Course<'_> {
    /// Metres.
    pub(super) fn radius(&self, photons: f64) -> f64 {
        self.radius * (photons / MILLION).powf(-self.power)
    }

    /// Reads a picture with every seed. Each has points and truth of its own, and photons too unless they are very many, so that replicates
    /// are independent.
    pub(super) fn read<const C: usize>(
        &self,
        picture: &Picture,
        truth: impl Fn(&[Spot], u64) -> anyhow::Result<Vec<Known<C>>>,
        found: &mut Findings,
    ) -> anyhow::Result<Trend> {
        let pictures: Vec<Sampled<C>> = self
            .seeds
            .clone()
            .map(|seed| {
                let spots = picture.spots(self.region, self.points, seed);
                Ok(Sampled { seed, truth: truth(&spots, seed)?, spots })
            })
            .collect::<anyhow::Result<_>>()?;
        let mut squares = vec![Vec::new(); pictures.len()];
        for &photons in self.photons {
            let at_once = if photons >= self.shared_from { pictures.len() } else { 1 };
            for (run, sampled) in pictures.chunks(at_once).enumerate() {
                let of_each = self.read_once(picture, photons, sampled, found)?;
                squares[run * at_once..].iter_mut().zip(of_each).for_each(|(squares, square)| squares.push(square));
            }
        }
        Ok(Trend { region: self.region, photons: self.photons.iter().map(|&n| n as f64).collect(), squares })
    }

    /// The mean square errors of some replicates that share their photons.
    fn read_once<const C: usize>(
        &self,
        picture: &Picture,
        photons: u64,
        sampled: &[Sampled<C>],
        found: &mut Findings,
    ) -> anyhow::Result<Vec<f64>> {
        let radius = self.radius(photons as f64);
        let passes = photons.div_ceil(PASS);
        // One reading of each point per pass, for it is the same point every time.
        let wanted =
            Wanted { photons: Some(photons), passes: Some(passes), samples: Some(passes), ..Wanted::default() };
        let cells: Vec<_> = sampled.iter().flat_map(|of| of.spots.iter().map(|spot| spot.cell.clone())).collect();
        let clock = CpuClock::start();
        let settings = Strategy::RADIUS_DIRECT_VIEW.within(radius).settings(sampled[0].seed);
        let outcome = picture.lab.read::<C>(&cells, settings, &wanted, 0.99)?;
        let seconds = clock.seconds();
        let mut cells = &outcome.cells[..];
        let mut squares = Vec::new();
        for of in sampled {
            let [square, of_truth] = mean_squares(&of.spots, &of.truth, cells);
            cells = &cells[of.spots.len()..];
            squares.push(square);
            found.rows.push(row([
                ("scene", picture.id.into()),
                ("part", self.region.title().into()),
                ("photons", photons.into()),
                ("passes", passes.into()),
                ("radius", radius.into()),
                ("seed", of.seed.into()),
                ("seed_of_photons", sampled[0].seed.into()),
                ("squared_error", square.into()),
                ("squared_error_of_truth", of_truth.into()),
                ("cpu_seconds", microseconds(seconds / sampled.len() as f64).into()),
            ]));
        }
        Ok(squares)
    }
}

/// A replicate's points.
struct Sampled<const C: usize> {
    seed: u64,
    spots: Vec<Spot>,
    truth: Vec<Known<C>>,
}

/// Mean square error of the readings, that of the truth taken off, and the latter, relative to the truth's squared mean.
fn mean_squares<const C: usize>(spots: &[Spot], truth: &[Known<C>], cells: &[CellResult<C>]) -> [f64; 2] {
    let [mut weight, mut mean, mut square, mut of_truth] = [0.0; 4];
    for ((spot, known), read) in spots.iter().zip(truth).zip(cells) {
        for c in 0..C {
            weight += spot.weight;
            mean += spot.weight * known.value[c];
            square += spot.weight * (read.value[c].mean().unwrap_or(0.0) - known.value[c]).powi(2);
            of_truth += spot.weight * known.variance[c];
        }
    }
    [square - of_truth, of_truth].map(|sum| sum * weight / (mean * mean))
}

impl Trend {
    pub(super) fn replicates(&self) -> usize {
        self.squares.len()
    }

    /// Mean over the replicates.
    pub(super) fn square(&self, number: usize, confidence: f64) -> Option<Interval> {
        self.squares.iter().map(|of_seed| of_seed[number]).collect::<Replicates>().interval(confidence)
    }

    /// Relative RMS error at each number of photons.
    pub(super) fn rms(&self, confidence: f64) -> Vec<(f64, Interval)> {
        let root = |x: f64| x.max(0.0).sqrt();
        let at = |(number, &photons): (usize, &f64)| {
            let square = self.square(number, confidence)?;
            let rms = Interval { value: root(square.value), low: root(square.low), high: root(square.high), ..square };
            Some((photons, rms))
        };
        self.photons.iter().enumerate().filter_map(at).collect()
    }

    /// The exponent of the RMS error in the photons; the interval is that of the replicates' own exponents.
    pub(super) fn slope(&self, confidence: f64) -> Option<Interval> {
        self.of_replicates(|fit| Some(fit.slope))?.interval(confidence)
    }

    /// The photons at which the law reaches an RMS error, as their logarithm to base 10; the interval is that of the replicates' own laws.
    pub(super) fn decades(&self, rms: f64, confidence: f64) -> Option<Interval> {
        // The line's own interval is not used: one that is narrow enough at any confidence has a crossing.
        self.of_replicates(|fit| Some(fit.solve(rms, 0.1)?.value.log10()))?.interval(confidence)
    }

    /// The law through the mean errors.
    pub(super) fn law(&self) -> Result<LogLogFit, SlopeError> {
        let count = self.replicates().max(1) as f64;
        let mean = |number: usize| self.squares.iter().map(|of_seed| of_seed[number]).sum::<f64>() / count;
        fit(&self.photons, (0..self.photons.len()).map(mean))
    }

    /// `None` if the law of any replicate has no answer.
    fn of_replicates(&self, of: impl Fn(&LogLogFit) -> Option<f64>) -> Option<Replicates> {
        self.squares.iter().map(|squares| of(&fit(&self.photons, squares.iter().copied()).ok()?)).collect()
    }
}

fn fit(photons: &[f64], squares: impl Iterator<Item = f64>) -> Result<LogLogFit, SlopeError> {
    fit_log_log(photons, &squares.map(|square| square.max(0.0).sqrt()).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_of_made_up_errors_is_found() {
        let photons = vec![1e5, 1e6, 1e7];
        // RMS errors of 0.1 and 0.11 at 1e6 photons, falling as N^(-1/6).
        let squares = |at: f64| photons.iter().map(|n: &f64| at * at * (n / 1e6).powf(-1.0 / 3.0)).collect();
        let trend =
            Trend { region: Region::Whole, squares: vec![squares(0.1), squares(0.11)], photons: photons.clone() };
        let slope = trend.slope(0.95).unwrap();
        assert!((slope.value + 1.0 / 6.0).abs() < 1e-12 && slope.half_width() < 1e-9);
        let decades = trend.decades(0.01, 0.95).unwrap();
        let expected = 12.0 + 3.0 * 1.1f64.log10();
        assert!((decades.value - expected).abs() < 1e-9 && decades.half_width() > 0.1);
        assert!((trend.law().unwrap().slope + 1.0 / 6.0).abs() < 1e-12);
    }
}
