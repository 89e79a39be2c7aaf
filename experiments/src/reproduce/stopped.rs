//! Trees stopped in several ways, and what they are like.

use photonlab_kdtree::{EmptyCost, SplitRule};
use photonlab_measure::{Interval, Replicates, fit_log_log};
use serde::Deserialize;

use super::{
    photon_set::PhotonSet,
    search::{Cost, Search},
    split_rules::bare_tree,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Parameters {
    pub(super) seed: u64,
    pub(super) replicates: u64,
    pub(super) photons: usize,
    pub(super) queries: usize,
    pub(super) k: usize,
    /// Ec in areas of the node, ascending from 0.
    pub(super) units: Vec<f64>,
    /// Fixed leaf sizes, ascending.
    pub(super) limits: Vec<usize>,
    /// The one of the units that comparisons are made at.
    pub(super) judged: f64,
    /// Photons in a leaf at scale 1 for which Ec as a constant is chosen.
    pub(super) constant_leaf: f64,
    /// Factors on all coordinates.
    pub(super) scales: Vec<f64>,
    /// A relative half-width above this says nothing.
    pub(super) precision: f64,
}

/// What trees of one rule are like, by replicate.
#[derive(Default)]
pub(super) struct Trees {
    /// Mean photons a leaf.
    pub(super) leaf: Vec<f64>,
    pub(super) largest: Vec<f64>,
    pub(super) costs: Vec<Cost>,
}

/// One set's trees.
pub(super) struct Stopped {
    pub(super) set: PhotonSet,
    pub(super) by_unit: Vec<Trees>,
    pub(super) by_limit: Vec<Trees>,
    /// By scale: Ec a constant, and the judged unit.
    pub(super) constant: Vec<Trees>,
    pub(super) scaled: Vec<Trees>,
}

pub(super) fn areas(unit: f64) -> SplitRule {
    SplitRule::SurfaceArea { empty_cost: EmptyCost::NodeAreas(unit) }
}

impl Trees {
    pub(super) fn add(
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

    pub(super) fn leaf(&self) -> Replicates {
        self.leaf.iter().copied().collect()
    }

    pub(super) fn cost(&self, of: fn(&Cost) -> f64) -> Replicates {
        self.costs.iter().map(of).collect()
    }
}

impl Stopped {
    pub(super) fn measure(set: PhotonSet, p: &Parameters) -> anyhow::Result<Self> {
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
    pub(super) fn constant(&self, p: &Parameters) -> f64 {
        let (leaf, photons) = (p.constant_leaf, p.photons as f64);
        match self.set {
            PhotonSet::Volume => 2.0 * leaf * (leaf / photons).powf(2.0 / 3.0),
            _ => leaf * leaf / photons,
        }
    }

    pub(super) fn judged(&self, p: &Parameters) -> Option<&Trees> {
        self.by_unit.iter().zip(&p.units).find(|&(_, &unit)| unit == p.judged).map(|(trees, _)| trees)
    }

    /// Photons tested at the judged unit over those of a leaf limit between two measured ones, replicate by replicate.
    pub(super) fn beside_limit(&self, p: &Parameters) -> Option<Replicates> {
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
    pub(super) fn scale_slope(&self, p: &Parameters, confidence: f64) -> Option<Interval> {
        let one = |replicate: usize| {
            let leaves: Vec<f64> = self.constant.iter().map(|trees| trees.leaf[replicate]).collect();
            Some(fit_log_log(&p.scales, &leaves).ok()?.slope)
        };
        (0..self.constant[0].leaf.len()).map(one).collect::<Option<Replicates>>()?.interval(confidence)
    }
}
