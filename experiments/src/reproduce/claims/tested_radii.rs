//! `tested-radii`: what radii that a test keeps or shrinks buy progressive passes.

use photonlab_measure::{Axis, Expected, FigureData, Interval, Record, Replicates, Verdict, student_t_quantile};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    decay::{Decay, Step},
    table::{Table, row},
    tested::{Light, PHOTONS, Rule, squared_errors},
    trials::Trials,
};

/// The slope that is expected in even light.
const SLOPE: [f64; 2] = [-1.02, -0.9];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Ascending.
    passes: Vec<u32>,
    replicates: u64,
    /// Of each test.
    level: f64,
    /// A slope known worse than this share of itself says nothing.
    slope_precision: f64,
}

/// Both rules in one light.
struct Shown {
    light: Light,
    /// Shrinking and tested.
    rules: [Decay; 2],
    /// The last radius with tests.
    radius: Replicates,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let shown: Vec<Shown> = Light::ALL.iter().map(|&light| Shown::take(light, &p)).collect::<anyhow::Result<_>>()?;
    let mut table = Table::new(2);
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let even = &shown[0].rules;
    even[0].judge_slope(&mut table, p.slope_precision);
    let [low, high] = SLOPE;
    let expected = Expected { value: -1.0, low, high, source: "the definition's bound".into() };
    let label = "tested, even light: log-log slope of the mean squared error";
    table.judge(label, expected, even[1].slope(table.confidence), p.slope_precision);
    for one in &shown {
        for decay in &one.rules {
            found.rows.extend(decay.rows().into_iter().map(|mut row_of| {
                row_of.extend(row([("light", one.light.title().into()), ("last_radius", one.radius.mean().into())]));
                row_of
            }));
        }
        found.figures.push(one.figure(&p, &table));
    }
    let confidence = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| conclude(&p, &shown, confidence));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

impl Shown {
    fn take(light: Light, p: &Parameters) -> anyhow::Result<Self> {
        let number = Light::ALL.iter().position(|&one| one == light).unwrap_or(0) as u64;
        let run = |rule: Rule, part: u64| {
            let trials = Trials { seed: p.seed, group: 2 * number + part, replicates: p.replicates };
            trials.run(|stream, _| Ok(squared_errors(light, rule, &p.passes, stream)))
        };
        let tested = run(Rule::Tested { level: p.level }, 1)?;
        let radius = tested.last().copied().unwrap_or_default();
        let variance = |passes: u32| {
            // Of the mean of passes with a Poisson count in each disc.
            let each = (1..=passes).map(|pass| f64::from(pass).powf(1.0 / 3.0) / PHOTONS);
            each.sum::<f64>() / f64::from(passes).powi(2)
        };
        let kept = |passes: u32| 1.0 / (PHOTONS * f64::from(passes));
        Ok(Self {
            light,
            rules: [
                decay("shrinking", -2.0 / 3.0, &run(Rule::Shrinking, 0)?, p, variance),
                decay("tested", -1.0, &tested, p, kept),
            ],
            radius,
        })
    }

    fn figure(&self, p: &Parameters, table: &Table) -> FigureData {
        let mut series: Vec<_> = self.rules.iter().map(|decay| decay.series(table.confidence)).collect();
        let laws = if self.light == Light::Even { 2 } else { 1 };
        let series = series.iter_mut().flat_map(|pair| pair.iter().take(laws).cloned().collect::<Vec<_>>()).collect();
        FigureData {
            id: self.light.title().replace(' ', "-"),
            title: format!("Squared error against passes: {}", self.light.title()),
            caption: format!("{} runs a point; bars: {}.", p.replicates, table.intervals()),
            x: Axis::log("passes"),
            y: Axis::log("mean squared error over the squared irradiance"),
            series,
        }
    }

    /// The squared error with tests over that with a schedule, after most passes.
    fn ratio(&self, confidence: f64) -> Option<Interval> {
        let [shrinking, tested] = self.rules.each_ref().map(|decay| decay.steps.last().map(|step| step.squared));
        let (shrinking, tested) = (shrinking?, tested?);
        let ratio = tested.mean()? / shrinking.mean()?;
        let relative = |of: &Replicates| Some(of.std_error()? / of.mean()?);
        let half = student_t_quantile(confidence, tested.degrees_of_freedom());
        Some(Interval::around(ratio, half * ratio * relative(&tested)?.hypot(relative(&shrinking)?), confidence))
    }
}

fn decay(name: &'static str, limit: f64, columns: &[Replicates], p: &Parameters, law: impl Fn(u32) -> f64) -> Decay {
    let step = |(&passes, &squared): (&u32, &Replicates)| Step {
        effort: f64::from(passes),
        setting: f64::NAN,
        squared,
        law: law(passes),
    };
    let source = "the variance of a Poisson count in each pass's disc";
    Decay { name, source, limit, steps: p.passes.iter().zip(columns).map(step).collect() }
}

fn conclude(p: &Parameters, shown: &[Shown], confidence: f64) -> (Verdict, String) {
    let text = |interval: Option<Interval>| {
        interval.map_or("unknown".into(), |i| format!("{:.3} ({:.3} to {:.3})", i.value, i.low, i.high))
    };
    let each = shown.iter().map(|one| {
        let [shrinking, tested] = one.rules.each_ref().map(|decay| text(decay.slope(confidence)));
        let radius = one.radius.mean().unwrap_or(f64::NAN);
        format!(
            "{}: slope {tested} against {shrinking}, squared error {} times, last radius {radius:.2}",
            one.light.title(),
            text(one.ratio(confidence))
        )
    });
    let reason = format!(
        "tested radii against r as i^(-1/6), the same first radius, {} to {} passes: {}",
        p.passes[0],
        p.passes[p.passes.len() - 1],
        each.collect::<Vec<_>>().join("; ")
    );
    (Verdict::Holds, reason)
}
