//! `split-cost`: the paper's cost of a plane against the median and against costs made for balls.

use photonlab_measure::{Comparison, Expected, Interval, Record, Row, Verdict, sidak_level};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    photon_set::PhotonSet,
    split_charts,
    split_rules::RULES,
    split_times::{BuildTimes, Stopwatch},
    split_trials::{Plan, Tried, exponent},
    table::row,
};

/// The family-wise confidence of the whole table.
const FAMILY: f64 = 0.99;
const SETS: [PhotonSet; 4] = [PhotonSet::Cube, PhotonSet::CornellBox, PhotonSet::BallLens, PhotonSet::Volume];
/// In [`RULES`]: the paper's cost with full leaves, as the median's are, and the cost of the grown box.
const PAPER_FULL: usize = 2;
const GROWN: usize = 4;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Ascending.
    photons: Vec<usize>,
    queries: usize,
    k: Vec<usize>,
    /// Radii by the photons that they hold at the typical query.
    radius_counts: Vec<usize>,
    timed_queries: usize,
    rounds: usize,
    least_seconds: f64,
    /// A ratio whose interval holds 1 says nothing if it is wider than this (half-width).
    precision: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let plan = Plan {
        seed: p.seed,
        replicates: p.replicates,
        photons: &p.photons,
        queries: p.queries,
        k: &p.k,
        radius_counts: &p.radius_counts,
    };
    let watch = Stopwatch { seed: p.seed, queries: p.timed_queries, rounds: p.rounds, least_seconds: p.least_seconds };
    let middle = |counts: &[usize]| counts[counts.len() / 2];
    let names = plan.names();
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, 2 * SETS.len() * names.len());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let (mut largest, mut all, mut times) = (Vec::new(), Vec::new(), Vec::new());
    for set in SETS {
        let tried = plan.run(set)?;
        found.rows.extend(rows(&tried, &names, confidence));
        times.push(watch.queries(set, p.photons[p.photons.len() - 1], middle(&p.k), middle(&p.radius_counts))?);
        all.push(tried);
    }
    for tried in &all {
        let last = &tried[tried.len() - RULES.len()..];
        found.comparisons.extend(compare(last, &names, confidence));
        largest.push(last);
    }
    for (set, times) in SETS.iter().zip(&times) {
        found.rows.extend(times.iter().zip(RULES).map(|(&time, (rule, _))| time_row(set.title(), rule, time)));
    }
    let builds = watch.builds(PhotonSet::CornellBox, &p.photons)?;
    found.rows.extend((0..RULES.len()).flat_map(|rule| build_rows(&builds, rule, confidence)));
    found.figures = split_charts::figures(&plan, &all, &times, &builds, confidence);
    let (verdict, reason) = conclude(&p, &names, &largest, confidence);
    Ok(context.record(found, verdict, reason))
}

/// What the laws of grown boxes lead one to expect of the photons tested, over those of the median.
fn compare(largest: &[Tried], names: &[String], confidence: f64) -> Vec<Comparison> {
    let walls = Expected { value: 1.25, low: 1.0, high: 3.0, source: "S cannot tell a square from a sliver".into() };
    let paper = match largest[0].set {
        PhotonSet::BallLens => {
            Expected { value: 0.9, low: 0.4, high: 1.0, source: "a cost sees where photons crowd".into() }
        }
        PhotonSet::Volume => Expected::within(1.0, 0.1, "in an even volume the median cuts cubes"),
        _ => walls,
    };
    let grown = Expected { value: 1.0, low: 0.4, high: 1.05, source: "Steiner's formula for the grown box".into() };
    let one = |rule: usize, expected: &Expected, search: usize| {
        let label = format!("{}, {}: tested by {}, over median", largest[0].set.title(), names[search], RULES[rule].0);
        let ratio = largest[rule].ratio(&largest[0], search, |cost| cost.tested, confidence);
        Comparison::judge(label, "1", expected.clone(), ratio)
    };
    let searches = 0..names.len();
    searches.clone().map(|s| one(PAPER_FULL, &paper, s)).chain(searches.map(|s| one(GROWN, &grown, s))).collect()
}

/// The paper's cost at leaves as full as the median's, and what that rests on.
fn conclude(p: &Parameters, names: &[String], largest: &[&[Tried]], confidence: f64) -> (Verdict, String) {
    let ratio = |set: &[Tried], rule: usize, search| set[rule].ratio(&set[0], search, |cost| cost.tested, confidence);
    let ratios = |set: &[Tried]| (0..names.len()).map(|s| ratio(set, PAPER_FULL, s)).collect::<Option<Vec<Interval>>>();
    let Some(all) = largest.iter().map(|set| ratios(set)).collect::<Option<Vec<_>>>() else {
        return (Verdict::NotMeasured, "one replicate has no interval".into());
    };
    if all.iter().flatten().any(|ratio| ratio.contains(1.0) && ratio.half_width() > p.precision) {
        return (Verdict::NotMeasured, "the intervals are wider than the definition asks".into());
    }
    let words = largest.iter().zip(&all).map(|(set, ratios)| {
        let (low, high) = ratios.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(r.value), h.max(r.value)));
        let better = ratios.iter().filter(|r| r.high < 1.0).count();
        let worse = ratios.iter().filter(|r| r.low > 1.0).count();
        format!(
            "{} {low:.2} to {high:.2} ({better} of {} searches fewer, {worse} more)",
            set[0].set.title(),
            ratios.len()
        )
    });
    let slender = |set: &[Tried], rule: usize| set[rule].slenderness.and_then(|s| s.mean()).unwrap_or(f64::NAN);
    let slivers = largest
        .iter()
        .map(|set| format!("{:.1} in {} ({:.1})", slender(set, PAPER_FULL), set[0].set.title(), slender(set, 0)));
    let reason = format!(
        "photons tested by the paper's cost at full leaves, over those of the median, at {} photons: {}. On a flat sheet S is \
         shared alike whichever way a piece is cut, so leaves become slivers: the typical leaf's length over its width is {} \
         (the median's)",
        p.photons[p.photons.len() - 1],
        words.collect::<Vec<_>>().join("; "),
        slivers.collect::<Vec<_>>().join(", "),
    );
    let fewer = all.iter().filter(|set| set.iter().all(|ratio| ratio.high < 1.0)).count();
    let verdict = match fewer {
        0 => Verdict::DoesNotHold,
        n if n == all.len() => Verdict::Holds,
        _ => Verdict::HoldsWithinLimits,
    };
    (verdict, reason)
}

fn rows(tried: &[Tried], names: &[String], confidence: f64) -> Vec<Row> {
    let mut rows = Vec::new();
    for sizes in tried.chunks(RULES.len()) {
        for own in sizes {
            for (search, name) in names.iter().enumerate() {
                rows.push(cost_row(own, &sizes[0], search, name));
            }
        }
    }
    for rule in 0..RULES.len() {
        let sizes: Vec<&Tried> = tried.iter().filter(|own| own.rule == rule).collect();
        for (search, name) in names.iter().enumerate() {
            let tested = exponent(&sizes, search, |cost| cost.tested, confidence);
            rows.push(slope_row(sizes[0].set, rule, &format!("photons tested, {name}"), tested));
        }
    }
    rows
}

fn cost_row(own: &Tried, median: &Tried, search: usize, name: &str) -> Row {
    let ratio = |of| own.ratio(median, search, of, 0.99).map(|ratio| ratio.value);
    let (nodes, tested) = (own.mean(search, |cost| cost.nodes), own.mean(search, |cost| cost.tested));
    row([
        ("set", own.set.title().into()),
        ("photons", own.photons.into()),
        ("rule", RULES[own.rule].0.into()),
        ("search", name.into()),
        ("replicates", tested.len().into()),
        ("found", own.mean(search, |cost| cost.found).mean().into()),
        ("nodes", nodes.mean().into()),
        ("nodes_std_error", nodes.std_error().into()),
        ("tested", tested.mean().into()),
        ("tested_std_error", tested.std_error().into()),
        ("nodes_over_median", ratio(|cost| cost.nodes).into()),
        ("tested_over_median", ratio(|cost| cost.tested).into()),
        ("leaf_size", own.leaf_size.mean().into()),
        ("leaf_slenderness", own.slenderness.and_then(|s| s.mean()).into()),
    ])
}

fn slope_row(set: PhotonSet, rule: usize, of: &str, slope: Option<Interval>) -> Row {
    row([
        ("set", set.title().into()),
        ("rule", RULES[rule].0.into()),
        ("slope_in_photons_of", of.into()),
        ("slope", slope.map(|s| s.value).into()),
        ("slope_low", slope.map(|s| s.low).into()),
        ("slope_high", slope.map(|s| s.high).into()),
    ])
}

fn time_row(set: &str, rule: &str, [nearest, radius]: [f64; 2]) -> Row {
    row([
        ("set", set.into()),
        ("rule", rule.into()),
        ("cpu_seconds_per_nearest_query", nearest.into()),
        ("cpu_seconds_per_radius_query", radius.into()),
    ])
}

fn build_rows(times: &BuildTimes, rule: usize, confidence: f64) -> Vec<Row> {
    let one = |(i, &photons): (usize, &usize)| {
        row([
            ("set", times.set.title().into()),
            ("rule", RULES[rule].0.into()),
            ("photons", photons.into()),
            ("build_cpu_seconds", times.best(rule, i).into()),
        ])
    };
    let slope = times.exponent(rule, confidence);
    let slope = slope_row(times.set, rule, "build CPU seconds", slope);
    times.photons.iter().enumerate().map(one).chain([slope]).collect()
}
