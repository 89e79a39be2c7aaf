//! The tree of this crate.

use photonlab_kdtree::{Instructions, KdTree, Neighbours, SplitRule};

use crate::clock;
use crate::contestant::{Checksum, Contestant, Job};
use crate::photons::PhotonSet;

pub(crate) struct Ours {
    pub(crate) tree: KdTree<[f32; 3]>,
    found: Neighbours,
}

impl Ours {
    pub(crate) fn build(set: &PhotonSet, rule: SplitRule) -> Self {
        Self::timed_build(set, rule).1
    }

    /// The seconds too. The tree takes what it is given, so the set is copied before the clock starts.
    pub(crate) fn timed_build(set: &PhotonSet, rule: SplitRule) -> (f64, Self) {
        let (points, payload) = (set.points.clone(), set.payload.clone());
        let (seconds, tree) = clock::time(|| KdTree::build(points, payload, rule).expect("finite points"));
        (seconds, Self { tree, found: Neighbours::default() })
    }

    pub(crate) fn with_instructions(self, set: Instructions) -> Self {
        Self { tree: self.tree.with_instructions(set), ..self }
    }
}

impl Contestant for Ours {
    fn run(&mut self, job: Job, queries: &[[f32; 3]]) -> Option<Checksum> {
        let mut sum = Checksum::default();
        for &query in queries {
            match job {
                Job::Nearest(k) => {
                    self.tree.nearest(query, k, f32::INFINITY, &mut self.found);
                    let farthest = self.found.farthest_squared().unwrap_or(0.0);
                    sum.add(self.found.len(), farthest, self.tree.sum_of(&self.found));
                }
                Job::Radius(radius) => sum.add(0, 0.0, self.tree.sum_within(query, radius)),
                Job::Search(radius) => {
                    let mut count = 0;
                    self.tree.within_blocks(query, radius, |_, mask, _| count += mask.count_ones() as usize);
                    sum.add(count, 0.0, [0.0; 3]);
                }
            }
        }
        Some(sum)
    }
}
