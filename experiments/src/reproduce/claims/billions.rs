//! `billions`: the error of a picture read directly from the map against the photons.

use std::{f64::consts::PI, ops::Range};

use photonlab_measure::{Comparison, Expected, Interval, Record, Verdict};
use photonlab_readout::Wanted;
use serde::Deserialize;

use crate::reproduce::{
    billions_chart::{Line, chart},
    context::{Context, Findings},
    cube_error::mean_square,
    cube_field::CubeField,
    photon_law::{Course, Known, Trend},
    picture::{Picture, Region, Spot},
    strategy::Strategy,
    table::Table,
};

/// Fewest photons that are "several billion".
const BILLION: f64 = 1e9;
/// As the definition says: mean square errors over CUBE's law, and decades of the photons for the target.
const LAW_TOLERANCE: f64 = 0.05;
const DECADES_TOLERANCE: f64 = 0.15;
/// Logarithms may be known this much worse than their size, over the precision of ratios.
const DECADES_PRECISION: f64 = 0.25;
/// How the radius falls where edges make the bias, and where the light is smooth.
const EDGE_POWER: f64 = 1.0 / 3.0;
const SMOOTH_POWER: f64 = 1.0 / 6.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Over the whole picture.
    replicates: u64,
    /// Of a run over the whole picture, ascending.
    photons: Vec<u64>,
    /// Of a run far from edges.
    smooth_photons: Vec<u64>,
    /// Points of a picture.
    points: usize,
    /// Photons from which on a run serves all replicates.
    shared_from: u64,
    /// Paths per point of the control.
    control_points: u64,
    /// The relative RMS error that is asked for.
    target: f64,
    /// Largest relative half-width of ratios and slopes.
    precision: f64,
    cube: Radii,
    cornell_box: Radii,
}

/// Of one scene, in metres.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Radii {
    /// With a million photons, whole picture.
    radius: f64,
    /// The same far from edges.
    smooth_radius: f64,
    /// Pictures far from edges: wide discs share photons, so that one says less, and costs less.
    smooth_replicates: u64,
    /// What counts as far.
    from_edges: f64,
}

impl Parameters {
    fn seeds(&self, replicates: u64) -> Range<u64> {
        self.seed..self.seed + replicates
    }

    /// The whole picture, and what is far from edges.
    fn courses(&self, radii: Radii) -> [Course<'_>; 2] {
        let (points, shared_from) = (self.points, self.shared_from);
        [
            Course {
                region: Region::Whole,
                seeds: self.seeds(self.replicates),
                photons: &self.photons,
                radius: radii.radius,
                power: EDGE_POWER,
                points,
                shared_from,
            },
            Course {
                region: Region::FromEdges(radii.from_edges),
                seeds: self.seeds(radii.smooth_replicates),
                photons: &self.smooth_photons,
                radius: radii.smooth_radius,
                power: SMOOTH_POWER,
                points,
                shared_from,
            },
        ]
    }
}

/// A scene's whole picture, and what of it is far from edges.
struct Scene {
    title: &'static str,
    trends: [Trend; 2],
}

/// What CUBE's solution predicts: mean square errors by number of photons, and the photons for the target.
struct Law {
    squares: Vec<(f64, f64)>,
    needed: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let most = p.replicates.max(p.cube.smooth_replicates).max(p.cornell_box.smooth_replicates);
    let mut found = Findings { seeds: p.seeds(most).collect(), ..Findings::default() };
    let field = CubeField::new();
    let laws = p.courses(p.cube).map(|course| Law::of(&field, &course, p.target));
    let scenes = [cube(&p, &field, &mut found)?, cornell_box(&p, &mut found)?];
    let mut table = Table::new(laws.iter().map(|law| law.squares.len() + 1).sum::<usize>() + 4);
    laws.iter().enumerate().for_each(|(part, law)| judge_law(&p, &scenes[0], part, law, &mut table));
    scenes.iter().for_each(|scene| judge_slopes(&p, scene, &mut table));
    for part in 0..2 {
        let lines = scenes.each_ref().map(|scene| Line { title: scene.title, trend: &scene.trends[part] });
        let law: Vec<_> = laws[part].squares.iter().copied().chain([(laws[part].needed, p.target.powi(2))]).collect();
        found.figures.push(chart(&lines, &law, p.target, &table)?);
    }
    let needed = scenes.each_ref().map(|scene| [0, 1].map(|part| scene.needed(part, &p, table.confidence)));
    let (mut comparisons, verdict, reason) = table.conclude(|| conclude(&p, &scenes, &needed));
    comparisons.extend(scenes.iter().zip(&needed).flat_map(|(scene, needed)| claimed(&p, scene, needed)));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// A face of CUBE against the solution.
fn cube(p: &Parameters, field: &CubeField, found: &mut Findings) -> anyhow::Result<Scene> {
    let picture = Picture::cube()?;
    let truth = |spots: &[Spot], _| {
        let known = |spot: &Spot| {
            let [u, v] = [spot.position.y, spot.position.z].map(|x| x / field.cube().half_edge());
            let luminance = field.illuminance(u, v) * field.cube().reflectance() / PI;
            Known { value: [luminance], variance: [0.0] }
        };
        Ok(spots.iter().map(known).collect())
    };
    let [whole, smooth] = p.courses(p.cube).map(|course| course.read(&picture, truth, found));
    Ok(Scene { title: picture.title, trends: [whole?, smooth?] })
}

/// The Cornell box against path tracing of the same points, a control of its own for each replicate.
fn cornell_box(p: &Parameters, found: &mut Findings) -> anyhow::Result<Scene> {
    let picture = Picture::cornell_box()?;
    let truth = |spots: &[Spot], seed: u64| {
        let cells: Vec<_> = spots.iter().map(|spot| spot.cell.clone()).collect();
        let wanted = Wanted { samples: Some(p.control_points), ..Wanted::default() };
        let control = picture.lab.read::<3>(&cells, Strategy::PATH.settings(seed + 1_000_000), &wanted, 0.99)?;
        let known = control.cells.iter().map(|cell| Known {
            value: cell.value.map(|value| value.mean().unwrap_or(0.0)),
            variance: cell.value.map(|value| value.std_error().unwrap_or(f64::INFINITY).powi(2)),
        });
        Ok(known.collect())
    };
    let [whole, smooth] = p.courses(p.cornell_box).map(|course| course.read(&picture, truth, found));
    Ok(Scene { title: picture.title, trends: [whole?, smooth?] })
}

impl Law {
    fn of(field: &CubeField, course: &Course<'_>, target: f64) -> Self {
        let square = |photons: f64| mean_square(field, course.region, photons, course.radius(photons));
        let squares = course.photons.iter().map(|&n| (n as f64, square(n as f64))).collect();
        let mut needed = BILLION;
        // Either power makes noise and, in leading order, bias fall as photons^(2 power - 1), so that few steps lead there.
        for _ in 0..3 {
            needed *= (square(needed) / target.powi(2)).powf(1.0 / (1.0 - 2.0 * course.power));
        }
        Self { squares, needed }
    }
}

impl Scene {
    /// Photons for the target.
    fn needed(&self, part: usize, p: &Parameters, confidence: f64) -> Option<Interval> {
        let decades = self.trends[part].decades(p.target, confidence)?;
        let photons = |decades: f64| 10f64.powf(decades);
        let (value, low, high) = (photons(decades.value), photons(decades.low), photons(decades.high));
        high.is_finite().then_some(Interval { value, low, high, confidence })
    }

    fn label(&self, part: usize) -> String {
        format!("{}, {}", self.title, self.trends[part].region.title())
    }
}

/// CUBE's errors and their extrapolation against the law.
fn judge_law(p: &Parameters, cube: &Scene, part: usize, law: &Law, table: &mut Table) {
    let (trend, label) = (&cube.trends[part], cube.label(part));
    for (number, &(photons, square)) in law.squares.iter().enumerate() {
        let measured = trend.square(number, table.confidence).map(|measured| measured.scaled(1.0 / square));
        let expected = Expected::within(1.0, LAW_TOLERANCE, "area law over the radiosity field, Poisson noise");
        let label = format!("{label}, {photons:.0} photons: mean square error over the law's");
        table.judge(label, expected, measured, p.precision);
    }
    let expected = Expected::within(law.needed.log10(), DECADES_TOLERANCE, "the same law at more photons");
    let label = format!("{label}: photons for {} %, logarithm to base 10", 100.0 * p.target);
    table.judge(label, expected, trend.decades(p.target, table.confidence), DECADES_PRECISION * p.precision);
}

fn judge_slopes(p: &Parameters, scene: &Scene, table: &mut Table) {
    for (part, slope, tolerance, source) in [
        (0, -1.0 / 6.0, 0.02, "uncorrected edges, mean square as N^(-1/3) (catalogue H5)"),
        (1, -1.0 / 3.0, 0.04, "smooth light, mean square as N^(-2/3) (catalogue H1)"),
    ] {
        let label = format!("{}: exponent of the RMS error in the photons", scene.label(part));
        let measured = scene.trends[part].slope(table.confidence);
        table.judge(label, Expected::within(slope, tolerance, source), measured, p.precision);
    }
}

/// The paper's words against the photons for the target: of the whole picture, and far from edges.
fn claimed(p: &Parameters, scene: &Scene, needed: &[Option<Interval>; 2]) -> [Comparison; 2] {
    let most = BILLION * BILLION;
    let several = Expected { value: 3.0 * BILLION, low: BILLION, high: most, source: "several billion or more".into() };
    let fewer = Expected { value: 0.0, low: 0.0, high: BILLION, source: "without edges nothing asks for more".into() };
    let compare = |(part, expected)| {
        let label = format!("{}: photons for {} %", scene.label(part), 100.0 * p.target);
        Comparison::judge(label, "1", expected, needed[part])
    };
    [(0, several), (1, fewer)].map(compare)
}

fn conclude(p: &Parameters, scenes: &[Scene; 2], needed: &[[Option<Interval>; 2]; 2]) -> (Verdict, String) {
    let [[Some(cube), Some(smooth_cube)], [Some(cornell_box), Some(smooth_box)]] = needed else {
        return (Verdict::NotMeasured, "the error does not fall with the photons in every replicate".into());
    };
    let count = |i: &Interval| format!("{:.1e} ({:.1e} to {:.1e})", i.value, i.low, i.high);
    let slope = |scene: &Scene| scene.trends[0].slope(cube.confidence).map_or(f64::NAN, |slope| slope.value);
    let reason = format!(
        "read directly, an RMS error of {} % over the whole picture takes {} photons in CUBE and {} in the Cornell box, by laws that fall as \
         N^{:.3} and N^{:.3}, measured up to {:.0e} photons in passes of one radius: the dark strips along edges make it so. Farther from edges \
         than {} and {} m it takes {} and {}",
        100.0 * p.target,
        count(cube),
        count(cornell_box),
        slope(&scenes[0]),
        slope(&scenes[1]),
        p.photons.last().copied().unwrap_or(0) as f64,
        p.cube.from_edges,
        p.cornell_box.from_edges,
        count(smooth_cube),
        count(smooth_box)
    );
    let all = |ok: &dyn Fn(&Interval) -> bool, of: &[&Interval]| of.iter().all(|i| ok(i));
    let verdict = if !all(&|i| i.high >= BILLION, &[cube, cornell_box]) {
        Verdict::DoesNotHold
    } else if !all(&|i| i.low >= BILLION, &[cube, cornell_box]) {
        Verdict::NotMeasured
    } else if all(&|i| i.low >= BILLION, &[smooth_cube, smooth_box]) {
        Verdict::Holds
    } else {
        Verdict::HoldsWithinLimits
    };
    (verdict, reason)
}
