//! `even-noise`: the k nearest over a density ramp and at a step.

use std::f64::consts::{LN_10, PI};

use photonlab_gather::Bandwidth;
use photonlab_measure::{Axis, Expected, FigureData, Interval, Point, Record, Row, Series, SeriesKind, Verdict};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    table::{Table, row},
    trials::{Trials, noise},
    uneven::{Reading, Shape, Uneven},
};

const RAMP_LAW: &str =
    "Gamma law of the photons expected within the k-th distance, Poisson count within a radius, both on exp(a x)";
const STEP_LAW: &str = "Gamma law of the photons expected within the k-th distance, half-plane law on either side";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    k: usize,
    /// Places on the ramp, as photons per square metre.
    densities: Vec<f64>,
    /// Of the ramp, per metre.
    decades: f64,
    /// The fixed radius holds k photons at this density.
    radius_density: f64,
    /// Photons per square metre on the bright side of the step.
    step_density: f64,
    /// The dark side's density over the bright one's.
    step_ratio: f64,
    /// Places beside the step, metres; the bright side is positive.
    step_places: Vec<f64>,
    /// The noise counts as even if the largest over the smallest is below this.
    even: f64,
    /// A mean known worse than this (relative half-width) says nothing.
    precision: f64,
    /// The same for a noise.
    noise_precision: f64,
}

/// One reading with its place along the horizontal axis and what it is called.
struct Placed {
    place: f64,
    name: String,
    reading: Reading,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let nearest = Bandwidth::Nearest { k: p.k, max_radius: f64::INFINITY };
    let fixed = Bandwidth::Radius((p.k as f64 / (PI * p.radius_density)).sqrt());
    let ramp = |name: &str, bandwidth, group| -> anyhow::Result<Vec<Placed>> {
        let place = |(i, &density): (usize, &f64)| {
            let field = Uneven { density, shape: Shape::Ramp { slope: p.decades * LN_10 } };
            let name = format!("ramp, {density} photons/m^2, {name}");
            let trials = Trials { seed: p.seed, group: group + i as u64, replicates: p.replicates };
            Ok(Placed { place: density, name, reading: field.read(bandwidth, &trials)? })
        };
        p.densities.iter().enumerate().map(place).collect()
    };
    let by_count = ramp("k nearest", nearest, 0)?;
    let by_radius = ramp("fixed radius", fixed, 1000)?;
    let at_step = step(&p, nearest)?;

    let all = || by_count.iter().chain(&by_radius).chain(&at_step);
    let mut table = Table::new(2 * all().count());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    for placed in all() {
        let source = if at_step.iter().any(|s| s.name == placed.name) { STEP_LAW } else { RAMP_LAW };
        judge(&mut table, placed, source, &p);
        found.rows.push(placed.row());
    }
    found.figures = figures(&p, &table, &by_count, &by_radius, &at_step);
    let (comparisons, verdict, reason) = table.conclude(|| verdict(&p, &by_count, &by_radius, &at_step));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// Readings on both sides of a step in density.
fn step(p: &Parameters, bandwidth: Bandwidth) -> anyhow::Result<Vec<Placed>> {
    let read = |(i, &place): (usize, &f64)| {
        let (density, ratio) = if place > 0.0 {
            (p.step_density, p.step_ratio)
        } else {
            (p.step_density * p.step_ratio, 1.0 / p.step_ratio)
        };
        let field = Uneven { density, shape: Shape::Step { distance: place.abs(), ratio } };
        let trials = Trials { seed: p.seed, group: 2000 + i as u64, replicates: p.replicates };
        let side = if place > 0.0 { "bright" } else { "dark" };
        let name = format!("step, {} mm on the {side} side, k nearest", 1000.0 * place.abs());
        Ok(Placed { place: 1000.0 * place, name, reading: field.read(bandwidth, &trials)? })
    };
    p.step_places.iter().enumerate().map(read).collect()
}

fn judge(table: &mut Table, placed: &Placed, source: &str, p: &Parameters) {
    let (reading, confidence) = (&placed.reading, table.confidence);
    let mean = Expected::exact(reading.law.mean, source);
    table.judge(format!("{}: mean over truth", placed.name), mean, reading.mean.interval(confidence), p.precision);
    let law = Expected::exact(reading.law_noise(), source);
    let measured = noise(&reading.square, confidence);
    table.judge(format!("{}: relative noise", placed.name), law, measured, p.noise_precision);
}

impl Placed {
    fn row(&self) -> Row {
        row([
            ("place", self.name.as_str().into()),
            ("replicates", self.reading.mean.len().into()),
            ("mean", self.reading.mean.mean().into()),
            ("mean_std_error", self.reading.mean.std_error().into()),
            ("mean_law", self.reading.law.mean.into()),
            ("relative_variance", self.reading.square.mean().into()),
            ("relative_variance_std_error", self.reading.square.std_error().into()),
            ("noise_law", self.reading.law_noise().into()),
        ])
    }
}

fn verdict(p: &Parameters, by_count: &[Placed], by_radius: &[Placed], at_step: &[Placed]) -> (Verdict, String) {
    let evenness = |places: &[Placed]| {
        let squares = places.iter().filter_map(|placed| placed.reading.square.mean());
        let (low, high) = squares.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        (low.sqrt(), high.sqrt())
    };
    let worst = |places: &[Placed]| {
        let errors = places.iter().filter_map(|placed| placed.reading.mean.mean()).map(|mean| 100.0 * (mean - 1.0));
        errors.fold(0.0_f64, |worst, error| if error.abs() > worst.abs() { error } else { worst })
    };
    let (low, high) = evenness(by_count);
    let (fixed_low, fixed_high) = evenness(by_radius);
    let found = format!(
        "over the ramp the k nearest (k = {}) keep a relative noise of {:.1} to {:.1} %, a fixed radius goes from {:.1} to {:.0} %",
        p.k,
        100.0 * low,
        100.0 * high,
        100.0 * fixed_low,
        100.0 * fixed_high
    );
    if high / low > p.even {
        return (Verdict::DoesNotHold, format!("{found}: uneven by more than a factor of {}", p.even));
    }
    let reason = format!(
        "{found}; but even noise is not even error: the bias of the k nearest grows to {:+.0} % at the sparse end and to {:+.0} % \
         beside a step of 1 to {}",
        worst(by_count),
        worst(at_step),
        1.0 / p.step_ratio
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn measured(label: &str, places: &[Placed], of: impl Fn(&Reading) -> Option<Interval>) -> Series {
    let points = places.iter().filter_map(|s| Some(Point::measured(s.place, of(&s.reading)?))).collect();
    Series { label: label.into(), kind: SeriesKind::Measured, points }
}

fn law(label: &str, places: &[Placed], of: impl Fn(&Reading) -> f64) -> Series {
    let points = places.iter().map(|s| Point::new(s.place, of(&s.reading))).collect();
    Series { label: label.into(), kind: SeriesKind::Predicted, points }
}

fn figures(
    p: &Parameters,
    table: &Table,
    by_count: &[Placed],
    by_radius: &[Placed],
    at_step: &[Placed],
) -> Vec<FigureData> {
    let of_noise = |reading: &Reading| noise(&reading.square, table.confidence);
    let of_mean = |reading: &Reading| reading.mean.interval(table.confidence);
    let ramp_caption = |what: &str| {
        format!(
            "{what} {} decade per metre; k = {}; the fixed radius holds {} photons at {} photons/m^2. {} fields per point; {}.",
            p.decades,
            p.k,
            p.k,
            p.radius_density,
            p.replicates,
            table.intervals()
        )
    };
    let density = || Axis::log("density at the point, photons/m^2");
    vec![
        FigureData {
            id: "noise".into(),
            title: "Relative noise over a density ramp".into(),
            caption: ramp_caption("Even for the k nearest, not for a fixed radius. Density changes by"),
            x: density(),
            y: Axis::log("standard deviation over mean"),
            series: vec![
                measured("k nearest", by_count, of_noise),
                law("its law", by_count, Reading::law_noise),
                measured("fixed radius", by_radius, of_noise),
                law("its law", by_radius, Reading::law_noise),
            ],
        },
        FigureData {
            id: "error".into(),
            title: "Mean reading over the same ramp".into(),
            caption: ramp_caption(
                "Where photons are sparse the k nearest reach into brighter parts. Density changes by",
            ),
            x: density(),
            y: Axis::linear("mean reading over true irradiance"),
            series: vec![
                measured("k nearest", by_count, of_mean),
                law("its law", by_count, |r| r.law.mean),
                measured("fixed radius", by_radius, of_mean),
                law("its law", by_radius, |r| r.law.mean),
            ],
        },
        FigureData {
            id: "step".into(),
            title: "Noise and error of the k nearest beside a step in density".into(),
            caption: format!(
                "Bright side {} photons/m^2, dark side {} of it; k = {}. The noise hardly shows the step, the error does. {} \
                 fields per point; {}.",
                p.step_density,
                p.step_ratio,
                p.k,
                p.replicates,
                table.intervals()
            ),
            x: Axis::linear("distance from the step, mm (bright side positive)"),
            y: Axis::linear("relative to the true irradiance (error) or the mean (noise)"),
            series: vec![
                measured("noise", at_step, of_noise),
                law("its law", at_step, Reading::law_noise),
                measured("error of the mean", at_step, |r| {
                    of_mean(r).map(|m| Interval { value: m.value - 1.0, low: m.low - 1.0, high: m.high - 1.0, ..m })
                }),
                law("its law", at_step, |r| r.law.mean - 1.0),
            ],
        },
    ]
}
