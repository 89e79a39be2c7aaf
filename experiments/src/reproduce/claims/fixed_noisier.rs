//! `fixed-noisier`: the noise of a constant radius against the k nearest.

use std::f64::consts::PI;

use photonlab_gather::Bandwidth;
use photonlab_measure::{Axis, Expected, FigureData, Point, Record, Series, SeriesKind, Verdict};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    placed::{Placed, law_noise, line, logarithmic_axis, marks, on_ramp},
    table::Table,
    trials::Trials,
    uneven::{Shape, Uneven},
};

/// Photons per square metre of the uniform plane.
const DENSITY: f64 = 1000.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Fields per point on the uniform plane, where the two differ by little.
    plane_replicates: u64,
    /// Fields per point on the ramp.
    ramp_replicates: u64,
    /// On the uniform plane, ascending: k, and the mean count within the radius.
    counts: Vec<usize>,
    /// On the ramp.
    k: usize,
    /// Places on the ramp, as photons per square metre, ascending.
    densities: Vec<f64>,
    /// Of the ramp, per metre.
    decades: f64,
    /// The one fixed radius on the ramp holds k photons at this density.
    radius_density: f64,
    /// A noise known worse than this (relative half-width) says nothing.
    precision: f64,
}

impl Parameters {
    fn nearest(&self) -> Bandwidth {
        nearest(self.k)
    }

    fn radius(&self) -> f64 {
        (self.k as f64 / (PI * self.radius_density)).sqrt()
    }
}

fn nearest(k: usize) -> Bandwidth {
    Bandwidth::Nearest { k, max_radius: f64::INFINITY }
}

/// A radius that holds `count` photons on the uniform plane.
fn holding(count: f64) -> Bandwidth {
    Bandwidth::Radius((count / (PI * DENSITY)).sqrt())
}

/// The two ways of searching, at the same places.
struct Pair {
    by_count: Vec<Placed>,
    by_radius: Vec<Placed>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let (plane, ramp) = (on_plane(&p)?, along_ramp(&p)?);
    let all = || [&plane, &ramp].into_iter().flat_map(|pair| pair.by_count.iter().chain(&pair.by_radius));
    let mut table = Table::new(all().count());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    for placed in all() {
        let source = "1 / sqrt(mean count) for a radius, the Gamma law for the k nearest (catalogue A1, A2)";
        let expected = Expected::exact(law_noise(placed.reading.law), source);
        let measured = placed.noise(table.confidence);
        table.judge(format!("{}: relative noise", placed.name), expected, measured, p.precision);
        found.rows.push(placed.row());
    }
    found.figures = vec![plane_figure(&p, &table, &plane), ramp_figure(&p, &table, &ramp)];
    let confidence = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| verdict(&p, confidence, &plane, &ramp));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

fn on_plane(p: &Parameters) -> anyhow::Result<Pair> {
    let mut pair = Pair { by_count: Vec::new(), by_radius: Vec::new() };
    let flat = Uneven { density: DENSITY, shape: Shape::Flat };
    for (i, &count) in p.counts.iter().enumerate() {
        let trials = |group| Trials { seed: p.seed, group: group + i as u64, replicates: p.plane_replicates };
        let read = |bandwidth, group, name: &str| {
            let name = format!("plane, {count} photons, {name}");
            Placed::read(&[count as f64], bandwidth, trials(group), |_| (flat, name.clone()))
        };
        pair.by_count.extend(read(nearest(count), 0, "k nearest")?);
        pair.by_radius.extend(read(holding(count as f64), 1000, "fixed radius")?);
    }
    Ok(pair)
}

fn along_ramp(p: &Parameters) -> anyhow::Result<Pair> {
    let read = |bandwidth, group, name: &str| {
        let trials = Trials { seed: p.seed, group, replicates: p.ramp_replicates };
        Placed::read(&p.densities, bandwidth, trials, |density| {
            (on_ramp(density, p.decades), format!("ramp, {density} photons/m^2, {name}"))
        })
    };
    Ok(Pair {
        by_count: read(p.nearest(), 2000, "k nearest")?,
        by_radius: read(Bandwidth::Radius(p.radius()), 3000, "fixed radius")?,
    })
}

/// At which places the fixed radius is certainly noisier, and at which it certainly is not.
fn noisier(pair: &Pair, confidence: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut noisier, mut quieter) = (Vec::new(), Vec::new());
    for (nearest, fixed) in pair.by_count.iter().zip(&pair.by_radius) {
        let (Some(near), Some(fix)) = (nearest.noise(confidence), fixed.noise(confidence)) else {
            continue;
        };
        if fix.low > near.high {
            noisier.push(fixed.place);
        } else if fix.high < near.low {
            quieter.push(fixed.place);
        }
    }
    (noisier, quieter)
}

fn verdict(p: &Parameters, confidence: f64, plane: &Pair, ramp: &Pair) -> (Verdict, String) {
    let (noisier_on_plane, quieter_on_plane) = noisier(plane, confidence);
    let (noisier_on_ramp, quieter_on_ramp) = noisier(ramp, confidence);
    let (Some(&sparse), Some(&dense), Some(_), true) =
        (noisier_on_ramp.last(), quieter_on_ramp.first(), quieter_on_plane.first(), noisier_on_plane.is_empty())
    else {
        return (Verdict::NotMeasured, "the run is too short to tell which of the two is noisier".into());
    };
    let percent = |placed: Option<&Placed>| {
        placed.and_then(|p| p.reading.square.mean()).map_or(f64::NAN, |square| 100.0 * square.sqrt())
    };
    let crossover = (p.k as f64 - 2.0) / (PI * p.radius().powi(2));
    let reason = format!(
        "in uniform light with equal mean count the fixed radius is the quieter one ({:.2} against {:.2} % at {} photons); with one \
         radius on a ramp it is noisier up to {sparse} and quieter from {dense} photons/m^2: it is noisier where its disc holds \
         fewer than k - 2 photons, here {crossover:.0} per m^2",
        percent(plane.by_radius.first()),
        percent(plane.by_count.first()),
        p.counts.first().copied().unwrap_or(0),
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn plane_figure(p: &Parameters, table: &Table, plane: &Pair) -> FigureData {
    let counts: Vec<f64> = p.counts.iter().map(|&count| count as f64).collect();
    let axis = logarithmic_axis(&counts);
    let law = |label: &str, over_root: fn(f64) -> f64| Series {
        label: label.into(),
        kind: SeriesKind::Predicted,
        points: axis.iter().map(|&n| Point::new(n, over_root(n))).collect(),
    };
    let measured = |placed: &Placed| Some(placed.noise(table.confidence)?.scaled(placed.place.sqrt()));
    FigureData {
        id: "plane".into(),
        title: "Noise in uniform light, equal mean count n".into(),
        caption: format!(
            "In units of 1 / sqrt(n), the noise of n independent photons: the k nearest with k = n are the noisier. {} fields per \
             point; {}.",
            p.plane_replicates,
            table.intervals()
        ),
        x: Axis::log("n, photons (k, or the mean count within the radius)"),
        y: Axis::linear("relative noise times sqrt(n)"),
        series: vec![
            marks("k nearest", &plane.by_count, measured),
            law("its law, sqrt(k / (k - 2))", |k| (k / (k - 2.0)).sqrt()),
            marks("fixed radius", &plane.by_radius, measured),
            law("its law, 1", |_| 1.0),
        ],
    }
}

fn ramp_figure(p: &Parameters, table: &Table, ramp: &Pair) -> FigureData {
    let axis = logarithmic_axis(&p.densities);
    let field = |density| on_ramp(density, p.decades);
    let measured = |placed: &Placed| placed.noise(table.confidence);
    FigureData {
        id: "ramp".into(),
        title: "One fixed radius and one k on a density ramp".into(),
        caption: format!(
            "Left of the crossing the fixed radius is noisier, right of it the k nearest are. Radius {:.1} mm, k = {}, {} decade per \
             metre. {} fields per point; {}.",
            1000.0 * p.radius(),
            p.k,
            p.decades,
            p.ramp_replicates,
            table.intervals()
        ),
        x: Axis::log("photons per square metre at the point"),
        y: Axis::log("standard deviation over mean"),
        series: vec![
            marks("k nearest", &ramp.by_count, measured),
            line("its law", &axis, p.nearest(), field, law_noise),
            marks("fixed radius", &ramp.by_radius, measured),
            line("its law", &axis, Bandwidth::Radius(p.radius()), field, law_noise),
        ],
    }
}
