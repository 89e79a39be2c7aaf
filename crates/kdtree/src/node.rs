//! One node as it is stored.

use std::ops::Range;

use crate::bounds::Bounds;

/// Children of a node: the lanes of the widest vector register.
pub(crate) const WIDTH: usize = 16;

/// Up to sixteen children, each with the tight box of its points, axis by axis.
///
/// The points of a node are a run in tree order, and those of its children are runs of it, in order.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    pub(crate) lo: [[f32; WIDTH]; 3],
    pub(crate) hi: [[f32; WIDTH]; 3],
    /// Where each child's points begin, and after the last child where they end.
    begins: [u32; WIDTH + 1],
    /// The node that is the first inner child; the others follow it.
    children: u32,
    /// Bits of the lanes that hold children.
    pub(crate) live: u16,
    /// Bits of the children that are nodes; the others are leaves.
    pub(crate) inner: u16,
}

impl Node {
    /// A node without children whose points begin at `first`.
    pub(crate) fn new(first: u32, children: u32) -> Self {
        let nowhere = [[f32::INFINITY; WIDTH]; 3];
        Self { lo: nowhere, hi: nowhere, begins: [first; WIDTH + 1], children, live: 0, inner: 0 }
    }

    /// Adds the next child.
    pub(crate) fn push(&mut self, bounds: &Bounds, points: u32, is_inner: bool) {
        let lane = self.live.count_ones() as usize;
        for axis in 0..3 {
            self.lo[axis][lane] = bounds.lo[axis];
            self.hi[axis][lane] = bounds.hi[axis];
        }
        let end = self.begins[lane] + points;
        self.begins[lane + 1..].fill(end);
        self.live |= 1 << lane;
        self.inner |= u16::from(is_inner) << lane;
    }

    #[inline(always)]
    pub(crate) fn is_inner(&self, lane: usize) -> bool {
        self.inner >> lane & 1 == 1
    }

    /// The number of the node that is the child in this lane.
    #[inline(always)]
    pub(crate) fn child(&self, lane: usize) -> usize {
        let before = self.inner & ((1 << lane) - 1);
        (self.children + before.count_ones()) as usize
    }

    /// The points below the child in this lane, in tree order.
    #[inline(always)]
    pub(crate) fn points(&self, lane: usize) -> Range<usize> {
        self.begins[lane] as usize..self.begins[lane + 1] as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_eight_cache_lines() {
        assert_eq!((size_of::<Node>(), align_of::<Node>()), (512, 64));
    }

    #[test]
    fn counts_its_inner_children() {
        let bounds = Bounds { lo: [0.0; 3], hi: [1.0; 3] };
        let mut node = Node::new(32, 7);
        for (points, is_inner) in [(16, false), (300, true), (4, false), (500, true)] {
            node.push(&bounds, points, is_inner);
        }
        assert_eq!((node.live, node.inner), (0b1111, 0b1010));
        assert_eq!((node.child(1), node.child(3)), (7, 8));
        assert_eq!(node.points(2), 348..352);
    }
}
