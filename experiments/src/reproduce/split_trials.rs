//! Every split rule on the same photons with the same queries, over sets, sizes and replicates.

use std::ops::Range;

use photonlab_kdtree::KdTree;
use photonlab_measure::{Interval, Replicates, fit_log_log};

use super::{
    photon_set::PhotonSet,
    search::{Cost, Search, radius_holding},
    split_rules::{RULES, bare_tree},
};

/// What is run.
pub(super) struct Plan<'a> {
    pub(super) seed: u64,
    pub(super) replicates: u64,
    pub(super) photons: &'a [usize],
    pub(super) queries: usize,
    pub(super) k: &'a [usize],
    pub(super) radius_counts: &'a [usize],
}

/// One rule on one set of one size, by replicate.
pub(super) struct Tried {
    pub(super) set: PhotonSet,
    pub(super) photons: usize,
    /// Its place in [`RULES`].
    pub(super) rule: usize,
    pub(super) leaf_size: Replicates,
    /// Median over leaves of the box's longest edge over the second; of full leaves alone.
    pub(super) slenderness: Option<Replicates>,
    /// In the order of [`Plan::names`].
    pub(super) searches: Vec<Vec<Cost>>,
}

impl Plan<'_> {
    /// The searches.
    pub(super) fn names(&self) -> Vec<String> {
        let nearest = self.k.iter().map(|k| format!("{k} nearest"));
        nearest.chain(self.radius_counts.iter().map(|count| format!("radius of {count}"))).collect()
    }

    /// Runs all of it on one set.
    pub(super) fn run(&self, set: PhotonSet) -> anyhow::Result<Vec<Tried>> {
        let sizes = self.photons.iter().flat_map(|&photons| (0..RULES.len()).map(move |rule| (photons, rule)));
        let mut tried: Vec<Tried> = sizes.map(|(photons, rule)| Tried::new(set, photons, rule, self)).collect();
        let most = self.photons.iter().copied().max().unwrap_or(0);
        for replicate in 0..self.replicates {
            let all = set.draw(most + self.queries, self.seed, replicate)?;
            for (number, &photons) in self.photons.iter().enumerate() {
                let row = &mut tried[number * RULES.len()..][..RULES.len()];
                self.compare(&all[..photons], &all[most..], row)?;
            }
        }
        Ok(tried)
    }

    /// One replicate of one size: every rule meets the same photons and queries.
    fn compare(&self, points: &[[f32; 3]], queries: &[[f32; 3]], row: &mut [Tried]) -> anyhow::Result<()> {
        let mut searches = Vec::new();
        for (tried, named) in row.iter_mut().zip(&RULES) {
            let tree = bare_tree(points, named.rule, named.limit)?;
            if searches.is_empty() {
                searches = self.searches(&tree, queries);
            }
            tried.leaf_size.push(points.len() as f64 / tree.shape().leaves as f64);
            if let Some(slenderness) = &mut tried.slenderness {
                slenderness.push(median_slenderness(&tree));
            }
            for (costs, search) in tried.searches.iter_mut().zip(&searches) {
                costs.push(search.cost(&tree, queries));
            }
        }
        Ok(())
    }

    fn searches(&self, tree: &KdTree<()>, queries: &[[f32; 3]]) -> Vec<Search> {
        let radius = |&count: &usize| Search::Radius(radius_holding(tree, queries, count));
        self.k.iter().map(|&k| Search::Nearest(k)).chain(self.radius_counts.iter().map(radius)).collect()
    }
}

impl Tried {
    fn new(set: PhotonSet, photons: usize, rule: usize, plan: &Plan) -> Self {
        // The exact sweep cuts anywhere; the other rules fill their leaves.
        let slenderness = (rule != 1).then(Replicates::new);
        let searches = vec![Vec::new(); plan.names().len()];
        Self { set, photons, rule, leaf_size: Replicates::new(), slenderness, searches }
    }

    /// The mean of what `of` says of a search.
    pub(super) fn mean(&self, search: usize, of: fn(&Cost) -> f64) -> Replicates {
        self.searches[search].iter().map(of).collect()
    }

    /// The mean of what `of` says of some searches, over that of another rule: the geometric mean over searches and
    /// replicates, with an interval that is even in logarithms, for ratios far from one scatter in proportion.
    pub(super) fn ratio(
        &self,
        other: &Tried,
        searches: Range<usize>,
        of: fn(&Cost) -> f64,
        confidence: f64,
    ) -> Option<Interval> {
        let one = |replicate: usize| {
            let ratio = |s: usize| of(&self.searches[s][replicate]) / of(&other.searches[s][replicate]);
            searches.clone().map(|s| ratio(s).ln()).sum::<f64>() / searches.len() as f64
        };
        let logarithm: Replicates = (0..self.searches[0].len()).map(one).collect();
        let Interval { value, low, high, confidence } = logarithm.interval(confidence)?;
        Some(Interval { value: value.exp(), low: low.exp(), high: high.exp(), confidence })
    }
}

/// Exponent of a search's cost in the number of photons; its interval is that of the replicates' own exponents.
pub(super) fn exponent(sizes: &[&Tried], search: usize, of: fn(&Cost) -> f64, confidence: f64) -> Option<Interval> {
    let photons: Vec<f64> = sizes.iter().map(|tried| tried.photons as f64).collect();
    let one = |replicate: usize| {
        let values: Vec<f64> = sizes.iter().map(|tried| of(&tried.searches[search][replicate])).collect();
        Some(fit_log_log(&photons, &values).ok()?.slope)
    };
    let replicates = sizes.first()?.searches[search].len();
    (0..replicates).map(one).collect::<Option<Replicates>>()?.interval(confidence)
}

/// Of the boxes of full leaves, which are runs of sixteen points.
fn median_slenderness(tree: &KdTree<()>) -> f64 {
    let leaf = |first: usize| {
        let mut edges: [f32; 3] = std::array::from_fn(|axis| {
            let run = (first..first + 16).map(|i| tree.point(i)[axis]);
            let (low, high) = run.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            high - low
        });
        edges.sort_by(f32::total_cmp);
        edges[2] / edges[1]
    };
    let mut ratios: Vec<f32> = (0..tree.len() / 16).map(|block| leaf(16 * block)).collect();
    ratios.sort_by(f32::total_cmp);
    ratios.get(ratios.len() / 2).map_or(1.0, |&ratio| f64::from(ratio))
}
