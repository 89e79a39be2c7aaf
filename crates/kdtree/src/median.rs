//! Building by the median rule.

use crate::block::BLOCK;
use crate::bounds::Bounds;
use crate::branch::Branch;
use crate::node::WIDTH;

/// Below this many points a subtree is built by one thread.
const SERIAL: usize = 1 << 13;

/// A point on its way to its leaf.
#[derive(Clone, Copy)]
struct Item {
    point: [f32; 3],
    index: u32,
}

/// The tree of at least one point, and the original indices in the order of its leaves.
pub(crate) fn build(points: &[[f32; 3]], leaf_limit: usize) -> (Branch, Vec<u32>) {
    let mut items: Vec<Item> = points.iter().zip(0..).map(|(&point, index)| Item { point, index }).collect();
    let root = grow(&mut items, leaf_limit);
    (root, items.iter().map(|item| item.index).collect())
}

/// Recursion is as deep as the tree: at most 31, for each cut halves the count.
fn grow(items: &mut [Item], leaf_limit: usize) -> Branch {
    let bounds = Bounds::around(items.iter().map(|item| item.point));
    let axis = match bounds.widest_axis() {
        Some(axis) if items.len() > leaf_limit => axis,
        _ => return leaf(bounds, items),
    };

    // A total order makes the two halves, as sets, a function of the points alone.
    let half = (items.len() / 2).next_multiple_of(unit(items.len(), leaf_limit));
    items.select_nth_unstable_by(half, |a, b| a.point[axis].total_cmp(&b.point[axis]).then(a.index.cmp(&b.index)));

    let serial = items.len() < SERIAL;
    let (low, high) = items.split_at_mut(half);
    let (left, right) = if serial {
        (grow(low, leaf_limit), grow(high, leaf_limit))
    } else {
        rayon::join(|| grow(low, leaf_limit), || grow(high, leaf_limit))
    };
    Branch::inner(bounds, left, right)
}

/// Halves are even but for whole blocks, and for whole nodes of blocks where there are several: so that these are full.
fn unit(len: usize, leaf_limit: usize) -> usize {
    match len {
        _ if leaf_limit < BLOCK => 1,
        len if len > WIDTH * BLOCK => WIDTH * BLOCK,
        _ => BLOCK,
    }
}

/// Within a leaf, points keep the order in which they were given.
fn leaf(bounds: Bounds, items: &mut [Item]) -> Branch {
    items.sort_unstable_by_key(|item| item.index);
    Branch::leaf(bounds, items.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_along_the_widest_axis_whatever_repeats() {
        // All but one point share the only coordinate that varies.
        let mut points = vec![[0.0, 4.0, 1.0]; 63];
        points.insert(5, [0.0, 9.0, 1.0]);
        let (root, order) = build(&points, 1);
        // The far half holds the lone point; halves of equal points are not cut further.
        assert_eq!(order.last(), Some(&5));
        assert_eq!(root.leaves(), 7);
    }

    #[test]
    fn equal_coordinates_part_by_original_index() {
        // Every tenth point lies apart; the cut falls among the equal others.
        let points: Vec<[f32; 3]> = (0..5000).map(|i| [f32::from(u8::from(i % 10 == 0)), 0.0, 0.0]).collect();
        let (_, order) = build(&points, 2560);
        let mut equal = (0..5000).filter(|i| i % 10 != 0);
        let low: Vec<u32> = equal.by_ref().take(2560).collect();
        assert_eq!(order[..2560], low);
    }
}
