//! The radius of a direct view, from a look at its first pass.

use std::f64::consts::PI;

use photonlab_final_gather::Light;
use photonlab_gather::{CHECK, Scratch};
use rayon::prelude::*;

use crate::{Cell, ErrorOver, Session, Target, adaptive::Common, look::Look, maps::SHRINK};

/// Points that are looked at, spread over the cells; of more cells, some.
const POINTS: usize = 4096;
/// Looks at most, each at twice the radius.
const LOOKS: usize = 8;
/// No radius holds more photons than this on average: beyond, time grows and little is gained.
const MOST_PHOTONS: f64 = 1000.0;
/// This share of the bias's own variance stays in its square, so that flat light does not ask for a radius without end.
const LEFT: f64 = 0.05;

/// The least and greatest power of the radius with which a bias is taken to grow: at a step of light it does not grow at all, in smooth
/// light with the square.
const SLOWEST: f64 = 0.25;
const SMOOTH: f64 = 2.0;

/// By so much the share of balls that reach over edges may grow where every reading is to be certified.
const ASTRAY: f64 = 0.001;

/// Sums over the cells of one look: squares and variances in the square of the cells' unit.
#[derive(Clone, Copy, Default)]
struct Seen {
    bias_squared: f64,
    /// What of it the photons' noise makes on average.
    of_noise: f64,
    variance: f64,
    photons: f64,
    reads: f64,
    astray: f64,
    cells: f64,
}

impl Seen {
    /// Share of the balls that reach over edges.
    fn share_astray(&self) -> f64 {
        self.astray / self.reads.max(1.0)
    }

    /// The squared bias that stands above what its own noise makes.
    fn heard(&self) -> f64 {
        self.bias_squared - self.of_noise
    }

    /// True if that is a share of what can be told from chance: of few cells' squared noise the sum varies much.
    fn is_loud(&self, share: f64) -> bool {
        self.heard() >= share * (1.0 + 12.0 / self.cells.sqrt()) * self.of_noise
    }

    /// The power of the radius with which the bias has grown since a look at half of it: 2 where light is smooth, less beside folds
    /// and shadows.
    fn growth_since(&self, before: &Seen) -> f64 {
        if self.is_loud(0.2) && before.is_loud(0.2) {
            (0.5 * (self.heard() / before.heard()).log2()).clamp(SLOWEST, SMOOTH)
        } else {
            SMOOTH
        }
    }
}

/// How much wider than the best radius for all of some passes the first is to be, if they shrink as pass^(-1/6): the mean of the passes
/// then has the least squared error, for a bias that grows with a power of the radius.
fn widening(passes: u64, power: f64) -> f64 {
    let counted = passes.min(1000);
    let mean = |of: &dyn Fn(f64) -> f64| (1..=counted).map(|pass| of(pass as f64)).sum::<f64>() / counted as f64;
    let (variance, bias) = (mean(&|pass| pass.powf(2.0 * SHRINK)), mean(&|pass| pass.powf(-power * SHRINK)));
    (variance / (bias * bias)).powf(0.5 / (power + 1.0))
}

impl<const C: usize> Session<'_, C> {
    /// The radius of the first pass with which the sum over cells of the squared error of `passes` passes is least, if
    /// their radii shrink as pass^(-1/6). With one pass's variances `v / r^2` and biases `b r^p` that is where
    /// `v / (passes r^2) = p b^2 r^(2 p)`. Both are looked at with balls of growing radii, until the bias is heard above its own noise,
    /// and taken from there. All cells have a part in it, so that it hardly depends on any one's photons.
    pub(crate) fn tuned_radius(&self, look: &Look<'_, C>, cells: &[Cell], first: f64, passes: u64) -> Common {
        let nearest = self.see(look, cells, 0.5 * first);
        let (mut radius, mut before, mut seen) = (first, nearest, self.see(look, cells, first));
        let fewest_astray = nearest.share_astray();
        for _ in 0..LOOKS {
            let photons = seen.photons / seen.reads.max(1.0);
            let may_grow = 4.0 * photons <= MOST_PHOTONS && 2.0 * radius <= self.largest_radius();
            if seen.is_loud(1.0) || !may_grow {
                break;
            }
            radius *= 2.0;
            (before, seen) = (seen, self.see(look, cells, radius));
        }
        if seen.variance <= 0.0 {
            return Common { radius: first, bend_squared: 0.0 };
        }
        let power = seen.growth_since(&before);
        let squared = seen.heard().max(LEFT * seen.of_noise);
        // The check takes the bias to grow with the square.
        let bias_squared = squared * ((CHECK * CHECK - 1.0) / (CHECK.powf(power) - 1.0)).powi(2);
        let best = seen.variance / (passes as f64 * power * bias_squared);
        let room = (MOST_PHOTONS * seen.reads / seen.photons.max(1.0)).sqrt();
        let last = (radius * best.powf(0.5 / (power + 1.0)).min(room)).min(self.largest_radius().max(first));
        let mut widest = last * widening(passes, power);
        while widest > first && self.goes_astray(&self.see(look, cells, widest), fewest_astray) {
            widest *= 0.8;
        }
        Common { radius: widest, bend_squared: squared / (seen.cells * radius.powi(4)) }
    }

    /// A reading that goes astray has no error bar: of single readings none is to be lost for less noise in the others.
    fn goes_astray(&self, seen: &Seen, fewest: f64) -> bool {
        self.error_over == ErrorOver::Worst && seen.share_astray() > fewest + ASTRAY
    }

    /// What balls of one radius show.
    fn see(&self, look: &Look<'_, C>, cells: &[Cell], radius: f64) -> Seen {
        let step = cells.len().div_ceil(POINTS).max(1);
        let points = (POINTS / cells.len().max(1)).clamp(1, look.samples as usize);
        let of_cells: Vec<Seen> = (0..cells.len())
            .into_par_iter()
            .step_by(step)
            .map_init(Scratch::default, |scratch, number| {
                let (cell, shift) = (&cells[number], look.shift(number));
                let mut light = Light::default();
                for sample in 0..points as u64 {
                    light.add(&look.sample(cell, number, sample, &shift, radius, scratch).light);
                }
                let Light { photons, reads, astray, .. } = light;
                let light = light.over(points as f64);
                let bias = light.bias.0.iter().sum::<f64>() / C as f64;
                // A cell wider than the ball has the mean of several balls, whose noise is each other's only in part.
                let balls = (self.area(cell) / (PI * radius * radius)).max(1.0);
                let of_noise = light.noise_of_bias / balls.min(points as f64);
                Seen {
                    bias_squared: bias * bias,
                    of_noise,
                    variance: light.noise / balls,
                    photons,
                    reads,
                    astray,
                    cells: 1.0,
                }
            })
            .collect();
        of_cells.iter().fold(Seen::default(), |sum, one| Seen {
            bias_squared: sum.bias_squared + one.bias_squared,
            of_noise: sum.of_noise + one.of_noise,
            variance: sum.variance + one.variance,
            photons: sum.photons + one.photons,
            reads: sum.reads + one.reads,
            astray: sum.astray + one.astray,
            cells: sum.cells + one.cells,
        })
    }

    /// Square metres over which a cell's reading is a mean; zero where that is not known, or a point.
    fn area(&self, cell: &Cell) -> f64 {
        match cell.target {
            Target::Patch { shape, film, .. } => self.world.cell_area(shape, cell.cell, [film.width, film.height]),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_many_passes_is_widened_to_the_least_squared_error() {
        assert_eq!(widening(1, 2.0), 1.0);
        for (passes, power) in [(8, 2.0), (16, 0.5)] {
            // The best radius for all is 1: a variance of p / r^2 and a bias of r^p for the mean of all.
            let error = |first: f64| {
                let radii = (1..=passes).map(|pass| first * f64::from(pass).powf(-SHRINK));
                let [variance, bias] = radii.fold([0.0; 2], |[v, b], r| [v + power / (r * r), b + r.powf(power)]);
                (variance + bias * bias / f64::from(passes)) / f64::from(passes)
            };
            let best = widening(passes as u64, power);
            assert!(error(best) < error(1.01 * best) && error(best) < error(best / 1.01), "{passes} {power}: {best}");
        }
    }
}
