//! `caustics`: light read straight from the caustic map against ray optics, and against path tracing.

use photonlab_measure::{Comparison, Expected, Interval, Record, Verdict};
use photonlab_readout::Cell;
use serde::Deserialize;

use crate::reproduce::{
    caustic_flux::{Kept, ball_rings, cup_boxes},
    caustic_profile::{BesideFold, Profile},
    context::{Context, Findings},
    lamp_caustic::under,
    ray_curves::{Curve, Measured, chart, time_ratio},
    strategy::Strategy,
    table::Table,
};

/// The lamps over the ball: name in rows and radius (m).
const LAMPS: [(&str, f64); 2] = [("large-lamp", 0.1), ("small-lamp", 0.02)];
/// Half-width of the floor under them (m) and cells along it.
const FLOOR: (f64, u32) = (0.1, 50);
/// Cells that are read under a lamp, by column, all in the row beside the axis: from the middle out.
const COLUMNS: std::ops::Range<u32> = 25..49;
const STEP: usize = 2;
/// Points of a cell where the map is read under a lamp, in all passes.
const READS: u64 = 64;
/// What a ring read from the map may be off by.
const RING_TOLERANCE: f64 = 0.01;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Photons of one replicate of a scene in parallel light.
    photons: u64,
    /// Radii of the gather discs at the fold (m), falling.
    blurs: Vec<f64>,
    /// Paths per cell under a lamp.
    lamp_points: Vec<u64>,
    /// Photons under a lamp.
    lamp_photons: Vec<u64>,
    /// Largest relative half-width of a ring's flux.
    ring_precision: f64,
    /// Largest relative half-width of anything else.
    precision: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let seeds = p.seed..p.seed + p.replicates;
    let mut found = Findings { seeds: seeds.clone().collect(), ..Findings::default() };
    let rings = ball_rings(p.photons, &seeds, &mut found)?;
    let boxes = cup_boxes(p.photons, &seeds, &mut found)?;
    let profiles = p
        .blurs
        .iter()
        .map(|&blur| Profile::read(blur, p.photons, &seeds, &mut found))
        .collect::<Result<Vec<_>, _>>()?;
    let curves =
        LAMPS.into_iter().map(|lamp| under_lamp(lamp, &p, &seeds, &mut found)).collect::<anyhow::Result<Vec<_>>>()?;

    let judged = rings.iter().chain(&boxes).map(Kept::comparisons).sum::<usize>();
    let mut table = Table::new(judged + profiles.iter().map(|profile| profile.judged().count()).sum::<usize>());
    rings.iter().for_each(|ring| ring.judge(&mut table, RING_TOLERANCE, p.ring_precision));
    boxes.iter().for_each(|kept| kept.judge(&mut table, RING_TOLERANCE, p.precision));
    for (profile, place) in profiles.iter().flat_map(|profile| profile.judged().map(move |place| (profile, place))) {
        let measured = place.read.interval(table.confidence).map(|read| read.scaled(1.0 / place.blurred));
        let expected = Expected::within(1.0, Profile::PRECISION, "mean of the ray-optical irradiance over the disc");
        let label = format!("{} m from the axis, disc of {} m: reading over the law's mean", place.r, profile.blur);
        table.judge(label, expected, measured, p.precision);
    }
    found.figures.push(Kept::figure(&rings, &boxes, &table));
    found.figures.push(Profile::figure(&profiles, &table));
    let ratios: Vec<Option<Interval>> = curves.iter().map(|curves| time_ratio(curves)).collect();
    for ((id, radius), curves) in LAMPS.into_iter().zip(&curves) {
        let title = format!("Caustic of a ball lens under a lamp of radius {radius} m");
        let id = format!("{id}-error-against-time");
        found.figures.push(chart(&id, &title, "CPU seconds", p.replicates, curves, Measured::seconds));
    }
    let (mut comparisons, verdict, reason) = table.conclude(|| verdict(&rings, &profiles, &ratios));
    for ((_, radius), ratio) in LAMPS.into_iter().zip(&ratios) {
        let expected = Expected { value: 0.2, low: 0.0, high: 1.0, source: "the definition's bound".into() };
        let label = format!("CPU time of the map over path tracing's at equal error, lamp of {radius} m");
        comparisons.push(Comparison::judge(label, "1", expected, *ratio));
    }
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// Path tracing and the map read at the point, under one lamp.
fn under_lamp(
    (id, radius): (&'static str, f64),
    p: &Parameters,
    seeds: &std::ops::Range<u64>,
    found: &mut Findings,
) -> anyhow::Result<Vec<Curve>> {
    let row = |cell: &Cell| cell.cell[1] == FLOOR.1 / 2;
    let column = |cell: &Cell| COLUMNS.step_by(STEP).any(|column| column == cell.cell[0]);
    let bench = under(id, radius, FLOOR, |cell| row(cell) && column(cell))?;
    let paths: Vec<_> = p.lamp_points.iter().map(|&points| (None, points)).collect();
    let maps: Vec<_> = p.lamp_photons.iter().map(|&photons| (Some(photons), READS)).collect();
    let path = bench.curve(Strategy::PATH, &paths, seeds, found)?;
    let map = bench.curve(Strategy::FINAL_GATHER, &maps, seeds, found)?;
    Ok(vec![path, Curve { title: "caustic map, read at the point".into(), ..map }])
}

fn verdict(rings: &[Kept], profiles: &[Profile], ratios: &[Option<Interval>]) -> (Verdict, String) {
    let [Some(large), Some(small)] = ratios else {
        return (Verdict::NotMeasured, "the time at equal error could not be measured".into());
    };
    let errors = rings.iter().filter_map(Kept::read_error);
    let Some(worst) = errors.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs())) else {
        return (Verdict::NotMeasured, "no ring was read".into());
    };
    let finest = profiles.last().expect("a definition has a radius");
    let beside = BesideFold::over(finest.blur);
    let reason = format!(
        "counted photons carry the ray-optical flux, and rings read from the map are off by at most {:+.2} % ({:+.2} to {:+.2}); beside a fold the \
         reading is the mean over the gather disc: more than 5 % off up to {:.1} radii from it (radius {} m), half a radius \
         inside {:.2} times and half a radius outside {:.1} times the irradiance. At equal error it takes {:.2} ({:.2} to {:.2}) times as long as path tracing under a \
         lamp of {} m and {:.2} ({:.2} to {:.2}) under one of {} m, and parallel light no path finds at all",
        100.0 * worst.value,
        100.0 * worst.low,
        100.0 * worst.high,
        beside.reach,
        finest.blur,
        beside.half_a_radius[0],
        beside.half_a_radius[1],
        large.value,
        large.low,
        large.high,
        LAMPS[0].1,
        small.value,
        small.low,
        small.high,
        LAMPS[1].1
    );
    if small.low >= 1.0 { (Verdict::DoesNotHold, reason) } else { (Verdict::HoldsWithinLimits, reason) }
}
