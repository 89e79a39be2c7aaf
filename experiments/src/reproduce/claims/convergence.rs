//! `convergence`: how fast squared errors fall with photons, at a smooth point, over an image with an edge, and pass by pass, and with
//! gather rays.

use photonlab_gather::{Bandwidth, Scratch};
use photonlab_measure::{Axis, FigureData, Interval, Record, Series, Verdict};
use photonlab_reference::convergence::{cosine_torus, half_lit_torus};
use photonlab_sampling::Stream;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    decay::{Decay, Step},
    gathered,
    progressive::{Asked, Progressive, Sequence},
    table::Table,
    torus::{read_crest, read_row},
    trials::Trials,
};

/// Comparisons of bias and variance for each number of passes.
const OF_PASSES: usize = 2;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Photons of a whole set, ascending.
    photons: Vec<u64>,
    replicates: u64,
    /// Rows of images.
    rows: u64,
    /// The count that does not grow.
    constant_k: usize,
    /// Of the progressive sequences.
    pass_photons: u64,
    /// Metres.
    first_radius: f64,
    /// Ascending.
    passes: Vec<u32>,
    sequences: u64,
    gathered: gathered::Parameters,
    /// A ratio to a law known worse than this (half-width) says nothing.
    precision: f64,
    /// The same for a slope.
    slope_precision: f64,
}

/// All that is measured.
struct Measured {
    /// Over photons.
    decays: [Decay; 4],
    progressive: [Progressive; 2],
    /// Over rays: where they rule the error, and where photons do.
    gathered: [Decay; 2],
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let measured = Measured::take(&p)?;
    let of_photons = measured.decays.len() * (p.photons.len() + 1);
    let of_rays = measured.gathered.iter().map(|decay| decay.steps.len()).sum::<usize>() + 1;
    let mut table = Table::new(of_photons + measured.progressive.len() * (OF_PASSES * p.passes.len() + 1) + of_rays);
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    for decay in &measured.decays {
        decay.judge_errors(&mut table, "photons", p.precision);
        decay.judge_slope(&mut table, p.slope_precision);
        found.rows.extend(decay.rows());
    }
    for progressive in &measured.progressive {
        progressive.judge(&mut table, p.precision);
        progressive.decay.judge_slope(&mut table, p.slope_precision);
        found.rows.extend(progressive.rows());
    }
    for decay in &measured.gathered {
        decay.judge_errors(&mut table, "rays", p.precision);
        found.rows.extend(decay.rows());
    }
    measured.gathered[0].judge_slope(&mut table, p.slope_precision);
    found.figures = vec![
        photons_figure(&p, &measured, &table),
        passes_figure(&p, &measured, &table),
        rays_figure(&p, &measured, &table),
    ];
    let confidence = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| conclude(&p, &measured, confidence));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

impl Parameters {
    /// Groups of trials share no random numbers.
    fn trials(&self, part: u64, replicates: u64) -> Trials {
        Trials { seed: self.seed, group: 1000 * part, replicates }
    }

    /// The error at every number of photons: `setting` chooses a radius or k, `read` makes a squared error of one set of photons.
    fn decay(
        &self,
        (name, source, limit): (&'static str, &'static str, f64),
        first: Trials,
        setting: impl Fn(f64) -> f64,
        law: impl Fn(f64, f64) -> f64,
        read: impl Fn(u64, f64, &mut Stream, &mut Scratch) -> anyhow::Result<f64> + Sync,
    ) -> anyhow::Result<Decay> {
        let step = |(i, &photons): (usize, &u64)| {
            let effort = photons as f64;
            let setting = setting(effort);
            let trials = Trials { group: first.group + i as u64, ..first };
            let columns = trials.run(|stream, scratch| Ok(vec![read(photons, setting, stream, scratch)?]))?;
            let squared = columns.first().copied().unwrap_or_default();
            Ok(Step { effort, setting, squared, law: law(effort, setting) })
        };
        let steps = self.photons.iter().enumerate().map(step).collect::<anyhow::Result<_>>()?;
        Ok(Decay { name, source, limit, steps })
    }
}

impl Measured {
    fn take(p: &Parameters) -> anyhow::Result<Self> {
        let asked = Asked { photons: p.pass_photons, radius: p.first_radius, passes: &p.passes };
        let progressive = |sequence: Sequence| {
            let part = Sequence::ALL.iter().position(|&one| one == sequence).unwrap_or(0) as u64;
            Progressive::measure(sequence, asked, p.trials(10 + part, p.sequences))
        };
        let [published, ours] = Sequence::ALL;
        Ok(Self {
            decays: [fixed_radius(p)?, nearest(p)?, constant_count(p)?, image(p)?],
            progressive: [progressive(published)?, progressive(ours)?],
            gathered: gathered::measure(&p.gathered, p.seed)?,
        })
    }
}

fn fixed_radius(p: &Parameters) -> anyhow::Result<Decay> {
    let source = "bias of the disc and binomial variance (catalogue H1)";
    p.decay(
        ("smooth point, fixed radius", source, -2.0 / 3.0),
        p.trials(0, p.replicates),
        cosine_torus::best_radius,
        |photons, radius| cosine_torus::fixed_radius(photons, radius).mean_squared(),
        |photons, radius, stream, scratch| {
            let value = read_crest(photons, Bandwidth::Radius(radius), stream, scratch)?;
            Ok((value - cosine_torus::TRUTH).powi(2))
        },
    )
}

fn nearest(p: &Parameters) -> anyhow::Result<Decay> {
    nearest_by("smooth point, best k", -2.0 / 3.0, p, 1, cosine_torus::best_count)
}

fn constant_count(p: &Parameters) -> anyhow::Result<Decay> {
    nearest_by("smooth point, constant k", 0.0, p, 2, |_| p.constant_k as f64)
}

fn nearest_by(
    name: &'static str,
    limit: f64,
    p: &Parameters,
    part: u64,
    count: impl Fn(f64) -> f64,
) -> anyhow::Result<Decay> {
    p.decay(
        (name, "the light within the k-th distance follows a Beta law (catalogue H2)", limit),
        p.trials(part, p.replicates),
        count,
        |photons, k| cosine_torus::nearest(photons, k).mean_squared(),
        |photons, k, stream, scratch| {
            let bandwidth = Bandwidth::Nearest { k: k as usize, max_radius: f64::INFINITY };
            Ok((read_crest(photons, bandwidth, stream, scratch)? - cosine_torus::TRUTH).powi(2))
        },
    )
}

fn image(p: &Parameters) -> anyhow::Result<Decay> {
    p.decay(
        ("image with an edge", "law of the straight edge, squared and integrated (catalogue H5)", -1.0 / 3.0),
        p.trials(3, p.rows),
        half_lit_torus::best_radius,
        |photons, radius| half_lit_torus::fixed_radius(photons, radius).mean_squared(),
        read_row,
    )
}

fn conclude(p: &Parameters, measured: &Measured, confidence: f64) -> (Verdict, String) {
    let of_passes = measured.progressive.iter().map(|progressive| &progressive.decay);
    let slopes = measured.decays.iter().chain(of_passes).chain(&measured.gathered[..1]).map(|decay| {
        format!(
            "{} {} where the law has {:.3} ({:.3} at its end, {:.3} in the limit)",
            decay.name,
            text(decay.slope(confidence)),
            decay.law_slope(),
            decay.last_slope().unwrap_or(f64::NAN),
            decay.limit
        )
    });
    let reason = format!(
        "every mean squared error follows its law. Log-log slopes, {} to {} photons or {} to {} passes: {}. With {} nearest photons however \
         many there are, the error stops at p^2 / k; with rays of final gather at the plateau that the photons leave it, where it is {} of its law",
        p.photons[0],
        p.photons[p.photons.len() - 1],
        p.passes[0],
        p.passes[p.passes.len() - 1],
        slopes.collect::<Vec<_>>().join("; "),
        p.constant_k,
        ratio(measured.gathered[1].steps.last(), confidence)
    );
    (Verdict::Holds, reason)
}

fn ratio(step: Option<&Step>, confidence: f64) -> String {
    let of_law = step.and_then(|step| Some(step.squared.interval(confidence)?.scaled(1.0 / step.law)));
    text(of_law)
}

fn text(slope: Option<Interval>) -> String {
    slope.map_or("unknown".into(), |s| format!("{:.3} ({:.3} to {:.3})", s.value, s.low, s.high))
}

fn photons_figure(p: &Parameters, measured: &Measured, table: &Table) -> FigureData {
    FigureData {
        id: "photons".into(),
        title: "Mean squared error against photons".into(),
        caption: format!(
            "Radius and k at their best for each number of photons, and k = {} for all. {} photon sets per mark, {} rows per mark of the \
             image; {}.",
            p.constant_k,
            p.replicates,
            p.rows,
            table.intervals()
        ),
        x: Axis::log("photons on the torus of 1 m^2"),
        y: Axis::log("mean squared error over the mean irradiance squared"),
        series: all_series(measured.decays.iter(), table),
    }
}

fn passes_figure(p: &Parameters, measured: &Measured, table: &Table) -> FigureData {
    FigureData {
        id: "passes".into(),
        title: "Mean squared error of progressive passes".into(),
        caption: format!(
            "{} photons a pass, first radius {} m, at the smooth point. {} sequences per mark; {}.",
            p.pass_photons,
            p.first_radius,
            p.sequences,
            table.intervals()
        ),
        x: Axis::log("passes"),
        y: Axis::log("mean squared error over the mean irradiance squared"),
        series: all_series(measured.progressive.iter().map(|progressive| &progressive.decay), table),
    }
}

fn rays_figure(p: &Parameters, measured: &Measured, table: &Table) -> FigureData {
    FigureData {
        id: "rays".into(),
        title: "Mean squared error of final gather against its rays".into(),
        caption: format!(
            "Integrating sphere of reflectance {}, {} independent photons, gathered within {} m: rays rule the error first, and photons at last. \
             {} replicates per mark; {}.",
            p.gathered.reflectance,
            p.gathered.photons,
            p.gathered.radius,
            p.gathered.replicates,
            table.intervals()
        ),
        x: Axis::log("gather rays"),
        y: Axis::log("mean squared error over the direct irradiance squared"),
        series: all_series(measured.gathered.iter(), table),
    }
}

fn all_series<'a>(decays: impl Iterator<Item = &'a Decay>, table: &Table) -> Vec<Series> {
    decays.flat_map(|decay| decay.series(table.confidence)).collect()
}
