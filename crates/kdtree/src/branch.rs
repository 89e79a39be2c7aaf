//! The tree while it grows: subtrees that threads return to one another.

use crate::bounds::Bounds;
use crate::node::Node;

/// A subtree whose points are a run of the order being built.
pub(crate) struct Branch {
    bounds: Bounds,
    content: Content,
}

enum Content {
    Leaf { len: usize },
    Inner(Box<[Branch; 2]>),
}

impl Branch {
    pub(crate) fn leaf(bounds: Bounds, len: usize) -> Self {
        Self { bounds, content: Content::Leaf { len } }
    }

    pub(crate) fn inner(bounds: Bounds, left: Self, right: Self) -> Self {
        Self { bounds, content: Content::Inner(Box::new([left, right])) }
    }

    /// The nodes in depth-first order, the leaves' points in the order of the runs.
    pub(crate) fn flatten(&self) -> Vec<Node> {
        let mut nodes = Vec::new();
        self.append(&mut nodes, &mut 0);
        nodes.shrink_to_fit();
        nodes
    }

    /// Recursion is as deep as the tree, which both rules bound by 78.
    fn append(&self, nodes: &mut Vec<Node>, points: &mut usize) {
        match &self.content {
            Content::Leaf { len } => {
                nodes.push(Node::leaf(self.bounds, *points as u32, *len as u32));
                *points += len;
            }
            Content::Inner(children) => {
                let parent = nodes.len();
                nodes.push(Node::inner(self.bounds, 0));
                children[0].append(nodes, points);
                nodes[parent] = Node::inner(self.bounds, nodes.len() as u32);
                children[1].append(nodes, points);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flattens_depth_first() {
        let b = Bounds { lo: [0.0; 3], hi: [1.0; 3] };
        let left = Branch::inner(b, Branch::leaf(b, 3), Branch::leaf(b, 4));
        let nodes = Branch::inner(b, left, Branch::leaf(b, 5)).flatten();
        let expected = [Node::inner(b, 4), Node::inner(b, 3), Node::leaf(b, 0, 3), Node::leaf(b, 3, 4)];
        assert_eq!(nodes[..4], expected);
        assert_eq!(nodes[4..], [Node::leaf(b, 7, 5)]);
    }
}
