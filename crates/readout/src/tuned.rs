//! The radius of a direct view, from a look at two passes' photons.

use photonlab_final_gather::{Light, Spot};
use photonlab_gather::{PhotonMap, Scratch};
use rayon::prelude::*;

use crate::{
    Cell, ErrorOver, Method, Session,
    adaptive::Common,
    look::Look,
    maps::{DIRECT_VIEW_COUNT, SHRINK},
    seen::{Seen, Step},
};

/// Points that are looked at, spread over the cells; of more cells, some.
const POINTS: usize = 8192;
/// Of a cell at least, if a pass has as many: the mean over a cell that is wider than a ball is less noisy than a point of it.
const POINTS_OF_CELL: usize = 4;
/// And points whose balls are asked whether they reach over edges.
const POINTS_ASTRAY: usize = 1024;
/// Fewer cells than this are not looked at themselves.
pub(crate) const FEWEST_CELLS: usize = 256;
/// Looks at most, each at twice the radius.
const LOOKS: usize = 8;
/// No radius holds more photons than this on average: beyond, time grows and little is gained.
const MOST_PHOTONS: f64 = 1000.0;
/// This share of the bias's own variance stays in its square, so that flat light does not ask for a radius without end.
const LEFT: f64 = 0.05;

/// A radius that all cells of a picture share is wider by this than the best of plain estimates: its bias is taken off as far as its noise
/// lets it. Of meters it is not, whose error bars count the bias whole. With 1,
/// 1.2 and 1.4 a ball lens's caustic had 1.20, 1.02 and 0.93 % of error in 2.2 to 2.4 s, one with a narrow focus 2.42, 2.26 and 2.27 %;
/// all light of the first, whose shadow's edge no correction helps, 5.99 and, with 1.3, 6.33 %.
const WIDER: f64 = 1.2;

/// By so much the share of balls that reach over edges may grow where every reading is to be certified.
const ASTRAY: f64 = 0.001;

/// Where balls are looked at.
enum Places<'c, const C: usize> {
    /// Where the cells read.
    Cells(&'c [Cell]),
    /// Where photons lie, all over the scene: few cells say little.
    Photons(Vec<Spot<C>>),
}

impl<const C: usize> Session<'_, C> {
    /// The radius of the first pass with which the sum over cells of the squared error of `passes` passes is least, if
    /// their radii shrink as pass^(-1/6). With one pass's variances `v / r^q` and biases `b r^p` that is where
    /// `q v / (passes r^q) = 2 p b^2 r^(2 p)`. For the nearest photons r^2 stands for their number. Balls are made wider until the change of
    /// light is heard above its noise, and powers and sizes are taken from there. All cells have a part in it, so that it hardly depends
    /// on any one's photons.
    pub(crate) fn tuned_radius<'p>(&self, looks: &[Look<'p, C>; 2], cells: &[Cell], passes: u64) -> Common {
        let first = looks[0].maps.surface_radius;
        let places = match &looks[0].maps.surface {
            Some(map) if cells.len() < FEWEST_CELLS => self.where_photons_lie(map),
            _ => Places::Cells(cells),
        };
        // Balls of one radius, or of the photons that such a ball holds where photons are.
        let photons_in = |radius: f64| DIRECT_VIEW_COUNT as f64 * (radius / first).powi(2);
        let with = |look: Look<'p, C>, radius| {
            let k = (photons_in(radius).round() as usize).max(2);
            Look { told_of: 0, k, ..look }
        };
        let seen_by = |radius| see(&looks.map(|look| with(look, radius)), &places, radius);
        let mut radius = 0.5 * first;
        let mut seen = seen_by(radius);
        let mut wider = seen_by(2.0 * radius);
        let mut fall = seen.fall_to(&wider);
        let (mut before, mut step) = (Step::default(), seen.step_to(&wider));
        for _ in 0..LOOKS {
            let may_grow = 16.0 * seen.photons_in_ball() <= MOST_PHOTONS && 4.0 * radius <= self.largest_radius();
            if step.is_loud(1.0) || !may_grow {
                break;
            }
            radius *= 2.0;
            seen = wider;
            wider = seen_by(2.0 * radius);
            fall = seen.fall_to(&wider);
            (before, step) = (step, seen.step_to(&wider));
        }
        if before.cells == 0.0 {
            before = seen_by(0.5 * radius).step_to(&seen);
        }
        let variance = seen.variance();
        if variance <= 0.0 {
            return Common { radius: first, photons: DIRECT_VIEW_COUNT as f64, ..Common::default() };
        }
        let power = step.growth_since(&before);
        let squared = step.squared.max(LEFT * step.noise);
        let bias_squared = squared / (2f64.powf(power) - 1.0).powi(2);
        let best = fall * variance / (2.0 * passes as f64 * power * bias_squared);
        let room = (MOST_PHOTONS / seen.photons_in_ball().max(f64::MIN_POSITIVE)).sqrt();
        let by = self.wider() * best.powf(1.0 / (2.0 * power + fall));
        let last = (radius * by.min(room)).min(self.largest_radius().max(first));
        // The radii of cells do not shrink while passes are as many as were expected.
        let mut widest = match self.settings.method {
            Method::Adaptive => last,
            _ => last * widening(passes, power, fall),
        };
        // A reading that goes astray has no error bar: of single readings none is to be lost for less noise in the others.
        if self.error_over == ErrorOver::Worst {
            let astray = |radius| share_astray(&with(looks[0], radius), cells, radius);
            let fewest = astray(0.5 * first);
            while widest > first && astray(widest) > fewest + ASTRAY {
                widest *= 0.8;
            }
        }
        Common {
            radius: widest,
            photons: photons_in(widest),
            bend_squared: squared / (9.0 * radius.powi(4) * seen.light_squared().max(f64::MIN_POSITIVE)),
            is_of_cells: matches!(places, Places::Cells(_)),
            spread: seen.spread(),
        }
    }

    /// See [`WIDER`].
    fn wider(&self) -> f64 {
        let is_corrected_picture =
            matches!(self.settings.method, Method::Radius { .. }) && self.error_over == ErrorOver::Image;
        if is_corrected_picture { WIDER } else { 1.0 }
    }

    /// Points of the scene where photons lie, spread evenly through the map.
    fn where_photons_lie(&self, map: &PhotonMap<C>) -> Places<'static, C> {
        let place = |index: usize| {
            let (at, sight) = self.where_it_lies(map.tree().point(index), map.tree().payloads()[index].normal)?;
            Some(Spot { at, sight, used: 0 })
        };
        let step = (map.len() / POINTS).max(1);
        Places::Photons((0..map.len()).step_by(step).filter_map(place).collect())
    }
}

/// What balls of one radius show.
fn see<const C: usize>(looks: &[Look<'_, C>; 2], places: &Places<'_, C>, radius: f64) -> Seen {
    match places {
        Places::Cells(cells) => see_in_cells(looks, cells, radius),
        Places::Photons(points) => see_at(looks, points, radius),
    }
}

/// The same in cells: all, or some of very many.
fn see_in_cells<const C: usize>(looks: &[Look<'_, C>; 2], cells: &[Cell], radius: f64) -> Seen {
    let most = looks[0].samples as usize;
    let points = (POINTS / cells.len().max(1)).clamp(POINTS_OF_CELL.min(most), most);
    // An odd one, which goes through the columns of pictures whose width is even.
    let step = (cells.len() * points).div_ceil(POINTS).max(1) | 1;
    let sums: Vec<_> = (0..cells.len())
        .into_par_iter()
        .step_by(step)
        .map_init(Scratch::default, |scratch, number| {
            let (cell, shift) = (&cells[number], looks[0].shift(number));
            let mut see = |look: &Look<'_, C>| {
                let mut light = Light::default();
                for sample in 0..points as u64 {
                    light.add(&look.sample(cell, number, sample, &shift, radius, scratch).estimate);
                }
                light
            };
            looks.each_ref().map(&mut see)
        })
        .collect();
    Seen::new(&sums, points as f64)
}

/// The same at some points.
fn see_at<const C: usize>(looks: &[Look<'_, C>; 2], points: &[Spot<C>], radius: f64) -> Seen {
    let see =
        |scratch: &mut Scratch, spot: &Spot<C>| looks.each_ref().map(|look| look.read_map(spot, radius, 0.0, scratch));
    let found: Vec<_> = points.par_iter().map_init(Scratch::default, see).collect();
    Seen::new(&found, 1.0)
}

/// Share of the balls of one radius in cells that reach over edges.
fn share_astray<const C: usize>(look: &Look<'_, C>, cells: &[Cell], radius: f64) -> f64 {
    let points = (POINTS_ASTRAY / cells.len().max(1)).clamp(1, look.samples as usize);
    let of_cell = |scratch: &mut Scratch, (number, cell): (usize, &Cell)| {
        let (mut light, shift) = (Light::<C>::default(), look.shift(number));
        for sample in 0..points as u64 {
            light.add(&look.sample(cell, number, sample, &shift, radius, scratch).estimate);
        }
        [light.astray, light.reads]
    };
    let found: Vec<_> = cells.par_iter().enumerate().map_init(Scratch::default, of_cell).collect();
    let [astray, reads] = found.into_iter().fold([0.0; 2], |[a, r], [astray, reads]| [a + astray, r + reads]);
    astray / f64::max(reads, 1.0)
}

/// How much wider than the best radius for all of some passes the first is to be, if they shrink as pass^(-1/6): the mean of the passes
/// then has the least squared error, for a bias that grows with one power of the radius and a variance that falls with another.
fn widening(passes: u64, power: f64, fall: f64) -> f64 {
    let counted = passes.min(1000);
    let mean = |of: &dyn Fn(f64) -> f64| (1..=counted).map(|pass| of(pass as f64)).sum::<f64>() / counted as f64;
    let (variance, bias) = (mean(&|pass| pass.powf(fall * SHRINK)), mean(&|pass| pass.powf(-power * SHRINK)));
    (variance / (bias * bias)).powf(1.0 / (2.0 * power + fall))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_many_passes_is_widened_to_the_least_squared_error() {
        assert_eq!(widening(1, 2.0, 2.0), 1.0);
        for (passes, power, fall) in [(8, 2.0, 2.0), (16, 0.5, 2.0), (16, 2.0, 3.0)] {
            // The best radius for all is 1: a variance of 2 p / (q r^q) and a bias of r^p for the mean of all.
            let error = |first: f64| {
                let radii = (1..=passes).map(|pass| first * f64::from(pass).powf(-SHRINK));
                let [variance, bias] =
                    radii.fold([0.0; 2], |[v, b], r| [v + 2.0 * power / (fall * r.powf(fall)), b + r.powf(power)]);
                (variance + bias * bias / f64::from(passes)) / f64::from(passes)
            };
            let best = widening(passes as u64, power, fall);
            assert!(error(best) < error(1.01 * best) && error(best) < error(best / 1.01), "{passes} {power}: {best}");
        }
    }
}
