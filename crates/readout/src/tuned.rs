//! The radius of a direct view, from a look at its first pass.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_final_gather::Light;
use photonlab_gather::{CHECK, PhotonMap, Scratch};
use photonlab_sampling::Sight;
use photonlab_scene::{Ray, SurfacePoint};
use rayon::prelude::*;

use crate::{
    Cell, ErrorOver, Method, Session, Target,
    adaptive::Common,
    look::Look,
    maps::{DIRECT_VIEW_COUNT, SHRINK},
};

/// Points that are looked at, spread over the cells; of more cells, some.
const POINTS: usize = 4096;
/// Fewer cells than this are not looked at themselves.
pub(crate) const FEWEST_CELLS: usize = 256;
/// A photon's surface is sought from so far, over the scene's size: its place is known to some 1e-7.
const AWAY: f64 = 1e-5;
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
    /// What the light itself has of it, without its noise.
    light_squared: f64,
    photons: f64,
    reads: f64,
    astray: f64,
    cells: f64,
}

impl Seen {
    /// Of the sum of samples at some points of one cell, which is the mean of some independent balls.
    fn new<const C: usize>(sum: &Light<C>, points: f64, balls: f64) -> Self {
        let mean = sum.over(points);
        let bias = mean.bias.0.iter().sum::<f64>() / C as f64;
        Self {
            bias_squared: bias * bias,
            of_noise: mean.noise_of_bias / balls.min(points),
            variance: mean.noise / balls,
            light_squared: (mean.irradiance.0.iter().sum::<f64>() / C as f64).powi(2) - mean.noise / balls,
            photons: sum.photons,
            reads: sum.reads,
            astray: sum.astray,
            cells: 1.0,
        }
    }

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

/// Where balls are looked at.
enum Places<'c, const C: usize> {
    /// Where the cells read.
    Cells(&'c [Cell]),
    /// Where photons lie, all over the scene: few cells say little.
    Photons(Vec<(SurfacePoint, Sight<C>)>),
}

impl<const C: usize> Session<'_, C> {
    /// The radius of the first pass with which the sum over cells of the squared error of `passes` passes is least, if
    /// their radii shrink as pass^(-1/6). With one pass's variances `v / r^2` and biases `b r^p` that is where
    /// `v / (passes r^2) = p b^2 r^(2 p)`. For the nearest photons r^2 stands for their number. Both are looked at with balls of growing radii, until the bias is heard above its own noise,
    /// and taken from there. All cells have a part in it, so that it hardly depends on any one's photons.
    pub(crate) fn tuned_radius(&self, look: &Look<'_, C>, cells: &[Cell], passes: u64) -> Common {
        let first = look.maps.surface_radius;
        let places = match &look.maps.surface {
            Some(map) if cells.len() < FEWEST_CELLS => self.where_photons_lie(map),
            _ => Places::Cells(cells),
        };
        // Balls each of which tells its bias: of one radius, or of the photons that such a ball holds where photons are.
        let photons_in = |radius: f64| DIRECT_VIEW_COUNT as f64 * (radius / first).powi(2);
        let at = |radius| Look { told_of: 1, k: (photons_in(radius).round() as usize).max(2), ..*look };
        let see = |radius| self.see(&at(radius), &places, radius);
        let (mut radius, mut before, mut seen) = (first, see(0.5 * first), see(first));
        let astray = |radius| self.see(&at(radius), &Places::Cells(cells), radius).share_astray();
        for _ in 0..LOOKS {
            let photons = seen.photons / seen.reads.max(1.0);
            let may_grow = 4.0 * photons <= MOST_PHOTONS && 2.0 * radius <= self.largest_radius();
            if seen.is_loud(1.0) || !may_grow {
                break;
            }
            radius *= 2.0;
            (before, seen) = (seen, see(radius));
        }
        if seen.variance <= 0.0 {
            return Common { radius: first, photons: DIRECT_VIEW_COUNT as f64, bend_squared: 0.0 };
        }
        let power = seen.growth_since(&before);
        let squared = seen.heard().max(LEFT * seen.of_noise);
        // The check takes the bias to grow with the square.
        let bias_squared = squared * ((CHECK * CHECK - 1.0) / (CHECK.powf(power) - 1.0)).powi(2);
        let best = seen.variance / (passes as f64 * power * bias_squared);
        let room = (MOST_PHOTONS * seen.reads / seen.photons.max(1.0)).sqrt();
        let last = (radius * best.powf(0.5 / (power + 1.0)).min(room)).min(self.largest_radius().max(first));
        // The radii of cells do not shrink while passes are as many as were expected.
        let shrinks = self.settings.method != Method::Adaptive;
        let mut widest = if shrinks { last * widening(passes, power) } else { last };
        // A reading that goes astray has no error bar: of single readings none is to be lost for less noise in the others.
        if self.error_over == ErrorOver::Worst {
            let fewest = astray(0.5 * first);
            while widest > first && astray(widest) > fewest + ASTRAY {
                widest *= 0.8;
            }
        }
        let bend = squared / radius.powi(4);
        Common {
            radius: widest,
            photons: photons_in(widest),
            bend_squared: bend / seen.light_squared.max(f64::MIN_POSITIVE),
        }
    }

    /// What balls of one radius show.
    fn see(&self, look: &Look<'_, C>, places: &Places<'_, C>, radius: f64) -> Seen {
        let seen = match places {
            Places::Cells(cells) => self.see_in_cells(look, cells, radius),
            Places::Photons(points) => see_at(look, points, radius),
        };
        seen.iter().fold(Seen::default(), |sum, one| Seen {
            bias_squared: sum.bias_squared + one.bias_squared,
            of_noise: sum.of_noise + one.of_noise,
            variance: sum.variance + one.variance,
            light_squared: sum.light_squared + one.light_squared,
            photons: sum.photons + one.photons,
            reads: sum.reads + one.reads,
            astray: sum.astray + one.astray,
            cells: sum.cells + one.cells,
        })
    }

    fn see_in_cells(&self, look: &Look<'_, C>, cells: &[Cell], radius: f64) -> Vec<Seen> {
        let step = cells.len().div_ceil(POINTS).max(1);
        let points = (POINTS / cells.len().max(1)).clamp(1, look.samples as usize);
        (0..cells.len())
            .into_par_iter()
            .step_by(step)
            .map_init(Scratch::default, |scratch, number| {
                let (cell, shift) = (&cells[number], look.shift(number));
                let mut light = Light::default();
                for sample in 0..points as u64 {
                    light.add(&look.sample(cell, number, sample, &shift, radius, scratch).light);
                }
                // A cell wider than the ball has the mean of several balls, whose noise is each other's only in part.
                let balls = (self.area(cell) / (PI * radius * radius)).max(1.0);
                Seen::new(&light, points as f64, balls)
            })
            .collect()
    }

    /// Points of the scene where photons lie, spread evenly through the map.
    fn where_photons_lie(&self, map: &PhotonMap<C>) -> Places<'static, C> {
        let (low, high) = self.world.bounds();
        let away = AWAY * (high - low).length();
        let place = |index: usize| {
            let normal = DVec3::from(map.tree().payloads()[index].normal.unpack().map(f64::from));
            let at = self.world.middle() + DVec3::from(map.tree().point(index).map(f64::from));
            let hit = self.world.cast(&Ray::new(at + away * normal, -normal), None, 2.0 * away)?;
            let sight = Sight::meter(hit.facing_normal(), None);
            (hit.facing_normal().dot(normal) > 0.5).then_some((hit.point, sight))
        };
        let step = (map.len() / POINTS).max(1);
        Places::Photons((0..map.len()).step_by(step).filter_map(place).collect())
    }

    /// Square metres over which a cell's reading is a mean; zero where that is not known, or a point.
    fn area(&self, cell: &Cell) -> f64 {
        match cell.target {
            Target::Patch { shape, film, .. } => self.world.cell_area(shape, cell.cell, [film.width, film.height]),
            _ => 0.0,
        }
    }
}

/// What balls of one radius show at some points.
fn see_at<const C: usize>(look: &Look<'_, C>, points: &[(SurfacePoint, Sight<C>)], radius: f64) -> Vec<Seen> {
    let see = |scratch: &mut Scratch, (point, sight): &(SurfacePoint, Sight<C>)| {
        Seen::new(&look.read_map(point, sight, 0, (radius, 1.0), scratch), 1.0, 1.0)
    };
    points.par_iter().map_init(Scratch::default, see).collect()
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
