//! `stop-rule`: where the paper's cost stops cutting.

use photonlab_kdtree::{EmptyCost, SplitRule};
use photonlab_measure::{
    Axis, Expected, FigureData, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict, fit_log_log,
};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    photon_set::PhotonSet,
    search::{Cost, Search},
    split_rules::bare_tree,
    table::{Table, row},
};

const SETS: [PhotonSet; 3] = [PhotonSet::Sheet, PhotonSet::Volume, PhotonSet::CornellBox];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    photons: usize,
    queries: usize,
    k: usize,
    /// Ec in areas of the node, ascending from 0.
    units: Vec<f64>,
    /// Fixed leaf sizes, ascending.
    limits: Vec<usize>,
    /// The one of the units that comparisons are made at.
    judged: f64,
    /// Photons in a leaf at scale 1 for which Ec as a constant is chosen.
    constant_leaf: f64,
    /// Factors on all coordinates.
    scales: Vec<f64>,
    /// A relative half-width above this says nothing.
    precision: f64,
}

/// What trees of one rule are like, by replicate.
#[derive(Default)]
struct Trees {
    /// Mean photons a leaf.
    leaf: Vec<f64>,
    largest: Vec<f64>,
    costs: Vec<Cost>,
}

/// One set's trees.
struct Stopped {
    set: PhotonSet,
    by_unit: Vec<Trees>,
    by_limit: Vec<Trees>,
    /// By scale: Ec a constant, and the judged unit.
    constant: Vec<Trees>,
    scaled: Vec<Trees>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut table = Table::new(3 * SETS.len() + 2 + 1);
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let sets: Vec<Stopped> = SETS.iter().map(|&set| Stopped::measure(set, &p)).collect::<anyhow::Result<_>>()?;
    for stopped in &sets {
        stopped.judge(&p, &mut table);
        found.rows.extend(stopped.rows(&p));
    }
    judge_scale(&p, &sets, &mut table);
    found.figures = vec![leaf_chart(&p, &sets, &table), scale_chart(&p, &sets, &table)];
    found.figures.extend(sets.iter().map(|stopped| stopped.cost_chart(&p, &table)));
    let confidence = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| conclude(&p, &sets, confidence));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

fn areas(unit: f64) -> SplitRule {
    SplitRule::SurfaceArea { empty_cost: EmptyCost::NodeAreas(unit) }
}

impl Trees {
    fn add(
        &mut self,
        points: &[[f32; 3]],
        rule: SplitRule,
        limit: usize,
        asked: Option<(Search, &[[f32; 3]])>,
    ) -> anyhow::Result<()> {
        let tree = bare_tree(points, rule, limit)?;
        let shape = tree.shape();
        self.leaf.push(points.len() as f64 / shape.leaves as f64);
        self.largest.push(shape.largest_leaf as f64);
        self.costs.extend(asked.map(|(search, queries)| search.cost(&tree, queries)));
        Ok(())
    }

    fn leaf(&self) -> Replicates {
        self.leaf.iter().copied().collect()
    }

    fn cost(&self, of: fn(&Cost) -> f64) -> Replicates {
        self.costs.iter().map(of).collect()
    }
}

impl Stopped {
    fn measure(set: PhotonSet, p: &Parameters) -> anyhow::Result<Self> {
        let none = |count: usize| (0..count).map(|_| Trees::default()).collect::<Vec<_>>();
        let mut stopped = Self {
            set,
            by_unit: none(p.units.len()),
            by_limit: none(p.limits.len()),
            constant: none(p.scales.len()),
            scaled: none(p.scales.len()),
        };
        for replicate in 0..p.replicates {
            let all = set.draw(p.photons + p.queries, p.seed, replicate)?;
            let (points, queries) = all.split_at(p.photons);
            let asked = Some((Search::Nearest(p.k), queries));
            for (trees, &unit) in stopped.by_unit.iter_mut().zip(&p.units) {
                trees.add(points, areas(unit), 1, asked)?;
            }
            for (trees, &limit) in stopped.by_limit.iter_mut().zip(&p.limits) {
                trees.add(points, areas(0.0), limit, asked)?;
            }
            let empty_cost = EmptyCost::Constant(stopped.constant(p));
            for (i, &scale) in p.scales.iter().enumerate() {
                let larger: Vec<[f32; 3]> = points.iter().map(|q| q.map(|x| x * scale as f32)).collect();
                stopped.constant[i].add(&larger, SplitRule::SurfaceArea { empty_cost }, 1, None)?;
                stopped.scaled[i].add(&larger, areas(p.judged), 1, None)?;
            }
        }
        Ok(stopped)
    }

    /// Where a halving just pays at the wanted leaf: half of S N is saved on a sheet of unit area, a third in a unit cube.
    fn constant(&self, p: &Parameters) -> f64 {
        let (leaf, photons) = (p.constant_leaf, p.photons as f64);
        match self.set {
            PhotonSet::Volume => 2.0 * leaf * (leaf / photons).powf(2.0 / 3.0),
            _ => leaf * leaf / photons,
        }
    }

    fn judged(&self, p: &Parameters) -> Option<&Trees> {
        self.by_unit.iter().zip(&p.units).find(|&(_, &unit)| unit == p.judged).map(|(trees, _)| trees)
    }

    fn judge(&self, p: &Parameters, table: &mut Table) {
        let (title, confidence) = (self.set.title(), table.confidence);
        let one = Expected { value: 1.0, low: 1.0, high: 2.0, source: "each cut lowers S N".into() };
        let single = self.by_unit.first().and_then(|trees| trees.leaf().interval(confidence));
        table.judge(format!("{title}, Ec = 0: photons a leaf"), one, single, p.precision);
        let (low, high) = match self.set {
            PhotonSet::Sheet => (1.0, 2.0),
            PhotonSet::Volume => (1.25, 3.0),
            _ => (1.0, 3.0),
        };
        let soft = Expected { value: 1.3, low, high, source: "a halving pays while it saves more than Ec".into() };
        let leaf =
            self.judged(p).and_then(|trees| trees.leaf().interval(confidence)).map(|leaf| leaf.scaled(1.0 / p.judged));
        table.judge(format!("{title}, Ec = {} S: photons a leaf over {}", p.judged, p.judged), soft, leaf, p.precision);
        let same = Expected { value: 1.0, low: 0.85, high: 1.5, source: "the same cuts, stopped elsewhere".into() };
        let label = format!("{title}, Ec = {} S: photons tested, over a fixed leaf size of the same mean", p.judged);
        table.judge(label, same, self.beside_limit(p).and_then(|r| r.interval(confidence)), p.precision);
    }

    /// Photons tested at the judged unit over those of a leaf limit between two measured ones, replicate by replicate.
    fn beside_limit(&self, p: &Parameters) -> Option<Replicates> {
        let judged = self.judged(p)?;
        let one = |replicate: usize| {
            let leaf = judged.leaf[replicate];
            let next = self.by_limit.iter().position(|trees| trees.leaf[replicate] >= leaf)?.max(1);
            let (low, high) = (&self.by_limit[next - 1], &self.by_limit[next]);
            let along = (leaf / low.leaf[replicate]).ln() / (high.leaf[replicate] / low.leaf[replicate]).ln();
            let [a, b] = [low, high].map(|trees| trees.costs[replicate].tested);
            Some(judged.costs[replicate].tested / (a * (b / a).powf(along)))
        };
        (0..judged.leaf.len()).map(one).collect()
    }

    /// Exponent of the leaf size in the scale with Ec a constant.
    fn scale_slope(&self, p: &Parameters, confidence: f64) -> Option<Interval> {
        let one = |replicate: usize| {
            let leaves: Vec<f64> = self.constant.iter().map(|trees| trees.leaf[replicate]).collect();
            Some(fit_log_log(&p.scales, &leaves).ok()?.slope)
        };
        (0..self.constant[0].leaf.len()).map(one).collect::<Option<Replicates>>()?.interval(confidence)
    }

    fn rows(&self, p: &Parameters) -> Vec<photonlab_measure::Row> {
        let one = |rule: String, scale: f64, trees: &Trees| {
            row([
                ("set", self.set.title().into()),
                ("stop", rule.into()),
                ("scale", scale.into()),
                ("replicates", trees.leaf.len().into()),
                ("leaf_size", trees.leaf().mean().into()),
                ("leaf_size_std_error", trees.leaf().std_error().into()),
                ("largest_leaf", trees.largest.iter().copied().fold(0.0_f64, f64::max).into()),
                ("nodes", trees.cost(|cost| cost.nodes).mean().into()),
                ("tested", trees.cost(|cost| cost.tested).mean().into()),
            ])
        };
        let units = self.by_unit.iter().zip(&p.units).map(|(trees, unit)| one(format!("Ec = {unit} S"), 1.0, trees));
        let limits = self.by_limit.iter().zip(&p.limits).map(|(trees, n)| one(format!("{n} photons"), 1.0, trees));
        let constant = format!("Ec = {:.4} m^2", self.constant(p));
        let constants = self.constant.iter().zip(&p.scales).map(|(trees, &scale)| one(constant.clone(), scale, trees));
        units.chain(limits).chain(constants).collect()
    }

    /// Work of a query over the leaf size, by either way to stop.
    fn cost_chart(&self, p: &Parameters, table: &Table) -> FigureData {
        let series = |label: &str, all: &[Trees], of: fn(&Cost) -> f64| {
            let point =
                |trees: &Trees| Some(Point::measured(trees.leaf().mean()?, trees.cost(of).interval(table.confidence)?));
            Series { label: label.into(), kind: SeriesKind::Measured, points: all.iter().filter_map(point).collect() }
        };
        let id = self.set.title().to_lowercase().replace(' ', "-");
        FigureData {
            id: format!("cost-{id}"),
            title: format!("Work of a query against the mean leaf size, {}", self.set.title()),
            caption: format!(
                "{} nearest among {} photons; Ec from {} to {} areas of the node, fixed limits from {} to {} photons. {} replicates of \
                 {} queries; {}.",
                p.k,
                p.photons,
                p.units[0],
                p.units[p.units.len() - 1],
                p.limits[0],
                p.limits[p.limits.len() - 1],
                p.replicates,
                p.queries,
                table.intervals()
            ),
            x: Axis::log("mean photons a leaf"),
            y: Axis::log("nodes opened or photons tested by a query"),
            series: vec![
                series("photons, stopped by Ec", &self.by_unit, |cost| cost.tested),
                series("photons, fixed limit", &self.by_limit, |cost| cost.tested),
                series("nodes, stopped by Ec", &self.by_unit, |cost| cost.nodes),
                series("nodes, fixed limit", &self.by_limit, |cost| cost.nodes),
            ],
        }
    }
}

/// A constant makes leaves depend on the unit of length, the node's area does not.
fn judge_scale(p: &Parameters, sets: &[Stopped], table: &mut Table) {
    for (stopped, power, source) in [
        (&sets[0], -1.0, "N^2 over the density, which goes as scale^-2"),
        (&sets[1], -1.2, "N^(5/3) over the density to the 2/3, which goes as scale^-3"),
    ] {
        let label = format!("{}, Ec constant: exponent of the leaf size in the scale", stopped.set.title());
        let slope = stopped.scale_slope(p, table.confidence);
        table.judge(label, Expected::within(power, 0.1, source), slope, p.precision);
    }
    let ratios = sets.iter().flat_map(|stopped| {
        let first = &stopped.scaled[0].leaf;
        stopped.scaled.iter().flat_map(move |trees| trees.leaf.iter().zip(first).map(|(leaf, first)| leaf / first))
    });
    let (low, high) = ratios.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
    let exact = Interval { value: 1.0, low, high, confidence: table.confidence };
    let label = format!("all sets, Ec = {} S: leaf size over that at the first scale", p.judged);
    table.judge(
        label,
        Expected::within(1.0, 0.005, "the scale drops out, up to the rounding of coordinates"),
        Some(exact),
        p.precision,
    );
}

fn conclude(p: &Parameters, sets: &[Stopped], confidence: f64) -> (Verdict, String) {
    let number = |x: Option<f64>| x.map_or("unknown".into(), |x| format!("{x:.2}"));
    let interval =
        |x: Option<Interval>| x.map_or("unknown".into(), |x| format!("{:.2} ({:.2} to {:.2})", x.value, x.low, x.high));
    let words = |of: &dyn Fn(&Stopped) -> String| {
        sets.iter().map(|s| format!("{} {}", s.set.title(), of(s))).collect::<Vec<_>>().join(", ")
    };
    let single = words(&|s| number(s.by_unit[0].leaf().mean()));
    let soft = words(&|s| {
        let leaf = s.judged(p).and_then(|trees| trees.leaf().interval(confidence));
        interval(leaf.map(|leaf| leaf.scaled(1.0 / p.judged)))
    });
    let beside = words(&|s| interval(s.beside_limit(p).and_then(|ratio| ratio.interval(confidence))));
    let reason = format!(
        "with Ec = 0 nothing stops before single photons (photons a leaf: {single}). Ec = e S is a soft leaf size (mean leaf over e at \
         e = {}: {soft}), and queries test as many photons as with a fixed leaf size of the same mean (ratio: {beside}). With Ec a \
         constant the leaf depends on the unit of length (exponents: sheet {}, volume {})",
        p.judged,
        interval(sets[0].scale_slope(p, confidence)),
        interval(sets[1].scale_slope(p, confidence))
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn leaf_chart(p: &Parameters, sets: &[Stopped], table: &Table) -> FigureData {
    let mut series: Vec<Series> = sets
        .iter()
        .map(|stopped| {
            let units = p.units.iter().zip(&stopped.by_unit).filter(|&(&unit, _)| unit > 0.0);
            let point =
                |(&unit, trees): (&f64, &Trees)| Some(Point::measured(unit, trees.leaf().interval(table.confidence)?));
            let label = stopped.set.title().into();
            Series { label, kind: SeriesKind::Measured, points: units.filter_map(point).collect() }
        })
        .collect();
    for (label, factor) in [("e photons", 1.0), ("2 e photons", 2.0), ("3 e photons", 3.0)] {
        let points = p.units.iter().filter(|&&unit| unit > 0.0).map(|&unit| Point::new(unit, factor * unit)).collect();
        series.push(Series { label: label.into(), kind: SeriesKind::Reference, points });
    }
    FigureData {
        id: "leaf-size".into(),
        title: "Mean leaf size against the cost of an empty node".into(),
        caption: format!(
            "Ec = e S, S the surface area of the node at hand; {} photons, {} replicates; {}.",
            p.photons,
            p.replicates,
            table.intervals()
        ),
        x: Axis::log("e, cost of an empty node in areas of the node"),
        y: Axis::log("mean photons a leaf"),
        series,
    }
}

fn scale_chart(p: &Parameters, sets: &[Stopped], table: &Table) -> FigureData {
    let series = sets.iter().take(2).zip([0.97, 1.03]).flat_map(|(stopped, aside)| {
        [("Ec constant", &stopped.constant), ("Ec in areas", &stopped.scaled)].map(|(name, all)| {
            let point = move |(&scale, trees): (&f64, &Trees)| {
                Some(Point::measured(aside * scale, trees.leaf().interval(table.confidence)?))
            };
            let points = p.scales.iter().zip(all).filter_map(point).collect();
            Series { label: format!("{}, {name}", stopped.set.title()), kind: SeriesKind::Measured, points }
        })
    });
    FigureData {
        id: "scale".into(),
        title: "Mean leaf size against the unit of length".into(),
        caption: format!(
            "The same photons, all coordinates times the scale; marks of one scale stand side by side. Even sets are halved, so leaf sizes \
             go by octaves. The constant is chosen for leaves of about {} at scale 1. {} photons, {} \
             replicates; {}.",
            p.constant_leaf,
            p.photons,
            p.replicates,
            table.intervals()
        ),
        x: Axis::log("scale"),
        y: Axis::log("mean photons a leaf"),
        series: series.collect(),
    }
}
