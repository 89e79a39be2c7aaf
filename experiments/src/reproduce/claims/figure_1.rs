//! `figure-1`: the Cornell box by every strategy, with difference pictures.

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, ImageEntry, Point, Record, Replicates, Row, Series, SeriesKind, Verdict,
    sidak_level,
};
use photonlab_readout::{Cell, Outcome, Wanted};
use photonlab_scene::Film;
use serde::Deserialize;

use crate::{
    false_colour,
    image::Image,
    interrupt::write_whole,
    reproduce::{
        context::{Context, Findings},
        cpu_clock::{CPU_SECONDS, CpuClock},
        lab::Lab,
        strategy::Strategy,
    },
};

const SCENE: &str = include_str!("../../../scenes/cornell-box.xml");
const CHANNELS: usize = 3;
/// Family-wise confidence of all comparisons.
const FAMILY: f64 = 0.99;
/// Final gather's mean may differ from the control's by this share, as the definition says.
const MEAN_TOLERANCE: f64 = 0.01;
/// Pixels brighter than this many times the image's mean show the lamp; they and their neighbours are left out.
const LAMP: f64 = 8.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    size: u32,
    photons: u64,
    points: u64,
    control_points: u64,
    mean_precision: f64,
}

/// What the replicates of one strategy gave.
struct Tried {
    strategy: Strategy,
    rms: Replicates,
    mean: Replicates,
    seconds: Replicates,
    first: Image,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut lab = Lab::new("cornell-box.xml", SCENE, &[])?;
    lab.world.scene.sensors[0].film = Film { width: p.size, height: p.size };
    let cells = Cell::of_sensor(&lab.world.scene, 0);
    let counts = |photons: Option<u64>, samples: u64| Wanted { photons, samples: Some(samples), ..Wanted::default() };
    let control_seed = p.seed + 1_000_000;
    let control =
        lab.read::<CHANNELS>(&cells, Strategy::PATH.settings(control_seed), &counts(None, p.control_points), 0.95)?;
    let truth = picture(&control, p.size);
    let judged = without_lamp(&truth);
    let mut found =
        Findings { seeds: (p.seed..p.seed + p.replicates).chain([control_seed]).collect(), ..Findings::default() };
    let mut tried = Vec::new();
    for strategy in Strategy::ALL {
        let photons = (strategy != Strategy::PATH).then_some(p.photons);
        let (mut rms, mut mean, mut seconds) = (Replicates::new(), Replicates::new(), Replicates::new());
        let mut first = None;
        for seed in p.seed..p.seed + p.replicates {
            let clock = CpuClock::start();
            let outcome = lab.read::<CHANNELS>(&cells, strategy.settings(seed), &counts(photons, p.points), 0.95)?;
            let spent = clock.seconds();
            let image = picture(&outcome, p.size);
            let (of_rms, of_mean) = errors(&image, &truth, &judged);
            rms.push(of_rms);
            mean.push(of_mean);
            seconds.push(spent);
            found.rows.push(row(&strategy, seed, of_rms, of_mean, spent));
            first.get_or_insert(image);
        }
        let first = first.expect("a definition asks for at least one replicate");
        tried.push(Tried { strategy, rms, mean, seconds, first });
    }
    save_pictures(context, &mut found, &tried, &truth, &judged)?;
    found.figures.push(chart(&tried, p.replicates));
    conclude(context, found, &p, &tried)
}

fn conclude(context: &Context, mut found: Findings, p: &Parameters, tried: &[Tried]) -> anyhow::Result<Record> {
    let of = |strategy: Strategy| tried.iter().find(|t| t.strategy == strategy).expect("every strategy was tried");
    let (direct, gather) = (of(Strategy::NEAREST_DIRECT_VIEW), of(Strategy::FINAL_GATHER));
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, 2);
    let mean = gather.mean.interval(confidence);
    let expected = Expected::within(0.0, MEAN_TOLERANCE, "path-traced control of another seed");
    found.comparisons.push(Comparison::judge("final gather: mean over control's mean, less 1", "1", expected, mean));
    let ratios: Replicates = found.rows.iter().filter_map(|row| ratio_of_seed(&found.rows, row)).collect();
    let ratio = ratios.interval(confidence);
    let expected = Expected { value: 0.25, low: 0.0, high: 0.5, source: "the definition's bound".into() };
    found.comparisons.push(Comparison::judge("RMS error, final gather over direct view", "1", expected, ratio));
    let narrow = gather.mean.half_width(confidence).is_some_and(|half| half <= p.mean_precision);
    let holds = found.comparisons.iter().all(|comparison| comparison.holds == Some(true));
    let numbers = format!(
        "RMS error {:.1} % by the direct view, {:.1} % by final gather, {:.1} % by path tracing, in {:.1}, {:.1} and {:.1} CPU seconds",
        100.0 * direct.rms.mean().unwrap_or(0.0),
        100.0 * gather.rms.mean().unwrap_or(0.0),
        100.0 * of(Strategy::PATH).rms.mean().unwrap_or(0.0),
        direct.seconds.mean().unwrap_or(0.0),
        gather.seconds.mean().unwrap_or(0.0),
        of(Strategy::PATH).seconds.mean().unwrap_or(0.0),
    );
    let (verdict, reason) = match (narrow, holds) {
        (false, _) => {
            (Verdict::NotMeasured, format!("the budget is too short for the mean's wanted precision; {numbers}"))
        }
        (true, true) => (Verdict::Holds, format!("final gather gives the picture that path tracing gives: {numbers}")),
        (true, false) => (Verdict::DoesNotHold, numbers),
    };
    Ok(context.record(found, verdict, reason))
}

/// Final gather's RMS error over the direct view's at the seed of a final-gather row.
fn ratio_of_seed(rows: &[Row], row: &Row) -> Option<f64> {
    let is = |row: &Row, strategy: Strategy| row.get("strategy").and_then(|s| s.as_str()) == Some(strategy.id);
    if !is(row, Strategy::FINAL_GATHER) {
        return None;
    }
    let direct = rows.iter().find(|r| is(r, Strategy::NEAREST_DIRECT_VIEW) && r.get("seed") == row.get("seed"))?;
    Some(row.get("rms")?.as_f64()? / direct.get("rms")?.as_f64()?)
}

fn picture(outcome: &Outcome<CHANNELS>, size: u32) -> Image {
    let pixels = outcome.cells.iter().map(|cell| std::array::from_fn(|c| cell.value[c].mean().unwrap_or(0.0) as f32));
    Image { width: size as usize, height: size as usize, pixels: pixels.collect() }
}

/// The pixels that are judged: neither the lamp's nor their neighbours.
fn without_lamp(truth: &Image) -> Vec<bool> {
    let brightest = |pixel: &[f32; 3]| f64::from(pixel.iter().copied().fold(0.0, f32::max));
    let mean = truth.pixels.iter().map(brightest).sum::<f64>() / truth.pixels.len() as f64;
    let shows_lamp = |x: usize, y: usize| brightest(&truth.pixels[y * truth.width + x]) > LAMP * mean;
    let near = |i: usize, end: usize| i.saturating_sub(1)..(i + 2).min(end);
    (0..truth.pixels.len())
        .map(|i| {
            let (x, y) = (i % truth.width, i / truth.width);
            !near(y, truth.height).any(|y| near(x, truth.width).any(|x| shows_lamp(x, y)))
        })
        .collect()
}

/// RMS difference over the truth's mean, and the relative difference of the means.
fn errors(image: &Image, truth: &Image, judged: &[bool]) -> (f64, f64) {
    let (mut squares, mut sum, mut sum_truth, mut count) = (0.0, 0.0, 0.0, 0.0);
    for ((a, b), _) in image.pixels.iter().zip(&truth.pixels).zip(judged).filter(|(_, judged)| **judged) {
        for c in 0..CHANNELS {
            let (a, b) = (f64::from(a[c]), f64::from(b[c]));
            squares += (a - b) * (a - b);
            sum += a;
            sum_truth += b;
            count += 1.0;
        }
    }
    ((squares / count).sqrt() / (sum_truth / count), sum / sum_truth - 1.0)
}

fn save_pictures(
    context: &Context,
    found: &mut Findings,
    tried: &[Tried],
    truth: &Image,
    judged: &[bool],
) -> anyhow::Result<()> {
    let white = truth.white();
    let mean = truth.pixels.iter().map(|p| (p[0] + p[1] + p[2]) / 3.0).sum::<f32>() / truth.pixels.len() as f32;
    let mut put = |name: &str, bytes: &[u8], title: String, caption: &str| -> anyhow::Result<()> {
        let (path, relative) = context.image(name);
        write_whole(&path, bytes)?;
        found.images.push(ImageEntry { title, path: relative, caption: caption.into() });
        Ok(())
    };
    let row: Vec<&Image> = tried.iter().map(|t| &t.first).chain([truth]).collect();
    let order: Vec<_> = tried.iter().map(|t| t.strategy.title).collect();
    let caption = format!("From the left: {}, control. All exposed alike.", order.join("; "));
    put("strategies.png", &Image::side_by_side(&row, white).to_png(white)?, "Every strategy".into(), &caption)?;
    for t in tried {
        let difference = |((a, b), judged): ((&[f32; 3], &[f32; 3]), &bool)| {
            std::array::from_fn(|c| if *judged { 100.0 * (a[c] - b[c]).abs() / mean } else { 0.0 })
        };
        let pixels = t.first.pixels.iter().zip(&truth.pixels).zip(judged).map(difference).collect();
        let image = Image { width: truth.width, height: truth.height, pixels };
        let bytes = false_colour::png(&image, "%", Some(60.0))?;
        let title = format!("Difference from the control: {}", t.strategy.title);
        put(
            &format!("{}-difference.png", t.strategy.id),
            &bytes,
            title,
            "In percent of the control's mean, mean of channels; the lamp's pixels and their neighbours are left out.",
        )?;
    }
    for (name, image) in tried.iter().map(|t| (t.strategy.id, &t.first)).chain([("control", truth)]) {
        let (path, _) = context.image(&format!("{name}.exr"));
        write_whole(&path, &image.to_exr()?)?;
    }
    Ok(())
}

fn chart(tried: &[Tried], replicates: u64) -> FigureData {
    let series = tried.iter().map(|t| {
        let point = t.rms.interval(0.95).map(|rms| Point::measured(t.seconds.mean().unwrap_or(0.0), rms.scaled(100.0)));
        Series { label: t.strategy.title.into(), kind: SeriesKind::Measured, points: point.into_iter().collect() }
    });
    FigureData {
        id: "error-against-time".into(),
        title: "Cornell box: error against time of every strategy".into(),
        caption: format!("{replicates} seeds each; bars: 95 % intervals of the RMS error over seeds. {CPU_SECONDS}."),
        x: Axis::log("CPU seconds"),
        y: Axis::log("RMS error, % of the mean"),
        series: series.collect(),
    }
}

fn row(strategy: &Strategy, seed: u64, rms: f64, mean: f64, seconds: f64) -> Row {
    let mut row = Row::new();
    row.insert("strategy".into(), strategy.id.into());
    row.insert("seed".into(), seed.into());
    row.insert("rms".into(), rms.into());
    row.insert("mean_difference".into(), mean.into());
    row.insert("cpu_seconds".into(), seconds.into());
    row
}
