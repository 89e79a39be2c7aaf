//! The split rules that are held against one another, with the names they have in figures.

use photonlab_kdtree::{DEFAULT_LEAF_LIMIT, EmptyCost, KdTree, Reach, SplitRule, VisitCost};

use super::cpu_clock::CpuClock;

/// The neighbours that rules with a reach are made for.
const REACH: Reach = Reach::Nearest(100);

/// Eq. 2 of the paper with its empty node at no cost, so that the leaf limit alone stops it.
pub(super) const PAPER: SplitRule = SplitRule::SurfaceArea { empty_cost: EmptyCost::NodeAreas(0.0) };

/// Every rule, the median first and the paper's next.
pub(super) const RULES: [(&str, SplitRule); 6] = [
    ("median", SplitRule::Median),
    ("paper's S N, exact sweep", PAPER),
    ("paper's S N, full leaves", SplitRule::Binned(VisitCost::SurfaceArea)),
    ("voxel volume", SplitRule::Binned(VisitCost::VoxelVolume(REACH))),
    ("grown box, in space", SplitRule::Binned(VisitCost::BallInSpace(REACH))),
    ("grown box, on a sheet", SplitRule::Binned(VisitCost::BallOnSheet(REACH))),
];

/// A tree of bare points.
pub(super) fn bare_tree(points: &[[f32; 3]], rule: SplitRule, limit: usize) -> anyhow::Result<KdTree<()>> {
    Ok(KdTree::build_with_leaf_limit(points.to_vec(), vec![(); points.len()], rule, limit)?)
}

/// CPU seconds of a build: the mean over builds that together take the least time, for the clock is coarse.
pub(super) fn build_seconds(points: &[[f32; 3]], rule: SplitRule, least: f64) -> anyhow::Result<f64> {
    let (mut sum, mut builds) = (0.0, 0);
    let clock = CpuClock::start();
    while clock.seconds() < least {
        drop(bare_tree(points, rule, DEFAULT_LEAF_LIMIT)?);
        builds += 1;
        sum = clock.seconds();
    }
    Ok(sum / f64::from(builds))
}
