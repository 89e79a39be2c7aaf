//! The kernels behind queries, each with every instruction set: a ball's walk, its sum, the k nearest, and the builds.

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use photonlab_kdtree::{Instructions, KdTree, Neighbours, Reach, SplitRule, VisitCost};

/// Uniform in the unit square at z = 0, from a multiplicative generator.
fn sheet(count: usize) -> Vec<[f32; 3]> {
    let mut state = 1u64;
    let mut draw = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f32 / (1u64 << 24) as f32
    };
    (0..count).map(|_| [draw(), draw(), 0.0]).collect()
}

fn queries(c: &mut Criterion) {
    let points = sheet(100_000);
    let tree = KdTree::build(points.clone(), points.clone(), SplitRule::default()).expect("finite");
    for set in [Instructions::Portable, Instructions::Avx2, Instructions::Avx512] {
        if !set.is_available() {
            continue;
        }
        let tree = tree.clone().with_instructions(set);
        let mut next = points.iter().cycle();
        c.bench_function(&format!("count within, {set:?}"), |b| {
            b.iter(|| {
                let mut count = 0;
                tree.within_blocks(*next.next().unwrap(), 0.018, |_, mask, _| count += mask.count_ones());
                count
            });
        });
        c.bench_function(&format!("sum within, {set:?}"), |b| {
            b.iter(|| tree.sum_within(*next.next().unwrap(), 0.018));
        });
        let mut found = Neighbours::default();
        c.bench_function(&format!("100 nearest, {set:?}"), |b| {
            b.iter(|| tree.kth_distance_squared(*next.next().unwrap(), 100, f32::INFINITY, &mut found));
        });
    }
}

fn builds(c: &mut Criterion) {
    let points = sheet(100_000);
    let mut group = c.benchmark_group("build");
    let costs = [
        VisitCost::SurfaceArea,
        VisitCost::VoxelVolume(Reach::Nearest(100)),
        VisitCost::BallInSpace(Reach::Nearest(100)),
        VisitCost::BallOnSheet(Reach::Nearest(100)),
    ];
    for rule in costs.map(SplitRule::Binned).into_iter().chain([SplitRule::Median]) {
        group.bench_function(BenchmarkId::from_parameter(format!("{rule:?}")), |b| {
            let payload = || (points.clone(), points.clone());
            b.iter_batched(payload, |(points, payload)| KdTree::build(points, payload, rule), BatchSize::LargeInput);
        });
    }
}

criterion_group!(benches, queries, builds);
criterion_main!(benches);
