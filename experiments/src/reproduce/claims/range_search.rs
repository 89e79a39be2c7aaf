//! `range-search`: how the work of a query grows with the photons, on average and at worst.

use std::f64::consts::PI;

use photonlab_kdtree::{DEFAULT_LEAF_LIMIT, SplitRule};
use photonlab_measure::{
    Axis, Expected, FigureData, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict, fit_log_log,
};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    field::stream,
    photon_set::PhotonSet,
    search::{Cost, Search, radius_holding},
    split_rules::bare_tree,
    table::{Table, row},
};

const SETS: [(PhotonSet, i32); 2] = [(PhotonSet::Sheet, 2), (PhotonSet::Volume, 3)];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Ascending.
    photons: Vec<usize>,
    queries: usize,
    k: Vec<usize>,
    /// Photons in the radius that shrinks as they crowd.
    held: usize,
    /// Photons in the fixed radius at the fewest photons.
    fixed_held: usize,
    /// Photons of the worst case.
    worst: Vec<usize>,
    /// A slope known worse than this (half-width) says nothing.
    precision: f64,
}

/// One search on one set, by size and replicate.
struct Growth {
    name: String,
    costs: Vec<Vec<Cost>>,
}

/// The searches of one set; the fixed radius is the last.
struct Grown {
    set: PhotonSet,
    dimension: i32,
    fixed_radius: f64,
    searches: Vec<Growth>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut table = Table::new(SETS.len() * (p.k.len() + 2) + 2);
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let sets: Vec<Grown> = SETS.iter().map(|&(set, d)| Grown::measure(set, d, &p)).collect::<anyhow::Result<_>>()?;
    for grown in &sets {
        grown.judge(&p, &mut table);
        found.rows.extend(grown.rows(&p));
    }
    let worst: Vec<[f64; 2]> = p.worst.iter().map(|&n| equally_far(n, &p)).collect::<anyhow::Result<_>>()?;
    for (i, what) in ["photons tested, of all", "nodes opened, of all"].into_iter().enumerate() {
        let shares = worst.iter().map(|shares| shares[i]);
        let (low, high) = shares.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        let exact = Interval { value: low, low, high, confidence: table.confidence };
        table.judge(
            format!("all photons equally far: {what}"),
            Expected::exact(1.0, "no box can be skipped"),
            Some(exact),
            p.precision,
        );
    }
    found.figures = sets.iter().map(|grown| grown.chart(&p, &table)).collect();
    found.figures.push(in_vain_chart(&p, &sets, &table));
    let confidence = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| conclude(&p, &sets, confidence));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

impl Grown {
    fn measure(set: PhotonSet, dimension: i32, p: &Parameters) -> anyhow::Result<Self> {
        let names = p.k.iter().map(|k| format!("{k} nearest"));
        let names = names.chain([format!("radius of {} photons", p.held), "fixed radius".into()]);
        let mut searches: Vec<Growth> =
            names.map(|name| Growth { name, costs: vec![Vec::new(); p.photons.len()] }).collect();
        let most = p.photons.iter().copied().max().unwrap_or(0);
        // Holds the photons in the open, far from the set's ends.
        let density = p.fixed_held as f64 / p.photons[0] as f64;
        let fixed_radius = if dimension == 2 { (density / PI).sqrt() } else { (0.75 * density / PI).cbrt() };
        for replicate in 0..p.replicates {
            let all = set.draw(most + p.queries, p.seed, replicate)?;
            for (i, &photons) in p.photons.iter().enumerate() {
                let tree = bare_tree(&all[..photons], SplitRule::Median, DEFAULT_LEAF_LIMIT)?;
                let queries = &all[most..];
                let held = Search::Radius(radius_holding(&tree, queries, p.held));
                let nearest = p.k.iter().map(|&k| Search::Nearest(k));
                let asked = nearest.chain([held, Search::Radius(fixed_radius as f32)]);
                for (growth, search) in searches.iter_mut().zip(asked) {
                    growth.costs[i].push(search.cost(&tree, queries));
                }
            }
        }
        Ok(Self { set, dimension, fixed_radius, searches })
    }

    /// The exponent of the worst-case bound.
    fn bound(&self) -> f64 {
        1.0 - 1.0 / f64::from(self.dimension)
    }

    fn fixed(&self) -> &Growth {
        &self.searches[self.searches.len() - 1]
    }

    /// Photons tested in vain by a ball of the fixed radius, by Steiner's formula for a cubic leaf of sixteen.
    fn in_vain(&self, photons: f64) -> f64 {
        let (r, edge) = (self.fixed_radius, (16.0 / photons).powf(1.0 / f64::from(self.dimension)));
        match self.dimension {
            2 => photons * edge * (edge + 4.0 * r),
            _ => photons * edge * (edge * edge + r * (6.0 * edge + 3.0 * PI * r)),
        }
    }

    fn judge(&self, p: &Parameters, table: &mut Table) {
        let title = self.set.title();
        let source = "O(log n) + c(k, d), Friedman, Bentley and Finkel 1977";
        for growth in &self.searches[..self.searches.len() - 1] {
            let expected = Expected { value: 0.05, low: 0.0, high: 0.1, source: source.into() };
            let slope = growth.slope(&p.photons, nodes, table.confidence);
            table.judge(
                format!("{title}, {}: slope of nodes opened", growth.name),
                expected,
                slope,
                p.precision / 0.05,
            );
        }
        let law: Vec<f64> = p.photons.iter().map(|&n| self.in_vain(n as f64)).collect();
        let steiner = fit_log_log(&sizes(&p.photons), &law).map_or(self.bound(), |fit| fit.slope);
        let source = "a leaf's edge goes as n^(-1/d); below the bound by the lower terms of Steiner's formula";
        let expected =
            Expected { value: steiner, low: steiner - 0.06, high: self.bound() + 0.03, source: source.into() };
        let slope = self.fixed().slope(&p.photons, vain, table.confidence);
        let label = format!("{title}, fixed radius: slope of photons tested in vain");
        table.judge(label, expected, slope, p.precision / steiner);
    }

    fn rows(&self, p: &Parameters) -> Vec<photonlab_measure::Row> {
        let mut rows = Vec::new();
        for growth in &self.searches {
            for (&photons, costs) in p.photons.iter().zip(&growth.costs) {
                let of = |of: fn(&Cost) -> f64| -> Replicates { costs.iter().map(of).collect() };
                rows.push(row([
                    ("set", self.set.title().into()),
                    ("search", growth.name.as_str().into()),
                    ("photons", photons.into()),
                    ("replicates", costs.len().into()),
                    ("nodes", of(nodes).mean().into()),
                    ("nodes_std_error", of(nodes).std_error().into()),
                    ("tested", of(|cost| cost.tested).mean().into()),
                    ("found", of(|cost| cost.found).mean().into()),
                    ("tested_in_vain", of(vain).mean().into()),
                    ("tested_in_vain_std_error", of(vain).std_error().into()),
                ]));
            }
        }
        rows
    }

    fn chart(&self, p: &Parameters, table: &Table) -> FigureData {
        let mut series: Vec<Series> =
            self.searches.iter().map(|growth| growth.series(&growth.name, &p.photons, nodes, table)).collect();
        let first = self.searches[0].costs[0].iter().map(nodes).collect::<Replicates>().mean().unwrap_or(f64::NAN);
        let bound = |&n: &usize| Point::new(n as f64, first * (n as f64 / p.photons[0] as f64).powf(self.bound()));
        series.push(Series {
            label: format!("n^(1 - 1/{}), through the first mark", self.dimension),
            kind: SeriesKind::Reference,
            points: p.photons.iter().map(bound).collect(),
        });
        FigureData {
            id: format!("nodes-{}", self.set.title()),
            title: format!("Nodes opened by a query at a photon, {}", self.set.title()),
            caption: format!(
                "Median rule; {} replicates of {} queries; {}. A fixed radius finds photons in proportion to n.",
                p.replicates,
                p.queries,
                table.intervals()
            ),
            x: Axis::log("photons n"),
            y: Axis::log("nodes opened, leaves included"),
            series,
        }
    }
}

impl Growth {
    /// The interval is that of the replicates' own slopes.
    fn slope(&self, photons: &[usize], of: fn(&Cost) -> f64, confidence: f64) -> Option<Interval> {
        let one = |replicate: usize| {
            let values: Vec<f64> = self.costs.iter().map(|costs| of(&costs[replicate])).collect();
            Some(fit_log_log(&sizes(photons), &values).ok()?.slope)
        };
        (0..self.costs[0].len()).map(one).collect::<Option<Replicates>>()?.interval(confidence)
    }

    fn series(&self, label: &str, photons: &[usize], of: fn(&Cost) -> f64, table: &Table) -> Series {
        let point = |(&n, costs): (&usize, &Vec<Cost>)| {
            let values: Replicates = costs.iter().map(of).collect();
            Some(Point::measured(n as f64, values.interval(table.confidence)?))
        };
        let points = photons.iter().zip(&self.costs).filter_map(point).collect();
        Series { label: label.into(), kind: SeriesKind::Measured, points }
    }
}

fn nodes(cost: &Cost) -> f64 {
    cost.nodes
}

fn vain(cost: &Cost) -> f64 {
    cost.tested - cost.found
}

fn sizes(photons: &[usize]) -> Vec<f64> {
    photons.iter().map(|&n| n as f64).collect()
}

/// Shares of photons tested and of nodes opened by a query at the centre of a sphere that holds all photons.
fn equally_far(photons: usize, p: &Parameters) -> anyhow::Result<[f64; 2]> {
    let mut random = stream(p.seed, 1 << 40);
    let on_sphere = |_| {
        let [u, v] = random.next2();
        let (z, angle) = (2.0 * u - 1.0, 2.0 * PI * v);
        let rim = (1.0 - z * z).sqrt();
        [rim * angle.cos(), rim * angle.sin(), z].map(|x| x as f32)
    };
    let points: Vec<[f32; 3]> = (0..photons).map(on_sphere).collect();
    let tree = bare_tree(&points, SplitRule::Median, DEFAULT_LEAF_LIMIT)?;
    let cost = Search::Nearest(p.k[0]).cost(&tree, &[[0.0; 3]]);
    Ok([cost.tested / photons as f64, cost.nodes / tree.shape().nodes as f64])
}

fn conclude(p: &Parameters, sets: &[Grown], confidence: f64) -> (Verdict, String) {
    let text = |slope: Option<Interval>| {
        slope.map_or("unknown".into(), |s| format!("{:.3} ({:.3} to {:.3})", s.value, s.low, s.high))
    };
    let words = sets.iter().map(|grown| {
        format!(
            "{}: {} for the {}, where the bound says {:.2}; photons tested in vain at a fixed radius go as n^{}",
            grown.set.title(),
            text(grown.searches[0].slope(&p.photons, nodes, confidence)),
            grown.searches[0].name,
            grown.bound(),
            text(grown.fixed().slope(&p.photons, vain, confidence))
        )
    });
    let reason = format!(
        "exponents in n of the nodes opened, {} to {} photons. {}. So the formula describes the rim of a range of fixed size, not a \
         gather; and where all photons are equally far, every node is opened and every photon tested",
        p.photons[0],
        p.photons[p.photons.len() - 1],
        words.collect::<Vec<_>>().join(". ")
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn in_vain_chart(p: &Parameters, sets: &[Grown], table: &Table) -> FigureData {
    let series = sets.iter().flat_map(|grown| {
        let law = p.photons.iter().map(|&n| Point::new(n as f64, grown.in_vain(n as f64))).collect();
        [
            grown.fixed().series(grown.set.title(), &p.photons, vain, table),
            Series {
                label: format!("{}: law of the grown leaf", grown.set.title()),
                kind: SeriesKind::Predicted,
                points: law,
            },
        ]
    });
    FigureData {
        id: "in-vain".into(),
        title: "Photons tested in vain at a fixed radius".into(),
        caption: format!(
            "Tested less found; the radius holds {} photons at the smallest n, far from the ends of the set. The law takes leaves for cubes of sixteen photons far from all ends: \
             tight boxes and queries near an end test fewer. {} replicates of {} \
             queries; {}.",
            p.fixed_held,
            p.replicates,
            p.queries,
            table.intervals()
        ),
        x: Axis::log("photons n"),
        y: Axis::log("photons tested in vain by a query"),
        series: series.collect(),
    }
}
