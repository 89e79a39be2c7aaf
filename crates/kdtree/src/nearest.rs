//! The k nearest points that the caller accepts.

use crate::tree::KdTree;
use crate::visits::{Meter, Unmetered, Visits};
use crate::walk::{Collector, walk};

/// A point found near a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Where the point stands in tree order.
    pub index: usize,
    /// Its [`distance_squared`](crate::distance_squared) to the query, in the square of the coordinates' unit.
    pub distance_squared: f32,
}

/// Keeps the best `k` points so far; once there are `k`, as a heap with the worst on top.
struct Nearest<'a, A> {
    k: usize,
    reach: f32,
    original: &'a [u32],
    accept: A,
    found: &'a mut Vec<Neighbour>,
}

impl<A: FnMut(usize) -> bool> Collector for Nearest<'_, A> {
    const NEAR_FIRST: bool = true;

    #[inline]
    fn reach(&self) -> f32 {
        self.reach
    }

    fn offer(&mut self, index: usize, distance_squared: f32) {
        let candidate = Neighbour { index, distance_squared };
        let full = self.found.len() == self.k;
        if (full && !self.is_worse(self.found[0], candidate)) || !(self.accept)(index) {
            return;
        }
        if full {
            self.found[0] = candidate;
            self.sink(0);
        } else {
            self.found.push(candidate);
            if self.found.len() < self.k {
                return;
            }
            for parent in (0..self.k / 2).rev() {
                self.sink(parent);
            }
        }
        self.reach = self.found[0].distance_squared;
    }
}

impl<A> Nearest<'_, A> {
    /// Farther, or as far and given later.
    #[inline]
    fn is_worse(&self, a: Neighbour, b: Neighbour) -> bool {
        a.distance_squared > b.distance_squared
            || (a.distance_squared == b.distance_squared && self.original[a.index] > self.original[b.index])
    }

    /// Restores the heap below a parent that may be better than its children.
    fn sink(&mut self, mut parent: usize) {
        loop {
            let mut child = 2 * parent + 1;
            if child >= self.found.len() {
                return;
            }
            if child + 1 < self.found.len() && self.is_worse(self.found[child + 1], self.found[child]) {
                child += 1;
            }
            if !self.is_worse(self.found[child], self.found[parent]) {
                return;
            }
            self.found.swap(parent, child);
            parent = child;
        }
    }
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Leaves in `found` the `k` nearest accepted points of the closed ball of `max_radius`, or all of them if
    /// there are fewer, by rising squared distance and, where that is equal, rising original index.
    ///
    /// The ball is that of [`within`](Self::within), so an infinite radius excludes nothing; a negative or NaN
    /// radius, or a query with a NaN coordinate, finds nothing. `accept` is asked at most once about a point,
    /// and only about points that would be among the `k` best so far; it should depend on the payload alone, for
    /// the order of asking is that of the walk. `found` is cleared first, and nothing is allocated once its
    /// capacity is `k`.
    pub fn nearest(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        accept: impl FnMut(&P) -> bool,
        found: &mut Vec<Neighbour>,
    ) {
        self.nearest_metered(query, k, max_radius, accept, found, &mut Unmetered);
    }

    /// [`nearest`](Self::nearest), telling what the walk cost.
    pub fn nearest_counted(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        accept: impl FnMut(&P) -> bool,
        found: &mut Vec<Neighbour>,
    ) -> Visits {
        let mut visits = Visits::default();
        self.nearest_metered(query, k, max_radius, accept, found, &mut visits);
        visits
    }

    fn nearest_metered(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        mut accept: impl FnMut(&P) -> bool,
        found: &mut Vec<Neighbour>,
        meter: &mut impl Meter,
    ) {
        found.clear();
        if k == 0 || max_radius.is_nan() || max_radius < 0.0 {
            return;
        }
        let (payload, original) = (&self.payload, &self.original);
        let accept = |index: usize| accept(&payload[index]);
        let mut nearest = Nearest { k, reach: max_radius * max_radius, original, accept, found };
        walk(&self.nodes, &self.points, query, &mut nearest, meter);
        found.sort_unstable_by(|a, b| {
            let by_distance = a.distance_squared.total_cmp(&b.distance_squared);
            by_distance.then_with(|| original[a.index].cmp(&original[b.index]))
        });
    }
}
