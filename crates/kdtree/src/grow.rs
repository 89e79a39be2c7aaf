//! Building by cuts at a rank: a plane is chosen, moved to the nearest whole block of points, and the points parted there.

use crate::block::BLOCK;
use crate::bounds::Bounds;
use crate::branch::Branch;
use crate::item::{Item, bounds, item, key};
use crate::node::WIDTH;

/// Below this many points a subtree is built by one thread.
const SERIAL: usize = 1 << 13;

/// Where to part a node: this many points, lowest along the axis, go to the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parting {
    pub(crate) axis: usize,
    pub(crate) left: usize,
}

/// Chooses where to part the points of a box that is not a single point; `None` stands for the median.
pub(crate) trait Choose: Sync {
    fn choose(&self, items: &[Item], bounds: &Bounds) -> Option<Parting>;
}

/// The tree of at least one point, and the points with the bits of their original indices in the order of its leaves.
pub(crate) fn build(points: &[[f32; 3]], leaf_limit: usize, rule: &impl Choose) -> (Branch, Vec<Item>) {
    let mut items: Vec<Item> = (0..points.len() as u32).map(|index| item(points, index)).collect();
    // With the medians that follow, at most 78 cuts.
    let chosen_cuts = 16 + points.len().next_power_of_two().ilog2() as usize;
    let root = grow(&mut items, leaf_limit, rule, chosen_cuts);
    (root, items)
}

/// Recursion is as deep as the tree: below the chosen cuts, each halves the count.
fn grow(items: &mut [Item], leaf_limit: usize, rule: &impl Choose, chosen_cuts: usize) -> Branch {
    let bounds = bounds(items);
    let axis = match bounds.widest_axis() {
        Some(axis) if items.len() > leaf_limit => axis,
        _ => return Branch::leaf(bounds, items.len()),
    };
    let chosen = if chosen_cuts > 0 { rule.choose(items, &bounds) } else { None };
    let parting = match chosen {
        Some(Parting { axis, left }) => Parting { axis, left: whole_blocks(left, items.len(), leaf_limit) },
        None => Parting { axis, left: middle(items.len(), leaf_limit) },
    };

    // A total order makes the two parts, as sets, a function of the points alone.
    items.select_nth_unstable_by_key(parting.left, |item| key(item, parting.axis));

    let serial = items.len() < SERIAL;
    let (low, high) = items.split_at_mut(parting.left);
    let cuts = chosen_cuts.saturating_sub(1);
    let mut left = || grow(low, leaf_limit, rule, cuts);
    let mut right = || grow(high, leaf_limit, rule, cuts);
    let (left, right) = if serial { (left(), right()) } else { rayon::join(left, right) };
    Branch::inner(bounds, left, right)
}

/// Half, but for whole blocks, and for whole nodes of blocks where there are several: so that these are full.
fn middle(len: usize, leaf_limit: usize) -> usize {
    let unit = match len {
        _ if leaf_limit < BLOCK => 1,
        len if len > WIDTH * BLOCK => WIDTH * BLOCK,
        _ => BLOCK,
    };
    (len / 2).next_multiple_of(unit)
}

/// The nearest number that fills blocks and leaves points on both sides.
fn whole_blocks(left: usize, len: usize, leaf_limit: usize) -> usize {
    let unit = if leaf_limit < BLOCK { 1 } else { BLOCK };
    let most = (len - 1) / unit * unit;
    ((left + unit / 2) / unit * unit).clamp(unit.min(most), most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_at_whole_blocks_and_never_at_an_end() {
        assert_eq!([17, 256, 257, 1000].map(|len| middle(len, 16)), [16, 128, 256, 512]);
        assert_eq!([2, 17, 257].map(|len| middle(len, 1)), [1, 8, 128]);
        assert_eq!([0, 7, 8, 90, 100].map(|left| whole_blocks(left, 100, 16)), [16, 16, 16, 96, 96]);
        assert_eq!([0, 7, 100].map(|left| whole_blocks(left, 100, 4)), [1, 7, 99]);
    }
}
