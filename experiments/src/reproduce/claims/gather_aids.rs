//! `gather-aids`: guided rays and precomputed irradiance against plain final gather at equal time.

use photonlab_measure::{Comparison, Expected, Interval, Record, Verdict};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    controlled::{ajar, cornell_box},
    cube_face::cube_face,
    ray_curves::{Bench, Curve, Measured, chart, error_over},
    strategy::Strategy,
};

/// Pixels across and down the pictures that have a control.
const SIZE: u32 = 32;
/// The aids, in the order of the record.
const AIDS: [Strategy; 2] = [Strategy::GUIDED, Strategy::PRECOMPUTED];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Photons, and points per pixel, with an aid.
    aided: (u64, u64),
    /// The same without, at several counts whose times surround that.
    plain: Vec<(u64, u64)>,
    /// Paths per pixel of controls.
    control_points: u64,
    /// Largest relative half-width of a ratio.
    precision: f64,
}

/// The aids' ratios in one scene, in the order of [`AIDS`].
struct Shown {
    scene: &'static str,
    ratios: [Option<Interval>; 2],
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let control_seed = p.seed + 1_000_000;
    let seeds = p.seed..p.seed + p.replicates;
    let mut found = Findings { seeds: seeds.chain([control_seed]).collect(), ..Findings::default() };
    let shown = [
        show("CUBE", &cube_face()?, &p, &mut found)?,
        show("the Cornell box", &cornell_box(SIZE, control_seed, p.control_points)?, &p, &mut found)?,
        show("the room lit past a wall", &ajar(SIZE, control_seed, p.control_points)?, &p, &mut found)?,
    ];
    let (verdict, reason) = conclude(&shown, p.precision);
    Ok(context.record(found, verdict, reason))
}

fn show<const C: usize>(
    scene: &'static str,
    bench: &Bench<C>,
    p: &Parameters,
    found: &mut Findings,
) -> anyhow::Result<Shown> {
    let seeds = p.seed..p.seed + p.replicates;
    let with_photons = |&(photons, points): &(u64, u64)| (Some(photons), points);
    let plain: Vec<_> = p.plain.iter().map(with_photons).collect();
    let plain = bench.curve(Strategy::FINAL_GATHER, &plain, &seeds, found)?;
    let mut aided = Vec::new();
    for aid in AIDS {
        aided.push(bench.curve(aid, &[with_photons(&p.aided)], &seeds, found)?);
    }
    let ratio = |curve: &Curve| error_over(&plain, &curve.points[0]);
    let ratios = [ratio(&aided[0]), ratio(&aided[1])];
    for (aid, ratio) in AIDS.iter().zip(ratios) {
        let label = format!("{scene}: error of {} over that without, equal CPU time", aid.title);
        let expected = Expected { value: 1.0, low: 0.1, high: 1.5, source: "the definition's bound".into() };
        found.comparisons.push(Comparison::judge(label, "1", expected, ratio));
    }
    let id = format!("{}-error-against-time", bench.id);
    let curves = std::iter::once(&plain).chain(&aided);
    let title = format!("Final gather with and without aids: {scene}");
    found.figures.push(chart(&id, &title, "CPU seconds", p.replicates, curves, Measured::seconds));
    Ok(Shown { scene, ratios })
}

fn conclude(shown: &[Shown], precision: f64) -> (Verdict, String) {
    if shown.iter().flat_map(|scene| scene.ratios).any(|ratio| ratio.is_none()) {
        return (Verdict::NotMeasured, "the times without aids do not surround those with them".into());
    }
    let is_narrow = |ratio: &Interval| ratio.half_width() <= precision * ratio.value;
    if !shown.iter().flat_map(|scene| scene.ratios).all(|ratio| ratio.is_some_and(|ratio| is_narrow(&ratio))) {
        return (Verdict::NotMeasured, "the intervals are wider than the definition asks".into());
    }
    let ratio_of = |scene: &Shown, aid: usize| scene.ratios[aid].expect("all are there");
    let told = |aid: usize| {
        let each = shown.iter().map(|scene| {
            let ratio = ratio_of(scene, aid);
            format!("{:.2} times ({:.2} to {:.2}) in {}", ratio.value, ratio.low, ratio.high, scene.scene)
        });
        each.collect::<Vec<_>>().join(", ")
    };
    let wins = |aid: usize| shown.iter().any(|scene| ratio_of(scene, aid).high < 1.0);
    let verdict = match (wins(0), wins(1)) {
        (true, true) => Verdict::Holds,
        (false, false) => Verdict::DoesNotHold,
        _ => Verdict::HoldsWithinLimits,
    };
    let reason = format!(
        "after as many CPU seconds the error with guided rays is {} that without; with precomputed irradiance {}",
        told(0),
        told(1)
    );
    (verdict, reason)
}
