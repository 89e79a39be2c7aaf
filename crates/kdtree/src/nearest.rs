//! The k nearest points, of all or of those that the caller accepts.

use crate::accept::{Accept, All, Asked, InBlocks};
use crate::block::{BLOCK, Block, lanes_in};
use crate::candidates::Candidates;
use crate::lanes::{Lanes, Task, dispatch};
use crate::neighbours::{Last, Neighbours};
use crate::node::{Node, WIDTH};
use crate::tree::{KdTree, MAX_DEPTH};
use crate::visits::{Meter, Unmetered, Visits};

/// A walk that opens nearer children first, from a first reach that shrinks.
struct Walk<'a, A, M> {
    nodes: &'a [Node],
    blocks: &'a [Block],
    query: [f32; 3],
    k: usize,
    reach: f32,
    accept: &'a mut A,
    meter: &'a mut M,
    candidates: &'a mut Candidates,
    pending: &'a mut [u64],
}

/// Low bits of a squared distance give way to the number of a lane.
const LANE: u32 = WIDTH as u32 - 1;

impl<A: Accept, M: Meter> Walk<'_, A, M> {
    /// Lays the children within reach on the pile, the nearest on top; returns the pile's new height.
    ///
    /// The order is fixed by the tree and query: a smaller reach skips children but never swaps two.
    #[inline(always)]
    fn open<L: Lanes>(&mut self, number: usize, height: usize) -> usize {
        self.meter.inner();
        let node = &self.nodes[number];
        let distances = L::to_boxes(node, &self.query);
        let mask = L::within(distances, self.reach) & node.live;
        let distances = L::store(distances);
        let keys: [u32; WIDTH] = std::array::from_fn(|lane| distances[lane].to_bits() & !LANE | lane as u32);
        let pile: &mut [u64; WIDTH] = self.pending[height..].first_chunk_mut().expect("room for the deepest tree");
        let mut left = mask;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            let key = keys[lane];
            if node.is_inner(lane) {
                L::prefetch(&self.nodes[node.child(lane)..][..1]);
            } else {
                L::prefetch(&self.blocks[node.points(lane).start / BLOCK..][..1]);
            }
            let farther = L::greater(&keys, mask, key).count_ones();
            pile[farther as usize & (WIDTH - 1)] = u64::from(key) << 32 | number as u64;
            left &= left - 1;
        }
        height + mask.count_ones() as usize
    }

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, points: std::ops::Range<usize>, places: usize) {
        self.meter.leaf(points.len());
        for block in points.start / BLOCK..points.end.div_ceil(BLOCK) {
            let distances = L::to_points(&self.blocks[block], &self.query);
            let mask = L::within(distances, self.reach) & lanes_in(&points, block);
            let mask = self.accept.ask(block * BLOCK, mask);
            if mask != 0 {
                self.candidates.append::<L>(block * BLOCK, mask, distances);
                if self.candidates.len() >= places {
                    self.reach = self.candidates.select::<L>(self.k, self.k + (places - self.k) / 2);
                }
            }
        }
    }
}

impl<A: Accept, M: Meter> Task for Walk<'_, A, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let places = Candidates::places(self.k);
        let mut height = self.open::<L>(0, 0);
        while height > 0 {
            height -= 1;
            let key = (self.pending[height] >> 32) as u32;
            if f32::from_bits(key & !LANE) > self.reach {
                continue;
            }
            let (node, lane) = (&self.nodes[self.pending[height] as u32 as usize], (key & LANE) as usize);
            if node.is_inner(lane) {
                height = self.open::<L>(node.child(lane), height);
            } else {
                self.leaf::<L>(node.points(lane), places);
            }
        }
        if self.candidates.len() > self.k {
            self.candidates.select::<L>(self.k, self.k);
        }
    }
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Leaves in `found` the `k` nearest points of the closed ball of `max_radius`, or all of them if there are
    /// fewer.
    ///
    /// The ball is that of [`within`](Self::within), so an infinite radius excludes nothing; a negative or NaN
    /// radius, or a query with a NaN coordinate, finds nothing. Of points equally far, those that come first in
    /// tree order are found. Allocates only where `found` has never held so many.
    pub fn nearest(&self, query: [f32; 3], k: usize, max_radius: f32, found: &mut Neighbours) {
        self.nearest_metered(query, k, max_radius, &mut All, found, &mut Unmetered);
    }

    /// [`nearest`](Self::nearest) of the points that `accept` takes by their payload.
    ///
    /// It is asked only about points within the reach so far, at most once about each, or twice after a
    /// query with the same `found` whose answer proved no bound. It should depend on the payload alone, for the
    /// order of asking is that of the walk.
    pub fn nearest_accepted(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        accept: impl FnMut(&P) -> bool,
        found: &mut Neighbours,
    ) {
        self.nearest_metered(query, k, max_radius, &mut Asked(&self.payload, accept), found, &mut Unmetered);
    }

    /// The same, asking about the points of a block together: `accept` is told the tree index of the block's first point, a multiple of
    /// [`BLOCK`], and the points in question as bits, of which it returns those that count.
    pub fn nearest_of_blocks(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        accept: impl FnMut(usize, u16) -> u16,
        found: &mut Neighbours,
    ) {
        self.nearest_metered(query, k, max_radius, &mut InBlocks(accept), found, &mut Unmetered);
    }

    /// [`nearest_accepted`](Self::nearest_accepted), telling what the walk cost.
    pub fn nearest_counted(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        accept: impl FnMut(&P) -> bool,
        found: &mut Neighbours,
    ) -> Visits {
        let mut visits = Visits::default();
        self.nearest_metered(query, k, max_radius, &mut Asked(&self.payload, accept), found, &mut visits);
        visits
    }

    /// Squared distance of the `k`-th nearest point within `max_radius`; none where there are fewer, or k is 0.
    pub fn kth_distance_squared(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        found: &mut Neighbours,
    ) -> Option<f32> {
        self.nearest(query, k, max_radius, found);
        found.farthest_squared().filter(|_| found.len() == k)
    }

    fn nearest_metered(
        &self,
        query: [f32; 3],
        k: usize,
        max_radius: f32,
        accept: &mut impl Accept,
        found: &mut Neighbours,
        meter: &mut impl Meter,
    ) {
        found.candidates.clear();
        let k = k.min(self.len());
        if k == 0 || max_radius.is_nan() || max_radius < 0.0 || query.iter().any(|c| c.is_nan()) {
            return;
        }
        let most = max_radius * max_radius;
        let first = found.last.and_then(|last| last.bound(query, k)).map_or(most, |bound| bound.min(most));
        self.walk_nearest(query, k, first, accept, found, meter);
        if found.len() < k && first < most {
            // The bound was no bound: the points, or what is accepted, are others than at the last query.
            found.candidates.clear();
            self.walk_nearest(query, k, most, accept, found, meter);
        }
        let full = found.farthest_squared().filter(|_| found.len() == k);
        found.last = full.map(|farthest_squared| Last { query, k, farthest_squared });
    }

    fn walk_nearest(
        &self,
        query: [f32; 3],
        k: usize,
        reach: f32,
        accept: &mut impl Accept,
        found: &mut Neighbours,
        meter: &mut impl Meter,
    ) {
        found.pending.resize(MAX_DEPTH * WIDTH, 0);
        let (nodes, blocks) = (&self.nodes[..], &self.blocks[..]);
        let (candidates, pending) = (&mut found.candidates, &mut found.pending[..]);
        dispatch(self.instructions, Walk { nodes, blocks, query, k, reach, accept, meter, candidates, pending });
    }
}

impl<const N: usize> KdTree<[f32; N]> {
    /// Sum of the payloads of points found in this tree, added in four chains and those in order.
    ///
    /// # Panics
    ///
    /// If `found` holds an index that this tree has not.
    pub fn sum_of(&self, found: &Neighbours) -> [f32; N] {
        let mut chains = [[0.0; N]; 4];
        for four in found.indices().chunks(4) {
            for (chain, &index) in chains.iter_mut().zip(four) {
                let payload = &self.payload[index as usize];
                (0..N).for_each(|channel| chain[channel] += payload[channel]);
            }
        }
        std::array::from_fn(|channel| chains.iter().map(|chain| chain[channel]).sum())
    }
}

impl Last {
    /// A reach that should hold k points: the last ball fits into one this much larger around the new query.
    ///
    /// Rounding makes it no certain bound, but an answer with k points is exact whatever the reach.
    fn bound(&self, query: [f32; 3], k: usize) -> Option<f32> {
        const ROUNDING: f32 = 1.0 + 1e-5;
        let moved = crate::distance_squared(self.query, query);
        // From farther off, the bound is worse than what the walk soon finds.
        (k == self.k && moved <= self.farthest_squared)
            .then(|| (self.farthest_squared.sqrt() + moved.sqrt()).powi(2) * ROUNDING)
    }
}
