//! `catalogue`: every scene whose answer is known, against that answer.

use std::{path::Path, time::Duration};

use photonlab_gather::Estimator;
use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, Point, Record, Row, Series, SeriesKind, Verdict,
};
use photonlab_readout::{Cell, CellResult, Direct, Method, Settings, Target, Wanted};
use photonlab_reference::catalogue::{ALL, Case, Entry, Expected as Answer, Reads};
use photonlab_trace::Limits;
use serde::Deserialize;

use crate::{
    by_channels,
    reproduce::{
        context::{Context, Findings},
        lab::Lab,
    },
};

/// Confidence of every interval.
const CONFIDENCE: f64 = 0.9999;

/// Photons below which a counted reading is not judged.
const FEWEST_PHOTONS: f64 = 1000.0;
/// Share of an answer that rounding may cost in sums of millions of terms.
const ROUNDING: f64 = 1e-9;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Wall time for one scene and method at most.
    seconds: f64,
    /// Wanted half-width over the value.
    precision: f64,
    /// The same where photons are counted.
    flux_precision: f64,
}

/// A way to read a scene.
#[derive(Clone, Copy)]
struct Way {
    name: &'static str,
    method: Method,
    precision: f64,
}

/// How many readings came out how.
#[derive(Default)]
struct Tally {
    right: usize,
    wide: usize,
    wrong: Vec<String>,
    unread: Vec<String>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let ways = [
        Way { name: "counted", method: Method::Bins, precision: p.flux_precision },
        Way { name: "final gather", method: Method::FinalGather { radius: None }, precision: p.precision },
    ];
    let folder = context.folder("scenes")?;
    let (mut found, mut tally) = (Findings { seeds: vec![p.seed], ..Findings::default() }, Tally::default());
    let mut series: Vec<Series> = ways.iter().map(|way| empty(way.name)).collect();
    for (place, entry) in ALL.iter().enumerate() {
        let cases = (entry.cases)();
        for (number, case) in cases.iter().enumerate() {
            say!("       {} {}", entry.id, case.name);
            let path = folder.join(format!("{}-{number}.xml", entry.id));
            put_down(case, &path)?;
            let lab = match Lab::open(&path) {
                Ok(lab) => lab,
                Err(error) => {
                    tally.unread.push(format!("{} {} ({error})", entry.id, case.name));
                    continue;
                }
            };
            let along = place as f64 + 0.6 + 0.8 * (number as f64 + 0.5) / cases.len() as f64;
            for (way, series) in ways.iter().zip(&mut series) {
                by_channels!(
                    lab.needs.channels,
                    read(&lab, (entry, case), *way, &p, along, &mut found, &mut tally, series)
                )?;
            }
        }
    }
    found.figures.push(figure(series, ways));
    conclude(context, found, &tally)
}

/// Writes the scene and what it names to files.
fn put_down(case: &Case, path: &Path) -> anyhow::Result<()> {
    std::fs::write(path, &case.xml)?;
    for (name, text) in &case.files {
        std::fs::write(path.with_file_name(name), text)?;
    }
    Ok(())
}

#[expect(clippy::too_many_arguments, reason = "what is read, how, and where the findings go")]
fn read<const C: usize>(
    lab: &Lab,
    (entry, case): (&Entry, &Case),
    way: Way,
    p: &Parameters,
    along: f64,
    found: &mut Findings,
    tally: &mut Tally,
    series: &mut Series,
) -> anyhow::Result<()> {
    let counts = way.method == Method::Bins;
    let readable = |cell: &Cell| !counts || matches!(cell.target, Target::Patch { .. });
    let cells: Vec<Cell> = Cell::of_meters(&lab.world.scene).into_iter().filter(readable).collect();
    if cells.is_empty() {
        return Ok(());
    }
    let settings = Settings {
        method: way.method,
        direct: Direct::Sampled,
        estimator: Estimator::default(),
        gather_rays: 1,
        seed: p.seed,
        limits: Limits { max_segments: lab.world.scene.max_depth, ..Limits::default() },
    };
    let wanted = Wanted {
        target_error: Some(way.precision),
        time_limit: Some(Duration::from_secs_f64(p.seconds)),
        ..Wanted::default()
    };
    let outcome = lab.read::<C>(&cells, settings, &wanted, CONFIDENCE)?;
    for (cell, result) in cells.iter().zip(&outcome.cells) {
        let id = &lab.world.scene.sensors[cell.sensor].id;
        let answer = case.expected.iter().find(|answer| &answer.sensor == id);
        let answer = answer.ok_or_else(|| anyhow::anyhow!("{} {}: no answer for {id}", entry.id, case.name))?;
        for channel in 0..C {
            let label = format!("{} {}, {id}{}, {}", entry.id, case.name, channel_name(C, channel), way.name);
            let measured = interval(result, channel, counts);
            let truth = answer.value[channel.min(answer.value.len() - 1)];
            judge(&label, answer, truth, measured, way.precision, found, tally);
            if let Some(m) = measured.filter(|_| truth > 0.0) {
                let percent = |x: f64| 100.0 * (x / truth - 1.0);
                let shown = Interval { value: percent(m.value), low: percent(m.low), high: percent(m.high), ..m };
                series.points.push(Point::measured(along, shown));
            }
        }
    }
    Ok(())
}

fn judge(
    label: &str,
    answer: &Answer,
    truth: f64,
    measured: Option<Interval>,
    precision: f64,
    found: &mut Findings,
    tally: &mut Tally,
) {
    let unit = match answer.reads {
        Reads::Irradiance => "W/m^2",
        Reads::Radiance => "W/(m^2 sr)",
        Reads::Flux => "W",
    };
    let expected = Expected::within(truth, answer.uncertainty.max(ROUNDING * truth), "closed form or quadrature");
    let mut comparison = Comparison::judge(label, unit, expected, measured);
    match (comparison.holds, measured) {
        (Some(false), _) => tally.wrong.push(label.into()),
        (_, None) => tally.unread.push(label.into()),
        (_, Some(m)) if m.half_width() > precision * truth => {
            tally.wide += 1;
            comparison =
                comparison.with_note(format!("half-width {:.2} % of the value", 100.0 * m.half_width() / truth));
        }
        _ => tally.right += 1,
    }
    let mut row = Row::new();
    row.insert("reading".into(), label.into());
    row.insert("expected".into(), truth.into());
    row.insert("measured".into(), measured.map(|m| m.value).into());
    row.insert("half_width".into(), measured.map(|m| m.half_width()).into());
    found.rows.push(row);
    found.comparisons.push(comparison);
}

/// The reading with noise and bias bound; what found nothing has none.
fn interval<const C: usize>(result: &CellResult<C>, channel: usize, counted: bool) -> Option<Interval> {
    let value = result.value[channel].mean()?;
    let half = result.half_width(channel, CONFIDENCE)?;
    // Few counts have no normal mean: a reading that rests on them is not judged, whatever its spread says.
    let rests_on_few = counted && result.photons < FEWEST_PHOTONS;
    let judged = !result.found_nothing() && !rests_on_few;
    judged.then_some(Interval { value, low: value - half, high: value + half, confidence: CONFIDENCE })
}

fn channel_name(channels: usize, channel: usize) -> &'static str {
    if channels == 1 { "" } else { [" R", " G", " B"][channel] }
}

fn empty(name: &str) -> Series {
    Series { label: name.into(), kind: SeriesKind::Measured, points: Vec::new() }
}

fn figure(series: Vec<Series>, ways: [Way; 2]) -> FigureData {
    FigureData {
        id: "deviations".into(),
        title: "Readings of scenes with known answers".into(),
        caption: format!(
            "Each point is one meter; bars: 99.99 % intervals with bias bounds. Wanted half-widths: {} % ({}), {} % ({}).",
            100.0 * ways[0].precision,
            ways[0].name,
            100.0 * ways[1].precision,
            ways[1].name
        ),
        x: Axis::named("entry", ALL.iter().map(|entry| entry.id)),
        y: Axis::linear("measured over expected, less 1, %"),
        series: series.into_iter().filter(|series| !series.points.is_empty()).collect(),
    }
}

fn conclude(context: &Context, found: Findings, tally: &Tally) -> anyhow::Result<Record> {
    let all = tally.right + tally.wide + tally.wrong.len();
    let some = |list: &[String]| list.iter().take(8).cloned().collect::<Vec<_>>().join("; ");
    let mut reason = format!("of {all} readings {} hold the answer with the wanted half-width", tally.right);
    if tally.wide > 0 {
        reason += &format!(", {} hold it with a wider one", tally.wide);
    }
    if !tally.wrong.is_empty() {
        reason += &format!(", {} do not: {}", tally.wrong.len(), some(&tally.wrong));
    }
    if !tally.unread.is_empty() {
        reason += &format!("; {} could not be read: {}", tally.unread.len(), some(&tally.unread));
    }
    let verdict = match (tally.wrong.is_empty(), tally.wide + tally.unread.len()) {
        (false, _) => Verdict::DoesNotHold,
        (true, 0) => Verdict::Holds,
        (true, _) if 2 * tally.right >= all => Verdict::HoldsWithinLimits,
        (true, _) => Verdict::NotMeasured,
    };
    Ok(context.record(found, verdict, reason))
}
