//! `illuminance-maps`: false colours and isolux lines of two surfaces, and whether the lines' bands hold.

use photonlab_measure::{
    Comparison, Expected, ImageEntry, Interval, Record, Replicates, Verdict, sidak_level, student_t_quantile,
};
use photonlab_readout::{CellResult, Outcome, Wanted};
use serde::Deserialize;

use crate::{
    cpu_clock::{CpuClock, microseconds},
    illuminance_map::IlluminanceMap,
    interrupt::write_whole,
    levels::Levels,
    reproduce::{
        context::{Context, Findings},
        map_scene::{MapScene, means},
        strategy::Strategy,
        table::row,
    },
};

/// Confidence of the maps' intervals, and of all comparisons together.
const CONFIDENCE: f64 = 0.95;
const FAMILY: f64 = 0.99;
/// Most levels on a scale.
const LEVELS: usize = 8;
/// Two scenes of two runs: a share of missed places each, of CUBE what holds and the error, of the office the mean.
const COMPARISONS: usize = 10;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Cells across CUBE's face, and rows of the office's floor.
    cube: u32,
    office: u32,
    few: Counts,
    many: Counts,
    /// Paths for each cell of the office's control.
    control_points: u64,
    /// Largest half-width of what is compared.
    precision: f64,
}

/// Of a map.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Counts {
    photons: u64,
    /// Gather rays for each cell.
    rays: u64,
}

/// How well one map does.
struct Judged {
    /// Share of the cells' intervals that hold the truth.
    held: f64,
    /// RMS error over the cells, lx, and over the RMS half-width.
    error: f64,
    error_over_width: f64,
    /// The map's mean over the truth's.
    mean: f64,
    /// Shares of the picture: on the wrong side of a line without a band, and under bands.
    missed: f64,
    banded: f64,
}

/// The maps of all seeds.
struct Tried {
    label: String,
    maps: Vec<Judged>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let control_seed = p.seed + 1_000_000;
    let scenes = [MapScene::cube(p.cube)?, MapScene::office(p.office, control_seed, p.control_points)?];
    let mut found =
        Findings { seeds: (p.seed..p.seed + p.replicates).chain([control_seed]).collect(), ..Findings::default() };
    let mut tried = Vec::new();
    for scene in &scenes {
        for (name, counts) in [("few", p.few), ("many", p.many)] {
            tried.push(try_maps(context, &p, scene, (name, counts), &mut found)?);
        }
    }
    found.comparisons = compare(&tried)?;
    let (verdict, reason) = conclude(&p, &tried, &found.comparisons);
    Ok(context.record(found, verdict, reason))
}

/// Reads a map by every seed and draws the first.
fn try_maps(
    context: &Context,
    p: &Parameters,
    scene: &MapScene,
    (name, counts): (&str, Counts),
    found: &mut Findings,
) -> anyhow::Result<Tried> {
    // The truth's scale makes maps of few and of many photons comparable.
    let truth = scene.truth.values.iter();
    let (least, most) = truth.fold((f64::INFINITY, 0.0f64), |(low, high), &lux| (low.min(lux), high.max(lux)));
    let levels = Levels::between(least, most, LEVELS);
    let wanted = Wanted { photons: Some(counts.photons), samples: Some(counts.rays), ..Wanted::default() };
    let mut maps = Vec::new();
    for seed in p.seed..p.seed + p.replicates {
        let clock = CpuClock::start();
        let settings = Strategy::FINAL_GATHER.settings(seed);
        let outcome = scene.lab.read::<1>(&scene.cells, settings, &wanted, CONFIDENCE)?;
        let seconds = clock.seconds();
        let map = IlluminanceMap { value: scene.grid(means(&outcome)), half_width: scene.grid(half_widths(&outcome)?) };
        let judged = judge(&map, scene, &levels);
        if seed == p.seed {
            draw(context, scene, (name, counts), &map, (&levels, judged.banded), found)?;
        }
        found.rows.push(row([
            ("scene", scene.id.into()),
            ("map", name.into()),
            ("seed", seed.into()),
            ("held", judged.held.into()),
            ("rms_error_lx", judged.error.into()),
            ("rms_error_over_half_width", judged.error_over_width.into()),
            ("mean_over_truth", judged.mean.into()),
            ("missed", judged.missed.into()),
            ("banded", judged.banded.into()),
            ("cpu_seconds", microseconds(seconds).into()),
        ]));
        maps.push(judged);
    }
    Ok(Tried { label: format!("{}, {name} photons", scene.title), maps })
}

/// Halves of the cells' intervals, lx.
fn half_widths(outcome: &Outcome<1>) -> anyhow::Result<Vec<f64>> {
    let degrees = outcome.cells.first().map_or(0.0, |cell| cell.value[0].degrees_of_freedom());
    anyhow::ensure!(degrees > 0.0, "one pass tells no interval: a map needs at least 2 rays for each cell");
    let t = student_t_quantile(CONFIDENCE, degrees);
    let half = |cell: &CellResult<1>| t * cell.value[0].std_error().unwrap_or(0.0) + cell.bias_bound_within(0, t);
    Ok(outcome.cells.iter().map(half).collect())
}

fn judge(map: &IlluminanceMap, scene: &MapScene, levels: &Levels) -> Judged {
    let (values, halves, truth) = (&map.value.values, &map.half_width.values, &scene.truth.values);
    let errors: Vec<f64> = values.iter().zip(truth).map(|(value, truth)| value - truth).collect();
    let rms = |numbers: &[f64]| (numbers.iter().map(|x| x * x).sum::<f64>() / numbers.len() as f64).sqrt();
    let held = errors.iter().zip(halves).filter(|(error, half)| error.abs() <= **half).count();
    Judged {
        held: held as f64 / errors.len() as f64,
        error: rms(&errors),
        error_over_width: rms(&errors) / rms(halves),
        mean: values.iter().sum::<f64>() / truth.iter().sum::<f64>(),
        missed: map.missed(levels, &scene.truth),
        banded: map.banded(levels),
    }
}

fn draw(
    context: &Context,
    scene: &MapScene,
    (name, counts): (&str, Counts),
    map: &IlluminanceMap,
    (levels, banded): (&Levels, f64),
    found: &mut Findings,
) -> anyhow::Result<()> {
    let (file, path) = context.image(&format!("{}-{name}.png", scene.id));
    write_whole(&file, &map.png(levels)?)?;
    let caption = format!(
        "{}; {} x {} cells, final gather of {} photons with {} rays for each cell. Isolux lines every {} lx; hatched, {:.0} % of the \
         picture, is where the 95 % interval holds a level: there a line may pass as well. The scale runs from {} to {} lx{}.",
        scene.surface,
        map.value.width,
        map.value.height,
        counts.photons,
        counts.rays,
        levels.text(levels.step),
        100.0 * banded,
        levels.text(levels.low()),
        levels.text(levels.high()),
        if levels.low() > 0.0 { ", not from zero" } else { "" },
    );
    found.images.push(ImageEntry { title: format!("{}, {name} photons", scene.title), path, caption });
    Ok(())
}

/// In the order of [`run`]: CUBE's maps, then the office's.
fn compare(tried: &[Tried]) -> anyhow::Result<Vec<Comparison>> {
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, COMPARISONS);
    let mut comparisons = Vec::new();
    let mut add = |tried: &Tried, what: &str, [low, value, high]: [f64; 3], source: &str, of: fn(&Judged) -> f64| {
        let expected = Expected { value, low, high, source: source.into() };
        let measured = tried.maps.iter().map(of).collect::<Replicates>().interval(confidence);
        comparisons.push(Comparison::judge(format!("{}: {what}", tried.label), "1", expected, measured));
    };
    for map in tried {
        let what = "share of the picture on the wrong side of a line without a band";
        add(map, what, [0.0, 0.05, 0.05], "95 % intervals miss one truth in twenty", |m| m.missed);
    }
    let (cube, office) = tried.split_at(tried.len() / 2);
    for map in cube {
        let source = "the interval's own promise, by the radiosity solution";
        add(map, "share of intervals that hold the truth", [0.93, 0.95, 1.0], source, |m| m.held);
        let source = "1 / 2.13 without bias, less with its bound";
        add(map, "RMS error over RMS half-width", [1.0 / 3.0, 0.469, 0.5], source, |m| m.error_over_width);
    }
    for map in office {
        add(map, "mean over path tracing's", [0.99, 1.0, 1.01], "both read the same light", |m| m.mean);
    }
    anyhow::ensure!(comparisons.len() == COMPARISONS, "the confidence was shared among the planned comparisons");
    Ok(comparisons)
}

fn conclude(p: &Parameters, tried: &[Tried], comparisons: &[Comparison]) -> (Verdict, String) {
    let mean = |map: &Tried, of: fn(&Judged) -> f64| map.maps.iter().map(of).collect::<Replicates>().mean();
    let words = tried.iter().map(|map| {
        let percent = |of| 100.0 * mean(map, of).unwrap_or(f64::NAN);
        format!(
            "{}: {:.1} % of intervals hold the truth, RMS error {:.0} lx, {:.0} % of the picture under bands and {:.2} % on the wrong side \
             of a line without one",
            map.label,
            percent(|m| m.held),
            mean(map, |m| m.error).unwrap_or(f64::NAN),
            percent(|m| m.banded),
            percent(|m| m.missed),
        )
    });
    let reason = words.collect::<Vec<_>>().join("; ");
    let is_wide = |measured: Option<Interval>| measured.is_none_or(|m| m.half_width() > p.precision);
    if comparisons.iter().any(|c| is_wide(c.measured)) {
        return (Verdict::NotMeasured, format!("{reason}; some intervals are wider than the definition asks"));
    }
    let holds = comparisons.iter().all(|c| c.holds == Some(true));
    (if holds { Verdict::Holds } else { Verdict::DoesNotHold }, reason)
}
