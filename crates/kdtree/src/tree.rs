//! The tree and what it holds.

use rayon::prelude::*;

use crate::binned::Binned;
use crate::block::{BLOCK, Block};
use crate::error::BuildError;
use crate::lanes::Instructions;
use crate::median::Median;
use crate::node::Node;
use crate::rule::{DEFAULT_LEAF_LIMIT, SplitRule};
use crate::sweep::{best_cut, enumerated_cut};
use crate::{grow, surface_area};

/// More than the cuts above any leaf: 78 at most (the depth limit of 2^31 points).
pub(crate) const MAX_DEPTH: usize = 80;

/// So that indices of points and of nodes (fewer than one a point) fit 32 bits.
pub(crate) const MAX_POINTS: usize = 1 << 31;

/// Points with a payload each, arranged for queries; immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct KdTree<P> {
    pub(crate) nodes: Vec<Node>,
    pub(crate) blocks: Vec<Block>,
    pub(crate) payload: Vec<P>,
    pub(crate) instructions: Instructions,
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Builds the tree of `points`, in any unit of length, `payload[i]` belonging to `points[i]`.
    ///
    /// Leaves hold up to [`DEFAULT_LEAF_LIMIT`] points, more where the rule says so. Runs on rayon's current
    /// thread pool; the result does not depend on it.
    pub fn build(points: Vec<[f32; 3]>, payload: Vec<P>, rule: SplitRule) -> Result<Self, BuildError> {
        Self::build_with_leaf_limit(points, payload, rule, DEFAULT_LEAF_LIMIT)
    }

    /// [`build`](Self::build), but nodes are cut until they hold `leaf_limit` points or fewer (0 counts as 1).
    ///
    /// With a limit of 1, [`SplitRule::SurfaceArea`] stops by its cost alone.
    pub fn build_with_leaf_limit(
        points: Vec<[f32; 3]>,
        payload: Vec<P>,
        rule: SplitRule,
        leaf_limit: usize,
    ) -> Result<Self, BuildError> {
        check_counts(points.len(), payload.len())?;
        check_finite(&points)?;
        rule.check()?;
        let instructions = Instructions::widest();
        if points.is_empty() {
            return Ok(Self { nodes: vec![], blocks: vec![], payload, instructions });
        }
        let leaf_limit = leaf_limit.max(1);
        let (root, order) = match rule {
            SplitRule::Median => grow::build(&points, leaf_limit, &Median),
            SplitRule::Binned(cost) => grow::build(&points, leaf_limit, &Binned { cost, instructions }),
            SplitRule::SurfaceArea { empty_cost } => surface_area::build(&points, empty_cost, leaf_limit, best_cut),
            SplitRule::Enumeration { empty_cost } => {
                surface_area::build(&points, empty_cost, leaf_limit, enumerated_cut)
            }
        };
        let order = order.columns();
        let block = |first: usize| Block::of((first..points.len().min(first + BLOCK)).map(|place| order.point(place)));
        let starts = (0..points.len()).into_par_iter().step_by(BLOCK);
        let blocks = starts.with_min_len(256).map(block).collect();
        let places = (0..points.len()).into_par_iter();
        let payload = places.with_min_len(4096).map(|place| payload[order.index(place) as usize]).collect();
        Ok(Self { nodes: root.into_nodes(), blocks, payload, instructions })
    }

    /// The same tree, queried with other instructions; unchanged where this processor lacks them.
    pub fn with_instructions(mut self, instructions: Instructions) -> Self {
        if instructions.is_available() {
            self.instructions = instructions;
        }
        self
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.payload.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.payload.is_empty()
    }

    /// The point of tree index `i`. Tree order goes leaf after leaf, within a leaf in the order given.
    ///
    /// # Panics
    ///
    /// If `i` is not below [`len`](Self::len).
    pub fn point(&self, i: usize) -> [f32; 3] {
        assert!(i < self.len(), "index {i} of {} points", self.len());
        self.blocks[i / BLOCK].point(i % BLOCK)
    }

    /// The coordinates, axis by axis, of the block of points whose first has tree index `first`, a multiple of [`BLOCK`]; NaN beyond the
    /// last point.
    ///
    /// # Panics
    ///
    /// If there is no such block.
    pub fn block_points(&self, first: usize) -> &[[f32; BLOCK]; 3] {
        &self.blocks[first / BLOCK].axes
    }

    /// The payloads in tree order. Where a point stood in the order given to `build` is for a payload to say.
    pub fn payloads(&self) -> &[P] {
        &self.payload
    }
}

fn check_counts(points: usize, payload: usize) -> Result<(), BuildError> {
    if points != payload {
        return Err(BuildError::LengthMismatch { points, payload });
    }
    if points > MAX_POINTS {
        return Err(BuildError::TooMany { points });
    }
    Ok(())
}

fn check_finite(points: &[[f32; 3]]) -> Result<(), BuildError> {
    match points.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
        Some(index) => Err(BuildError::NonFinite { index }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_must_agree_and_fit() {
        assert_eq!(check_counts(3, 2), Err(BuildError::LengthMismatch { points: 3, payload: 2 }));
        assert_eq!(check_counts(MAX_POINTS, MAX_POINTS), Ok(()));
        let points = MAX_POINTS + 1;
        assert_eq!(check_counts(points, points), Err(BuildError::TooMany { points }));
    }

    #[test]
    fn refuses_what_is_not_finite() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let points = vec![[0.0; 3], [0.0, 0.0, bad], [bad, 0.0, 0.0]];
            let built = KdTree::build(points, vec![(); 3], SplitRule::Median);
            assert_eq!(built, Err(BuildError::NonFinite { index: 1 }));
        }
    }
}
