//! One node as it is stored.

use crate::bounds::Bounds;

/// A node of 32 bytes: the tight box of its points, and where to go on.
///
/// Nodes lie in depth-first order, so a left child follows its parent directly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) bounds: Bounds,
    /// First point of a leaf, or the node that is the right child.
    link: u32,
    /// Number of points of a leaf; zero marks an inner node, for no leaf is empty.
    len: u32,
}

/// What a node holds.
pub(crate) enum Content {
    /// A run of points in tree order.
    Leaf(std::ops::Range<usize>),
    /// Two children: the next node, and the node of this number.
    Inner { right: usize },
}

impl Node {
    pub(crate) fn leaf(bounds: Bounds, first: u32, len: u32) -> Self {
        debug_assert!(len > 0);
        Self { bounds, link: first, len }
    }

    pub(crate) fn inner(bounds: Bounds, right: u32) -> Self {
        Self { bounds, link: right, len: 0 }
    }

    #[inline]
    pub(crate) fn content(&self) -> Content {
        let link = self.link as usize;
        match self.len {
            0 => Content::Inner { right: link },
            len => Content::Leaf(link..link + len as usize),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_half_a_cache_line() {
        assert_eq!(size_of::<Node>(), 32);
    }
}
