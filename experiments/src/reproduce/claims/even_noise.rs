//! `even-noise`: the k nearest over a density ramp and beside a step.

use std::f64::consts::PI;

use photonlab_gather::Bandwidth;
use photonlab_measure::{Axis, Expected, FigureData, Interval, Record, Verdict};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    placed::{Placed, law_noise, line, logarithmic_axis, marks, noise_range, on_ramp},
    table::Table,
    trials::Trials,
    uneven::{Shape, Uneven},
};

const NEAREST_LAW: &str = "the photons expected within the k-th distance follow a Gamma law (catalogue A7, B3)";
const RADIUS_LAW: &str = "Poisson count (catalogue A1)";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    k: usize,
    /// Places on the ramp, as photons per square metre, ascending.
    densities: Vec<f64>,
    /// Of the ramp, per metre.
    decades: f64,
    /// The fixed radius holds k photons at this density.
    radius_density: f64,
    /// Photons per square metre on the bright side of the step.
    step_density: f64,
    /// The dark side's density over the bright one's.
    step_ratio: f64,
    /// Places beside the step, millimetres, ascending; the bright side is positive.
    step_places: Vec<f64>,
    /// The noise counts as even if the largest over the smallest is below this.
    even: f64,
    /// A mean known worse than this (relative half-width) says nothing.
    precision: f64,
    /// The same for a noise.
    noise_precision: f64,
}

impl Parameters {
    fn nearest(&self) -> Bandwidth {
        Bandwidth::Nearest { k: self.k, max_radius: f64::INFINITY }
    }

    fn fixed(&self) -> Bandwidth {
        Bandwidth::Radius((self.k as f64 / (PI * self.radius_density)).sqrt())
    }

    fn beside_step(&self, place: f64) -> Uneven {
        let (density, ratio) = if place > 0.0 {
            (self.step_density, self.step_ratio)
        } else {
            (self.step_density * self.step_ratio, 1.0 / self.step_ratio)
        };
        Uneven { density, shape: Shape::Step { distance: 1e-3 * place.abs(), ratio } }
    }
}

struct Readings {
    by_count: Vec<Placed>,
    by_radius: Vec<Placed>,
    at_step: Vec<Placed>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let readings = Readings::take(&p)?;
    let mut table = Table::new(2 * readings.all().count());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    for (placed, law) in readings.all() {
        let (reading, confidence) = (&placed.reading, table.confidence);
        let mean = Expected::exact(reading.law.mean, law);
        table.judge(format!("{}: mean over truth", placed.name), mean, placed.mean(confidence), p.precision);
        let expected = Expected::exact(law_noise(reading.law), law);
        table.judge(format!("{}: relative noise", placed.name), expected, placed.noise(confidence), p.noise_precision);
        found.rows.push(placed.row());
    }
    found.figures = vec![
        ramp_noise_figure(&p, &table, &readings),
        ramp_error_figure(&p, &table, &readings),
        step_figure(&p, &table, &readings),
    ];
    let (comparisons, verdict, reason) = table.conclude(|| verdict(&p, &readings));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

impl Readings {
    fn take(p: &Parameters) -> anyhow::Result<Self> {
        let trials = |group| Trials { seed: p.seed, group, replicates: p.replicates };
        let ramp = |name: &str, bandwidth, group| {
            Placed::read(&p.densities, bandwidth, trials(group), |density| {
                (on_ramp(density, p.decades), format!("ramp, {density} photons/m^2, {name}"))
            })
        };
        let beside = |place: f64| {
            let side = if place > 0.0 { "bright" } else { "dark" };
            (p.beside_step(place), format!("step, {} mm on the {side} side, k nearest", place.abs()))
        };
        Ok(Self {
            by_count: ramp("k nearest", p.nearest(), 0)?,
            by_radius: ramp("fixed radius", p.fixed(), 1000)?,
            at_step: Placed::read(&p.step_places, p.nearest(), trials(2000), beside)?,
        })
    }

    /// Every reading with the law it should follow.
    fn all(&self) -> impl Iterator<Item = (&Placed, &'static str)> {
        let nearest = self.by_count.iter().chain(&self.at_step).map(|placed| (placed, NEAREST_LAW));
        nearest.chain(self.by_radius.iter().map(|placed| (placed, RADIUS_LAW)))
    }
}

fn verdict(p: &Parameters, readings: &Readings) -> (Verdict, String) {
    let worst = |places: &[Placed]| {
        let errors = places.iter().filter_map(|placed| placed.reading.mean.mean()).map(|mean| 100.0 * (mean - 1.0));
        errors.fold(0.0_f64, |worst, error| if error.abs() > worst.abs() { error } else { worst })
    };
    let percent = |(low, high): (f64, f64)| (100.0 * low, 100.0 * high);
    let (low, high) = percent(noise_range(&readings.by_count));
    let (fixed_low, fixed_high) = percent(noise_range(&readings.by_radius));
    let (step_low, step_high) = percent(noise_range(&readings.at_step));
    let found = format!(
        "over the ramp the k nearest (k = {}) keep a relative noise of {low:.1} to {high:.1} % where a fixed radius goes from \
         {fixed_low:.1} to {fixed_high:.0} %",
        p.k
    );
    if high / low > p.even {
        return (Verdict::DoesNotHold, format!("{found}: uneven by more than a factor of {}", p.even));
    }
    let reason = format!(
        "{found}. Even noise is not even error: the mean of the k nearest is off by {:+.0} % at the sparse end and by up to {:+.0} % \
         beside a step of 1 to {}, where the noise is {step_low:.0} to {step_high:.0} %",
        worst(&readings.by_count),
        worst(&readings.at_step),
        1.0 / p.step_ratio
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn ramp_caption(p: &Parameters, table: &Table, what: &str) -> String {
    format!(
        "{what} The density changes by {} decade per metre; k = {}, and the fixed radius holds as many at {} photons/m^2. {} fields \
         per point; {}.",
        p.decades,
        p.k,
        p.radius_density,
        p.replicates,
        table.intervals()
    )
}

fn ramp_noise_figure(p: &Parameters, table: &Table, readings: &Readings) -> FigureData {
    let axis = logarithmic_axis(&p.densities);
    let field = |density| on_ramp(density, p.decades);
    let measured = |placed: &Placed| placed.noise(table.confidence);
    FigureData {
        id: "noise".into(),
        title: "Relative noise over a density ramp".into(),
        caption: ramp_caption(p, table, "Even for the k nearest, not for a fixed radius."),
        x: Axis::log("photons per square metre at the point"),
        y: Axis::log("standard deviation over mean"),
        series: vec![
            marks("k nearest", &readings.by_count, measured),
            line("its law", &axis, p.nearest(), field, law_noise),
            marks("fixed radius", &readings.by_radius, measured),
            line("its law", &axis, p.fixed(), field, law_noise),
        ],
    }
}

fn ramp_error_figure(p: &Parameters, table: &Table, readings: &Readings) -> FigureData {
    let axis = logarithmic_axis(&p.densities);
    let field = |density| on_ramp(density, p.decades);
    let measured = |placed: &Placed| placed.mean(table.confidence);
    FigureData {
        id: "error".into(),
        title: "Mean reading over the same ramp".into(),
        caption: ramp_caption(p, table, "Where photons are sparse, the k nearest reach into brighter parts."),
        x: Axis::log("photons per square metre at the point"),
        y: Axis::linear("mean reading over true irradiance"),
        series: vec![
            marks("k nearest", &readings.by_count, measured),
            line("its law", &axis, p.nearest(), field, |law| law.mean),
            marks("fixed radius", &readings.by_radius, measured),
            line("its law", &axis, p.fixed(), field, |law| law.mean),
        ],
    }
}

fn step_figure(p: &Parameters, table: &Table, readings: &Readings) -> FigureData {
    let reach = p.step_places.iter().fold(0.0_f64, |reach, place| reach.max(place.abs()));
    let side = |sign: f64| (0..=60).map(move |i| sign * reach * (f64::from(i) / 60.0).max(1e-6));
    let axis: Vec<f64> = side(-1.0).rev().chain(side(1.0)).collect();
    let field = |place| p.beside_step(place);
    let error = |m: Interval| Interval { value: m.value - 1.0, low: m.low - 1.0, high: m.high - 1.0, ..m };
    FigureData {
        id: "step".into(),
        title: "Noise and error of the k nearest beside a step in density".into(),
        caption: format!(
            "The noise hardly shows the step, the error does. Bright side {} photons/m^2, dark side {} of it; k = {}. {} fields per \
             point; {}.",
            p.step_density,
            p.step_ratio,
            p.k,
            p.replicates,
            table.intervals()
        ),
        x: Axis::linear("distance from the step, mm (bright side positive)"),
        y: Axis::linear("relative noise, and error of the mean over the truth"),
        series: vec![
            marks("noise", &readings.at_step, |placed| placed.noise(table.confidence)),
            line("its law", &axis, p.nearest(), field, law_noise),
            marks("error", &readings.at_step, |placed| placed.mean(table.confidence).map(error)),
            line("its law", &axis, p.nearest(), field, |law| law.mean - 1.0),
        ],
    }
}
