//! A tree depends on its points and rule, not on who built it; and queries look at few of its points.

use crate::obvious::{RULES, build};
use photonlab_kdtree::{KdTree, Neighbours, SplitRule};

/// Points of a sheet and of a volume in turn, some of them repeated, from a small multiplicative generator.
fn points(count: usize) -> Vec<[f32; 3]> {
    let mut state = 12345u64;
    let mut draw = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 48) as f32 / 65536.0
    };
    (0..count).map(|i| [draw(), draw(), if i % 2 == 0 { 0.0 } else { draw() }]).collect()
}

fn with_threads(threads: usize, make: impl FnOnce() -> KdTree<usize> + Send) -> KdTree<usize> {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(make)
}

#[test]
fn any_number_of_threads_builds_the_same_tree() {
    let points = points(60_000);
    // All but the quadratic one.
    for rule in RULES.into_iter().filter(|rule| !matches!(rule, SplitRule::Enumeration { .. })) {
        let alone = with_threads(1, || build(&points, rule, 8));
        for threads in [2, 3, 8] {
            assert!(alone == with_threads(threads, || build(&points, rule, 8)), "{threads} threads, {rule:?}");
        }
    }
}

#[test]
fn queries_look_at_few_points() {
    let points = points(60_000);
    for rule in &RULES[..8] {
        let tree = build(&points, *rule, 16);
        let mut found = Neighbours::default();
        let visits = tree.nearest_counted([0.5, 0.5, 0.0], 100, f32::INFINITY, |_| true, &mut found);
        assert!(visits.points < 2_500 && visits.nodes < 1_000, "{visits:?}, {rule:?}");
        assert!(visits.leaves <= visits.nodes);
        let visits = tree.within_counted([0.5, 0.5, 0.0], 0.03, |_, _| ());
        assert!(visits.points < 2_500 && visits.nodes < 1_000, "{visits:?}, {rule:?}");
        let all = tree.within_counted([0.5; 3], 9.0, |_, _| ());
        let shape = tree.shape();
        assert_eq!((all.points, all.nodes, all.leaves), (60_000, shape.nodes, shape.leaves));
    }
}
