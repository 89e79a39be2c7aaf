//! All points near a segment of a line.

use crate::block::{BLOCK, Block, lanes_in};
use crate::lanes::{Lanes, Task, dispatch};
use crate::node::{Node, WIDTH};
use crate::tree::KdTree;

/// What rounding in `f64` can do to a box's distance, in parts of the largest coordinate.
const SLACK: f64 = 1e-12;

/// Stands for the inverse of a length of zero: finite, so that zero times it is zero.
const STEEP: f64 = 1e300;

/// Squared distance from a point to a closed segment, given by its ends, in the square of their unit.
///
/// [`KdTree::near_segment`] decides by this value, so a loop over all points that calls this function is its
/// specification. A segment whose ends coincide is that point.
///
/// # Numerics
///
/// In `f64`, where no difference or product of finite `f32` overflows or vanishes; each step is rounded, never fused.
#[inline]
pub fn segment_distance_squared(ends: [[f32; 3]; 2], point: [f32; 3]) -> f64 {
    Segment::new(ends).distance_squared(point)
}

/// A segment ready to be measured from.
#[derive(Clone, Copy)]
struct Segment {
    start: [f64; 3],
    /// From its start to its end.
    span: [f64; 3],
    /// One over the square of its length; zero if it has none.
    per_square: f64,
}

impl Segment {
    #[inline(always)]
    fn new(ends: [[f32; 3]; 2]) -> Self {
        let [start, end] = ends.map(|end| end.map(f64::from));
        let span: [f64; 3] = std::array::from_fn(|axis| end[axis] - start[axis]);
        let square = ((span[0] * span[0]) + (span[1] * span[1])) + (span[2] * span[2]);
        Self { start, span, per_square: if square > 0.0 { 1.0 / square } else { 0.0 } }
    }

    #[inline(always)]
    fn distance_squared(&self, point: [f32; 3]) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|axis: usize| f64::from(point[axis]) - self.start[axis]);
        let along = (((x * self.span[0]) + (y * self.span[1])) + (z * self.span[2])) * self.per_square;
        let along = if along > 0.0 { along } else { 0.0 };
        let along = if along < 1.0 { along } else { 1.0 };
        let (x, y, z) = (x - along * self.span[0], y - along * self.span[1], z - along * self.span[2]);
        ((x * x) + (y * y)) + (z * z)
    }
}

/// A walk in tree order.
struct Walk<'a, V> {
    nodes: &'a [Node],
    blocks: &'a [Block],
    segment: Segment,
    /// One over the span, axis by axis.
    inverse: [f64; 3],
    /// The radius, and what rounding adds to it.
    grown: f64,
    reach: f64,
    visit: V,
}

impl<V: FnMut(usize, f64)> Walk<'_, V> {
    /// The children whose boxes, grown by the radius on all sides, the segment meets: where a point near it can lie.
    #[inline(always)]
    fn open(&self, node: usize) -> u16 {
        let node = &self.nodes[node];
        let (mut enters, mut leaves) = ([0.0f64; WIDTH], [1.0f64; WIDTH]);
        for axis in 0..3 {
            let (start, inverse) = (self.segment.start[axis], self.inverse[axis]);
            for lane in 0..WIDTH {
                let lo = (f64::from(node.lo[axis][lane]) - self.grown - start) * inverse;
                let hi = (f64::from(node.hi[axis][lane]) + self.grown - start) * inverse;
                let (first, last) = if lo < hi { (lo, hi) } else { (hi, lo) };
                enters[lane] = if first > enters[lane] { first } else { enters[lane] };
                leaves[lane] = if last < leaves[lane] { last } else { leaves[lane] };
            }
        }
        let bit = |lane: usize| if enters[lane] <= leaves[lane] + SLACK { 1u16 << lane } else { 0 };
        (0..WIDTH).fold(0, |mask, lane| mask | bit(lane)) & node.live
    }

    #[inline(always)]
    fn leaf(&mut self, points: std::ops::Range<usize>) {
        for block in points.start / BLOCK..points.end.div_ceil(BLOCK) {
            let axes = &self.blocks[block].axes;
            let mut distances = [0.0; BLOCK];
            for lane in 0..BLOCK {
                distances[lane] = self.segment.distance_squared([axes[0][lane], axes[1][lane], axes[2][lane]]);
            }
            let bit = |lane: usize| if distances[lane] <= self.reach { 1u16 << lane } else { 0 };
            let mut mask = (0..BLOCK).fold(0, |mask, lane| mask | bit(lane)) & lanes_in(&points, block);
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize;
                (self.visit)(block * BLOCK + lane, distances[lane]);
                mask &= mask - 1;
            }
        }
    }
}

impl<V: FnMut(usize, f64)> Task for Walk<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let mut pending = [(0u32, 0u16); crate::tree::MAX_DEPTH];
        let mut depth = 0;
        let (mut node, mut mask) = (0, self.open(0));
        loop {
            if mask == 0 {
                if depth == 0 {
                    return;
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
                mask = self.open(node);
            } else {
                self.leaf(parent.points(lane));
            }
        }
    }
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Calls `visit(tree index, squared distance)` for every point of a closed capsule, by rising tree index: those whose
    /// [`segment_distance_squared`] to the segment between `ends` is at most the square of `radius`, computed in `f64`.
    ///
    /// An infinite radius takes every point. A negative or NaN radius, or an end that is not finite, takes nothing. Does not
    /// allocate.
    pub fn near_segment(&self, ends: [[f32; 3]; 2], radius: f32, visit: impl FnMut(usize, f64)) {
        let coordinates = || ends.iter().flatten();
        if radius.is_nan() || radius < 0.0 || self.is_empty() || !coordinates().all(|c| c.is_finite()) {
            return;
        }
        let segment = Segment::new(ends);
        let radius = f64::from(radius);
        let largest = coordinates().fold(0.0, |largest: f64, &c| largest.max(f64::from(c.abs())));
        let walk = Walk {
            nodes: &self.nodes,
            blocks: &self.blocks,
            segment,
            inverse: segment.span.map(|span| if span == 0.0 { STEEP } else { 1.0 / span }),
            grown: radius + SLACK * (radius + largest),
            reach: radius * radius,
            visit,
        };
        dispatch(self.instructions, walk);
    }
}
