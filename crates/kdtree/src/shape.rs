//! How a tree turned out.

use crate::node::Node;
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
    /// Bytes that the tree adds to the points and payloads themselves: nodes, and the padding of the last block.
    pub overhead_bytes: usize,
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Counts nodes, leaves and bytes in one pass over the nodes.
    pub fn shape(&self) -> TreeShape {
        let bytes = size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..]) + size_of_val(&self.payload[..]);
        let overhead_bytes = bytes - self.len() * (size_of::<[f32; 3]>() + size_of::<P>());
        let mut shape = TreeShape { bytes, overhead_bytes, ..TreeShape::default() };
        if !self.nodes.is_empty() {
            shape.nodes = 1;
            measure(&self.nodes, 0, 1, &mut shape);
        }
        shape
    }
}

fn measure(nodes: &[Node], number: usize, depth: usize, shape: &mut TreeShape) {
    let node = &nodes[number];
    shape.nodes += node.live.count_ones() as usize;
    for lane in 0..node.live.count_ones() as usize {
        if node.is_inner(lane) {
            measure(nodes, node.child(lane), depth + 1, shape);
        } else {
            shape.leaves += 1;
            shape.depth = shape.depth.max(depth + 1);
            shape.largest_leaf = shape.largest_leaf.max(node.points(lane).len());
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
            nodes: 5,
            leaves: 4,
            depth: 2,
            largest_leaf: 16,
            bytes: 512 + 64 * (12 + 1),
            overhead_bytes: 512,
        };
        assert_eq!(shape(64), expected);
    }
}
