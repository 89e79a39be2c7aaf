//! `range-search`: how the work of a query grows with the photons, on average and at worst.

use photonlab_measure::{
    Axis, Expected, FigureData, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict, fit_log_log,
};

use crate::reproduce::{
    context::{Context, Findings},
    growth::{Grown, Growth, Parameters, equally_far, nodes, sizes, vain},
    photon_set::PhotonSet,
    search::Cost,
    table::{Table, row},
};

const SETS: [(PhotonSet, i32); 2] = [(PhotonSet::Sheet, 2), (PhotonSet::Volume, 3)];

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
    fn series(&self, label: &str, photons: &[usize], of: fn(&Cost) -> f64, table: &Table) -> Series {
        let point = |(&n, costs): (&usize, &Vec<Cost>)| {
            let values: Replicates = costs.iter().map(of).collect();
            Some(Point::measured(n as f64, values.interval(table.confidence)?))
        };
        let points = photons.iter().zip(&self.costs).filter_map(point).collect();
        Series { label: label.into(), kind: SeriesKind::Measured, points }
    }
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
