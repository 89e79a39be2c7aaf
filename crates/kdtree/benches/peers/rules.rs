//! The split rules beside one another: build time, points tested, rates.

use photonlab_kdtree::{Neighbours, Reach, SplitRule, VisitCost};

use crate::clock;
use crate::contestant::{Contestant, Job};
use crate::ours::Ours;
use crate::photons::PhotonSet;

const K: usize = 100;

/// One row a rule.
pub(crate) fn compare(set: &PhotonSet) {
    let costs = [
        VisitCost::SurfaceArea,
        VisitCost::VoxelVolume(Reach::Nearest(K)),
        VisitCost::BallInSpace(Reach::Nearest(K)),
        VisitCost::BallOnSheet(Reach::Nearest(K)),
    ];
    for rule in [SplitRule::Median].into_iter().chain(costs.map(SplitRule::Binned)) {
        let builds = [(); 2].map(|()| Ours::timed_build(set, rule));
        let seconds = builds.iter().map(|(seconds, _)| *seconds).fold(f64::INFINITY, f64::min);
        let [(_, mut ours), _] = builds;
        let shape = ours.tree.shape();
        let rate = |ours: &mut Ours, queries: &[[f32; 3]]| {
            let best = [(); 3].map(|()| clock::time(|| ours.run(Job::Nearest(K), queries)).0);
            queries.len() as f64 / best.into_iter().fold(f64::INFINITY, f64::min) / 1e3
        };
        println!(
            "{:8} {rule:?}: build {seconds:.3} s, {:.3} of the photons' bytes, {:.0} points tested, {:.0} k/s random, \
             {:.0} k/s coherent",
            set.name,
            shape.bytes as f64 / (shape.bytes - shape.overhead_bytes) as f64,
            tested(&ours, set),
            rate(&mut ours, &set.random),
            rate(&mut ours, &set.coherent),
        );
    }
}

/// Points tested by a query alone, on average.
fn tested(ours: &Ours, set: &PhotonSet) -> f64 {
    let cost = |&query: &[f32; 3]| {
        ours.tree.nearest_counted(query, K, f32::INFINITY, |_| true, &mut Neighbours::default()).points as f64
    };
    let costs: Vec<f64> = set.random.iter().step_by(11).map(cost).collect();
    costs.iter().sum::<f64>() / costs.len() as f64
}
