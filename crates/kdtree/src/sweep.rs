//! The exact minimum of eq. 2 over every plane through a point.

use crate::bounds::Bounds;

/// A plane and the side of the points that lie in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    pub(crate) axis: usize,
    pub(crate) at: f32,
    /// Whether the points in the plane go to the left.
    pub(crate) ties_left: bool,
    /// Points on the left, zero and all included.
    pub(crate) left: usize,
    /// `S_left * N_left + S_right * N_right`, without `Ec`.
    pub(crate) cost: f64,
}

impl Cut {
    /// Whether a point of this coordinate on the cut's axis goes to the left.
    #[inline]
    pub(crate) fn is_left(&self, coordinate: f32) -> bool {
        coordinate < self.at || (self.ties_left && coordinate == self.at)
    }
}

/// A way to find the best cut of a cell, of whose points the `orders` are the sorted numbers along each axis.
pub(crate) type Seek = fn(cell: &Bounds, points: &[[f32; 3]], orders: [&[u32]; 3]) -> Option<Cut>;

/// The same as [`best_cut`] by the paper's enumeration: for every point a plane, and for every plane a look at every
/// point. Quadratic; there to be measured.
pub(crate) fn enumerated_cut(cell: &Bounds, points: &[[f32; 3]], orders: [&[u32]; 3]) -> Option<Cut> {
    let mut best = None;
    for axis in 0..3 {
        let (slab, count) = (Slab::new(cell, axis), orders[axis].len());
        for &index in orders[axis] {
            let at = points[index as usize][axis];
            for ties_left in [false, true] {
                let mut cut = Cut { axis, at, ties_left, left: 0, cost: 0.0 };
                cut.left = orders[axis].iter().filter(|&&other| cut.is_left(points[other as usize][axis])).count();
                cut.cost = slab.cost(at, cut.left, count);
                if changes(&cut, cell, count) {
                    keep_better(&mut best, cut, count);
                }
            }
        }
    }
    best
}

/// Whether a cut parts the points or shrinks the cell.
fn changes(cut: &Cut, cell: &Bounds, count: usize) -> bool {
    (cut.left > 0 || cut.at > cell.lo[cut.axis]) && (cut.left < count || cut.at < cell.hi[cut.axis])
}

/// The best cut of a cell; none where its points coincide and it cannot shrink either.
///
/// `orders[axis]` numbers the cell's points by rising coordinate on that axis.
pub(crate) fn best_cut(cell: &Bounds, points: &[[f32; 3]], orders: [&[u32]; 3]) -> Option<Cut> {
    let mut best = None;
    for axis in 0..3 {
        sweep(cell, points, orders[axis], axis, &mut best);
    }
    best
}

/// Tries every plane across one axis, the points of equal coordinate first on its right, then on its left.
fn sweep(cell: &Bounds, points: &[[f32; 3]], order: &[u32], axis: usize, best: &mut Option<Cut>) {
    let slab = Slab::new(cell, axis);
    let coordinate = |i: usize| points[order[i] as usize][axis];
    let count = order.len();
    let mut first = 0;
    while first < count {
        let at = coordinate(first);
        let mut end = first + 1;
        while end < count && coordinate(end) == at {
            end += 1;
        }
        for (left, ties_left) in [(first, false), (end, true)] {
            let cut = Cut { axis, at, ties_left, left, cost: slab.cost(at, left, count) };
            if changes(&cut, cell, count) {
                keep_better(best, cut, count);
            }
        }
        first = end;
    }
}

/// Earlier candidates win full ties, so the lower axis and then the lower coordinate does.
fn keep_better(best: &mut Option<Cut>, cut: Cut, count: usize) {
    let unevenness = |cut: &Cut| cut.left.abs_diff(count - cut.left);
    let better = best
        .as_ref()
        .is_none_or(|best| cut.cost < best.cost || (cut.cost == best.cost && unevenness(&cut) < unevenness(best)));
    if better {
        *best = Some(cut);
    }
}

/// A cell seen along one axis: the area of a slice is linear in its thickness.
struct Slab {
    lo: f64,
    hi: f64,
    faces: f64,
    rim: f64,
}

impl Slab {
    fn new(cell: &Bounds, axis: usize) -> Self {
        let extent = cell.extent();
        let (b, c) = (extent[(axis + 1) % 3], extent[(axis + 2) % 3]);
        let (lo, hi) = (f64::from(cell.lo[axis]), f64::from(cell.hi[axis]));
        Self { lo, hi, faces: 2.0 * b * c, rim: 2.0 * (b + c) }
    }

    #[inline]
    fn cost(&self, at: f32, left: usize, count: usize) -> f64 {
        let at = f64::from(at);
        let area_left = self.faces + self.rim * (at - self.lo);
        let area_right = self.faces + self.rim * (self.hi - at);
        area_left * left as f64 + area_right * (count - left) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn orders(points: &[[f32; 3]]) -> [Vec<u32>; 3] {
        std::array::from_fn(|axis| {
            let mut order: Vec<u32> = (0..points.len() as u32).collect();
            order.sort_by(|&a, &b| points[a as usize][axis].total_cmp(&points[b as usize][axis]));
            order
        })
    }

    fn swept(cell: &Bounds, points: &[[f32; 3]]) -> Option<Cut> {
        let orders = orders(points);
        best_cut(cell, points, [&orders[0], &orders[1], &orders[2]])
    }

    /// Eq. 2 by enumeration: every point's coordinate, both sides for ties, counts by looking at each point.
    fn enumerated(cell: &Bounds, points: &[[f32; 3]]) -> Option<f64> {
        let mut best: Option<f64> = None;
        for (axis, at, ties_left) in
            (0..3).flat_map(|a| points.iter().flat_map(move |p| [(a, p[a], false), (a, p[a], true)]))
        {
            let left = points.iter().filter(|p| p[axis] < at || (ties_left && p[axis] == at)).count();
            let right = points.len() - left;
            let (low, high) = cell.cut(axis, at);
            if (left == 0 && low.extent()[axis] == 0.0) || (right == 0 && high.extent()[axis] == 0.0) {
                continue;
            }
            let cost = low.area() * left as f64 + high.area() * right as f64;
            best = Some(best.map_or(cost, |b| b.min(cost)));
        }
        best
    }

    #[test]
    fn cuts_between_two_clusters_and_puts_a_wall_in_a_flat_cell() {
        // Unit square walls at x = 0 and x = 10: the first cut makes one wall a flat cell.
        let wall = |x: f32| [[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.0, 1.0], [x, 1.0, 1.0]];
        let points: Vec<_> = wall(0.0).into_iter().chain(wall(10.0)).collect();
        let cut = swept(&Bounds::around(points.iter().copied()), &points).unwrap();
        assert_eq!((cut.axis, cut.at, cut.ties_left, cut.left), (0, 0.0, true, 4));
        assert_eq!(cut.cost, 2.0 * 4.0 + 42.0 * 4.0);
    }

    #[test]
    fn shrinks_a_cell_to_its_points_and_then_stops() {
        let points = [[0.5; 3]; 3];
        let mut cell = Bounds { lo: [0.0; 3], hi: [1.0; 3] };
        for _ in 0..6 {
            let cut = swept(&cell, &points).unwrap();
            let (low, high) = cell.cut(cut.axis, cut.at);
            cell = if cut.left == 0 { high } else { low };
        }
        assert_eq!((cell.area(), swept(&cell, &points)), (0.0, None));
    }

    #[test]
    fn equal_costs_prefer_even_counts() {
        // On a line every area is zero.
        let points: Vec<_> = (0..10).map(|i| [0.0, 0.0, (i * i) as f32]).collect();
        let cut = swept(&Bounds::around(points.iter().copied()), &points).unwrap();
        assert_eq!((cut.axis, cut.at, cut.left, cut.cost), (2, 16.0, 5, 0.0));
    }

    proptest! {
        #[test]
        fn equals_enumeration(
            grid in prop::collection::vec(prop::array::uniform3(-3i8..4), 1..40),
            margin in prop::array::uniform3(0u8..2),
        ) {
            let points: Vec<[f32; 3]> = grid.iter().map(|p| p.map(f32::from)).collect();
            let mut cell = Bounds::around(points.iter().copied());
            for axis in 0..3 {
                cell.lo[axis] -= f32::from(margin[axis]);
            }
            // Small whole numbers: every cost is exact, so the comparison is too.
            let cut = swept(&cell, &points);
            prop_assert_eq!(cut.map(|c| c.cost), enumerated(&cell, &points));
            let orders = orders(&points);
            prop_assert_eq!(cut, enumerated_cut(&cell, &points, [&orders[0], &orders[1], &orders[2]]));
            if let Some(cut) = cut {
                let left = points.iter().filter(|p| cut.is_left(p[cut.axis])).count();
                prop_assert_eq!(left, cut.left);
            }
        }
    }
}
