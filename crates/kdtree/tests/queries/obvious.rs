//! The obvious loops, and the comparison of a tree with them.

use photonlab_kdtree::{
    BLOCK, EmptyCost, Instructions, KdTree, Neighbours, Reach, SplitRule, VisitCost, distance_squared,
};

/// The rules that every case is put through.
pub(crate) const RULES: [SplitRule; 10] = [
    SplitRule::Median,
    SplitRule::SurfaceArea { empty_cost: EmptyCost::Constant(0.0) },
    SplitRule::SurfaceArea { empty_cost: EmptyCost::Constant(3.0) },
    SplitRule::SurfaceArea { empty_cost: EmptyCost::NodeAreas(2.0) },
    SplitRule::Binned(VisitCost::SurfaceArea),
    SplitRule::Binned(VisitCost::VoxelVolume(Reach::Radius(0.25))),
    SplitRule::Binned(VisitCost::BallInSpace(Reach::Nearest(20))),
    SplitRule::Binned(VisitCost::BallOnSheet(Reach::Nearest(100))),
    SplitRule::Enumeration { empty_cost: EmptyCost::NodeAreas(3.0) },
    // Never splits: one leaf of any size.
    SplitRule::SurfaceArea { empty_cost: EmptyCost::Constant(f64::INFINITY) },
];

/// A found point as original index and the bits of its squared distance.
pub(crate) type Hit = (usize, u32);

/// All points in the closed ball, by original index.
pub(crate) fn loop_within(points: &[[f32; 3]], query: [f32; 3], radius: f32) -> Vec<Hit> {
    let distances = points.iter().map(|&p| distance_squared(query, p)).enumerate();
    let inside = distances.filter(|&(_, d)| radius >= 0.0 && d <= radius * radius);
    inside.map(|(i, d)| (i, d.to_bits())).collect()
}

/// The first `k` of them by distance and then tree order, of those that `accept` takes.
pub(crate) fn loop_nearest(
    tree: &KdTree<usize>,
    points: &[[f32; 3]],
    query: [f32; 3],
    k: usize,
    radius: f32,
    accept: impl Fn(usize) -> bool,
) -> Vec<Hit> {
    let mut hits = loop_within(points, query, radius);
    hits.retain(|&(i, _)| accept(i));
    // The bits of floats that are not negative sort as the floats do.
    let mut place = vec![0; points.len()];
    tree.payloads().iter().enumerate().for_each(|(at, &original)| place[original] = at);
    hits.sort_by_key(|&(i, bits)| (bits, place[i]));
    hits.truncate(k);
    hits
}

/// A tree whose payload is the original index.
pub(crate) fn build(points: &[[f32; 3]], rule: SplitRule, leaf_limit: usize) -> KdTree<usize> {
    let payload = (0..points.len()).collect();
    KdTree::build_with_leaf_limit(points.to_vec(), payload, rule, leaf_limit).expect("points are finite")
}

/// Every index once, and points and payloads where the index says.
pub(crate) fn assert_is_a_permutation(tree: &KdTree<usize>, points: &[[f32; 3]]) {
    let mut seen = vec![false; points.len()];
    assert_eq!((tree.len(), tree.is_empty()), (points.len(), points.is_empty()));
    for i in 0..tree.len() {
        let original = tree.payloads()[i];
        assert!(!std::mem::replace(&mut seen[original], true));
        assert_eq!(tree.point(i).map(f32::to_bits), points[original].map(f32::to_bits));
    }
}

/// The sets of instructions that this processor has.
pub(crate) fn instructions() -> impl Iterator<Item = Instructions> {
    [Instructions::Portable, Instructions::Avx2, Instructions::Avx512].into_iter().filter(|set| set.is_available())
}

/// Every question, counted and not, with all instructions, against the loops.
pub(crate) fn assert_answers(tree: &KdTree<usize>, points: &[[f32; 3]], query: [f32; 3], k: usize, radius: f32) {
    for set in instructions() {
        let tree = tree.clone().with_instructions(set);
        assert_within(&tree, points, query, radius);
        for modulus in [1, 3] {
            assert_nearest(&tree, points, query, k, radius, modulus);
        }
    }
}

fn assert_within(tree: &KdTree<usize>, points: &[[f32; 3]], query: [f32; 3], radius: f32) {
    let mut order = vec![];
    let mut inside = vec![];
    let visits = tree.within_counted(query, radius, |i, d| {
        order.push(i);
        inside.push((tree.payloads()[i], d.to_bits()));
    });
    assert!(order.is_sorted_by(|a, b| a < b), "not by rising tree index");
    assert!(visits.points >= inside.len() && visits.nodes <= tree.shape().nodes);
    inside.sort_unstable();
    assert_eq!(inside, loop_within(points, query, radius), "within {radius:e} of {query:?}");
    let mut count = 0;
    tree.within(query, radius, |_, _| count += 1);
    assert_eq!(count, inside.len());
}

fn assert_nearest(tree: &KdTree<usize>, points: &[[f32; 3]], query: [f32; 3], k: usize, radius: f32, modulus: usize) {
    let accept = |i: usize| i.is_multiple_of(modulus);
    let expected = loop_nearest(tree, points, query, k, radius, accept);
    let check = |found: &mut Neighbours| {
        let walked: Vec<_> = found.iter().collect();
        let farthest = found.farthest_squared();
        found.sort();
        let hits: Vec<Hit> = found.iter().map(|n| (tree.payloads()[n.index], n.distance_squared.to_bits())).collect();
        assert_eq!(hits, expected, "{k} nearest to {query:?} within {radius:e}");
        assert_eq!(farthest.map(f32::to_bits), hits.last().map(|hit| hit.1));
        if let Some(last) = found.pop() {
            assert_eq!((tree.payloads()[last.index], last.distance_squared.to_bits()), hits[hits.len() - 1]);
        }
        walked
    };
    let mut found = Neighbours::default();
    let visits = tree.nearest_counted(query, k, radius, |&i| accept(i), &mut found);
    assert!(visits.points >= found.len());
    let fresh = check(&mut found);
    // Again, with the memory of this very answer, and with that of one that bounds too little.
    tree.nearest_accepted(query, k, radius, |&i| accept(i), &mut found);
    assert_eq!(check(&mut found), fresh);
    let in_block = |first: usize, mask: u16| {
        let counts = |lane: usize| first + lane < tree.len() && accept(tree.payloads()[first + lane]);
        (0..BLOCK).filter(|&lane| counts(lane)).fold(0, |all, lane| all | 1 << lane) & mask
    };
    tree.nearest_of_blocks(query, k, radius, in_block, &mut found);
    assert_eq!(check(&mut found), fresh);
    tree.nearest(query, k, f32::INFINITY, &mut found);
    tree.nearest_accepted(query, k, radius, |&i| accept(i), &mut found);
    assert_eq!(check(&mut found), fresh);
    if modulus == 1 {
        tree.nearest(query, k, radius, &mut found);
        assert_eq!(check(&mut found), fresh);
        let kth = tree.kth_distance_squared(query, k, radius, &mut found);
        assert_eq!(kth.map(f32::to_bits), expected.get(k.wrapping_sub(1)).map(|hit| hit.1));
    }
}
