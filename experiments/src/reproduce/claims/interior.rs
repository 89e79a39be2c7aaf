//! `interior`: photons that reach a receiver indoors and out, and what final gather costs there.

use photonlab_measure::{Axis, Expected, FigureData, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict};
use photonlab_readout::{Method, Settings, Wanted};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    ray_curves::{Bench, Measured, chart, time_ratio},
    receivers::{Receiver, Site},
    strategy::Strategy,
    table::{Table, row},
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Photons of a count.
    counted: u64,
    /// Paths per cell.
    points: Vec<u64>,
    /// Photons of final gather, ascending.
    photons: Vec<u64>,
    /// Its rays per cell.
    gather_points: u64,
    /// Paths per cell of the control.
    control_points: u64,
    /// Largest relative half-width of a share.
    precision: f64,
}

/// What a site showed.
struct Shown {
    site: Site,
    share: Replicates,
    expected: Expected,
    time: Option<Interval>,
    /// True if final gather with most photons read its map at all. Where every ball would reach over the edge of its surface, it
    /// traces paths instead and the map is waste.
    reads_map: bool,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let control_seed = p.seed + 1_000_000;
    let seeds = p.seed..p.seed + p.replicates;
    let mut found = Findings { seeds: seeds.clone().chain([control_seed]).collect(), ..Findings::default() };
    let mut shown = Vec::new();
    for site in Site::ALL {
        let receiver = Receiver::new(site, control_seed, p.control_points)?;
        let share = shares(&receiver, &p, &seeds, &mut found)?;
        let expected = receiver.expected_share();
        let Receiver { lab, cells, truth, .. } = receiver;
        let truth = truth.into_iter().map(|truth| Some(([truth], truth))).collect();
        let bench = Bench { id: site.id(), lab, cells, truth, noise_of_truth: 0.0, border: Vec::new() };
        let paths: Vec<_> = p.points.iter().map(|&points| (None, points)).collect();
        let maps: Vec<_> = p.photons.iter().map(|&photons| (Some(photons), p.gather_points)).collect();
        let curves = [
            bench.curve(Strategy::PATH, &paths, &seeds, &mut found)?,
            bench.curve(Strategy::FINAL_GATHER, &maps, &seeds, &mut found)?,
        ];
        let title = format!("{}: error of final gather and of path tracing", site.title());
        let id = format!("{}-error-against-time", site.id());
        found.figures.push(chart(&id, &title, "CPU seconds", p.replicates, &curves, Measured::seconds));
        let reads_map = curves[1].points.last().is_some_and(|most| most.reads_map);
        shown.push(Shown { site, share, expected, time: time_ratio(&curves), reads_map });
    }
    let mut table = Table::new(shown.len());
    for s in &shown {
        let label = format!("{}: photons on the receiver over photons emitted", s.site.title());
        // Small shares are judged relative to themselves.
        let law = s.expected.value;
        let expected =
            Expected { value: 1.0, low: s.expected.low / law, high: s.expected.high / law, ..s.expected.clone() };
        let measured = s.share.interval(table.confidence).map(|share| share.scaled(1.0 / law));
        table.judge(format!("{label}, relative to E A / Phi = {law:.3e}"), expected, measured, p.precision);
    }
    found.figures.insert(0, share_figure(&shown, &table));
    found.figures.insert(1, time_figure(&shown));
    let (comparisons, verdict, reason) = table.conclude(|| verdict(&shown));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// Photons that arrive on the receiver over those emitted, by counting.
fn shares(
    receiver: &Receiver,
    p: &Parameters,
    seeds: &std::ops::Range<u64>,
    found: &mut Findings,
) -> anyhow::Result<Replicates> {
    let mut shares = Replicates::new();
    for seed in seeds.clone() {
        let settings = Settings { method: Method::Bins, ..Strategy::PATH.settings(seed) };
        let wanted = Wanted { photons: Some(p.counted), ..Wanted::default() };
        let outcome = receiver.lab.read::<1>(&receiver.cells, settings, &wanted, 0.99)?;
        let arrived: f64 = outcome.cells.iter().map(|cell| cell.photons).sum();
        let share = arrived / outcome.photons as f64;
        shares.push(share);
        found.rows.push(row([
            ("scene", receiver.site.id().into()),
            ("seed", seed.into()),
            ("emitted", outcome.photons.into()),
            ("arrived", arrived.into()),
            ("share", share.into()),
        ]));
    }
    Ok(shares)
}

fn verdict(shown: &[Shown]) -> (Verdict, String) {
    let mean = |s: &Shown| s.share.mean().unwrap_or(0.0);
    let times: Option<Vec<Interval>> = shown.iter().map(|s| s.time).collect();
    let (Some(times), [closed, aimed, scattered, field]) = (times, shown) else {
        return (Verdict::NotMeasured, "the time at equal error could not be measured in every scene".into());
    };
    let reason = format!(
        "of the emitted photons {:.1} % reach the receiver in the closed room, {:.1} % through the window if they are aimed at it and \
         {:.2} % if not, and {:.4} % in the open field; at equal error final gather takes, in this order, {} times as long as path \
         tracing{}",
        100.0 * mean(closed),
        100.0 * mean(aimed),
        100.0 * mean(scattered),
        100.0 * mean(field),
        times.iter().map(in_words).collect::<Vec<_>>().join(", "),
        without_map(shown),
    );
    let least_indoors = mean(closed).min(mean(aimed));
    let kept = least_indoors > mean(scattered).max(mean(field));
    let cheaper = times[..2].iter().all(|time| time.low < times[3].high);
    match (kept && cheaper, times[..2].iter().all(|time| time.high < 1.0)) {
        (true, true) => (Verdict::Holds, reason),
        (true, false) => (
            Verdict::HoldsWithinLimits,
            format!(
                "{reason}: indoors the map serves better than outdoors, but path tracing still reaches the same error about as soon or sooner"
            ),
        ),
        (false, _) => (Verdict::DoesNotHold, reason),
    }
}

fn in_words(time: &Interval) -> String {
    let digits = if time.value < 5.0 { 2 } else { 1 };
    format!("{:.digits$} ({:.digits$} to {:.digits$})", time.value, time.low, time.high)
}

/// Where final gather was path tracing with a map that nobody read.
fn without_map(shown: &[Shown]) -> String {
    let unread: Vec<&str> = shown.iter().filter(|s| !s.reads_map).map(|s| s.site.title()).collect();
    if unread.is_empty() {
        return String::new();
    }
    format!(
        " ({}: no map is read, since every ball would reach over the edge of its surface, and its gather rays are paths; the ratio is what the \
         unread map costs)",
        unread.join(", ")
    )
}

fn share_figure(shown: &[Shown], table: &Table) -> FigureData {
    let place = |i: usize| i as f64 + 1.0;
    let measured = |(i, s): (usize, &Shown)| Some(Point::measured(place(i), s.share.interval(table.confidence)?));
    let law = |(i, s): (usize, &Shown)| Point::new(place(i), s.expected.value);
    FigureData {
        id: "share".into(),
        title: "Photons that reach the receiver".into(),
        caption: format!(
            "Arrivals over emitted photons; one that comes twice counts twice. Closed room and window: the floor; open field: an upright \
             square metre. {}.",
            table.intervals()
        ),
        x: Axis::named("scene", shown.iter().map(|s| s.site.title())),
        y: Axis::log("arrivals per emitted photon"),
        series: vec![
            Series {
                label: "counted".into(),
                kind: SeriesKind::Measured,
                points: shown.iter().enumerate().filter_map(measured).collect(),
            },
            Series {
                label: "E A / Phi".into(),
                kind: SeriesKind::Predicted,
                points: shown.iter().enumerate().map(law).collect(),
            },
        ],
    }
}

fn time_figure(shown: &[Shown]) -> FigureData {
    let point = |(i, s): (usize, &Shown)| Some(Point::measured(i as f64 + 1.0, s.time?));
    FigureData {
        id: "time".into(),
        title: "CPU time of final gather over path tracing's at equal error".into(),
        caption: "At the error of final gather with most photons; bars: from the 99 % interval of that error.".into(),
        x: Axis::named("scene", shown.iter().map(|s| s.site.title())),
        y: Axis::log("time of final gather over path tracing's"),
        series: vec![
            Series {
                label: "measured".into(),
                kind: SeriesKind::Measured,
                points: shown.iter().enumerate().filter_map(point).collect(),
            },
            Series {
                label: "equal".into(),
                kind: SeriesKind::Reference,
                points: (0..shown.len()).map(|i| Point::new(i as f64 + 1.0, 1.0)).collect(),
            },
        ],
    }
}
