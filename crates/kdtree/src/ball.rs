//! All points in a closed ball.

use crate::block::{BLOCK, Block, lanes_in};
use crate::lanes::{Lanes, Task, dispatch};
use crate::node::Node;
use crate::tree::KdTree;
use crate::visits::{Meter, Unmetered, Visits};

/// Is shown the blocks that may have points in the ball.
trait Visitor {
    /// What it gathers on the way, in registers where it can.
    type State<L: Lanes>;

    fn start<L: Lanes>() -> Self::State<L>;

    /// Point `first + i` is in the ball where bit i of `mask` is set.
    fn visit<L: Lanes>(&mut self, state: &mut Self::State<L>, first: usize, mask: u16, distances: L::Floats);

    fn finish<L: Lanes>(&mut self, state: Self::State<L>);
}

/// Is shown blocks of sixteen points that lie in a ball.
///
/// A closure does for [`KdTree::within_blocks`]; a type of one's own can mark its `visit` `#[inline(always)]`, so that it is compiled
/// with the vector instructions of the tree.
pub trait VisitBlock {
    /// The point of tree index `first + i` is in the ball, at the squared distance of lane i, where bit i of `mask` is set: at least
    /// one is.
    fn visit(&mut self, first: usize, mask: u16, distances: &[f32; BLOCK]);
}

impl<V: FnMut(usize, u16, &[f32; BLOCK])> VisitBlock for V {
    #[inline(always)]
    fn visit(&mut self, first: usize, mask: u16, distances: &[f32; BLOCK]) {
        self(first, mask, distances);
    }
}

/// Passes blocks on.
struct Each<V>(V);

impl<V: VisitBlock> Visitor for Each<V> {
    type State<L: Lanes> = ();

    #[inline(always)]
    fn start<L: Lanes>() {}

    #[inline(always)]
    fn visit<L: Lanes>(&mut self, _: &mut (), first: usize, mask: u16, distances: L::Floats) {
        if mask != 0 {
            self.0.visit(first, mask, &L::store(distances));
        }
    }

    #[inline(always)]
    fn finish<L: Lanes>(&mut self, _: ()) {}
}

/// Adds the payloads, in sixteen lanes; of few channels also those of no point, which costs less than to guess whether there is one.
struct Sum<'a, const N: usize> {
    payload: &'a [[f32; N]],
    sums: [[f32; BLOCK]; N],
}

impl<const N: usize> Visitor for Sum<'_, N> {
    type State<L: Lanes> = [L::Floats; N];

    #[inline(always)]
    fn start<L: Lanes>() -> [L::Floats; N] {
        [L::load(&[0.0; BLOCK]); N]
    }

    #[inline(always)]
    fn visit<L: Lanes>(&mut self, sums: &mut [L::Floats; N], first: usize, mask: u16, _: L::Floats) {
        if N > 4 && mask == 0 {
            return;
        }
        match self.payload[first..].first_chunk::<BLOCK>() {
            Some(rows) => L::add_rows(sums, rows.as_flattened(), mask),
            None => {
                let mut rows = [[0.0; N]; BLOCK];
                rows[..self.payload.len() - first].copy_from_slice(&self.payload[first..]);
                L::add_rows(sums, rows.as_flattened(), mask);
            }
        }
    }

    #[inline(always)]
    fn finish<L: Lanes>(&mut self, sums: [L::Floats; N]) {
        self.sums = sums.map(L::store);
    }
}

impl<const N: usize> Sum<'_, N> {
    /// The lanes added in pairs, and the pairs likewise.
    fn total(&self) -> [f32; N] {
        let sums = self.sums.as_flattened();
        std::array::from_fn(|channel| {
            let mut lanes: [f32; BLOCK] = std::array::from_fn(|lane| sums[lane * N + channel]);
            for half in [8, 4, 2, 1] {
                for lane in 0..half {
                    lanes[lane] += lanes[lane + half];
                }
            }
            lanes[0]
        })
    }
}

/// A walk in tree order.
struct Walk<'a, V, M> {
    nodes: &'a [Node],
    blocks: &'a [Block],
    query: [f32; 3],
    reach: f32,
    visitor: &'a mut V,
    meter: &'a mut M,
}

impl<V: Visitor, M: Meter> Walk<'_, V, M> {
    #[inline(always)]
    fn open<L: Lanes>(&mut self, node: usize) -> u16 {
        self.meter.inner();
        let node = &self.nodes[node];
        L::within(L::to_boxes(node, &self.query), self.reach) & node.live
    }

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, state: &mut V::State<L>, points: std::ops::Range<usize>) {
        self.meter.leaf(points.len());
        if points.start.is_multiple_of(BLOCK) && points.len() <= BLOCK {
            return self.block::<L>(state, points.start / BLOCK, u16::MAX >> (BLOCK - points.len()));
        }
        for block in points.start / BLOCK..points.end.div_ceil(BLOCK) {
            self.block::<L>(state, block, lanes_in(&points, block));
        }
    }

    #[inline(always)]
    fn block<L: Lanes>(&mut self, state: &mut V::State<L>, block: usize, lanes: u16) {
        let distances = L::to_points(&self.blocks[block], &self.query);
        let mask = L::within(distances, self.reach) & lanes;
        self.visitor.visit::<L>(state, block * BLOCK, mask, distances);
    }
}

impl<V: Visitor, M: Meter> Task for Walk<'_, V, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let mut state = V::start::<L>();
        let mut pending = [(0u32, 0u16); crate::tree::MAX_DEPTH];
        let mut depth = 0;
        let (mut node, mut mask) = (0, self.open::<L>(0));
        loop {
            if mask == 0 {
                if depth == 0 {
                    return self.visitor.finish::<L>(state);
                }
                depth -= 1;
                (node, mask) = (pending[depth].0 as usize, pending[depth].1);
                continue;
            }
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let parent = &self.nodes[node];
            if parent.is_inner(lane) {
                if mask != 0 {
                    pending[depth] = (node as u32, mask);
                    depth += 1;
                }
                node = parent.child(lane);
                mask = self.open::<L>(node);
            } else {
                self.leaf::<L>(&mut state, parent.points(lane));
            }
        }
    }
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Calls `visit(tree index, squared distance)` for every point of the closed ball, by rising tree index.
    ///
    /// In the ball are the points whose [`distance_squared`](crate::distance_squared) to `query` is at most
    /// `radius * radius`, both as computed in `f32`. So a point exactly at a representable radius along an axis
    /// is inside, an infinite radius takes every point, radius zero takes the points at computed distance zero,
    /// and a radius whose square overflows or vanishes acts as infinity or zero. A negative or NaN radius, or a
    /// query with a NaN coordinate, takes nothing; an infinite coordinate is infinitely far from every point. Does not allocate.
    pub fn within(&self, query: [f32; 3], radius: f32, mut visit: impl FnMut(usize, f32)) {
        self.within_blocks(query, radius, |first, mask, distances| each(first, mask, distances, &mut visit));
    }

    /// [`within`](Self::within), telling what the walk cost.
    pub fn within_counted(&self, query: [f32; 3], radius: f32, mut visit: impl FnMut(usize, f32)) -> Visits {
        let mut visits = Visits::default();
        let mut each = Each(|first, mask, distances: &[f32; BLOCK]| each(first, mask, distances, &mut visit));
        self.walk_ball(query, radius, &mut each, &mut visits);
        visits
    }

    /// [`within`](Self::within) by blocks of sixteen: `visit(first, mask, squared distances)` for every block with
    /// points in the ball, by rising `first`.
    ///
    /// The point of tree index `first + i` is in the ball where bit i of the mask is set; the distances of other
    /// lanes mean nothing. A block can be shown more than once where leaves share it, with other bits each time.
    pub fn within_blocks(&self, query: [f32; 3], radius: f32, visit: impl FnMut(usize, u16, &[f32; BLOCK])) {
        self.visit_within(query, radius, visit);
    }

    /// [`within_blocks`](Self::within_blocks) for a visitor that is a type of its own.
    pub fn visit_within(&self, query: [f32; 3], radius: f32, visitor: impl VisitBlock) {
        self.walk_ball(query, radius, &mut Each(visitor), &mut Unmetered);
    }

    fn walk_ball<V: Visitor>(&self, query: [f32; 3], radius: f32, visitor: &mut V, meter: &mut impl Meter) {
        if radius >= 0.0 && !self.is_empty() && !query.iter().any(|c| c.is_nan()) {
            let (nodes, blocks, reach) = (&self.nodes[..], &self.blocks[..], radius * radius);
            dispatch(self.instructions, Walk { nodes, blocks, query, reach, visitor, meter });
        }
    }
}

impl<const N: usize> KdTree<[f32; N]> {
    /// Sum of the payloads in the ball of [`within`](Self::within); zero where that takes nothing.
    ///
    /// Payloads are added in sixteen lanes, lane i those of tree index i modulo 16 by rising index, and the lanes
    /// at the end in pairs: the same bits whatever the instructions.
    pub fn sum_within(&self, query: [f32; 3], radius: f32) -> [f32; N] {
        let mut sum = Sum { payload: &self.payload, sums: [[0.0; BLOCK]; N] };
        self.walk_ball(query, radius, &mut sum, &mut Unmetered);
        sum.total()
    }
}

#[inline(always)]
fn each(first: usize, mut mask: u16, distances: &[f32; BLOCK], visit: &mut impl FnMut(usize, f32)) {
    while mask != 0 {
        let lane = mask.trailing_zeros() as usize;
        visit(first + lane, distances[lane]);
        mask &= mask - 1;
    }
}
