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
/// The confidence of slopes, which are not judged.
const SLOPES: f64 = 0.95;
const SETS: [PhotonSet; 4] = [PhotonSet::Cube, PhotonSet::CornellBox, PhotonSet::BallLens, PhotonSet::Volume];
/// In [`RULES`]: the paper's cost by exact sweep, with the full leaves of the other rules, and the cost of the grown box.
const PAPER: usize = 1;
const PAPER_FULL: usize = 2;
const GROWN: usize = 4;
const COMPARED: [usize; 3] = [PAPER, PAPER_FULL, GROWN];

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
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, COMPARED.len() * SETS.len());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let (mut largest, mut all, mut times) = (Vec::new(), Vec::new(), Vec::new());
    for set in SETS {
        let tried = plan.run(set)?;
        found.rows.extend(rows(&tried, &names));
        times.push(watch.queries(set, p.photons[p.photons.len() - 1], middle(&p.k), middle(&p.radius_counts))?);
        all.push(tried);
    }
    for tried in &all {
        let last = &tried[tried.len() - RULES.len()..];
        found.comparisons.extend(compare(last, confidence));
        largest.push(last);
    }
    for (set, times) in SETS.iter().zip(&times) {
        found.rows.extend(times.iter().zip(&RULES).map(|(&time, named)| time_row(set.title(), named.name, time)));
    }
    let builds = watch.builds(PhotonSet::CornellBox, &p.photons)?;
    found.rows.extend((0..RULES.len()).flat_map(|rule| build_rows(&builds, rule)));
    found.figures = split_charts::figures(&plan, &all, &times, &builds, confidence);
    let (verdict, reason) = conclude(&p, &largest, &found.comparisons, confidence);
    Ok(context.record(found, verdict, reason))
}

/// Photons tested at the most photons, over those of the median, over all searches.
fn tested(set: &[Tried], rule: usize, confidence: f64) -> Option<Interval> {
    set[rule].ratio(&set[0], 0..set[rule].searches.len(), |cost| cost.tested, confidence)
}

/// What the laws of grown boxes lead one to expect.
fn compare(set: &[Tried], confidence: f64) -> Vec<Comparison> {
    let one = |rule: usize| {
        let (value, low, high, source) = match (rule, set[0].set) {
            (GROWN, _) => (1.0, 0.4, 1.05, "Steiner's formula for the grown box"),
            (_, PhotonSet::BallLens) => (0.9, 0.4, 1.0, "a cost sees where photons crowd"),
            (_, PhotonSet::Volume) => (1.0, 0.9, 1.1, "in an even volume the median cuts cubes"),
            _ => (1.25, 1.0, 3.0, "S cannot tell a square from a sliver"),
        };
        let label = format!("{}, {}: photons tested, over the median's", set[0].set.title(), RULES[rule].name);
        let expected = Expected { value, low, high, source: source.into() };
        Comparison::judge(label, "1", expected, tested(set, rule, confidence))
            .with_note("geometric mean over the searches")
    };
    COMPARED.map(one).into()
}

/// The paper's cost beside the median at leaves of one mean size, and what that rests on.
fn conclude(p: &Parameters, largest: &[&[Tried]], comparisons: &[Comparison], confidence: f64) -> (Verdict, String) {
    let ratios = |rule: usize| largest.iter().map(|set| tested(set, rule, confidence)).collect::<Option<Vec<_>>>();
    let (Some(swept), Some(grown)) = (ratios(PAPER), ratios(GROWN)) else {
        return (Verdict::NotMeasured, "one replicate has no interval".into());
    };
    if swept.iter().any(|ratio| ratio.contains(1.0) && ratio.half_width() > p.precision) {
        return (Verdict::NotMeasured, "the intervals are wider than the definition asks".into());
    }
    let words = |ratios: &[Interval], chosen: &dyn Fn(&[Tried], &Interval) -> bool| {
        let one = |(set, r): (&&[Tried], &Interval)| {
            let title = set[0].set.title();
            chosen(set, r).then(|| format!("{title} {:.2} ({:.2} to {:.2})", r.value, r.low, r.high))
        };
        let all: Vec<String> = largest.iter().zip(ratios).filter_map(one).collect();
        if all.is_empty() { "nowhere".into() } else { all.join(", ") }
    };
    let slender = |set: &[Tried], rule: usize| set[rule].slenderness.and_then(|s| s.mean()).unwrap_or(f64::NAN);
    let slivers = largest
        .iter()
        .map(|set| format!("{} {:.1} ({:.1})", set[0].set.title(), slender(set, PAPER_FULL), slender(set, 0)));
    let reason = format!(
        "photons tested by the paper's cost over those of the median, {} photons, leaves of one mean size to a few per cent: fewer than leaf sizes \
         explain in {}; as many in {}; more in {}. On a flat sheet S is shared alike whichever way a piece is cut, so with full leaves these become \
         slivers, typical length over width: {} (the median's). The cost of the grown box: {}{}",
        p.photons[p.photons.len() - 1],
        words(&swept, &is_fewer),
        words(&swept, &|set, r| !is_fewer(set, r) && !is_more(set, r)),
        words(&swept, &is_more),
        slivers.collect::<Vec<_>>().join(", "),
        words(&grown, &|_, _| true),
        other_than_expected(comparisons),
    );
    let verdict = match largest.iter().zip(&swept).filter(|(set, ratio)| is_fewer(set, ratio)).count() {
        0 => Verdict::DoesNotHold,
        n if n == swept.len() => Verdict::Holds,
        _ => Verdict::HoldsWithinLimits,
    };
    (verdict, reason)
}

/// The paper's mean leaf over the median's: close to one, and as much as leaves alone can change what is tested.
fn leaf_ratio(set: &[Tried]) -> f64 {
    let leaf = |rule: usize| set[rule].leaf_size.mean().unwrap_or(f64::NAN);
    leaf(PAPER) / leaf(0)
}

/// Fewer than the median by more than smaller leaves explain.
fn is_fewer(set: &[Tried], ratio: &Interval) -> bool {
    ratio.high < leaf_ratio(set).min(1.0)
}

/// More than the median by more than larger leaves explain.
fn is_more(set: &[Tried], ratio: &Interval) -> bool {
    ratio.low > leaf_ratio(set).max(1.0)
}

/// What was foreseen wrongly is said, whatever the verdict.
fn other_than_expected(comparisons: &[Comparison]) -> String {
    let missed: Vec<&str> = comparisons.iter().filter(|c| c.holds == Some(false)).map(|c| c.label.as_str()).collect();
    if missed.is_empty() { String::new() } else { format!(". Other than expected: {}", missed.join("; ")) }
}

fn rows(tried: &[Tried], names: &[String]) -> Vec<Row> {
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
            let tested = exponent(&sizes, search, |cost| cost.tested, SLOPES);
            rows.push(slope_row(sizes[0].set, rule, &format!("photons tested, {name}"), tested));
        }
    }
    rows
}

fn cost_row(own: &Tried, median: &Tried, search: usize, name: &str) -> Row {
    let ratio = |of| own.ratio(median, search..search + 1, of, 0.99).map(|ratio| ratio.value);
    let (nodes, tested) = (own.mean(search, |cost| cost.nodes), own.mean(search, |cost| cost.tested));
    row([
        ("set", own.set.title().into()),
        ("photons", own.photons.into()),
        ("rule", RULES[own.rule].name.into()),
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
        ("rule", RULES[rule].name.into()),
        ("slope_in_photons_of", of.into()),
        ("slope", slope.map(|s| s.value).into()),
        ("slope_low", slope.map(|s| s.low).into()),
        ("slope_high", slope.map(|s| s.high).into()),
        ("slope_confidence", SLOPES.into()),
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

fn build_rows(times: &BuildTimes, rule: usize) -> Vec<Row> {
    let one = |(i, &photons): (usize, &usize)| {
        row([
            ("set", times.set.title().into()),
            ("rule", RULES[rule].name.into()),
            ("photons", photons.into()),
            ("build_cpu_seconds", times.best(rule, i).into()),
        ])
    };
    let slope = times.exponent(rule, SLOPES);
    let slope = slope_row(times.set, rule, "build CPU seconds", slope);
    times.photons.iter().enumerate().map(one).chain([slope]).collect()
}
