//! How a tree turned out.

use crate::node::{Content, Node};
use crate::tree::KdTree;

/// How a tree turned out: the numbers that memory and build experiments report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TreeShape {
    /// Nodes stored, leaves included.
    pub nodes: usize,
    /// Leaves among them; none is empty.
    pub leaves: usize,
    /// Nodes on the longest way from the root to a leaf, both included; 0 for the empty tree.
    pub depth: usize,
    /// Points in the largest leaf.
    pub largest_leaf: usize,
    /// Bytes held in all: points, payloads, and `overhead_bytes`.
    pub bytes: usize,
    /// Bytes that the tree adds to the points and payloads themselves: nodes and original indices.
    pub overhead_bytes: usize,
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Counts nodes, leaves and bytes in one pass over the nodes.
    pub fn shape(&self) -> TreeShape {
        let overhead_bytes = size_of_val(&self.nodes[..]) + size_of_val(&self.original[..]);
        let mut shape = TreeShape {
            nodes: self.nodes.len(),
            bytes: overhead_bytes + size_of_val(&self.points[..]) + size_of_val(&self.payload[..]),
            overhead_bytes,
            ..TreeShape::default()
        };
        if !self.nodes.is_empty() {
            measure(&self.nodes, 0, 1, &mut shape);
        }
        shape
    }
}

/// Recursion is as deep as the tree, which both rules bound by 78.
fn measure(nodes: &[Node], node: usize, depth: usize, shape: &mut TreeShape) {
    match nodes[node].content() {
        Content::Leaf(range) => {
            shape.leaves += 1;
            shape.depth = shape.depth.max(depth);
            shape.largest_leaf = shape.largest_leaf.max(range.len());
        }
        Content::Inner { right } => {
            measure(nodes, node + 1, depth + 1, shape);
            measure(nodes, right, depth + 1, shape);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SplitRule;

    #[test]
    fn of_nothing_and_of_a_line() {
        let line = |n: u16| (0..n).map(|i| [f32::from(i), 0.0, 0.0]).collect::<Vec<_>>();
        let shape = |n| KdTree::build(line(n), vec![0u8; n.into()], SplitRule::Median).unwrap().shape();
        assert_eq!(shape(0), TreeShape::default());
        let expected = TreeShape {
            nodes: 7,
            leaves: 4,
            depth: 3,
            largest_leaf: 16,
            bytes: 7 * 32 + 64 * (4 + 12 + 1),
            overhead_bytes: 7 * 32 + 64 * 4,
        };
        assert_eq!(shape(64), expected);
    }
}
