//! The doors that lead to the same walk: blocks, sums, batches.

use crate::obvious::{RULES, instructions};
use photonlab_kdtree::{KdTree, Neighbours};
use proptest::prelude::*;

fn points(count: usize) -> impl Strategy<Value = Vec<[f32; 3]>> {
    let coordinate = || prop_oneof![(-3i8..4).prop_map(f32::from), -3f32..3.0];
    prop::collection::vec(prop::array::uniform3(coordinate()), 0..count)
}

/// Small whole numbers, so that sums are exact in any order.
fn payload<const N: usize>(points: &[[f32; 3]]) -> Vec<[f32; N]> {
    (0..points.len()).map(|i| std::array::from_fn(|c| ((i * 7 + c * 3) % 100) as f32 - 20.0)).collect()
}

fn assert_sums<const N: usize>(points: &[[f32; 3]], query: [f32; 3], radius: f32) {
    for rule in RULES {
        let tree = KdTree::build_with_leaf_limit(points.to_vec(), payload::<N>(points), rule, 5).unwrap();
        let (mut expected, mut inside) = ([0.0; N], vec![]);
        tree.within(query, radius, |index, distance| {
            inside.push((index, distance.to_bits()));
            (0..N).for_each(|c| expected[c] += tree.payloads()[index][c]);
        });
        for set in instructions() {
            let tree = tree.clone().with_instructions(set);
            assert_eq!(tree.sum_within(query, radius), expected, "{set:?}");
            let mut seen = vec![];
            tree.within_blocks(query, radius, |first, mask, distances| {
                let lanes = (0..16).filter(|lane| mask >> lane & 1 == 1);
                seen.extend(lanes.map(|lane| (first + lane, distances[lane].to_bits())));
            });
            assert_eq!(seen, inside, "{set:?}");
            let mut found = Neighbours::default();
            tree.nearest(query, points.len(), radius, &mut found);
            assert_eq!(tree.sum_of(&found), expected);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn blocks_and_sums_are_those_of_the_ball(
        points in points(120),
        query in prop::array::uniform3(-4f32..4.0),
        radius in 0f32..5.0,
    ) {
        assert_sums::<1>(&points, query, radius);
        assert_sums::<3>(&points, query, radius);
        assert_sums::<4>(&points, query, radius);
        assert_sums::<6>(&points, query, radius);
    }

    /// Sums that round differently in another order.
    #[test]
    fn instructions_add_to_the_same_bits(points in points(300), query in prop::array::uniform3(-4f32..4.0)) {
        let payload: Vec<[f32; 3]> = points.iter().map(|p| p.map(|c| (c * 1.7).exp())).collect();
        let tree = KdTree::build(points, payload, RULES[0]).unwrap();
        let answer = |set| {
            let tree = tree.clone().with_instructions(set);
            let mut found = Neighbours::default();
            tree.nearest(query, 40, f32::INFINITY, &mut found);
            [tree.sum_within(query, 3.0), tree.sum_of(&found)].map(|sum| sum.map(f32::to_bits))
        };
        let answers: Vec<_> = instructions().map(answer).collect();
        prop_assert!(answers.iter().all(|other| *other == answers[0]));
    }

    #[test]
    fn a_batch_answers_in_the_order_asked(points in points(200), mut queries in points(100)) {
        queries.push([f32::NAN, 0.0, 0.0]);
        queries.push([f32::INFINITY, -9e30, 0.0]);
        let tree = KdTree::build(points.clone(), points, RULES[0]).unwrap();
        let alone = |query: [f32; 3], found: &mut Neighbours| {
            tree.nearest(query, 7, 2.0, found);
            found.iter().map(|n| (n.index, n.distance_squared.to_bits())).collect::<Vec<_>>()
        };
        let expected: Vec<_> = queries.iter().map(|&query| alone(query, &mut Neighbours::default())).collect();
        prop_assert_eq!(tree.batch(&queries, |i, found| alone(queries[i], found)), expected);
    }
}
