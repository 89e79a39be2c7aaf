//! The split rules that are held against one another, with the names they have in figures.

use photonlab_kdtree::{DEFAULT_LEAF_LIMIT, EmptyCost, KdTree, Reach, SplitRule, VisitCost};

use super::cpu_clock::CpuClock;

/// The neighbours that rules with a reach are made for.
const REACH: Reach = Reach::Nearest(100);

/// Eq. 2 of the paper with its empty node at no cost, so that the leaf limit alone stops it.
pub(super) const PAPER: SplitRule = SplitRule::SurfaceArea { empty_cost: EmptyCost::NodeAreas(0.0) };

/// A rule with its name in figures and its leaf limit.
pub(super) struct NamedRule {
    pub(super) name: &'static str,
    pub(super) rule: SplitRule,
    /// Photons in a leaf at most.
    pub(super) limit: usize,
}

/// Every rule, the median first and the paper's next. The exact sweep cuts between any two photons, which leaves its leaves
/// two thirds full on average; its limit is larger in proportion, so that all trees have leaves of one mean size.
pub(super) const RULES: [NamedRule; 6] = [
    NamedRule { name: "median", rule: SplitRule::Median, limit: DEFAULT_LEAF_LIMIT },
    NamedRule { name: "paper's S N, exact sweep", rule: PAPER, limit: DEFAULT_LEAF_LIMIT * 3 / 2 },
    binned("paper's S N, full leaves", VisitCost::SurfaceArea),
    binned("voxel volume", VisitCost::VoxelVolume(REACH)),
    binned("grown box, in space", VisitCost::BallInSpace(REACH)),
    binned("grown box, on a sheet", VisitCost::BallOnSheet(REACH)),
];

const fn binned(name: &'static str, cost: VisitCost) -> NamedRule {
    NamedRule { name, rule: SplitRule::Binned(cost), limit: DEFAULT_LEAF_LIMIT }
}

/// A tree of bare points.
pub(super) fn bare_tree(points: &[[f32; 3]], rule: SplitRule, limit: usize) -> anyhow::Result<KdTree<()>> {
    Ok(KdTree::build_with_leaf_limit(points.to_vec(), vec![(); points.len()], rule, limit)?)
}

/// CPU seconds of a build: the mean over builds that together take the least time, for the clock is coarse.
pub(super) fn build_seconds(points: &[[f32; 3]], rule: SplitRule, limit: usize, least: f64) -> anyhow::Result<f64> {
    let (mut sum, mut builds) = (0.0, 0);
    let clock = CpuClock::start();
    while clock.seconds() < least {
        drop(bare_tree(points, rule, limit)?);
        builds += 1;
        sum = clock.seconds();
    }
    Ok(sum / f64::from(builds))
}
