//! The one walk through the tree, whatever the question.

use crate::distance::distance_squared;
use crate::node::{Content, Node};
use crate::visits::Meter;

/// A question to the tree.
pub(crate) trait Collector {
    /// Whether the nearer child is opened first; otherwise points come in tree order.
    const NEAR_FIRST: bool;

    /// The largest squared distance still of interest; never NaN, and never rises during a walk.
    fn reach(&self) -> f32;

    /// A point within reach, with its squared distance.
    fn offer(&mut self, index: usize, distance_squared: f32);
}

/// Offers every point within the collector's reach, and skips no point at exactly its reach.
///
/// A query with a NaN coordinate is near nothing. Does not allocate.
pub(crate) fn walk<C: Collector, M: Meter>(
    nodes: &[Node],
    points: &[[f32; 3]],
    query: [f32; 3],
    collector: &mut C,
    meter: &mut M,
) {
    if nodes.is_empty() || query.iter().any(|c| c.is_nan()) {
        return;
    }
    let mut pending = Pending::new();
    pending.push(0, nodes[0].bounds.distance_squared(query));
    while let Some((current, bound)) = pending.pop() {
        if bound > collector.reach() {
            continue;
        }
        match nodes[current].content() {
            Content::Leaf(range) => {
                meter.leaf(range.len());
                for (index, &point) in range.clone().zip(&points[range]) {
                    let distance = distance_squared(query, point);
                    if distance <= collector.reach() {
                        collector.offer(index, distance);
                    }
                }
            }
            Content::Inner { right } => {
                meter.inner();
                let left = current + 1;
                let left_bound = nodes[left].bounds.distance_squared(query);
                let right_bound = nodes[right].bounds.distance_squared(query);
                if C::NEAR_FIRST && right_bound < left_bound {
                    pending.push(left, left_bound);
                    pending.push(right, right_bound);
                } else {
                    pending.push(right, right_bound);
                    pending.push(left, left_bound);
                }
            }
        }
    }
}

/// Nodes still to open, each with the least distance of any point in it.
struct Pending {
    nodes: [(u32, f32); Self::CAPACITY],
    len: usize,
}

impl Pending {
    /// Each level adds one node; no tree is deeper than 78 cuts (the depth limit of 2^31 points).
    const CAPACITY: usize = 80;

    fn new() -> Self {
        Self { nodes: [(0, 0.0); Self::CAPACITY], len: 0 }
    }

    #[inline]
    fn push(&mut self, node: usize, bound: f32) {
        self.nodes[self.len] = (node as u32, bound);
        self.len += 1;
    }

    #[inline]
    fn pop(&mut self) -> Option<(usize, f32)> {
        self.len = self.len.checked_sub(1)?;
        let (node, bound) = self.nodes[self.len];
        Some((node as usize, bound))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_for_the_deepest_tree() {
        let deepest = crate::surface_area::depth_limit(crate::tree::MAX_POINTS);
        assert!(deepest < Pending::CAPACITY);
    }
}
