//! `stop-rule`: where the paper's cost stops cutting.

use photonlab_measure::{Expected, Interval, Record, Verdict};

use crate::reproduce::{
    context::{Context, Findings},
    photon_set::PhotonSet,
    stop_charts::{leaf_chart, scale_chart},
    stopped::{Parameters, Stopped, Trees},
    table::{Table, row},
};

const SETS: [PhotonSet; 3] = [PhotonSet::Sheet, PhotonSet::Volume, PhotonSet::CornellBox];

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

impl Stopped {
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
