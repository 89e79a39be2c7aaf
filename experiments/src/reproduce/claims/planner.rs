//! `planner`: is the method that `auto` chooses the best, does it meet the wanted error, and is its time foretold?

use std::ops::Range;

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Group, Interval, Point, Record, Replicates, Row, Series, SeriesKind,
    Verdict, binomial_interval,
};
use photonlab_photometry::Response;
use photonlab_planner::{Candidate, Planner};
use photonlab_readout::{Cell, ErrorOver, Session, Settings, Target};
use photonlab_reference::catalogue::{ALL, Case};
use photonlab_sampling::PassOptics;
use serde::Deserialize;

use crate::{
    by_channels,
    certificate::is_clear_of_edges,
    command::Options,
    ladder::{Ladder, Silent},
    planned::candidates,
    reproduce::{
        case_reading::put_down,
        context::{Context, Findings},
        covered::Truth,
        cpu_clock::{CPU_SECONDS, CpuClock, microseconds},
        fnv::fnv1a,
        hindsight::{Best, largest_error},
        lab::Lab,
        table::row,
    },
};

/// Confidence of each interval.
const CONFIDENCE: f64 = 0.95;
/// Confidence of the intervals that end a run.
const BARS: f64 = 0.95;
/// What every run costs besides, in a regret: starting a program and reading a scene.
const BESIDES: f64 = 0.3;
/// Regrets, in the mean and at worst; shares of targets met, and of times foretold within a factor.
const MEAN_REGRET: f64 = 1.3;
const WORST_REGRET: f64 = 2.5;
const MET: f64 = 0.95;
const FORETOLD: f64 = 0.9;
const FACTOR: f64 = 1.5;
/// One scene in so many is set aside.
const ASIDE: u64 = 3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Every so many-th scene is read, by the hash of its name.
    one_in: u64,
    seeds: u64,
    /// CPU seconds of a fixed run from which on no longer one is tried.
    ladder_seconds: f64,
    /// Targets that the best method in hindsight would take longer to are left out.
    longest: f64,
    targets: Vec<f64>,
    /// Fewer seeds say nothing of 95 %.
    fewest_seeds: u64,
}

/// A scene to one target.
struct Race {
    scene: String,
    set_aside: bool,
    target: f64,
    best: Best,
    /// By seed.
    runs: Vec<Run>,
}

/// One run by `auto`.
struct Run {
    seconds: f64,
    error: f64,
    /// Wall time in all, pilots included: as foretold when they had ended, and as it was.
    foretold: Option<f64>,
    took: f64,
    chosen: String,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let folder = context.folder("scenes")?;
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let mut races = Vec::new();
    let cases = ALL.iter().flat_map(|entry| (entry.cases)().into_iter().map(move |case| (entry, case)));
    for (number, (entry, case)) in cases.enumerate() {
        let scene = format!("{} {}", entry.id, case.name);
        let hash = fnv1a(&scene);
        if !(hash / ASIDE).is_multiple_of(p.one_in) {
            continue;
        }
        say!("       {scene}");
        let path = folder.join(format!("{number}.xml"));
        put_down(&case, &path)?;
        let lab = Lab::open(&path)?;
        let first = p.seed + 1000 * (number as u64 + 1);
        let of_scene = by_channels!(lab.needs.channels, race(&lab, &case, &p, first))?;
        let set_aside = hash.is_multiple_of(ASIDE);
        races.extend(of_scene.into_iter().map(|race| Race { scene: scene.clone(), set_aside, ..race }));
    }
    found.rows = races.iter().map(Race::row).collect();
    for (set_aside, which) in [(false, "tuned-on"), (true, "set-aside")] {
        let of: Vec<&Race> = races.iter().filter(|race| race.set_aside == set_aside).collect();
        let comparisons = compare(&of, which);
        let summary = words(&of);
        found.groups.push(Group { title: format!("{which} scenes"), summary, comparisons: comparisons.len() });
        found.comparisons.extend(comparisons);
    }
    found.figures = figures(&races);
    let (verdict, reason) = conclude(&p, &races, &found.comparisons);
    Ok(context.record(found, verdict, reason))
}

/// One scene to every target that the best method in hindsight reaches soon enough.
fn race<const C: usize>(lab: &Lab, case: &Case, p: &Parameters, first: u64) -> anyhow::Result<Vec<Race>> {
    let mut cells = Cell::of_meters(&lab.world.scene);
    cells.retain(|cell| !matches!(cell.target, Target::Leaving { .. }));
    if cells.is_empty() {
        return Ok(Vec::new());
    }
    let optics = PassOptics::<C>::new(&lab.world, Response::Radiometric)?;
    let options = Options::usual();
    let settings = options.settings(&lab.world.scene).map_err(|failure| anyhow::anyhow!("{failure}"))?;
    let (world, needs, error_over) = (&lab.world, &lab.needs, ErrorOver::Worst);
    let session = Session { world, optics: &optics, needs, settings, confidence: BARS, error_over };
    let entrants = candidates(&options, &session, &cells).map_err(|failure| anyhow::anyhow!("{failure}"))?;
    let truths = truths(lab, case, &cells, optics.results())?;
    // A meter that is to read nothing has no relative error.
    if truths.iter().any(|truth| truth.value <= 0.0) {
        return Ok(Vec::new());
    }
    let seeds = first..first + p.seeds;
    let climb = |&entrant: &Candidate| {
        Ladder::climb(&session, &cells, entrant, seeds.clone(), p.ladder_seconds, &|outcome| {
            largest_error(&outcome, &truths)
        })
    };
    let ladders: Vec<Ladder<f64>> = entrants.iter().map(climb).collect();
    let mut races = Vec::new();
    for &target in &p.targets {
        let Some(best) = Best::of(&ladders, target).filter(|best| best.seconds <= p.longest) else { continue };
        let runs = seeds
            .clone()
            .map(|seed| read(&session, &cells, &truths, &entrants, (target, seed)))
            .collect::<anyhow::Result<_>>()?;
        races.push(Race { scene: String::new(), set_aside: false, target, best, runs });
    }
    Ok(races)
}

/// The answer to each reading.
fn truths(lab: &Lab, case: &Case, cells: &[Cell], results: usize) -> anyhow::Result<Vec<Truth>> {
    let mut truths = Vec::new();
    for cell in cells {
        let id = &lab.world.scene.sensors[cell.sensor].id;
        let answer = case.expected.iter().find(|answer| &answer.sensor == id);
        let answer = answer.ok_or_else(|| anyhow::anyhow!("no answer for {id}"))?;
        let value = |channel: usize| answer.value[channel.min(answer.value.len() - 1)];
        truths.extend((0..results).map(|c| Truth { value: value(c), uncertainty: answer.uncertainty }));
    }
    Ok(truths)
}

/// One run as `auto` makes it.
fn read<const C: usize>(
    session: &Session<'_, C>,
    cells: &[Cell],
    truths: &[Truth],
    entrants: &[Candidate],
    (target, seed): (f64, u64),
) -> anyhow::Result<Run> {
    let with_seed = |entrant: &Candidate| Candidate { settings: Settings { seed, ..entrant.settings }, ..*entrant };
    let entrants: Vec<Candidate> = entrants.iter().map(with_seed).collect();
    let planner =
        Planner { session: *session, cells, target, time_limit: None, patience: None, trusts: &is_clear_of_edges };
    let (clock, start) = (CpuClock::start(), std::time::Instant::now());
    let plan = planner.race(&entrants)?;
    let foretold = plan.seconds_left().map(|left| start.elapsed().as_secs_f64() + left);
    let chosen = entrants[plan.chosen].title();
    let outcome = plan.go_on(&Silent)?;
    let (seconds, took) = (clock.seconds(), start.elapsed().as_secs_f64());
    Ok(Run { seconds, error: largest_error(&outcome, truths), foretold, took, chosen })
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

    fn row(&self) -> Row {
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

fn compare(races: &[&Race], which: &str) -> Vec<Comparison> {
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

fn words(races: &[&Race]) -> String {
    let percent = |of: fn(&Race) -> u64| share(races, of).map_or(f64::NAN, |share| 100.0 * share.value);
    let (Some(mean), Some(worst)) = (mean_regret(races), worst_regret(races)) else { return "too few".into() };
    let scenes: std::collections::BTreeSet<&str> = races.iter().map(|race| race.scene.as_str()).collect();
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

fn conclude(p: &Parameters, races: &[Race], comparisons: &[Comparison]) -> (Verdict, String) {
    let aside: Vec<&Race> = races.iter().filter(|race| race.set_aside).collect();
    let reason = words(&aside);
    let (tuned, decides) = comparisons.split_at(comparisons.len() / 2);
    let misses = |of: &[Comparison]| of.iter().any(|comparison| comparison.holds == Some(false));
    let verdict = match (p.seeds < p.fewest_seeds || aside.is_empty(), misses(decides), misses(tuned)) {
        (true, ..) => Verdict::NotMeasured,
        (false, true, _) => Verdict::DoesNotHold,
        (false, false, true) => Verdict::HoldsWithinLimits,
        (false, false, false) => Verdict::Holds,
    };
    (verdict, reason)
}

fn figures(races: &[Race]) -> Vec<FigureData> {
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
