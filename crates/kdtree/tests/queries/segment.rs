//! Points near a segment equal the obvious loop.

use crate::brute_force::{case, radius};
use crate::obvious::{RULES, build, instructions};
use photonlab_kdtree::{KdTree, SplitRule, segment_distance_squared};
use proptest::prelude::*;

/// Found points as original index and the bits of their squared distance, in the order of those.
fn found(tree: &KdTree<usize>, ends: [[f32; 3]; 2], radius: f32) -> Vec<(usize, u64)> {
    let (mut order, mut hits) = (vec![], vec![]);
    tree.near_segment(ends, radius, |index, distance_squared| {
        order.push(index);
        hits.push((tree.payloads()[index], distance_squared.to_bits()));
    });
    assert!(order.is_sorted_by(|a, b| a < b), "not by rising tree index");
    hits.sort_unstable();
    hits
}

fn looped(points: &[[f32; 3]], ends: [[f32; 3]; 2], radius: f32) -> Vec<(usize, u64)> {
    let each = points.iter().map(|&point| segment_distance_squared(ends, point)).enumerate();
    let inside = each.filter(|&(_, d)| radius >= 0.0 && d <= f64::from(radius) * f64::from(radius));
    inside.map(|(index, d)| (index, d.to_bits())).collect()
}

fn assert_near(points: &[[f32; 3]], rule: SplitRule, leaf_limit: usize, ends: [[f32; 3]; 2], radius: f32) {
    let tree = build(points, rule, leaf_limit);
    for set in instructions() {
        let tree = tree.clone().with_instructions(set);
        assert_eq!(found(&tree, ends, radius), looped(points, ends, radius), "{radius:e} around {ends:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    /// Segments between any two queries, those of no length included, with every radius.
    #[test]
    fn answers_equal_the_loop(
        (points, queries) in case(),
        rule in prop::sample::select(RULES.to_vec()),
        leaf_limit in prop::sample::select(vec![0usize, 1, 3, 16]),
        radius in radius(),
    ) {
        for &start in &queries {
            for &end in &queries {
                assert_near(&points, rule, leaf_limit, [start, end], radius);
            }
        }
    }

    /// A radius that is nearly the distance to some point, and segments along an axis.
    #[test]
    fn the_capsule_is_closed(
        (points, queries) in case(),
        pick in any::<prop::sample::Index>(),
        axis in 0usize..3,
    ) {
        prop_assume!(!points.is_empty());
        let target = points[pick.index(points.len())];
        for start in queries {
            let mut end = start;
            end[axis] = target[axis];
            let radius = segment_distance_squared([start, end], target).sqrt() as f32;
            for radius in [radius.next_down(), radius, radius.next_up()] {
                assert_near(&points, SplitRule::Median, 1, [start, end], radius);
            }
        }
    }
}

/// By hand: before the start, beside the segment, beyond the end.
#[test]
fn distances_are_right() {
    let ends = [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    for (point, expected) in [([0.0, 2.0, 0.0], 5.0), ([2.5, 0.0, -3.0], 9.0), ([4.0, 1.0, 1.0], 3.0)] {
        assert_eq!(segment_distance_squared(ends, point), expected);
    }
    assert_eq!(segment_distance_squared([[1.0, 2.0, 3.0]; 2], [1.0, 2.0, 5.0]), 4.0);
}

/// Ends that are not finite and radii that are not numbers take nothing.
#[test]
fn what_is_not_finite_takes_nothing() {
    let tree = build(&[[0.0; 3], [1.0; 3]], SplitRule::Median, 1);
    let fine = [[0.0; 3], [1.0, 1.0, 1.0]];
    assert_eq!(found(&tree, fine, 0.0).len(), 2);
    assert_eq!(found(&tree, fine, f32::INFINITY).len(), 2);
    assert!(found(&tree, fine, f32::NAN).is_empty() && found(&tree, fine, -1.0).is_empty());
    for bad in [f32::NAN, f32::INFINITY] {
        assert!(found(&tree, [[bad, 0.0, 0.0], [0.0; 3]], 1.0).is_empty());
        assert!(found(&tree, [[0.0; 3], [0.0, bad, 0.0]], f32::INFINITY).is_empty());
    }
}
