//! `final-gather-rays`: rays of final gather against paths of path tracing at equal error.

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, LogLogFit, Point, Record, Replicates, Row, Series, SeriesKind,
    Verdict, fit_log_log,
};
use photonlab_readout::{Cell, Wanted};
use photonlab_reference::cube::Cube;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    cpu_clock::{CPU_SECONDS, CpuClock},
    lab::Lab,
    strategy::Strategy,
};

const SCENE: &str = include_str!("../../../scenes/cube.xml");
/// The meters of the scene in half-edges from the face's centre.
const METERS: [[f64; 2]; 6] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.998, 0.0], [0.998, 0.5], [0.998, 0.998]];
const CONFIDENCE: f64 = 0.99;
/// A gather ray is expected to be worth at most this many paths.
const MOST: f64 = 10.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    points: Vec<u64>,
    photons: Vec<u64>,
    /// Largest relative half-width of the deciding ratio.
    precision: f64,
}

/// Error and time of one setting over its seeds.
struct Measured {
    rays: f64,
    /// Mean over the seeds of the mean square relative error of the six meters.
    square: Replicates,
    seconds: Replicates,
}

impl Measured {
    /// Root of the mean square, with the interval of the mean square carried through the root.
    fn rms(&self) -> Option<Interval> {
        let square = self.square.interval(CONFIDENCE)?;
        let root = |x: f64| x.max(0.0).sqrt();
        Some(Interval { value: root(square.value), low: root(square.low), high: root(square.high), ..square })
    }
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let lab = Lab::new("cube.xml", SCENE, &[])?;
    let solution = Cube::BENCHMARK.solve();
    let truth = METERS.map(|[u, v]| solution.luminance(u, v));
    let mut found = Findings { seeds: (p.seed..p.seed + p.replicates).collect(), ..Findings::default() };
    let mut curves =
        vec![(Strategy::PATH.title.to_string(), curve(&lab, &p, Strategy::PATH, None, &truth, &mut found)?)];
    for &photons in &p.photons {
        let title = format!("final gather, {photons} photons");
        curves.push((title, curve(&lab, &p, Strategy::FINAL_GATHER, Some(photons), &truth, &mut found)?));
    }
    let law = path_law(&curves[0].1)?;
    let most_photons = &curves[curves.len() - 1].1;
    let deciding = ratio(&law, &most_photons[0]);
    let expected =
        Expected { value: 3.0, low: 1.0, high: MOST, source: "one path is about three bounces of noise".into() };
    let label = format!("paths that replace one of {} gather rays per meter, most photons", p.points[0]);
    found.comparisons.push(Comparison::judge(label, "1", expected, deciding));
    let slope = law.slope_interval(CONFIDENCE);
    let expected = Expected::within(-0.5, 0.05, "independent paths; the lattice may do slightly better");
    found.comparisons.push(Comparison::judge("slope of path tracing's RMS error in paths", "1", expected, Some(slope)));
    found.figures.push(chart("error-against-rays", "rays or paths per meter", &curves, &p, |m| m.rays));
    found.figures.push(chart("error-against-time", "CPU seconds for six meters", &curves, &p, |m| {
        m.seconds.mean().unwrap_or(0.0)
    }));
    let sooner = time_ratio(&curves);
    let (verdict, reason) = conclude(deciding, sooner, p.precision);
    Ok(context.record(found, verdict, reason))
}

fn conclude(ratio: Option<Interval>, sooner: Option<f64>, precision: f64) -> (Verdict, String) {
    let Some(ratio) = ratio.filter(|r| r.half_width() <= precision * r.value) else {
        return (Verdict::NotMeasured, "the intervals are wider than the definition asks".into());
    };
    let time = sooner.map_or(String::new(), |t| {
        format!(
            "; in CPU time, photons included, final gather takes {t:.2} times as long as path tracing at equal error"
        )
    });
    let reason = format!(
        "at few rays one gather ray in CUBE replaces {:.1} paths ({:.1} to {:.1}), and the gain ends at the photons' own noise{time}",
        ratio.value, ratio.low, ratio.high
    );
    (if ratio.low > 1.0 { Verdict::HoldsWithinLimits } else { Verdict::DoesNotHold }, reason)
}

fn curve(
    lab: &Lab,
    p: &Parameters,
    strategy: Strategy,
    photons: Option<u64>,
    truth: &[f64; 6],
    found: &mut Findings,
) -> anyhow::Result<Vec<Measured>> {
    let cells = Cell::of_meters(&lab.world.scene);
    let mut one = |points: u64| -> anyhow::Result<Measured> {
        let mut measured = Measured { rays: points as f64, square: Replicates::new(), seconds: Replicates::new() };
        for seed in p.seed..p.seed + p.replicates {
            let clock = CpuClock::start();
            let wanted = Wanted { photons, samples: Some(points), ..Wanted::default() };
            let outcome = lab.read::<1>(&cells, strategy.settings(seed), &wanted, CONFIDENCE)?;
            let spent = clock.seconds();
            let relative = |(cell, truth): (&photonlab_readout::CellResult<1>, &f64)| {
                (cell.value[0].mean().unwrap_or(0.0) / truth - 1.0).powi(2)
            };
            let square = outcome.cells.iter().zip(truth).map(relative).sum::<f64>() / truth.len() as f64;
            measured.square.push(square);
            measured.seconds.push(spent);
            found.rows.push(row(&strategy, photons, points, seed, square.sqrt(), spent));
        }
        Ok(measured)
    };
    p.points.iter().map(|&points| one(points)).collect()
}

/// RMS error against paths.
fn path_law(paths: &[Measured]) -> anyhow::Result<LogLogFit> {
    let x: Vec<f64> = paths.iter().map(|m| m.rays).collect();
    let y: Vec<f64> = paths.iter().map(|m| m.square.mean().unwrap_or(0.0).sqrt()).collect();
    Ok(fit_log_log(&x, &y)?)
}

/// Paths at the error of a final-gather setting, over its rays; the interval is that of the setting's error.
fn ratio(law: &LogLogFit, gather: &Measured) -> Option<Interval> {
    let rms = gather.rms()?;
    let paths = |error: f64| law.solve(error, CONFIDENCE).map(|paths| paths.value / gather.rays);
    Some(Interval { value: paths(rms.value)?, low: paths(rms.high)?, high: paths(rms.low)?, confidence: CONFIDENCE })
}

/// Time of final gather over that of path tracing at the error of final gather's last point with most photons.
fn time_ratio(curves: &[(String, Vec<Measured>)]) -> Option<f64> {
    let x: Vec<f64> = curves[0].1.iter().map(|m| m.seconds.mean().unwrap_or(0.0)).collect();
    let y: Vec<f64> = curves[0].1.iter().map(|m| m.square.mean().unwrap_or(0.0).sqrt()).collect();
    let law = fit_log_log(&x, &y).ok()?;
    let last = curves.last()?.1.last()?;
    let path_seconds = law.solve(last.rms()?.value, CONFIDENCE)?.value;
    Some(last.seconds.mean()? / path_seconds)
}

fn chart(
    id: &str,
    x: &str,
    curves: &[(String, Vec<Measured>)],
    p: &Parameters,
    place: impl Fn(&Measured) -> f64,
) -> FigureData {
    let series = curves.iter().map(|(title, curve)| {
        let points = curve.iter().filter_map(|m| Some(Point::measured(place(m), m.rms()?.scaled(100.0))));
        Series { label: title.clone(), kind: SeriesKind::Measured, points: points.collect() }
    });
    FigureData {
        id: id.into(),
        title: "CUBE, six meters: error of final gather and of path tracing".into(),
        caption: format!(
            "RMS over the meters against the radiosity solution, {} seeds a point; bars: 99 % intervals. {CPU_SECONDS}.",
            p.replicates
        ),
        x: Axis::log(x),
        y: Axis::log("RMS error, %"),
        series: series.collect(),
    }
}

fn row(strategy: &Strategy, photons: Option<u64>, points: u64, seed: u64, rms: f64, seconds: f64) -> Row {
    let mut row = Row::new();
    row.insert("strategy".into(), strategy.id.into());
    row.insert("photons".into(), photons.into());
    row.insert("points".into(), points.into());
    row.insert("seed".into(), seed.into());
    row.insert("rms".into(), rms.into());
    row.insert("cpu_seconds".into(), seconds.into());
    row
}
