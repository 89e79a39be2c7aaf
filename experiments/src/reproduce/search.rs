//! One kind of query put to a tree many times, and what it costs.

use photonlab_kdtree::{KdTree, Neighbours};
use rayon::prelude::*;

use super::cpu_clock::CpuClock;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Search {
    /// The k nearest.
    Nearest(usize),
    /// All within a radius.
    Radius(f32),
}

/// Means per query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Cost {
    /// Opened, leaves included.
    pub(super) nodes: f64,
    /// Photons whose distance was computed.
    pub(super) tested: f64,
    /// Photons in the answer.
    pub(super) found: f64,
}

impl Search {
    /// Counts the work of queries that know nothing of one another.
    pub(super) fn cost<P: Copy + Send + Sync>(self, tree: &KdTree<P>, queries: &[[f32; 3]]) -> Cost {
        let one = |&query: &[f32; 3]| {
            let (visits, found) = match self {
                Self::Nearest(k) => {
                    let mut found = Neighbours::default();
                    let visits = tree.nearest_counted(query, k, f32::INFINITY, |_| true, &mut found);
                    (visits, found.len())
                }
                Self::Radius(radius) => {
                    let mut found = 0;
                    let visits = tree.within_counted(query, radius, |_, _| found += 1);
                    (visits, found)
                }
            };
            [visits.nodes, visits.points, found]
        };
        let add = |a: [usize; 3], b: [usize; 3]| std::array::from_fn(|i| a[i] + b[i]);
        let sums: [usize; 3] = queries.par_iter().map(one).reduce(|| [0; 3], add);
        let [nodes, tested, found] = sums.map(|sum| sum as f64 / queries.len() as f64);
        Cost { nodes, tested, found }
    }

    /// CPU seconds per query of one thread that asks them in turn, again and again for the least time.
    pub(super) fn seconds<P: Copy + Send + Sync>(self, tree: &KdTree<P>, queries: &[[f32; 3]], least: f64) -> f64 {
        let (mut memory, mut found, mut turns) = (Neighbours::default(), 0, 0);
        let clock = CpuClock::start();
        let mut sum = 0.0;
        while sum < least {
            for &query in queries {
                match self {
                    Self::Nearest(k) => tree.nearest(query, k, f32::INFINITY, &mut memory),
                    Self::Radius(radius) => {
                        tree.within_blocks(query, radius, |_, mask, _| found += mask.count_ones() as usize);
                    }
                }
            }
            turns += queries.len();
            sum = clock.seconds();
        }
        std::hint::black_box((&memory, found));
        sum / turns as f64
    }
}

/// The radius within which the typical query finds `count` photons: the median of the distances to the last of them.
pub(super) fn radius_holding<P: Copy + Send + Sync>(tree: &KdTree<P>, queries: &[[f32; 3]], count: usize) -> f32 {
    let last = |&query: &[f32; 3]| {
        tree.kth_distance_squared(query, count, f32::INFINITY, &mut Neighbours::default()).unwrap_or(f32::INFINITY)
    };
    let mut squares: Vec<f32> = queries.par_iter().map(last).collect();
    squares.sort_by(f32::total_cmp);
    squares[squares.len() / 2].sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use photonlab_kdtree::SplitRule;

    #[test]
    fn counts_on_a_line() {
        let line: Vec<[f32; 3]> = (0..64).map(|i| [i as f32, 0.0, 0.0]).collect();
        let tree = KdTree::build(line.clone(), vec![(); 64], SplitRule::Median).unwrap();
        // The first three of sixteen in one leaf.
        let cost = Search::Radius(2.0).cost(&tree, &line[..1]);
        assert_eq!(cost, Cost { nodes: 2.0, tested: 16.0, found: 3.0 });
        assert_eq!(Search::Nearest(5).cost(&tree, &line).found, 5.0);
        assert_eq!(radius_holding(&tree, &line[30..33], 3), 1.0);
    }
}
