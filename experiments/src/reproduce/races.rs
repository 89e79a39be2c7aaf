//! Runs by `auto` beside the best method in hindsight.

use std::{collections::BTreeSet, ops::Range};

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, Point, Replicates, Row, Series, SeriesKind, binomial_interval,
};

use super::{
    cpu_clock::{CPU_SECONDS, microseconds},
    hindsight::Best,
    table::row,
};

/// Confidence of each interval.
const CONFIDENCE: f64 = 0.95;
/// What every run costs besides, in a regret: starting a program and reading a scene.
const BESIDES: f64 = 0.3;
/// Regrets, in the mean and at worst; shares of targets met, and of times foretold within a factor.
const MEAN_REGRET: f64 = 1.3;
const WORST_REGRET: f64 = 2.5;
const MET: f64 = 0.95;
const FORETOLD: f64 = 0.9;
const FACTOR: f64 = 1.5;

/// A scene to one target.
pub(super) struct Race {
    pub(super) scene: String,
    pub(super) set_aside: bool,
    pub(super) target: f64,
    pub(super) best: Best,
    /// By seed.
    pub(super) runs: Vec<Run>,
}

/// One run by `auto`.
pub(super) struct Run {
    pub(super) seconds: f64,
    pub(super) error: f64,
    /// Wall time in all, pilots included: as foretold when they had ended, and as it was.
    pub(super) foretold: Option<f64>,
    pub(super) took: f64,
    pub(super) chosen: String,
}

impl Race {
    fn seconds(&self) -> f64 {
        self.runs.iter().map(|run| run.seconds).sum::<f64>() / self.runs.len() as f64
    }

    fn regret(&self) -> f64 {
        (self.seconds() + BESIDES) / (self.best.seconds + BESIDES)
    }

    fn met(&self) -> u64 {
        self.runs.iter().filter(|run| run.error <= self.target).count() as u64
    }

    fn foretold(&self) -> u64 {
        self.runs.iter().filter(|run| run.is_foretold()).count() as u64
    }

    /// The method that most runs chose.
    fn usual_choice(&self) -> &str {
        let count = |title: &str| self.runs.iter().filter(|run| run.chosen == title).count();
        self.runs.iter().map(|run| run.chosen.as_str()).max_by_key(|title| count(title)).unwrap_or("")
    }

    /// How it went, in a line.
    pub(super) fn words(&self) -> String {
        format!(
            "to {} %: {} takes {:.3} s, auto {:.3} s, mostly by {}; {} of {} met it, {} were foretold",
            100.0 * self.target,
            self.best.candidate.title(),
            self.best.seconds,
            self.seconds(),
            self.usual_choice(),
            self.met(),
            self.runs.len(),
            self.foretold()
        )
    }

    pub(super) fn row(&self) -> Row {
        row([
            ("scene", self.scene.as_str().into()),
            ("set_aside", self.set_aside.into()),
            ("target", self.target.into()),
            ("best", self.best.candidate.title().into()),
            ("best_cpu_seconds", microseconds(self.best.seconds).into()),
            ("extrapolated", self.best.extrapolated.into()),
            ("chosen", self.usual_choice().into()),
            ("cpu_seconds", microseconds(self.seconds()).into()),
            ("regret", self.regret().into()),
            ("runs", self.runs.len().into()),
            ("met", self.met().into()),
            ("foretold", self.foretold().into()),
        ])
    }
}

impl Run {
    fn is_foretold(&self) -> bool {
        self.foretold.is_some_and(|foretold| {
            let ratio = self.took / foretold;
            (1.0 / FACTOR..=FACTOR).contains(&ratio)
        })
    }
}

fn runs(races: &[&Race]) -> u64 {
    races.iter().map(|race| race.runs.len() as u64).sum()
}

/// Of logarithms over races: scenes are what a stranger's stand for.
fn mean_regret(races: &[&Race]) -> Option<Interval> {
    let logarithms: Replicates = races.iter().map(|race| race.regret().ln()).collect();
    let it = logarithms.interval(CONFIDENCE)?;
    Some(Interval { value: it.value.exp(), low: it.low.exp(), high: it.high.exp(), confidence: CONFIDENCE })
}

fn worst_regret<'r>(races: &[&'r Race]) -> Option<&'r Race> {
    races.iter().copied().max_by(|a, b| a.regret().total_cmp(&b.regret()))
}

fn share(races: &[&Race], of: fn(&Race) -> u64) -> Option<Interval> {
    let all = runs(races);
    (all > 0).then(|| binomial_interval(races.iter().map(|race| of(race)).sum(), all, CONFIDENCE))
}

/// The comparisons of one part of the scenes.
pub(super) fn compare(races: &[&Race], which: &str) -> Vec<Comparison> {
    let at_most = |value: f64| Expected { value, low: 0.0, high: value, source: "demanded".into() };
    let at_least = |value: f64| Expected { value, low: value, high: 1.0, source: "demanded".into() };
    let worst = worst_regret(races).map(|race| {
        let value = race.regret();
        Interval { value, low: value, high: value, confidence: CONFIDENCE }
    });
    let label = |what: &str| format!("{which} scenes: {what}");
    vec![
        Comparison::judge(label("regret, geometric mean"), "1", at_most(MEAN_REGRET), mean_regret(races)),
        Comparison::judge(label("regret, worst"), "1", at_most(WORST_REGRET), worst),
        Comparison::judge(label("share of runs that meet the target"), "1", at_least(MET), share(races, Race::met)),
        Comparison::judge(
            label("share of times foretold within a factor of 1.5"),
            "1",
            at_least(FORETOLD),
            share(races, Race::foretold),
        ),
    ]
}

/// What was found in it.
pub(super) fn words(races: &[&Race]) -> String {
    let percent = |of: fn(&Race) -> u64| share(races, of).map_or(f64::NAN, |share| 100.0 * share.value);
    let (Some(mean), Some(worst)) = (mean_regret(races), worst_regret(races)) else { return "too few".into() };
    let scenes: BTreeSet<&str> = races.iter().map(|race| race.scene.as_str()).collect();
    format!(
        "{} scenes, {} targets, {} runs: regret {:.2} ({:.2} to {:.2}), at worst {:.2} ({} to {} %); target met in {:.1} %, time \
         foretold within a factor of 1.5 in {:.1} %",
        scenes.len(),
        races.len(),
        runs(races),
        mean.value,
        mean.low,
        mean.high,
        worst.regret(),
        worst.scene,
        100.0 * worst.target,
        percent(Race::met),
        percent(Race::foretold)
    )
}

/// Times beside those of the best, and beside those foretold.
pub(super) fn figures(races: &[Race]) -> Vec<FigureData> {
    let part = |set_aside: bool| races.iter().filter(move |race| race.set_aside == set_aside);
    let series = |label: &str, points: Vec<Point>| Series { label: label.into(), kind: SeriesKind::Measured, points };
    let time = |race: &Race| {
        let seconds: Replicates = race.runs.iter().map(|run| run.seconds).collect();
        Some(Point::measured(race.best.seconds, seconds.interval(CONFIDENCE)?))
    };
    let range = span(races.iter().map(|race| race.best.seconds));
    let line = Series {
        label: "no regret".into(),
        kind: SeriesKind::Reference,
        points: [range.start, range.end].map(|x| Point::new(x, x)).into(),
    };
    let foretold = |race: &Race| {
        let all: Replicates = race.runs.iter().filter_map(|run| Some(run.took / run.foretold?)).collect();
        Some(Point::measured(race.seconds(), all.interval(CONFIDENCE)?))
    };
    let factor = |by: f64| Series {
        label: format!("a factor of {FACTOR} {}", if by > 1.0 { "more" } else { "less" }),
        kind: SeriesKind::Reference,
        points: [range.start, range.end].map(|x| Point::new(x, by)).into(),
    };
    vec![
        FigureData {
            id: "regret".into(),
            title: "What `auto` takes against the best method in hindsight".into(),
            caption: format!("Each mark: one scene to one target; bars: 95 % over seeds. {CPU_SECONDS}."),
            x: Axis::log("CPU seconds of the best"),
            y: Axis::log("CPU seconds of auto"),
            series: vec![
                series("tuned-on", part(false).filter_map(time).collect()),
                series("set-aside", part(true).filter_map(time).collect()),
                line,
            ],
        },
        FigureData {
            id: "foretold".into(),
            title: "Time that runs took over the time foretold".into(),
            caption: "Wall time, pilots included; mean over seeds and its 95 % interval.".into(),
            x: Axis::log("CPU seconds of auto"),
            y: Axis::log("time taken / time foretold"),
            series: vec![
                series("tuned-on", part(false).filter_map(foretold).collect()),
                series("set-aside", part(true).filter_map(foretold).collect()),
                factor(FACTOR),
                factor(1.0 / FACTOR),
            ],
        },
    ]
}

fn span(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    if low < high { low..high } else { 0.01..1.0 }
}
