//! How the work of a query grows with the photons.

use std::f64::consts::PI;

use photonlab_kdtree::{DEFAULT_LEAF_LIMIT, SplitRule};
use photonlab_measure::{Interval, Replicates, fit_log_log};
use serde::Deserialize;

use super::{
    field::stream,
    photon_set::PhotonSet,
    search::{Cost, Search, radius_holding},
    split_rules::bare_tree,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Parameters {
    pub(super) seed: u64,
    pub(super) replicates: u64,
    /// Ascending.
    pub(super) photons: Vec<usize>,
    pub(super) queries: usize,
    pub(super) k: Vec<usize>,
    /// Photons in the radius that shrinks as they crowd.
    pub(super) held: usize,
    /// Photons in the fixed radius at the fewest photons.
    pub(super) fixed_held: usize,
    /// Photons of the worst case.
    pub(super) worst: Vec<usize>,
    /// A slope known worse than this (half-width) says nothing.
    pub(super) precision: f64,
}

/// One search on one set, by size and replicate.
pub(super) struct Growth {
    pub(super) name: String,
    pub(super) costs: Vec<Vec<Cost>>,
}

/// The searches of one set; the fixed radius is the last.
pub(super) struct Grown {
    pub(super) set: PhotonSet,
    pub(super) dimension: i32,
    pub(super) fixed_radius: f64,
    pub(super) searches: Vec<Growth>,
}

impl Grown {
    pub(super) fn measure(set: PhotonSet, dimension: i32, p: &Parameters) -> anyhow::Result<Self> {
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
    pub(super) fn bound(&self) -> f64 {
        1.0 - 1.0 / f64::from(self.dimension)
    }

    pub(super) fn fixed(&self) -> &Growth {
        &self.searches[self.searches.len() - 1]
    }

    /// Photons tested in vain by a ball of the fixed radius, by Steiner's formula for a cubic leaf of sixteen.
    pub(super) fn in_vain(&self, photons: f64) -> f64 {
        let (r, edge) = (self.fixed_radius, (16.0 / photons).powf(1.0 / f64::from(self.dimension)));
        match self.dimension {
            2 => photons * edge * (edge + 4.0 * r),
            _ => photons * edge * (edge * edge + r * (6.0 * edge + 3.0 * PI * r)),
        }
    }
}

impl Growth {
    /// The interval is that of the replicates' own slopes.
    pub(super) fn slope(&self, photons: &[usize], of: fn(&Cost) -> f64, confidence: f64) -> Option<Interval> {
        let one = |replicate: usize| {
            let values: Vec<f64> = self.costs.iter().map(|costs| of(&costs[replicate])).collect();
            Some(fit_log_log(&sizes(photons), &values).ok()?.slope)
        };
        (0..self.costs[0].len()).map(one).collect::<Option<Replicates>>()?.interval(confidence)
    }
}

pub(super) fn nodes(cost: &Cost) -> f64 {
    cost.nodes
}

pub(super) fn vain(cost: &Cost) -> f64 {
    cost.tested - cost.found
}

pub(super) fn sizes(photons: &[usize]) -> Vec<f64> {
    photons.iter().map(|&n| n as f64).collect()
}

/// Shares of photons tested and of nodes opened by a query at the centre of a sphere that holds all photons.
pub(super) fn equally_far(photons: usize, p: &Parameters) -> anyhow::Result<[f64; 2]> {
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
