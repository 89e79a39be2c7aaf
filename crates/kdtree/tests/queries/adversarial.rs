//! Point sets made to break trees, against the obvious loop.

use crate::obvious::{RULES, assert_answers, assert_is_a_permutation, build};
use photonlab_kdtree::{EmptyCost, Neighbours, SplitRule};

/// Every rule and several leaf limits, radii and counts, at the given queries.
fn check(points: &[[f32; 3]], queries: &[[f32; 3]], radii: &[f32]) {
    for rule in RULES {
        for leaf_limit in [1, 16] {
            let tree = build(points, rule, leaf_limit);
            assert_is_a_permutation(&tree, points);
            for &query in queries {
                for &radius in [0.0, -0.0, f32::INFINITY].iter().chain(radii) {
                    for k in [0, 1, 2, 7, points.len(), points.len() + 1, usize::MAX] {
                        assert_answers(&tree, points, query, k, radius);
                    }
                }
            }
        }
    }
}

fn lattice(n: i32, step: f32) -> Vec<[f32; 3]> {
    (0..n * n * n).map(|i| [i % n, i / n % n, i / (n * n)].map(|c| c as f32 * step)).collect()
}

#[test]
fn nothing_and_a_single_point() {
    check(&[], &[[0.0; 3], [f32::INFINITY; 3]], &[1.0]);
    check(&[[1.0, 2.0, 3.0]], &[[1.0, 2.0, 3.0], [0.0; 3], [-1e38; 3]], &[1.0, 14f32.sqrt()]);
}

#[test]
fn all_identical() {
    check(&[[0.1, -0.2, 0.3]; 100], &[[0.1, -0.2, 0.3], [5.0; 3]], &[1.0]);
}

#[test]
fn duplicates_beyond_a_leaf() {
    let mut points = vec![[0.0; 3]; 50];
    points.extend(vec![[1.0, 0.0, 0.0]; 50]);
    points.extend([[0.5, 0.0, 0.0], [0.0, 9.0, 0.0]]);
    points.rotate_left(23);
    check(&points, &[[0.0; 3], [0.5, 0.0, 0.0], [1.0, 1.0, 0.0]], &[0.5, 1.0]);
}

#[test]
fn negative_zero_is_zero() {
    let signs = [0.0, -0.0];
    let points: Vec<_> = (0..64usize).map(|i| [signs[i & 1], signs[i >> 1 & 1], (i / 20) as f32]).collect();
    check(&points, &[[0.0; 3], [-0.0, 0.0, 1.0]], &[1.0]);
}

#[test]
fn collinear_and_coplanar() {
    let line: Vec<_> = (0..90).map(|i| [i as f32, 2.0 * i as f32, -(i as f32)]).collect();
    check(&line, &[[10.0, 20.0, -10.0], [44.5, 0.0, 0.0]], &[6f32.sqrt(), 30.0]);
    let plane: Vec<_> = (0..100).map(|i| [(i % 10) as f32, (i / 10) as f32, 7.0]).collect();
    check(&plane, &[[4.5, 4.5, 7.0], [4.5, 4.5, 0.0], [3.0, 3.0, 7.0]], &[1.0, 7.0, 2f32.sqrt()]);
}

#[test]
fn lattice_with_many_ties() {
    check(&lattice(6, 1.0), &[[2.0; 3], [2.5; 3], [0.0; 3]], &[1.0, 2.0, 0.75f32.sqrt(), 0.0]);
}

#[test]
fn all_equidistant_from_the_query() {
    // Signed permutations of (2, 3, 6) and (7, 0, 0): integer points of the sphere of radius 7.
    let mut points = vec![];
    for [a, b, c] in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        for signs in 0..8u8 {
            let value = [2.0, 3.0, 6.0f32];
            let sign = |bit: u8| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
            points.push([sign(0) * value[a], sign(1) * value[b], sign(2) * value[c]]);
        }
    }
    points.extend([[7.0, 0.0, 0.0], [0.0, -7.0, 0.0], [0.0, 0.0, 7.0]]);
    assert!(points.iter().all(|&p| photonlab_kdtree::distance_squared(p, [0.0; 3]) == 49.0));
    check(&points, &[[0.0; 3]], &[7.0, 7f32.next_down()]);
}

#[test]
fn where_squares_underflow_and_overflow() {
    // Squares of 1e-30 vanish, so all points tie at zero; squares of 1e30 are infinite, so all others tie there.
    check(&lattice(4, 1e-30), &[[0.0; 3], [1e-30; 3], [1.0; 3]], &[1e-30, 1.0]);
    check(&lattice(4, 1e30), &[[0.0; 3], [1e30; 3], [1.5e30; 3]], &[1e30, 1e18]);
    // Around the smallest normal square, bits are lost one by one.
    check(&lattice(4, 1.3e-19), &[[0.0; 3], [2e-19; 3]], &[1.3e-19, 2.6e-19]);
    let ends = [f32::MIN, f32::MAX];
    let corners: Vec<_> = (0..40usize).map(|i| [ends[i & 1], ends[i >> 1 & 1], ends[i >> 2 & 1]]).collect();
    check(&corners, &[[0.0; 3], [f32::MAX; 3]], &[1e38]);
}

#[test]
fn scales_from_the_smallest_to_the_largest() {
    let points: Vec<_> = (-126..127).map(|e| [2f32.powi(e), 0.0, -(2f32.powi(-e))]).collect();
    check(&points, &[[0.0; 3], [1.0, 0.0, -1.0], [1e38, 0.0, 0.0]], &[2f32.sqrt(), 1e10]);
}

#[test]
fn queries_far_outside() {
    let far = [[1e6, 0.0, 0.0], [-1e20; 3], [f32::MAX, f32::MIN, 0.0], [f32::INFINITY, 0.0, 0.0]];
    check(&lattice(4, 0.1), &far, &[1e6, 1e20, 999_999.7]);
}

#[test]
fn nan_finds_nothing() {
    let points = lattice(4, 1.0);
    for rule in RULES {
        let tree = build(&points, rule, 4);
        for (query, radius) in
            [([f32::NAN, 0.0, 0.0], f32::INFINITY), ([0.0, 0.0, f32::NAN], 1.0), ([0.0; 3], f32::NAN)]
        {
            let mut found = Neighbours::default();
            let visits = tree.within_counted(query, radius, |_, _| panic!("found a point"));
            assert_eq!(visits, photonlab_kdtree::Visits::default());
            tree.nearest_accepted(query, 3, radius, |_| panic!("asked about a point"), &mut found);
            assert!(found.is_empty());
        }
    }
}

#[test]
fn nothing_accepted_is_nothing_found() {
    let tree = build(&lattice(4, 1.0), SplitRule::Median, 4);
    let mut asked = vec![];
    let mut found = Neighbours::default();
    let refuse = |&i: &usize| {
        asked.push(i);
        false
    };
    tree.nearest_accepted([0.0; 3], 3, f32::INFINITY, refuse, &mut found);
    assert!(found.is_empty());
    asked.sort_unstable();
    assert_eq!(asked, (0..64).collect::<Vec<_>>(), "each point is asked about once");
}

#[test]
fn spirals_into_a_corner_without_deep_recursion() {
    // Shrinking cubes around a corner, and shells of them: every best cut peels off a few points.
    let shrink = |base: f32, n: i32| (0..n).map(move |i| base.powi(-i)).map(|s| [s, s, s]);
    let points: Vec<_> = shrink(1.01, 4000).chain(shrink(2.0, 120)).collect();
    for empty_cost in [EmptyCost::Constant(0.0), EmptyCost::NodeAreas(0.5)] {
        let tree = build(&points, SplitRule::SurfaceArea { empty_cost }, 1);
        assert!(tree.shape().depth <= 16 + 2 * 13 + 1);
        assert_answers(&tree, &points, [0.0; 3], 50, 1e-10);
        assert_answers(&tree, &points, [0.5; 3], 50, 0.01);
    }
}
