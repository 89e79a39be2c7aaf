//! The tree while it grows: subtrees that threads return to one another, gathered into wide nodes at the end.

use std::collections::VecDeque;

use crate::bounds::Bounds;
use crate::node::{Node, WIDTH};

/// A subtree whose points are a run of the order being built.
pub(crate) struct Branch {
    bounds: Bounds,
    points: u32,
    leaves: u32,
    halves: Option<Box<[Branch; 2]>>,
}

impl Branch {
    pub(crate) fn leaf(bounds: Bounds, len: usize) -> Self {
        debug_assert!(len > 0);
        Self { bounds, points: len as u32, leaves: 1, halves: None }
    }

    pub(crate) fn inner(bounds: Bounds, left: Self, right: Self) -> Self {
        let (points, leaves) = (left.points + right.points, left.leaves + right.leaves);
        Self { bounds, points, leaves, halves: Some(Box::new([left, right])) }
    }

    /// Leaves below, itself included.
    #[cfg(test)]
    pub(crate) fn leaves(&self) -> usize {
        self.leaves as usize
    }

    /// Cuts above the deepest leaf. Recursion is as deep as the tree.
    #[cfg(test)]
    pub(crate) fn cuts(&self) -> usize {
        self.halves.as_deref().map_or(0, |[left, right]| 1 + left.cuts().max(right.cuts()))
    }

    /// The nodes level by level, the leaves' points in the order of the runs.
    pub(crate) fn into_nodes(self) -> Vec<Node> {
        let mut nodes = Vec::with_capacity(self.leaves as usize / 15 + 1);
        let mut pending = VecDeque::from([(&self, 0)]);
        while let Some((branch, first)) = pending.pop_front() {
            let children = (nodes.len() + 1 + pending.len()) as u32;
            let mut node = Node::new(first, children);
            let mut begins = first;
            for child in branch.children() {
                let is_inner = child.halves.is_some();
                node.push(&child.bounds, child.points, is_inner);
                if is_inner {
                    pending.push_back((child, begins));
                }
                begins += child.points;
            }
            nodes.push(node);
        }
        nodes.shrink_to_fit();
        nodes
    }

    /// Up to sixteen disjoint subtrees that make up this one, in order.
    ///
    /// The largest are opened first, down to those that one more node can hold; then the smallest, as far as
    /// all their leaves fit here, for each saves a node.
    fn children(&self) -> Vec<&Self> {
        let mut children = vec![self];
        loop {
            let large = |c: &&Self| c.leaves as usize > WIDTH || children.len() == 1 && c.halves.is_some();
            let candidates = || children.iter().enumerate().filter(|(_, c)| c.halves.is_some());
            let largest = candidates().filter(|(_, c)| large(c)).max_by_key(|(i, c)| (c.leaves, usize::MAX - i));
            let room = WIDTH - children.len();
            let smallest = candidates().filter(|(_, c)| c.leaves as usize <= room + 1).min_by_key(|(_, c)| c.leaves);
            let Some((at, child)) = largest.filter(|_| room > 0).or(smallest) else {
                return children;
            };
            let [left, right] = &**child.halves.as_ref().expect("only inner branches are candidates");
            children.splice(at..=at, [left, right]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn even(leaves: usize) -> Branch {
        let b = Bounds { lo: [0.0; 3], hi: [1.0; 3] };
        match leaves {
            1 => Branch::leaf(b, 3),
            _ => Branch::inner(b, even(leaves / 2), even(leaves - leaves / 2)),
        }
    }

    #[test]
    fn gathers_sixteen_children_level_by_level() {
        let nodes = even(1 << 8).into_nodes();
        assert_eq!(nodes.len(), 17);
        assert_eq!((nodes[0].live, nodes[0].inner), (u16::MAX, u16::MAX));
        assert!(nodes[1..].iter().all(|node| (node.live, node.inner) == (u16::MAX, 0)));
        assert_eq!((nodes[0].child(5), nodes[6].points(2)), (6, 3 * 82..3 * 83));
    }

    #[test]
    fn a_lone_leaf_and_an_uneven_tree() {
        let lone = even(1).into_nodes();
        assert_eq!((lone.len(), lone[0].live, lone[0].inner), (1, 1, 0));
        // Sixteen leaves need a node of their own; the four others fit beside it.
        let b = Bounds { lo: [0.0; 3], hi: [1.0; 3] };
        let nodes = Branch::inner(b, even(16), even(4)).into_nodes();
        assert_eq!((nodes.len(), nodes[0].live, nodes[0].inner), (2, 0b11111, 0b1));
    }
}
