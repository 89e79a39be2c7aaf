//! What methods need for which error, over scenes.

use std::collections::BTreeMap;

use photonlab_measure::{Axis, Expected, FigureData, Interval, Point, Replicates, Row, Series, SeriesKind};

use super::{
    cpu_clock::{CPU_SECONDS, microseconds},
    hindsight::{seconds_to, within},
    peers::Peer,
    table::{Table, row},
};
use crate::{ladder::Ladder, system};

/// The error whose times are compared.
const ERROR: f64 = 0.01;
/// What one method everywhere costs at least, over the best of each scene.
const ONE_METHOD: f64 = 1.2;
/// What a half-width costs at most, over an error of that size.
const CERTAINTY: f64 = 3.0;
/// Fewest scenes that tell of a method.
const FEWEST: u64 = 5;
/// Times beyond so many times that of the longest run are not told.
const FARTHEST: f64 = 10.0;
/// Largest half-width of a logarithm of ratios that says something.
const PRECISION: f64 = 0.5;

/// What a run found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// The largest error of the readings, relative to the answer.
    pub(super) error: f64,
    /// The largest half-width, relative to the reading.
    pub(super) half_width: f64,
}

/// One scene by all methods that read it.
pub(super) struct SceneSpeeds {
    pub(super) name: String,
    pub(super) ladders: Vec<Ladder<Found>>,
    pub(super) peer: Option<Peer>,
}

/// Seconds to 1 % of a method, error and half-width.
struct Times {
    error: f64,
    half_width: Option<f64>,
}

impl SceneSpeeds {
    pub(super) fn rows(&self) -> Vec<Row> {
        let own = self.ladders.iter().flat_map(|ladder| {
            ladder.rungs.iter().map(|rung| {
                let found = || rung.runs.iter().map(|run| run.as_ref());
                row([
                    ("scene", self.name.as_str().into()),
                    ("method", ladder.candidate.title().into()),
                    ("cpu_seconds", microseconds(rung.seconds).into()),
                    ("error_of_95_percent", finite(within(found().map(|run| Some(run?.error))))),
                    ("half_width_of_95_percent", finite(within(found().map(|run| Some(run?.half_width))))),
                ])
            })
        });
        let peer = self.peer.iter().flat_map(|peer| {
            peer.levels.iter().map(|level| {
                row([
                    ("scene", self.name.as_str().into()),
                    ("method", peer.name.as_str().into()),
                    ("cpu_seconds", microseconds(level.seconds).into()),
                    ("error_of_95_percent", finite(within(level.errors.iter().map(|&error| Some(error))))),
                ])
            })
        });
        own.chain(peer).collect()
    }

    /// By method.
    fn times(&self) -> BTreeMap<String, Times> {
        let of = |ladder: &Ladder<Found>| {
            let levels = |of: fn(&Found) -> f64| -> Vec<(f64, f64)> {
                let level = |rung: &crate::ladder::Rung<Found>| {
                    (rung.seconds, within(rung.runs.iter().map(|run| run.as_ref().map(of))))
                };
                ladder.rungs.iter().map(level).collect()
            };
            let error = seconds_near(&levels(|found| found.error))?;
            let half_width = seconds_near(&levels(|found| found.half_width));
            Some((ladder.candidate.title(), Times { error, half_width }))
        };
        self.ladders.iter().filter_map(of).collect()
    }

    /// The fastest to 1 %, by error.
    fn best(&self) -> Option<(String, f64)> {
        let times = self.times().into_iter().map(|(method, times)| (method, times.error));
        times.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn of_peer(&self) -> Option<f64> {
        let level =
            |level: &super::peers::PeerLevel| (level.seconds, within(level.errors.iter().map(|&error| Some(error))));
        let levels: Vec<(f64, f64)> = self.peer.as_ref()?.levels.iter().map(level).collect();
        seconds_near(&levels)
    }

    /// Fit for a file name.
    fn slug(&self) -> String {
        let plain: String =
            self.name.to_lowercase().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { ' ' }).collect();
        plain.split_whitespace().collect::<Vec<_>>().join("-")
    }

    fn figure(&self) -> FigureData {
        let own = self.ladders.iter().map(|ladder| {
            let point = |rung: &crate::ladder::Rung<Found>| {
                spread(rung.seconds, rung.runs.iter().flatten().map(|found| found.error))
            };
            (ladder.candidate.title(), ladder.rungs.iter().filter_map(point).collect::<Vec<_>>())
        });
        let peer = self.peer.iter().map(|peer| {
            let points = peer.levels.iter().filter_map(|level| spread(level.seconds, level.errors.iter().copied()));
            (peer.name.clone(), points.collect())
        });
        let series = own.chain(peer).filter(|(_, points)| !points.is_empty());
        let without = if self.peer.is_none() {
            " Mitsuba 3: not installed, or it does not read this scene, or reads something else."
        } else {
            ""
        };
        FigureData {
            id: self.slug(),
            title: format!("{}: error against time", self.name),
            caption: format!(
                "The largest relative error of the readings, of runs that found one beyond what is not known of the answer: median, least and largest.{without} {CPU_SECONDS}; {}, {}.",
                system::processor(),
                super::date::today()
            ),
            x: Axis::log("CPU seconds"),
            y: Axis::log("largest relative error"),
            series: series.map(|(label, points)| Series { label, kind: SeriesKind::Measured, points }).collect(),
        }
    }
}

/// The time to 1 %, if it is not far beyond the longest run.
fn seconds_near(levels: &[(f64, f64)]) -> Option<f64> {
    let (seconds, _) = seconds_to(levels, ERROR)?;
    let longest = levels.iter().map(|level| level.0).fold(0.0, f64::max);
    (seconds <= FARTHEST * longest).then_some(seconds)
}

fn finite(value: f64) -> serde_json::Value {
    if value.is_finite() { value.into() } else { serde_json::Value::Null }
}

/// The median of some errors with their ends, of those that are above what is not known of the answer; `None` if none is.
fn spread(seconds: f64, errors: impl Iterator<Item = f64>) -> Option<Point> {
    let mut errors: Vec<f64> = errors.filter(|error| *error > 0.0).collect();
    errors.sort_by(f64::total_cmp);
    let (&low, &high) = (errors.first()?, errors.last()?);
    high.is_finite().then(|| Point { x: seconds, y: errors[errors.len() / 2], low: Some(low), high: Some(high) })
}

/// Ratios over scenes: their geometric mean with its interval.
fn geometric(ratios: &[f64], confidence: f64) -> Option<Interval> {
    let logarithms: Replicates = ratios.iter().map(|ratio| ratio.ln()).collect();
    let it = logarithms.interval(confidence).filter(|_| ratios.len() as u64 >= FEWEST)?;
    Some(Interval { value: it.value.exp(), low: it.low.exp(), high: it.high.exp(), confidence })
}

/// By method: its time over the best's, scene by scene, and the time of a half-width over that of an error.
fn ratios(scenes: &[SceneSpeeds]) -> BTreeMap<String, (Vec<f64>, Vec<f64>)> {
    let mut ratios: BTreeMap<String, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
    for scene in scenes {
        let Some((_, best)) = scene.best() else { continue };
        for (method, times) in scene.times() {
            let (everywhere, certainty) = ratios.entry(method).or_default();
            everywhere.push(times.error / best);
            certainty.extend(times.half_width.map(|half_width| half_width / times.error));
        }
    }
    ratios
}

/// Makes the comparisons, and says how many there are.
pub(super) fn judge(scenes: &[SceneSpeeds], mut table: Option<&mut Table>) -> usize {
    let all = ratios(scenes);
    for (method, (everywhere, certainty)) in &all {
        let Some(table) = table.as_deref_mut() else { continue };
        let at_least = Expected { value: ONE_METHOD, low: ONE_METHOD, high: 1e6, source: "expected".into() };
        let label = format!("{method}: time to 1 %, over that of the best, in scenes where it gets there");
        let interval = geometric(everywhere, table.confidence);
        table.judge(label, at_least, interval, PRECISION);
        let at_most = Expected { value: CERTAINTY, low: 0.0, high: CERTAINTY, source: "expected".into() };
        let label = format!("{method}: time to a half-width of 1 %, over that to an error of 1 %");
        let interval = geometric(certainty, table.confidence);
        table.judge(label, at_most, interval, PRECISION);
    }
    2 * all.len()
}

/// What was found in all scenes.
pub(super) fn words(scenes: &[SceneSpeeds], confidence: f64) -> String {
    let mut soonest: BTreeMap<String, usize> = BTreeMap::new();
    scenes.iter().filter_map(|scene| scene.best()).for_each(|(method, _)| *soonest.entry(method).or_default() += 1);
    let mut soonest: Vec<(String, usize)> = soonest.into_iter().collect();
    soonest.sort_by_key(|method| std::cmp::Reverse(method.1));
    let soonest: Vec<String> = soonest.into_iter().map(|(method, count)| format!("{method} in {count}")).collect();
    let told = |interval: Option<Interval>| match interval {
        Some(it) => format!("{:.2} ({:.2} to {:.2})", it.value, it.low, it.high),
        None => "too few scenes".into(),
    };
    let all = ratios(scenes);
    let everywhere: Vec<String> = all
        .iter()
        .map(|(method, (ratios, _))| {
            format!("{method} {} in {} scenes", told(geometric(ratios, confidence)), ratios.len())
        })
        .collect();
    let certainty: Vec<String> =
        all.iter().map(|(method, (_, ratios))| format!("{method} {}", told(geometric(ratios, confidence)))).collect();
    let of_peer: Vec<f64> = scenes.iter().filter_map(|scene| Some(scene.of_peer()? / scene.best()?.1)).collect();
    let peer = scenes.iter().find_map(|scene| scene.peer.as_ref()).map_or(String::new(), |peer| {
        let count = of_peer.len();
        format!("; {} over the best here {} in {count} scenes", peer.name, told(geometric(&of_peer, confidence)))
    });
    format!(
        "{} scenes; soonest to an error of 1 %: {}; one method everywhere takes, over the best of each scene where it gets there: {}{peer}; a \
         half-width of 1 % takes, over an error of 1 %: {}",
        scenes.len(),
        soonest.join(", "),
        everywhere.join(", "),
        certainty.join(", ")
    )
}

/// One of each scene, all fronts in one, and the price of certainty.
pub(super) fn figures(scenes: &[SceneSpeeds]) -> Vec<FigureData> {
    let of_scenes = scenes.iter().map(SceneSpeeds::figure).filter(|figure| !figure.series.is_empty());
    [fronts(scenes), price(scenes)].into_iter().chain(of_scenes).collect()
}

/// Each scene's front, time over that of its best method to 1 %.
fn fronts(scenes: &[SceneSpeeds]) -> FigureData {
    let mut kinds: BTreeMap<&str, Vec<Point>> = BTreeMap::new();
    let mut of_peer = Vec::new();
    for scene in scenes {
        let Some((_, best)) = scene.best() else { continue };
        let kind = match scene.name.as_bytes().first() {
            Some(b'C') => "direct light (C)",
            Some(b'D') => "interreflection (D)",
            Some(b'E') => "specular paths (E)",
            Some(b'F') => "media (F)",
            _ => "rooms, walls, skies (I)",
        };
        let rungs = || scene.ladders.iter().flat_map(|ladder| &ladder.rungs);
        let all: Vec<(f64, f64)> =
            rungs().map(|rung| (rung.seconds, within(rung.runs.iter().map(|run| Some(run.as_ref()?.error))))).collect();
        let is_on_front = |at: &&(f64, f64)| all.iter().all(|other| other.0 >= at.0 || other.1 > at.1);
        let front = all.iter().filter(|at| at.1.is_finite() && at.1 > 0.0).filter(is_on_front);
        kinds.entry(kind).or_default().extend(front.map(|&(seconds, error)| Point::new(seconds / best, error)));
        let levels = scene.peer.iter().flat_map(|peer| &peer.levels);
        of_peer.extend(levels.filter_map(|level| {
            let error = within(level.errors.iter().map(|&error| Some(error)));
            (error.is_finite() && error > 0.0).then(|| Point::new(level.seconds / best, error))
        }));
    }
    let measured = |label: &str, points: Vec<Point>| Series { label: label.into(), kind: SeriesKind::Measured, points };
    let mut series: Vec<Series> = kinds.into_iter().map(|(kind, points)| measured(kind, points)).collect();
    if let Some(peer) = scenes.iter().find_map(|scene| scene.peer.as_ref()) {
        series.push(measured(&peer.name, of_peer));
    }
    let law = [0.01_f64, 100.0].map(|time| Point::new(time, ERROR / time.sqrt())).into();
    series.push(Series { label: "error as time to the power -1/2".into(), kind: SeriesKind::Reference, points: law });
    FigureData {
        id: "fronts".into(),
        title: "What no method beats in both time and error, all scenes".into(),
        caption: format!(
            "Time over that of the scene's best method to an error of 1 %; errors that 95 % of the seeds do not exceed. {CPU_SECONDS}; {}, {}.",
            system::processor(),
            super::date::today()
        ),
        x: Axis::log("time over the best's to 1 %"),
        y: Axis::log("largest relative error"),
        series,
    }
}

/// By method, scene by scene: the time of a half-width over that of an error.
fn price(scenes: &[SceneSpeeds]) -> FigureData {
    let all = ratios(scenes);
    let place = |step: usize, count: usize| 0.6 * ((step as f64 + 0.5) / count as f64 - 0.5);
    let of = |(number, (_, ratios)): (usize, &(Vec<f64>, Vec<f64>))| -> Vec<Point> {
        let mut ratios = ratios.clone();
        ratios.sort_by(f64::total_cmp);
        let count = ratios.len();
        let at = |(step, ratio): (usize, f64)| Point::new(number as f64 + 1.0 + place(step, count), ratio);
        ratios.into_iter().enumerate().map(at).collect()
    };
    let points: Vec<Point> = all.values().enumerate().flat_map(of).collect();
    // A narrow axis breaks names at spaces.
    let names: Vec<String> = all.keys().map(|method| method.replacen('-', " ", 1)).collect();
    let even = [0.5, all.len() as f64 + 0.5].map(|x| Point::new(x, 1.0)).into();
    FigureData {
        id: "price-of-certainty".into(),
        title: "Time to a half-width of 1\u{a0}% over the time to an error of 1\u{a0}%".into(),
        caption: "Each mark: one scene, by rising ratio. 95 % of the seeds are within 1 %, by their true error or by their own half-width.".into(),
        x: Axis::named("method", names.iter().map(String::as_str)),
        y: Axis::log("time to half-width / time to error"),
        series: vec![
            Series { label: "a scene".into(), kind: SeriesKind::Measured, points },
            Series { label: "as long".into(), kind: SeriesKind::Reference, points: even },
        ],
    }
}
