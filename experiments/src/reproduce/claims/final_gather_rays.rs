//! `final-gather-rays`: rays of final gather against paths of path tracing at equal error.

use photonlab_measure::{Comparison, Expected, Interval, Record, Verdict};
use photonlab_readout::Cell;
use photonlab_reference::cube::Cube;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    controlled::cornell_box,
    cube_field::METERS,
    lab::Lab,
    ray_curves::{Bench, CONFIDENCE, Curve, Measured, chart, path_law, paths_per_ray, time_ratio},
};

const CUBE: &str = include_str!("../../../scenes/cube.xml");
/// Pixels across and down the picture of the Cornell box.
const SIZE: u32 = 12;
/// A gather ray is expected to be worth at most this many paths.
const MOST: f64 = 10.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    points: Vec<u64>,
    photons: Vec<u64>,
    pixel_points: Vec<u64>,
    pixel_photons: Vec<u64>,
    /// Paths per pixel of the control.
    control_points: u64,
    /// Largest relative half-width of the deciding ratios.
    precision: f64,
}

/// What a scene showed.
struct Shown {
    paths_per_ray: Option<Interval>,
    time_ratio: Option<Interval>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let control_seed = p.seed + 1_000_000;
    let seeds = p.seed..p.seed + p.replicates;
    let mut found = Findings { seeds: seeds.clone().chain([control_seed]).collect(), ..Findings::default() };
    let curves = cube()?.curves(&p.points, &p.photons, seeds.clone(), &mut found)?;
    let cube = judge("CUBE", "per meter", &curves, &p, &mut found)?;
    let curves = cornell_box(SIZE, control_seed, p.control_points)?.curves(
        &p.pixel_points,
        &p.pixel_photons,
        seeds,
        &mut found,
    )?;
    let cornell_box = judge("the Cornell box", "per pixel", &curves, &p, &mut found)?;
    let (verdict, reason) = conclude(&cube, &cornell_box, p.precision);
    Ok(context.record(found, verdict, reason))
}

/// The six meters against the radiosity solution, each relative to its own truth.
fn cube() -> anyhow::Result<Bench<1>> {
    let lab = Lab::new("cube.xml", CUBE, &[])?;
    let solution = Cube::BENCHMARK.solve();
    let truth = METERS.map(|(_, [u, v])| solution.luminance(u, v));
    let cells = Cell::of_meters(&lab.world.scene);
    Ok(Bench {
        id: "cube",
        lab,
        cells,
        truth: truth.map(|l| Some(([l], l))).to_vec(),
        noise_of_truth: 0.0,
        border: Vec::new(),
    })
}

/// Comparisons and figures of one scene.
fn judge(scene: &str, each: &str, curves: &[Curve], p: &Parameters, found: &mut Findings) -> anyhow::Result<Shown> {
    let law = path_law(curves)?;
    let fewest = &curves[curves.len() - 1].points[0];
    let ratio = paths_per_ray(&law, fewest);
    let expected =
        Expected { value: 3.0, low: 1.0, high: MOST, source: "one path is about three bounces of noise".into() };
    let label = format!("{scene}: paths that replace one of {} gather rays {each}, most photons", fewest.rays);
    found.comparisons.push(Comparison::judge(label, "1", expected, ratio));
    let slope = law.slope_interval(CONFIDENCE);
    let expected = Expected::within(-0.5, 0.05, "independent paths; the lattice may do slightly better");
    let label = format!("{scene}: slope of path tracing's RMS error in paths");
    found.comparisons.push(Comparison::judge(label, "1", expected, Some(slope)));

    let title = format!("{scene}: error of final gather and of path tracing");
    let id =
        |of: &str| format!("{}-error-against-{of}", scene.trim_start_matches("the ").replace(' ', "-").to_lowercase());
    let rays = format!("rays or paths {each}");
    found.figures.push(chart(&id("rays"), &title, &rays, p.replicates, curves, |m| m.rays));
    found.figures.push(chart(&id("time"), &title, "CPU seconds", p.replicates, curves, Measured::seconds));
    Ok(Shown { paths_per_ray: ratio, time_ratio: time_ratio(curves) })
}

fn conclude(cube: &Shown, cornell_box: &Shown, precision: f64) -> (Verdict, String) {
    let narrow = |shown: &Shown| shown.paths_per_ray.filter(|r| r.half_width() <= precision * r.value);
    let (Some(a), Some(b)) = (narrow(cube), narrow(cornell_box)) else {
        return (Verdict::NotMeasured, "the intervals are wider than the definition asks".into());
    };
    let time = |shown: &Shown| shown.time_ratio.as_ref().map_or("unknown".into(), |t| format!("{:.2}", t.value));
    let reason = format!(
        "at few rays one gather ray replaces {:.1} paths ({:.1} to {:.1}) in CUBE and {:.1} ({:.1} to {:.1}) in the Cornell box, and \
         the gain ends at the photons' own noise; in CPU time at equal error, photons included, final gather takes {} and {} times as \
         long as path tracing",
        a.value,
        a.low,
        a.high,
        b.value,
        b.low,
        b.high,
        time(cube),
        time(cornell_box)
    );
    (if a.low > 1.0 && b.low > 1.0 { Verdict::HoldsWithinLimits } else { Verdict::DoesNotHold }, reason)
}
