//! Where pruning fails, a query looks at everything once and no more; counted, not timed.

use crate::obvious::{RULES, build};
use photonlab_kdtree::{KdTree, Neighbours, Reach, SplitRule, VisitCost};

/// Points of the unit circle in the plane x = 0 whose computed distance to the centre of any circle about the x axis
/// is alike: a few exact ones, repeated.
fn equidistant(count: usize) -> Vec<[f32; 3]> {
    let corners = [[0.0, 3.0, 4.0], [0.0, -4.0, 3.0], [0.0, 5.0, 0.0], [0.0, -3.0, -4.0], [0.0, 0.0, -5.0]];
    (0..count).map(|i| corners[i * 7 % 5]).collect()
}

#[test]
fn all_equidistant_costs_one_look_at_each_point() {
    for count in [1_000, 16_000] {
        let points = equidistant(count);
        for rule in RULES.into_iter().filter(|rule| !matches!(rule, SplitRule::Enumeration { .. })) {
            let tree = build(&points, rule, 16);
            let shape = tree.shape();
            for k in [1, 100, count / 2, count - 1] {
                let (mut found, mut asked) = (Neighbours::default(), 0);
                let accept = |_: &usize| {
                    asked += 1;
                    true
                };
                let visits = tree.nearest_counted([7.0, 0.0, 0.0], k, f32::INFINITY, accept, &mut found);
                assert_eq!((visits.points, visits.nodes, asked), (count, shape.nodes, count), "{rule:?}");
                found.sort();
                let first: Vec<u32> = (0..k as u32).collect();
                assert_eq!(found.indices(), first, "the first in tree order");
                assert_eq!(found.farthest_squared(), Some(74.0));
            }
        }
    }
}

#[test]
fn memory_is_within_a_third_of_the_photons() {
    let mut state = 9u64;
    let mut draw = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f32 / (1u64 << 24) as f32
    };
    let volume: Vec<[f32; 3]> = (0..100_003).map(|_| [draw(), draw(), draw()]).collect();
    let sheet: Vec<[f32; 3]> = volume.iter().map(|&[x, y, _]| [x * x, y, 0.0]).collect();
    let costs = [VisitCost::SurfaceArea, VisitCost::BallOnSheet(Reach::Nearest(100))].map(SplitRule::Binned);
    for rule in [SplitRule::default(), SplitRule::Median, costs[0], costs[1]] {
        for points in [&volume, &sheet] {
            let tree = KdTree::build(points.clone(), vec![0u32; points.len()], rule).unwrap();
            let (held, given) = (tree.shape().bytes as f64, 16.0 * points.len() as f64);
            assert!(held <= 1.3 * given, "{rule:?}: {}", held / given);
            assert!(tree.shape().largest_leaf <= 16);
        }
    }
}
