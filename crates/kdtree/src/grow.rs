//! Building by cuts at a rank: a plane is chosen, moved to the nearest whole block of points, and the points parted there.

use crate::block::BLOCK;
use crate::bounds::Bounds;
use crate::branch::Branch;
use crate::columns::{Around, Columns, ColumnsMut, Table};
use crate::lanes::{Instructions, dispatch};
use crate::node::WIDTH;
use crate::rank::Part;

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
    fn choose(&self, points: &Columns, bounds: &Bounds) -> Option<Parting>;
}

/// The tree of at least one point, and the points in the order of its leaves, within a leaf in the order given.
pub(crate) fn build(points: &[[f32; 3]], leaf_limit: usize, rule: &impl Choose) -> (Branch, Table) {
    let mut table = Table::of(points, 0..points.len() as u32);
    let mut spare = Table::like(&table);
    let instructions = Instructions::widest();
    let bounds = dispatch(instructions, Around(table.columns()));
    // With the medians that follow, at most 78 cuts.
    let chosen_cuts = 16 + points.len().next_power_of_two().ilog2() as usize;
    let grower = Grower { leaf_limit, rule, instructions };
    let run = Run { here: table.columns_mut(), there: spare.columns_mut(), is_home: true };
    let root = grower.grow(run, bounds, chosen_cuts);
    (root, table)
}

/// The points of a node, and as much room.
struct Run<'a> {
    here: ColumnsMut<'a>,
    there: ColumnsMut<'a>,
    /// Whether the leaves' points belong here rather than there.
    is_home: bool,
}

/// What stays the same for every node.
struct Grower<'a, R> {
    leaf_limit: usize,
    rule: &'a R,
    instructions: Instructions,
}

impl<R: Choose> Grower<'_, R> {
    /// Recursion is as deep as the tree: below the chosen cuts, each halves the count.
    fn grow(&self, run: Run, bounds: Bounds, chosen_cuts: usize) -> Branch {
        let Run { here, mut there, is_home } = run;
        let len = here.len();
        let axis = match bounds.widest_axis() {
            Some(axis) if len > self.leaf_limit => axis,
            _ => {
                if !is_home {
                    there.copy_from(&here.as_columns());
                }
                return Branch::leaf(bounds, len);
            }
        };
        let chosen = if chosen_cuts > 0 { self.rule.choose(&here.as_columns(), &bounds) } else { None };
        let Parting { axis, left: rank } = match chosen {
            Some(Parting { axis, left }) => Parting { axis, left: whole_blocks(left, len, self.leaf_limit) },
            None => Parting { axis, left: middle(len, self.leaf_limit) },
        };

        let part = Part { from: here.as_columns(), to: there, bounds, axis, rank };
        let [low, high] = dispatch(self.instructions, part);

        let room = here.split_at(rank);
        let cuts = chosen_cuts.saturating_sub(1);
        let side = |(here, bounds), there| self.grow(Run { here, there, is_home: !is_home }, bounds, cuts);
        let [low_room, high_room] = room;
        let (left, right) = if len < SERIAL {
            (side(low, low_room), side(high, high_room))
        } else {
            rayon::join(|| side(low, low_room), || side(high, high_room))
        };
        Branch::inner(bounds, left, right)
    }
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
