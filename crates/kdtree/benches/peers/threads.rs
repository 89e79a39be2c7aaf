//! What a second thread brings: wall time of builds and of batches of queries on pools of one and of two threads, best of
//! several in turn. Asked for by `PEERS_THREADS=2`, on a machine with nothing else to do.

use std::time::Instant;

use photonlab_kdtree::{KdTree, SplitRule};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::photons::PhotonSet;

const K: usize = 100;
const ROUNDS: usize = 7;

/// One row a set, and the geometric means.
pub(crate) fn compare(sets: &[PhotonSet], threads: usize) {
    let pools = [1, threads].map(|n| ThreadPoolBuilder::new().num_threads(n).build().expect("a pool"));
    let mut logs = [0.0; 2];
    for set in sets {
        let tree = KdTree::build(set.points.clone(), set.payload.clone(), SplitRule::default()).expect("finite points");
        let (mut build, mut query) = ([f64::INFINITY; 2], [f64::INFINITY; 2]);
        for _ in 0..ROUNDS {
            for (i, pool) in pools.iter().enumerate() {
                build[i] = build[i].min(time_build(pool, set));
                query[i] = query[i].min(time_queries(pool, set, &tree));
            }
        }
        let gains = [build[0] / build[1], query[0] / query[1]];
        println!("{:8} {threads} threads over one: build {:.2}, nearest {:.2}", set.name, gains[0], gains[1]);
        (0..2).for_each(|i| logs[i] += gains[i].ln() / sets.len() as f64);
    }
    println!("{threads} threads over one: build {:.2}, nearest {:.2}", logs[0].exp(), logs[1].exp());
}

fn time_build(pool: &ThreadPool, set: &PhotonSet) -> f64 {
    let (points, payload) = (set.points.clone(), set.payload.clone());
    let start = Instant::now();
    let tree = pool.install(|| KdTree::build(points, payload, SplitRule::Median).expect("finite points"));
    let seconds = start.elapsed().as_secs_f64();
    drop(tree);
    seconds
}

fn time_queries(pool: &ThreadPool, set: &PhotonSet, tree: &KdTree<[f32; 3]>) -> f64 {
    let start = Instant::now();
    let ask = |i: usize, found: &mut photonlab_kdtree::Neighbours| {
        tree.nearest(set.random[i], K, f32::INFINITY, found);
        found.len()
    };
    let found: usize = pool.install(|| tree.batch(&set.random, ask)).into_iter().sum();
    assert_eq!(found, K * set.random.len());
    start.elapsed().as_secs_f64()
}
