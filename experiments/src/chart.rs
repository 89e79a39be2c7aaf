//! `photonlab chart`: speed against accuracy of every method on a scene.

use std::path::PathBuf;

use photonlab_measure::{Axis, FigureData, Point, Series, SeriesKind};
use photonlab_paper_figures::draw;
use photonlab_photometry::Response;
use photonlab_planner::{Balance, Candidate};
use photonlab_readout::{ErrorOver, Session};
use serde_json::json;

use crate::{
    Failure, by_channels,
    chart_reference::{References, Values},
    command::{self, Options},
    cpu_clock::CPU_SECONDS,
    interrupt,
    ladder::Ladder,
    loaded::{Loaded, optics},
    planned::{candidates, race},
    reads::Reads,
    system,
};

/// Runs of each length.
const SEEDS: std::ops::Range<u64> = 1..5;
/// CPU seconds of a run from which on no longer one is tried.
const LONGEST: f64 = 2.0;
/// Errors that the planner is asked for.
const TARGETS: [f64; 4] = [0.05, 0.02, 0.01, 0.005];
/// Most pixels across and down of an image that is charted.
const MOST_PIXELS: u32 = 32;

/// One run: what it read, and its own error bar.
pub(crate) struct Kept {
    pub(crate) values: Values,
    pub(crate) bar: Option<f64>,
}

/// A length of runs as the chart shows it.
struct Mark {
    method: String,
    seconds: f64,
    /// Root mean square over the seeds of the error, and of the half-width.
    error: Option<f64>,
    bar: Option<f64>,
    on_front: bool,
}

/// Charts a scene: two figures and their numbers in a folder.
pub(crate) fn chart(arguments: &command::Chart) -> Result<(), Failure> {
    // On one thread CPU time is wall time, and what is foretold can be shown beside what is measured.
    system::start_threads(Some(1))?;
    let mut loaded = Loaded::new(&arguments.scene)?;
    loaded.needs_light(&arguments.scene.scene)?;
    let read = Reads::of(&mut loaded, &arguments.scene.scene, MOST_PIXELS)?;
    let stem = arguments.scene.scene.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy().into_owned());
    let folder = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}-chart")));
    interrupt::make_folder(&folder).map_err(|error| {
        Failure::usage(format!("-o {}: cannot be made: {error}; choose a writable folder", folder.display()))
    })?;
    let chart = by_channels!(loaded.needs.channels, measure(arguments, &loaded, &read))?;
    let name = arguments.scene.scene.file_name().map_or(stem, |name| name.to_string_lossy().into_owned());
    let rows = serde_json::to_string_pretty(&chart.rows(&name, &read)).map_err(anyhow::Error::from)?;
    interrupt::write_whole(&folder.join("chart.json"), rows.as_bytes())?;
    for figure in chart.figures(&name, &read) {
        if figure.series.iter().all(|series| series.kind != SeriesKind::Measured) {
            say!("note: no {}.svg: no run has one above zero", figure.id);
            continue;
        }
        let drawn = draw(&figure).map_err(anyhow::Error::from)?;
        interrupt::write_whole(&folder.join(format!("{}.svg", figure.id)), drawn.as_bytes())?;
    }
    use std::io::Write as _;
    std::io::stdout().write_all(chart.words(&read, &folder.display().to_string()).as_bytes())?;
    Ok(())
}

/// What was measured and foretold.
struct Chart {
    marks: Vec<Mark>,
    references: References,
    /// Target, seconds, method.
    foretold: Vec<(f64, f64, String)>,
}

fn measure<const C: usize>(arguments: &command::Chart, loaded: &Loaded, read: &Reads) -> Result<Chart, Failure> {
    let options = Options::usual();
    let optics = optics::<C>(loaded, &arguments.scene.scene, Response::Radiometric)?;
    let (world, needs, confidence) = (&loaded.world, &loaded.needs, options.confidence);
    let settings = options.settings(&world.scene)?;
    let session = Session { world, optics: &optics, needs, settings, confidence, error_over: read.error_over };
    let entrants = candidates(&options, &session, &read.cells)?;
    let even = |entrant: &&Candidate| entrant.balance == Balance::Even;
    let keep = |outcome: photonlab_readout::Outcome<C>| Kept {
        values: Values::of(&outcome),
        bar: outcome.error(read.error_over, confidence),
    };
    let mut ladders = Vec::new();
    for &entrant in entrants.iter().filter(even) {
        say!("       {}", entrant.title());
        ladders.push(Ladder::climb(&session, &read.cells, entrant, SEEDS, &|rung| rung.seconds > LONGEST, &keep));
    }
    say!("       references");
    let references = References::of(&session, &read.cells, &ladders)?;
    let mut marks: Vec<Mark> =
        ladders.iter().flat_map(|ladder| of_ladder(ladder, &references, read.error_over)).collect();
    mark_the_front(&mut marks);
    let mut foretold = Vec::new();
    for target in TARGETS {
        let options = Options { target_error: Some(target), ..options.clone() };
        let plan = race(&options, &session, &read.cells, (target, None))?;
        if let Some(forecast) = plan.forecast {
            foretold.push((target, forecast.seconds, plan.entrants[plan.chosen].candidate.title()));
        }
    }
    Ok(Chart { marks, references, foretold })
}

fn of_ladder(ladder: &Ladder<Kept>, references: &References, over: ErrorOver) -> Vec<Mark> {
    let root_mean_square = |values: Vec<f64>| {
        let squares = values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64;
        (!values.is_empty() && squares.is_finite() && squares > 0.0).then(|| squares.sqrt())
    };
    let mark = |rung: &crate::ladder::Rung<Kept>| {
        let kept = || rung.runs.iter().flatten();
        let truth = references.for_judging(&ladder.candidate);
        Mark {
            method: ladder.candidate.title(),
            seconds: rung.seconds,
            error: root_mean_square(kept().filter_map(|run| run.values.error(&truth.values, over)).collect()),
            bar: root_mean_square(kept().filter_map(|run| run.bar).collect()),
            on_front: false,
        }
    };
    ladder.rungs.iter().map(mark).collect()
}

/// What no other mark beats in both time and error.
fn mark_the_front(marks: &mut [Mark]) {
    let all: Vec<(f64, f64)> = marks.iter().filter_map(|mark| Some((mark.seconds, mark.error?))).collect();
    for mark in marks {
        let Some(error) = mark.error else { continue };
        mark.on_front = !all.iter().any(|&(s, e)| s <= mark.seconds && e <= error && (s < mark.seconds || e < error));
    }
}

impl Chart {
    fn methods(&self) -> Vec<&str> {
        let mut methods: Vec<&str> = self.marks.iter().map(|mark| mark.method.as_str()).collect();
        methods.dedup();
        methods
    }

    fn figures(&self, name: &str, read: &Reads) -> [FigureData; 2] {
        let series = |of: fn(&Mark) -> Option<f64>| -> Vec<Series> {
            let points = |method: &str| {
                let marks = self.marks.iter().filter(|mark| mark.method == method);
                marks.filter_map(|mark| Some(Point::new(mark.seconds, of(mark)?))).collect::<Vec<_>>()
            };
            let one =
                |method: &&str| Series { label: (*method).into(), kind: SeriesKind::Measured, points: points(method) };
            self.methods().iter().map(one).filter(|series| !series.points.is_empty()).collect()
        };
        let run = format!("{CPU_SECONDS}; one thread, {}.", system::processor());
        let foretold = Series {
            label: "the planner's choice, foretold".into(),
            kind: SeriesKind::Predicted,
            points: self.foretold.iter().map(|&(target, seconds, _)| Point::new(seconds, target)).collect(),
        };
        let span = |at: f64| {
            let times = || self.marks.iter().map(|mark| mark.seconds);
            [times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max)].map(|x| Point::new(x, at)).into()
        };
        let reference = self.references.widest().map(|own| Series {
            label: "half-width of the references".into(),
            kind: SeriesKind::Reference,
            points: span(own),
        });
        let mut errors = series(|mark| mark.error);
        errors.extend(reference);
        let mut bars = series(|mark| mark.bar);
        bars.extend(Some(foretold).filter(|series| series.points.len() > 1));
        [
            FigureData {
                id: "error".into(),
                title: format!("{name}: error against time"),
                caption: format!("{}: {}; {}. {run}", read.words(), read.over(), self.references.words()),
                x: Axis::log("CPU seconds"),
                y: Axis::log("relative error"),
                series: errors,
            },
            FigureData {
                id: "certainty".into(),
                title: format!("{name}: error bar against time"),
                caption: format!("Half-width of the 95 % intervals, {}. {run}", read.over()),
                x: Axis::log("CPU seconds"),
                y: Axis::log("relative half-width"),
                series: bars,
            },
        ]
    }

    fn rows(&self, name: &str, read: &Reads) -> serde_json::Value {
        let marks = self.marks.iter().map(|mark| {
            json!({"method": mark.method, "cpu_seconds": mark.seconds, "error": mark.error, "half_width": mark.bar,
                "on_front": mark.on_front})
        });
        let foretold = self
            .foretold
            .iter()
            .map(|(target, seconds, method)| json!({"target": target, "seconds": seconds, "method": method}));
        json!({"scene": name, "read": read.words(), "errors_are": read.over(), "processor": system::processor(), "runs_of_a_length": SEEDS.count(),
            "references": self.references.words(), "reference_half_width": self.references.widest(),
            "marks": marks.collect::<Vec<_>>(), "foretold": foretold.collect::<Vec<_>>()})
    }

    fn words(&self, read: &Reads, folder: &str) -> String {
        let mut text = format!(
            "{}; errors are {}, {}\n\nno other is both faster and more accurate than:\n",
            read.words(),
            read.over(),
            self.references.words()
        );
        let mut front: Vec<&Mark> = self.marks.iter().filter(|mark| mark.on_front).collect();
        front.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        for mark in front {
            let percent =
                |share: Option<f64>| share.map_or("unknown".into(), |share| format!("{:.3} %", 100.0 * share));
            text += &format!(
                "  {:>9.3} s  error {:>9}  half-width {:>9}  {}\n",
                mark.seconds,
                percent(mark.error),
                percent(mark.bar),
                mark.method
            );
        }
        text += "\nto a half-width the planner takes:\n";
        for (target, seconds, method) in &self.foretold {
            text += &format!("  {:>5} %  {seconds:>9.2} s foretold  {method}\n", 100.0 * target);
        }
        text + &format!("\n{folder}/error.svg, certainty.svg, chart.json\n")
    }
}
