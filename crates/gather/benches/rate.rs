//! Estimates per second of CPU time on one thread: kernels, the check of the bias and the linear fit beside the bare query
//! that adds the flux up. A million photons even on a square, queries in random order, 50 photons in the ball. Best of
//! several rounds in turn. `RATE_QUERIES` sets the queries of a round (50 000), `RATE_ROUNDS` the rounds (5).

use std::{f64::consts::PI, hint::black_box, time::Instant};

use photonlab_gather::{
    AreaModel, Bandwidth, Estimator, GatherPoint, Inside, Kernel, PhotonMap, Scratch, Surroundings, Tests,
};
use photonlab_kdtree::{KdTree, Neighbours, SplitRule};
use photonlab_photometry::{PackedDirection, PathClass, Photon};

const PHOTONS: usize = 1_000_000;
const IN_BALL: usize = 50;

/// Every query is beside an edge that leaves half of the disc: the moments are at hand, so that the fit alone is timed.
struct Edge;

impl<P> Surroundings<P> for Edge {
    fn weighs(&self) -> bool {
        false
    }

    fn inside(&self, _: f64, _: Kernel) -> Option<Inside> {
        let first = [2.0 / (3.0 * PI), 0.0, 0.0];
        Some(Inside { area: 0.5, first, second: [[0.125, 0.0, 0.0], [0.0, 0.125, 0.0], [0.0; 3]], open: true })
    }
}

/// A number from the environment.
fn setting(name: &str, default: usize) -> usize {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// Even numbers in [0, 1) from a linear congruence (Knuth's MMIX).
struct Even(u64);

impl Even {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u32 << 24) as f32
    }
}

fn main() {
    let (queries, rounds) = (setting("RATE_QUERIES", 50_000), setting("RATE_ROUNDS", 5));
    let mut even = Even(1);
    let photon = Photon {
        flux: [1.0],
        direction: PackedDirection::pack([0.0, 0.0, -1.0]),
        normal: PackedDirection::pack([0.0, 0.0, 1.0]),
        class: PathClass::Direct,
        segments: 1,
    };
    let positions: Vec<[f32; 3]> = (0..PHOTONS).map(|_| [even.next(), even.next(), 0.0]).collect();
    let map =
        PhotonMap::<1>::build(positions.clone(), vec![photon; PHOTONS], SplitRule::Median).expect("finite photons");
    let points: Vec<GatherPoint> = (0..queries)
        .map(|_| GatherPoint { position: [even.next(), even.next(), 0.0], normal: [0.0, 0.0, 1.0] })
        .collect();

    let radius = (IN_BALL as f64 / (PI * PHOTONS as f64)).sqrt();
    let nearest = Bandwidth::Nearest { k: IN_BALL, max_radius: f64::INFINITY };
    let tests = Tests::default();
    let (mut scratch, mut found) = (Scratch::default(), Neighbours::default());
    let mut turn = 0;
    // As a run reads a map: one estimate of four tells its bias.
    let mut gather = |at: &GatherPoint, bandwidth, kernel, area: AreaModel, told_of: u32| {
        turn += 1;
        let estimator = Estimator { tells_bias: turn % told_of == 0, ..Estimator::new(kernel, area) };
        if area != AreaModel::Disc {
            map.gather_among(at, bandwidth, estimator, &tests, &Edge, &mut scratch).irradiance[0]
        } else {
            map.gather(at, bandwidth, estimator, &tests, &mut scratch).irradiance[0]
        }
    };
    // The kd-tree bench's: the sum of payloads in the ball, or of the nearest.
    let flux = vec![[1.0f32]; PHOTONS];
    let bare_tree = KdTree::build(positions.clone(), flux, SplitRule::Median).expect("finite photons");
    let mut bare = |at: &GatherPoint, bandwidth| match bandwidth {
        Bandwidth::Radius(radius) => f64::from(bare_tree.sum_within(at.position, radius as f32)[0]),
        Bandwidth::Nearest { k, max_radius } => {
            bare_tree.nearest(at.position, k, max_radius as f32, &mut found);
            f64::from(bare_tree.sum_of(&found)[0])
        }
    };
    for (name, bandwidth) in [("radius", Bandwidth::Radius(radius)), ("nearest", nearest)] {
        let mut best = [f64::INFINITY; 7];
        for _ in 0..rounds {
            let mut time = |which: usize, one: &mut dyn FnMut(&GatherPoint) -> f64| {
                let start = Instant::now();
                points.iter().for_each(|at| {
                    black_box(one(at));
                });
                best[which] = best[which].min(start.elapsed().as_secs_f64() / queries as f64);
            };
            time(0, &mut |at| bare(at, bandwidth));
            let (disc, epanechnikov) = (Kernel::Disc, Kernel::Epanechnikov);
            time(1, &mut |at| gather(at, bandwidth, disc, AreaModel::Disc, 4));
            time(2, &mut |at| gather(at, bandwidth, epanechnikov, AreaModel::Disc, 4));
            time(3, &mut |at| gather(at, bandwidth, epanechnikov, AreaModel::Clipped, 4));
            time(4, &mut |at| gather(at, bandwidth, epanechnikov, AreaModel::Linear, 4));
            time(5, &mut |at| gather(at, bandwidth, epanechnikov, AreaModel::Clipped, 1));
            time(6, &mut |at| gather(at, bandwidth, epanechnikov, AreaModel::Linear, 1));
        }
        let rows = [
            "bare query",
            "disc, one of four tells its bias",
            "Epanechnikov, one of four",
            "clipped at an edge, one of four",
            "linear fit there, one of four",
            "clipped there, all tell it",
            "linear fit there, all tell it",
        ];
        for (what, seconds) in rows.iter().zip(best) {
            println!("{name:8} {what:32} {:9.0} per second, {:5.2} of bare", 1.0 / seconds, best[0] / seconds);
        }
    }
}
