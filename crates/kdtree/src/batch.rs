//! Many queries at once.

use rayon::prelude::*;

use crate::neighbours::Neighbours;
use crate::tree::KdTree;

/// Queries that one thread answers in a row.
const RUN: usize = 1024;

impl<P: Copy + Send + Sync> KdTree<P> {
    /// `ask(i, memory)` for each query `queries[i]`, in an order in which queries follow near ones; answers in the
    /// order given.
    ///
    /// Neighbouring queries share what they read and bound each other's search. Runs on rayon's current thread pool,
    /// each thread with memory of its own; the answers do not depend on it where `ask` leaves them to the tree.
    pub fn batch<T: Send>(&self, queries: &[[f32; 3]], ask: impl Fn(usize, &mut Neighbours) -> T + Sync) -> Vec<T> {
        let mut order: Vec<u64> =
            queries.par_iter().zip(0..queries.len()).map(|(&q, i)| self.place(q) | i as u64).collect();
        order.par_sort_unstable();
        let answer = |run: &[u64]| {
            let mut memory = Neighbours::default();
            let numbers = run.iter().map(|&key| (key & u64::from(u32::MAX)) as usize);
            numbers.map(|i| (i, ask(i, &mut memory))).collect::<Vec<_>>()
        };
        let runs: Vec<Vec<(usize, T)>> = order.par_chunks(RUN).map(answer).collect();
        let mut answers: Vec<Option<T>> = std::iter::repeat_with(|| None).take(queries.len()).collect();
        runs.into_iter().flatten().for_each(|(i, answer)| answers[i] = Some(answer));
        answers.into_iter().map(|answer| answer.expect("every query is in one run")).collect()
    }

    /// Along a Morton curve through the points' box, in the upper 32 bits: 10 bits an axis.
    fn place(&self, query: [f32; 3]) -> u64 {
        const CELLS: f32 = 1024.0;
        let Some(root) = self.nodes.first() else { return 0 };
        let cell = |axis: usize| {
            let children = root.live.count_ones() as usize;
            let lo = root.lo[axis][..children].iter().copied().fold(f32::INFINITY, f32::min);
            let hi = root.hi[axis][..children].iter().copied().fold(f32::NEG_INFINITY, f32::max);
            // A query outside, or NaN, goes to an end.
            ((query[axis] - lo) / (hi - lo) * CELLS).clamp(0.0, CELLS - 1.0) as u64
        };
        let spread = |x: u64| (0..10).fold(0, |bits, bit| bits | (x >> bit & 1) << (3 * bit));
        (spread(cell(0)) | spread(cell(1)) << 1 | spread(cell(2)) << 2) << 32
    }
}
