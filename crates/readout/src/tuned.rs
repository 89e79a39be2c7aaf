//! The radius of a direct view, from a look at its first pass.

use std::f64::consts::PI;

use photonlab_final_gather::Light;
use photonlab_gather::Scratch;
use rayon::prelude::*;

use crate::{
    Cell, ErrorOver, Session, Target,
    adaptive::{Common, NOISE_OF_BIAS},
    look::Look,
};

/// Points that are looked at, spread over the cells; of more cells, some.
const POINTS: usize = 4096;
/// Looks at most, and the change of radius below which another would not pay.
const LOOKS: usize = 8;
const SETTLED: f64 = 0.1;
/// The radius shrinks or grows by at most these factors from one look to the next.
const SHRINKS: f64 = 0.5;
const GROWS: f64 = 2.0;
/// This share of the bias's own variance stays in its square, so that flat light does not ask for a radius without end; and no
/// radius holds more photons than this on average, beyond which time grows and little is gained.
const LEFT: f64 = 0.05;
const MOST_PHOTONS: f64 = 1000.0;

/// By so much the share of balls that reach over edges may grow where every reading is to be certified.
const ASTRAY: f64 = 0.001;

/// Sums over the cells.
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

impl<const C: usize> Session<'_, C> {
    /// The radius of the first pass with which the sum over cells of the squared error is least, if passes' radii then shrink
    /// as pass^(-1/6): where one pass's biases are `b r^2` and its variances `v / r^2`, `r^6 = sum v / (2 sum b^2)` (as for a cell
    /// of its own, see [`CellRadius`](crate::adaptive::CellRadius)). Found from a first radius by looking at what biases and variances
    /// the balls of each radius show. All cells have a part in it, so that it hardly depends on any one's photons.
    pub(crate) fn tuned_radius(&self, look: &Look<'_, C>, cells: &[Cell], first: f64) -> Common {
        let mut common = Common { radius: first, bend_squared: 0.0 };
        let (mut before, mut fewest_astray) = (common, 1.0);
        for _ in 0..LOOKS {
            let radius = common.radius;
            let seen = self.see(look, cells, radius);
            if seen.variance <= 0.0 {
                break;
            }
            // A reading that goes astray has no error bar: of single readings none is to be lost for less noise in the others.
            let astray = seen.astray / seen.reads.max(1.0);
            if self.error_over == ErrorOver::Worst && astray > fewest_astray + ASTRAY {
                return before;
            }
            (before, fewest_astray) = (common, fewest_astray.min(astray));
            let bias_squared = (seen.bias_squared - seen.of_noise).max(LEFT * seen.of_noise);
            let change = (seen.variance / (2.0 * bias_squared)).powf(1.0 / 6.0);
            let room = (MOST_PHOTONS * seen.reads / seen.photons.max(1.0)).sqrt().max(1.0);
            let next = radius * change.clamp(SHRINKS, GROWS.min(room));
            common.bend_squared = bias_squared / (seen.cells * radius.powi(4));
            common.radius = next.min(self.largest_radius().max(first));
            if (next / radius - 1.0).abs() < SETTLED {
                break;
            }
        }
        common
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
                let of_noise = NOISE_OF_BIAS * light.noise / balls.min(points as f64);
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
