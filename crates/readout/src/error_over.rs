//! One number of all cells' errors.

use photonlab_measure::{
    Replicates, Uncertain, log_variance_error, median_of_largest, shrunken_variances, student_t_quantile,
};

use crate::{
    CellResult,
    outcome::{MISSING_AT_MOST, OF_BIAS_NOISE},
    outlook::Laws,
};

/// An image's error to come is foretold by so many cells at most: the mean of many is known by these.
const FORETOLD_BY: usize = 4096;
/// Noise below this share of the value is rounding.
const ROUNDING: f64 = 1e-9;

/// How the cells' errors make one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorOver {
    /// The worst relative half-width over cells and channels (`measure`).
    Worst,
    /// The RMS half-width over the mean (`render`).
    Image,
}

impl ErrorOver {
    /// The relative half-width of the cells' intervals; `None` below two passes or where nothing was found anywhere.
    pub(crate) fn of<const C: usize>(self, cells: &[CellResult<C>], results: usize, confidence: f64) -> Option<f64> {
        self.combine(cells, results, confidence, |cell, c, t| {
            let noise =
                cell.value[c].std_error().unwrap_or(0.0) + OF_BIAS_NOISE * cell.bias[c].std_error().unwrap_or(0.0);
            let known = cell.bias[c].mean().unwrap_or(0.0).abs()
                + MISSING_AT_MOST * cell.unresolved[c].mean().unwrap_or(0.0).abs()
                + cell.rare_bound(c)
                + cell.grain_bound(c);
            t * noise + known
        })
    }

    /// The same after more passes, by the laws of noise and bias. Of many noises that few passes
    /// found the largest is large by chance, so that the worst is that of noises drawn towards each other, with what chance makes of
    /// them at the end.
    pub(crate) fn expected<const C: usize>(
        self,
        cells: &[CellResult<C>],
        results: usize,
        confidence: f64,
        laws: &Laws,
    ) -> Option<f64> {
        let t = student_t_quantile(confidence, (laws.passes - 1) as f64);
        let noise = |cell: &CellResult<C>, c: usize| {
            t * (laws.noise(&cell.value[c]) + OF_BIAS_NOISE * laws.noise_of_bias(&cell.bias[c]))
        };
        let known = |cell: &CellResult<C>, c: usize| {
            laws.size_of_bias(&cell.bias[c])
                + MISSING_AT_MOST * laws.size_of_bias(&cell.unresolved[c])
                + laws.by_count(cell.rare_bound(c))
                + laws.by_count(cell.grain_bound(c))
        };
        if self == ErrorOver::Image {
            let some: Vec<&CellResult<C>> = spread_over(cells.len(), FORETOLD_BY).map(|index| &cells[index]).collect();
            return self.combine(&some, results, confidence, |cell, c, _| noise(cell, c) + known(cell, c));
        }
        if cells.first()?.value[0].len() < 2 {
            return None;
        }
        let each = || cells.iter().flat_map(|cell| (0..results).map(move |c| (cell, c)));
        if each().any(|(cell, _)| cell.found_nothing()) {
            return Some(f64::INFINITY);
        }
        let relative = |of: &dyn Fn(&CellResult<C>, usize) -> f64| -> Vec<f64> {
            let value = |cell: &CellResult<C>, c: usize| cell.value[c].mean().unwrap_or(0.0).abs();
            each().filter(|&(cell, c)| value(cell, c) > 0.0).map(|(cell, c)| of(cell, c) / value(cell, c)).collect()
        };
        Some(worst_to_come(&relative(&noise), &relative(&known), laws))
    }

    /// The part of it that no number of further passes of the same radius can take away: the bias, where it is
    /// significant, and what is gathered across edges.
    pub(crate) fn floor_of<const C: usize>(
        self,
        cells: &[CellResult<C>],
        results: usize,
        confidence: f64,
    ) -> Option<f64> {
        self.combine(cells, results, confidence, |cell, c, t| {
            let significant =
                |r: &Replicates| (r.mean().unwrap_or(0.0).abs() - t * r.std_error().unwrap_or(0.0)).max(0.0);
            significant(&cell.bias[c]) + significant(&cell.unresolved[c])
        })
    }

    fn combine<const C: usize>(
        self,
        cells: &[impl std::borrow::Borrow<CellResult<C>>],
        results: usize,
        confidence: f64,
        half_width: impl Fn(&CellResult<C>, usize, f64) -> f64,
    ) -> Option<f64> {
        let passes = cells.first()?.borrow().value[0].len();
        if passes < 2 {
            return None;
        }
        // One quantile serves all cells.
        let t = student_t_quantile(confidence, (passes - 1) as f64);
        let each = || cells.iter().flat_map(|cell| (0..results).map(move |c| (cell.borrow(), c)));
        let value = |cell: &CellResult<C>, c: usize| cell.value[c].mean().unwrap_or(0.0).abs();
        match self {
            ErrorOver::Image => {
                let count = (cells.len() * results) as f64;
                let squares: f64 = each().map(|(cell, c)| half_width(cell, c, t).powi(2)).sum();
                let mean = each().map(|(cell, c)| value(cell, c)).sum::<f64>() / count;
                (mean > 0.0).then(|| (squares / count).sqrt() / mean)
            }
            // A channel in which proven dark or a lamp without that colour reads zero has no relative error.
            ErrorOver::Worst => each()
                .filter(|(cell, c)| value(cell, *c) > 0.0 || cell.found_nothing())
                .map(
                    |(cell, c)| {
                        if value(cell, c) > 0.0 { half_width(cell, c, t) / value(cell, c) } else { f64::INFINITY }
                    },
                )
                .reduce(f64::max)
                .or(Some(0.0)),
        }
    }
}

/// At most so many of all, in steps of the golden section, which are in step with no rows of cells.
fn spread_over(all: usize, most: usize) -> impl Iterator<Item = usize> {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let place = move |step: usize| ((step as f64 * golden).fract() * all as f64) as usize;
    (0..all.min(most)).map(move |step| if all <= most { step } else { place(step) })
}

/// The median of the largest error to come, by noises and known parts relative to their values.
fn worst_to_come(noises: &[f64], known: &[f64], laws: &Laws) -> f64 {
    let noisy: Vec<f64> = noises.iter().filter(|noise| **noise > ROUNDING).map(|noise| noise * noise).collect();
    let (variances, unsure) = shrunken_variances(&noisy, (laws.done - 1) as f64);
    let by_chance = log_variance_error((laws.passes - 1) as f64).1;
    // A noise's logarithm has half of its variance's.
    let spread = 0.5 * (unsure + by_chance).sqrt();
    let mut variances = variances.into_iter();
    let mut median = |noise: f64| if noise > ROUNDING { variances.next().map_or(noise, f64::sqrt) } else { noise };
    let of = |(&noise, &known): (&f64, &f64)| Uncertain { known, median: median(noise), spread };
    let values: Vec<Uncertain> = noises.iter().zip(known).map(of).collect();
    median_of_largest(&values).unwrap_or(0.0)
}
