//! Building by the median rule.

use crate::block::BLOCK;
use crate::branch::Branch;
use crate::item::{Item, bounds, item, key};
use crate::node::WIDTH;

/// Below this many points a subtree is built by one thread.
const SERIAL: usize = 1 << 13;

/// The tree of at least one point, and the points with the bits of their original indices in the order of its leaves.
pub(crate) fn build(points: &[[f32; 3]], leaf_limit: usize) -> (Branch, Vec<Item>) {
    let mut items: Vec<Item> = (0..points.len() as u32).map(|index| item(points, index)).collect();
    let root = grow(&mut items, leaf_limit);
    (root, items)
}

/// Recursion is as deep as the tree: at most 31, for each cut halves the count.
fn grow(items: &mut [Item], leaf_limit: usize) -> Branch {
    let bounds = bounds(items);
    let axis = match bounds.widest_axis() {
        Some(axis) if items.len() > leaf_limit => axis,
        _ => return Branch::leaf(bounds, items.len()),
    };

    // A total order makes the two halves, as sets, a function of the points alone.
    let half = (items.len() / 2).next_multiple_of(unit(items.len(), leaf_limit));
    items.select_nth_unstable_by_key(half, |item| key(item, axis));

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::item::index;

    #[test]
    fn halves_along_the_widest_axis_whatever_repeats() {
        // All but one point share the only coordinate that varies.
        let mut points = vec![[0.0, 4.0, 1.0]; 63];
        points.insert(5, [0.0, 9.0, 1.0]);
        let (root, order) = build(&points, 1);
        // The far half holds the lone point; halves of equal points are not cut further.
        assert_eq!(order.last().map(index), Some(5));
        assert_eq!(root.leaves(), 7);
    }

    #[test]
    fn equal_coordinates_part_by_original_index() {
        // Every tenth point lies apart; the cut falls among the equal others.
        let points: Vec<[f32; 3]> = (0..5000).map(|i| [f32::from(u8::from(i % 10 == 0)), 0.0, 0.0]).collect();
        let (_, order) = build(&points, 2560);
        let mut equal = (0..5000).filter(|i| i % 10 != 0);
        let low: Vec<u32> = equal.by_ref().take(2560).collect();
        let mut found: Vec<u32> = order[..2560].iter().map(index).collect();
        found.sort_unstable();
        assert_eq!(found, low);
    }
}
