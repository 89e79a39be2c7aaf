//! `cost`: CPU time and memory against photons and rays.

use std::{fs, path::Path};

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, Point, Record, Replicates, Row, Series, SeriesKind, Verdict,
};
use serde::Deserialize;

use crate::reproduce::{
    command_cost::Spent,
    context::{Context, Findings},
    cpu_clock::microseconds,
    table::row,
};

const SCENE: &str = include_str!("../../../scenes/cornell-box.xml");
/// Its file, with a meter on the floor.
const FILE: &str = "cornell-box.xml";
const METER: &str = r#"<sensor type="irradiancemeter"><film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="12"/></film></sensor></shape>"#;
/// Cells of the meter across and down.
const SIZE: u32 = 12;
/// Confidence of each interval.
const CONFIDENCE: f64 = 0.99;
/// The cost of one more is expected within this of what it is at the most counts, from this step on.
const STEP: f64 = 0.15;
const FIRST: usize = 1;
/// Memory may grow by this share from where a pass is full.
const GROWTH: f64 = 0.1;
/// A pass's photons at most, as the schedule has them where neither error nor clock ends a run.
const FULL: u64 = 1 << 19;
/// Rays of a pass from which on what they have found is added up before all are through.
const FULL_OF_RAYS: u64 = 1 << 20;
/// Passes of a run at least, and so many times more until the allocator has settled: it keeps in pieces what passes give back, and its memory
/// rises by a tenth or two over the first fifty.
const PASSES: u64 = 16;
const SETTLED: u64 = 3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Emitted in all, rising.
    photons: Vec<u64>,
    /// Points of a cell meanwhile.
    points: u64,
    /// Final-gather rays in all, rising.
    rays: Vec<u64>,
    /// Emitted meanwhile, always in sixteen passes.
    photons_for_rays: u64,
    /// Largest half-width of a cost of one more over another.
    precision: f64,
}

/// Costs at rising counts of one kind.
struct Growth {
    of: &'static str,
    points: Vec<Cost>,
}

struct Cost {
    count: u64,
    /// By seed.
    spent: Vec<Spent>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let scene = context.folder("scenes")?.join(FILE);
    fs::write(&scene, SCENE.replacen("</shape>", METER, 1))?;
    let cells = u64::from(SIZE * SIZE);
    let mut found = Findings { seeds: (p.seed..p.seed + p.replicates).collect(), ..Findings::default() };
    let of_photons: Vec<_> = p.photons.iter().map(|&photons| (photons, photons, p.points)).collect();
    let of_rays: Vec<_> = p.rays.iter().map(|&rays| (rays, p.photons_for_rays, rays.div_ceil(cells))).collect();
    let growths = [
        Growth::measure("photons", &scene, &of_photons, &p, &mut found)?,
        Growth::measure("rays", &scene, &of_rays, &p, &mut found)?,
    ];
    let mut narrow = true;
    for growth in &growths {
        narrow &= growth.judge(p.precision, &mut found);
    }
    found.figures = vec![time(&growths, p.replicates), memory(&growths)];
    let (verdict, reason) = conclude(&growths, narrow, &found);
    Ok(context.record(found, verdict, reason))
}

impl Growth {
    /// Counts, each with the photons and the points of a cell that make it.
    fn measure(
        of: &'static str,
        scene: &Path,
        counts: &[(u64, u64, u64)],
        p: &Parameters,
        found: &mut Findings,
    ) -> anyhow::Result<Self> {
        let mut points = Vec::new();
        for &(count, photons, samples) in counts {
            let seeds = p.seed..p.seed + p.replicates;
            let spent: Vec<Spent> =
                seeds.clone().map(|seed| Spent::reading(scene, photons, samples, seed)).collect::<Result<_, _>>()?;
            found.rows.extend(seeds.zip(&spent).map(|(seed, spent)| cost_row(of, count, seed, spent)));
            points.push(Cost { count, spent });
        }
        Ok(Self { of, points })
    }

    /// What one more takes between two neighbouring counts, over what it takes between the last two, by seeds in pairs.
    fn of_one_more(&self, step: usize) -> Option<Interval> {
        let marginal = |step: usize, seed: usize| {
            let [less, more] = [&self.points[step], &self.points[step + 1]];
            (more.spent[seed].seconds - less.spent[seed].seconds) / (more.count - less.count) as f64
        };
        let last = self.points.len() - 2;
        let ratios: Replicates =
            (0..self.points[0].spent.len()).map(|seed| marginal(step, seed) / marginal(last, seed)).collect();
        ratios.interval(CONFIDENCE)
    }

    /// The steps that are judged.
    fn steps(&self) -> std::ops::Range<usize> {
        FIRST..self.points.len() - 2
    }

    /// Memory at the most counts over that at the fewest after which the allocator has settled, if these are fewer.
    fn growth_of_memory(&self) -> Option<f64> {
        let fills = SETTLED * PASSES * if self.of == "rays" { FULL_OF_RAYS } else { FULL };
        let (last, fewer) = self.points.split_last()?;
        let full = fewer.iter().find(|cost| cost.count >= fills)?;
        Some(last.most_bytes()? / full.most_bytes()?)
    }

    /// False if an interval is wider than asked.
    fn judge(&self, precision: f64, found: &mut Findings) -> bool {
        let mut narrow = true;
        for step in self.steps() {
            let ratio = self.of_one_more(step);
            narrow &= ratio.is_some_and(|ratio| ratio.half_width() <= precision);
            let expected = Expected::within(1.0, STEP, "passes share nothing");
            let [from, to] = [0, 1].map(|next| self.points[step + next].count);
            let label = format!("CPU time of one more of {}, {from} to {to}, over that of the last step", self.of);
            found.comparisons.push(Comparison::judge(label, "1", expected, ratio));
        }
        if let Some(growth) = self.growth_of_memory() {
            let source = "a pass bounds memory".into();
            let expected = Expected { value: 1.0, low: 0.0, high: 1.0 + GROWTH, source };
            let measured = Interval { value: growth, low: growth, high: growth, confidence: CONFIDENCE };
            let label =
                format!("largest memory, most {} over the fewest that fill three times sixteen passes", self.of);
            found.comparisons.push(Comparison::judge(label, "1", expected, Some(measured)));
        }
        narrow
    }
}

impl Cost {
    /// Of any seed: an allocator that keeps what is freed, in pieces, keeps a tenth more in some runs than in others.
    fn most_bytes(&self) -> Option<f64> {
        Some(self.spent.iter().map(|spent| spent.bytes).max()?? as f64)
    }
}

fn conclude(growths: &[Growth], narrow: bool, found: &Findings) -> (Verdict, String) {
    let missed = found.comparisons.iter().any(|comparison| comparison.holds == Some(false));
    let told = |growth: &Growth| {
        let ratios: Vec<String> =
            growth.steps().filter_map(|step| Some(format!("{:.2}", growth.of_one_more(step)?.value))).collect();
        let memory =
            growth.growth_of_memory().map_or(String::new(), |by| format!(", memory by {by:.2} once passes are full"));
        format!("one more of {} takes {} times what it takes at the end{memory}", growth.of, ratios.join(", "))
    };
    let reason = format!("{}; {}", told(&growths[0]), told(&growths[1]));
    match (missed, narrow) {
        (true, _) => (Verdict::DoesNotHold, reason),
        (false, true) => (Verdict::Holds, reason),
        (false, false) => (Verdict::NotMeasured, format!("{reason}; the intervals are wider than the definition asks")),
    }
}

fn series(label: &str, kind: SeriesKind, points: Vec<Point>) -> Series {
    Series { label: label.into(), kind, points }
}

fn time(growths: &[Growth], replicates: u64) -> FigureData {
    let mut all = Vec::new();
    for growth in growths {
        let measured = |cost: &Cost| {
            let seconds: Replicates = cost.spent.iter().map(|spent| spent.seconds).collect();
            Some(Point::measured(cost.count as f64, seconds.interval(CONFIDENCE)?))
        };
        all.push(series(growth.of, SeriesKind::Measured, growth.points.iter().filter_map(measured).collect()));
        if let Some(last) = growth.points.last() {
            let mean = last.spent.iter().map(|spent| spent.seconds).sum::<f64>() / last.spent.len() as f64;
            let line = |cost: &Cost| Point::new(cost.count as f64, mean * cost.count as f64 / last.count as f64);
            let label = format!("in proportion to {}", growth.of);
            all.push(series(&label, SeriesKind::Reference, growth.points.iter().map(line).collect()));
        }
    }
    FigureData {
        id: "time".into(),
        title: "Final gather in the Cornell box: time against photons and rays".into(),
        caption: format!("CPU seconds of a command on one thread; {replicates} seeds a point; bars: 99 % intervals."),
        x: Axis::log("photons, or rays, in all"),
        y: Axis::log("CPU seconds"),
        series: all,
    }
}

fn memory(growths: &[Growth]) -> FigureData {
    let of = |growth: &Growth| {
        let point = |cost: &Cost| Some(Point::new(cost.count as f64, cost.most_bytes()? / f64::from(1 << 20)));
        series(growth.of, SeriesKind::Measured, growth.points.iter().filter_map(point).collect())
    };
    FigureData {
        id: "memory".into(),
        title: "Final gather in the Cornell box: memory against photons and rays".into(),
        caption: "Largest resident memory of a command on one thread, of any seed, where the system tells it.".into(),
        x: Axis::log("photons, or rays, in all"),
        y: Axis::log("MiB"),
        series: growths.iter().map(of).collect(),
    }
}

fn cost_row(of: &str, count: u64, seed: u64, spent: &Spent) -> Row {
    row([
        ("of", of.into()),
        ("count", count.into()),
        ("seed", seed.into()),
        ("cpu_seconds", microseconds(spent.seconds).into()),
        ("peak_bytes", spent.bytes.into()),
    ])
}
