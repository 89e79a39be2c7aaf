//! Every query equals the obvious loop, ties included, on drawn point sets.

use crate::obvious::{RULES, assert_answers, assert_is_a_permutation, build};
use proptest::prelude::*;

/// A coordinate of one kind; a set mixes nothing, so that its kind shows.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Smooth,
    Lattice,
    Tiny,
    Huge,
    AnyFinite,
}

impl Kind {
    fn coordinate(self) -> BoxedStrategy<f32> {
        match self {
            Self::Smooth => (-1f32..1.0).boxed(),
            Self::Lattice => (-2i8..3).prop_map(f32::from).boxed(),
            Self::Tiny => (-4i8..5).prop_map(|i| f32::from(i) * 1e-30).boxed(),
            Self::Huge => (-4i8..5).prop_map(|i| f32::from(i) * 1e30).boxed(),
            Self::AnyFinite => any::<f32>().prop_filter("finite", |x| x.is_finite()).boxed(),
        }
    }

    fn point(self) -> BoxedStrategy<[f32; 3]> {
        prop::array::uniform3(self.coordinate()).boxed()
    }
}

fn kind() -> impl Strategy<Value = Kind> {
    let kinds = vec![Kind::Smooth, Kind::Lattice, Kind::Tiny, Kind::Huge, Kind::AnyFinite];
    prop::sample::select(kinds)
}

/// How many axes vary: 0 makes all points identical, 1 a line, 2 a plane.
fn flatten(mut points: Vec<[f32; 3]>, axes: usize) -> Vec<[f32; 3]> {
    let first = points.first().copied().unwrap_or_default();
    for point in &mut points {
        point[axes..].copy_from_slice(&first[axes..]);
    }
    points
}

pub(crate) fn radius() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(0.0),
        Just(f32::INFINITY),
        Just(1.0),
        Just(2.0),
        0f32..3.0,
        Just(2e-30),
        Just(2e30),
        Just(1e19),
        Just(-1.0),
    ]
}

/// Points of one kind and dimension, with queries among them and anywhere.
pub(crate) fn case() -> impl Strategy<Value = (Vec<[f32; 3]>, Vec<[f32; 3]>)> {
    (kind(), 0usize..4).prop_flat_map(|(kind, axes)| {
        let points = prop::collection::vec(kind.point(), 0..200).prop_map(move |p| flatten(p, axes));
        let queries = prop::collection::vec(kind.point(), 2);
        let elsewhere = Kind::AnyFinite.point();
        (points, queries, elsewhere, any::<prop::sample::Index>()).prop_map(|(points, mut queries, far, pick)| {
            queries.push(far);
            if !points.is_empty() {
                queries.push(points[pick.index(points.len())]);
            }
            (points, queries)
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn answers_equal_the_loop(
        (points, queries) in case(),
        rule in prop::sample::select(RULES.to_vec()),
        leaf_limit in prop::sample::select(vec![0usize, 1, 3, 16]),
        k in prop_oneof![0usize..10, 0usize..300],
        radius in radius(),
    ) {
        let tree = build(&points, rule, leaf_limit);
        assert_is_a_permutation(&tree, &points);
        for query in queries {
            assert_answers(&tree, &points, query, k, radius);
            assert_answers(&tree, &points, query, k, f32::INFINITY);
        }
    }

    /// A radius that is exactly the distance to some point, and its neighbours among the floats.
    #[test]
    fn the_ball_is_closed_to_the_last_bit(
        (points, queries) in case(),
        rule in prop::sample::select(RULES.to_vec()),
        pick in any::<prop::sample::Index>(),
    ) {
        prop_assume!(!points.is_empty());
        let tree = build(&points, rule, 1);
        let target = points[pick.index(points.len())];
        for query in queries {
            let radius = photonlab_kdtree::distance_squared(query, target).sqrt();
            for radius in [radius.next_down(), radius, radius.next_up()] {
                assert_answers(&tree, &points, query, 5, radius);
            }
        }
    }
}
