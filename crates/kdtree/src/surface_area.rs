//! Building by the surface-area rule, eq. 2 of the paper.

use rayon::prelude::*;

use crate::bounds::Bounds;
use crate::branch::Branch;
use crate::columns::Table;
use crate::rule::EmptyCost;
use crate::sweep::{Cut, Seek};

/// Below this many points a subtree is built by one thread.
const SERIAL: usize = 1 << 12;

/// The most cuts above any leaf of a tree of `count` points: 16 more than twice what even halves need.
pub(crate) fn depth_limit(count: usize) -> usize {
    16 + 2 * count.next_power_of_two().ilog2() as usize
}

/// The tree of at least one point, and the points in the order of its leaves, within a leaf in the order given.
pub(crate) fn build(points: &[[f32; 3]], empty_cost: EmptyCost, leaf_limit: usize, seek: Seek) -> (Branch, Table) {
    let mut sorted: [Vec<u32>; 3] = std::array::from_fn(|axis| sorted_along(points, axis));
    let mut scratch = vec![0; points.len()];
    let [x, y, z] = &mut sorted;
    let orders = Orders { along: [x, y, z], scratch: &mut scratch };
    let cell = orders.tight_box(points);
    let root = Builder { points, empty_cost, leaf_limit, seek }.grow(cell, orders, depth_limit(points.len()));
    let [order, ..] = sorted;
    (root, Table::of(points, order.into_iter()))
}

fn sorted_along(points: &[[f32; 3]], axis: usize) -> Vec<u32> {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    let key = |index: u32| points[index as usize][axis];
    order.par_sort_unstable_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    order
}

/// What stays the same for every node.
struct Builder<'a> {
    points: &'a [[f32; 3]],
    empty_cost: EmptyCost,
    leaf_limit: usize,
    seek: Seek,
}

impl Builder<'_> {
    /// `cell` is the part of space that the cuts above left to this node; the node itself stores its tight box.
    ///
    /// Recursion is as deep as the tree.
    fn grow(&self, mut cell: Bounds, mut orders: Orders, cuts_left: usize) -> Branch {
        // A cut with nothing on one side only shrinks the cell, at most once a face. Its empty node is not
        // stored: no query would open it.
        let cut = loop {
            let Some(cut) = self.worthwhile_cut(&cell, &orders, cuts_left) else {
                return self.leaf(orders);
            };
            let (low, high) = cell.cut(cut.axis, cut.at);
            match cut.left {
                0 => cell = high,
                all if all == orders.len() => cell = low,
                _ => break cut,
            }
        };

        let (bounds, serial) = (orders.tight_box(self.points), orders.len() < SERIAL);
        orders.partition(self.points, &cut);
        let (low, high) = cell.cut(cut.axis, cut.at);
        let (left, right) = orders.split_at(cut.left);
        let left = || self.grow(low, left, cuts_left - 1);
        let right = || self.grow(high, right, cuts_left - 1);
        let (left, right) = if serial { (left(), right()) } else { rayon::join(left, right) };
        Branch::inner(bounds, left, right)
    }

    /// The best cut, unless the node is better left a leaf.
    fn worthwhile_cut(&self, cell: &Bounds, orders: &Orders, cuts_left: usize) -> Option<Cut> {
        if orders.len() <= self.leaf_limit || cuts_left == 0 {
            return None;
        }
        let area = cell.area();
        let cost_as_leaf = area * orders.len() as f64;
        // An infinite cost of a node without area is not a number, and no reason to cut.
        (self.seek)(cell, self.points, orders.as_slices())
            .filter(|cut| self.empty_cost.of(area) + cut.cost <= cost_as_leaf)
    }

    /// Within a leaf, points keep the order in which they were given.
    fn leaf(&self, orders: Orders) -> Branch {
        let bounds = orders.tight_box(self.points);
        let [order, ..] = orders.along;
        order.sort_unstable();
        Branch::leaf(bounds, order.len())
    }
}

/// The points of one node, sorted along each axis, with room to partition them.
struct Orders<'a> {
    along: [&'a mut [u32]; 3],
    scratch: &'a mut [u32],
}

impl<'a> Orders<'a> {
    fn len(&self) -> usize {
        self.scratch.len()
    }

    fn as_slices(&self) -> [&[u32]; 3] {
        [&*self.along[0], &*self.along[1], &*self.along[2]]
    }

    /// The ends of each sorted run.
    fn tight_box(&self, points: &[[f32; 3]]) -> Bounds {
        let coordinate = |axis: usize, i: usize| points[self.along[axis][i] as usize][axis];
        Bounds {
            lo: std::array::from_fn(|axis| coordinate(axis, 0)),
            hi: std::array::from_fn(|axis| coordinate(axis, self.len() - 1)),
        }
    }

    /// Moves the left points of a cut to the front of every run, keeping each side sorted.
    fn partition(&mut self, points: &[[f32; 3]], cut: &Cut) {
        for axis in (0..3).filter(|&axis| axis != cut.axis) {
            let run = &mut *self.along[axis];
            let (mut kept, mut moved) = (0, 0);
            for i in 0..run.len() {
                let index = run[i];
                if cut.is_left(points[index as usize][cut.axis]) {
                    run[kept] = index;
                    kept += 1;
                } else {
                    self.scratch[moved] = index;
                    moved += 1;
                }
            }
            run[kept..].copy_from_slice(&self.scratch[..moved]);
        }
    }

    fn split_at(self, left: usize) -> (Self, Self) {
        let [x, y, z] = self.along.map(|run| run.split_at_mut(left));
        let scratch = self.scratch.split_at_mut(left);
        let low = Self { along: [x.0, y.0, z.0], scratch: scratch.0 };
        let high = Self { along: [x.1, y.1, z.1], scratch: scratch.1 };
        (low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::best_cut;
    use crate::{KdTree, SplitRule};

    fn leaves(points: &[[f32; 3]], empty_cost: EmptyCost, leaf_limit: usize) -> usize {
        build(points, empty_cost, leaf_limit, best_cut).0.leaves()
    }

    #[test]
    fn the_cost_of_an_empty_node_stops_the_cuts() {
        // A line of equal steps in a flat cell of width 1: halving saves half of S N.
        let points: Vec<[f32; 3]> = (0..64).map(|i| [i as f32, (i % 2) as f32, 0.0]).collect();
        assert_eq!(leaves(&points, EmptyCost::NodeAreas(0.0), 1), 64);
        let some = leaves(&points, EmptyCost::NodeAreas(4.0), 1);
        assert!((4..32).contains(&some), "{some} leaves");
        assert_eq!(leaves(&points, EmptyCost::NodeAreas(1e9), 1), 1);
        assert_eq!(leaves(&points, EmptyCost::Constant(f64::INFINITY), 1), 1);
    }

    #[test]
    fn a_constant_cost_depends_on_scale_and_node_areas_do_not() {
        let grid = |step: f32| -> Vec<[f32; 3]> {
            (0..512).map(|i| [i & 7, (i >> 3) & 7, i >> 6].map(|c| c as f32 * step)).collect()
        };
        let (small, large) = (grid(0.125), grid(64.0));
        let areas = EmptyCost::NodeAreas(6.0);
        assert_eq!(leaves(&small, areas, 1), leaves(&large, areas, 1));
        let constant = EmptyCost::Constant(40.0);
        assert!(leaves(&small, constant, 1) < leaves(&large, constant, 1));
    }

    #[test]
    fn depth_is_limited_where_every_cut_peels_off_a_few_points() {
        assert_eq!([1, 2, 3, 1 << 31].map(depth_limit), [16, 18, 20, 78]);
        // Cubes that halve: by eq. 2 it is cheapest to take off the few outermost points.
        let points: Vec<[f32; 3]> = (0..250).map(|i| [2f32.powi(i - 125); 3]).collect();
        let root = build(&points, EmptyCost::NodeAreas(0.0), 1, best_cut).0;
        assert_eq!(root.cuts(), depth_limit(250));
        assert!(depth_limit(crate::tree::MAX_POINTS) < crate::tree::MAX_DEPTH);
        let rule = SplitRule::SurfaceArea { empty_cost: EmptyCost::NodeAreas(0.0) };
        let tree = KdTree::build_with_leaf_limit(points, vec![(); 250], rule, 1).unwrap();
        assert!(tree.shape().largest_leaf > 50, "{:?}", tree.shape());
    }

    #[test]
    fn a_leaf_keeps_the_order_given() {
        let points: Vec<[f32; 3]> = (0..99).map(|i| [-(i as f32), 0.0, (i % 7) as f32]).collect();
        let (_, order) = build(&points, EmptyCost::Constant(f64::INFINITY), 1, best_cut);
        assert!((0..99).all(|place| order.columns().index(place as usize) == place));
    }
}
