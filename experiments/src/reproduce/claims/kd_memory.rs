//! `kd-memory`: the bytes that a tree adds to its photons, and building beside tracing.

use photonlab_kdtree::{KdTree, SplitRule, TreeShape};
use photonlab_measure::{Axis, Comparison, Expected, FigureData, Interval, Point, Record, Series, SeriesKind, Verdict};
use photonlab_photometry::{PackedDirection, PathClass, Photon};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    photon_set::PhotonSet,
    split_rules::PAPER,
    table::row,
};

const SETS: [PhotonSet; 4] = [PhotonSet::Cube, PhotonSet::CornellBox, PhotonSet::BallLens, PhotonSet::Volume];
/// Bytes a photon of nodes that are all full, and the most that is expected.
const FULL: f64 = 512.0 / 256.0 * 16.0 / 15.0;
const MOST: f64 = 5.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Ascending.
    photons: Vec<usize>,
}

/// One tree.
struct Held {
    set: PhotonSet,
    rule: &'static str,
    photons: usize,
    /// Bytes of a position with its payload.
    photon_bytes: usize,
    shape: TreeShape,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let mut all = Vec::new();
    for set in SETS {
        for replicate in 0..p.replicates {
            for &photons in &p.photons {
                let points = set.draw(photons, p.seed, replicate)?;
                all.extend(hold::<1>(set, &points)?);
                all.extend(hold::<3>(set, &points)?);
            }
        }
    }
    for set in SETS {
        found.comparisons.extend(["median", "default"].map(|rule| compare(&all, set, rule)));
    }
    found.rows = all.iter().map(Held::row).collect();
    found.figures = vec![overhead_chart(&p, &all), share_chart(&p, &all)];
    let (verdict, reason) = conclude(&all, &found.comparisons);
    Ok(context.record(found, verdict, reason))
}

/// The trees of one payload by every rule.
fn hold<const C: usize>(set: PhotonSet, points: &[[f32; 3]]) -> anyhow::Result<Vec<Held>> {
    let down = PackedDirection::pack([0.0, 0.0, -1.0]);
    let up = PackedDirection::pack([0.0, 0.0, 1.0]);
    let photon = Photon { flux: [1.0; C], direction: down, normal: up, class: PathClass::Direct, segments: 1 };
    let rules = [("median", SplitRule::Median), ("default", SplitRule::default()), ("paper's S N, exact sweep", PAPER)];
    let one = |(rule, split)| {
        let (points, photons) = (points.to_vec(), points.len());
        let tree = KdTree::build(points, vec![photon; photons], split)?;
        let photon_bytes = size_of::<[f32; 3]>() + size_of::<Photon<C>>();
        Ok(Held { set, rule, photons, photon_bytes, shape: tree.shape() })
    };
    rules.into_iter().map(one).collect()
}

impl Held {
    /// Bytes that the tree adds to a photon.
    fn overhead(&self) -> f64 {
        self.shape.overhead_bytes as f64 / self.photons as f64
    }

    fn share(&self) -> f64 {
        self.overhead() / self.photon_bytes as f64
    }

    fn row(&self) -> photonlab_measure::Row {
        row([
            ("set", self.set.title().into()),
            ("rule", self.rule.into()),
            ("photons", self.photons.into()),
            ("photon_bytes", self.photon_bytes.into()),
            ("bytes", self.shape.bytes.into()),
            ("overhead_bytes_per_photon", self.overhead().into()),
            ("nodes", self.shape.nodes.into()),
            ("leaves", self.shape.leaves.into()),
            ("depth", self.shape.depth.into()),
        ])
    }
}

/// The least, the mean and the most over what `chosen` takes.
fn range(all: &[Held], chosen: impl Fn(&Held) -> bool, of: impl Fn(&Held) -> f64) -> Interval {
    let values: Vec<f64> = all.iter().filter(|held| chosen(held)).map(of).collect();
    let (low, high) = values.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &x| (l.min(x), h.max(x)));
    Interval { value: values.iter().sum::<f64>() / values.len() as f64, low, high, confidence: 0.99 }
}

fn compare(all: &[Held], set: PhotonSet, rule: &str) -> Comparison {
    let expected = Expected {
        value: FULL,
        low: FULL - 0.04,
        high: MOST,
        source: "one box of six numbers for sixteen photons".into(),
    };
    let measured = range(all, |held| held.set == set && held.rule == rule, Held::overhead);
    let label = format!("{}, {rule} rule: bytes that the tree adds to a photon", set.title());
    let mut comparison = Comparison::judge(label, "B", expected, Some(measured))
        .with_note("exact counts: the range over replicates, sizes and payloads");
    comparison.holds = Some(FULL - 0.04 <= measured.low && measured.high <= MOST);
    comparison
}

fn conclude(all: &[Held], comparisons: &[Comparison]) -> (Verdict, String) {
    let used = |held: &Held| held.rule != "paper's S N, exact sweep";
    let bytes = range(all, used, Held::overhead);
    let grey = all.iter().map(|held| held.photon_bytes).min().unwrap_or(0);
    let rgb = all.iter().map(|held| held.photon_bytes).max().unwrap_or(0);
    let share = |size: usize| 100.0 * range(all, |held| used(held) && held.photon_bytes == size, Held::share).high;
    let paper = range(all, |held| !used(held), Held::overhead);
    let reason = format!(
        "median and default trees add {:.2} to {:.2} bytes a photon to {grey} (grey) or {rgb} (RGB): at most {:.0} and {:.0} %. The \
         paper's rule, whose leaves are not full, adds {:.1} to {:.1}",
        bytes.low,
        bytes.high,
        share(grey),
        share(rgb),
        paper.low,
        paper.high
    );
    match comparisons.iter().all(|c| c.holds == Some(true)) {
        true => (Verdict::Holds, reason),
        false => (Verdict::DoesNotHold, reason),
    }
}

/// Marks of one rule over the sets.
fn over_sets(all: &[Held], aside: f64, label: &str, chosen: impl Fn(&Held) -> bool, of: fn(&Held) -> f64) -> Series {
    let point = |(i, set): (usize, PhotonSet)| {
        Point::measured(i as f64 + 1.0 + aside, range(all, |held| held.set == set && chosen(held), of))
    };
    Series {
        label: label.into(),
        kind: SeriesKind::Measured,
        points: SETS.into_iter().enumerate().map(point).collect(),
    }
}

fn overhead_chart(p: &Parameters, all: &[Held]) -> FigureData {
    let rules = ["median", "default", "paper's S N, exact sweep"];
    let series = rules
        .iter()
        .enumerate()
        .map(|(i, &rule)| over_sets(all, 0.12 * (i as f64 - 1.0), rule, |held| held.rule == rule, Held::overhead));
    FigureData {
        id: "overhead".into(),
        title: "Bytes that the tree adds to a photon".into(),
        caption: format!("Counted; bars: least and most over {} replicates and {:?} photons.", p.replicates, p.photons),
        x: Axis::named("photon set", SETS.map(PhotonSet::title)),
        y: Axis::linear("bytes a photon beside position and payload"),
        series: series.collect(),
    }
}

fn share_chart(p: &Parameters, all: &[Held]) -> FigureData {
    let mut sizes: Vec<usize> = all.iter().map(|held| held.photon_bytes).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let series = sizes.iter().zip(["grey", "RGB"]).enumerate().map(|(i, (&size, name))| {
        let chosen = |held: &Held| held.photon_bytes == size && held.rule == "default";
        over_sets(all, 0.12 * (i as f64 - 0.5), &format!("{name}, {size} bytes a photon"), chosen, |held| {
            100.0 * held.share()
        })
    });
    FigureData {
        id: "share".into(),
        title: "Memory of the default tree beside its photons".into(),
        caption: format!("Counted; bars: least and most over {} replicates and {:?} photons.", p.replicates, p.photons),
        x: Axis::named("photon set", SETS.map(PhotonSet::title)),
        y: Axis::linear("tree, % of positions and payloads"),
        series: series.collect(),
    }
}
