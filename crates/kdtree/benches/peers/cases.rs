//! The cases of one photon set.

use photonlab_kdtree::Neighbours;

use crate::contestant::Job;
use crate::ours::Ours;
use crate::photons::PhotonSet;

/// In what order queries come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Order {
    Random,
    Coherent,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) k: usize,
    pub(crate) job: Job,
    pub(crate) order: Order,
}

impl Case {
    pub(crate) fn queries<'a>(&self, set: &'a PhotonSet) -> &'a [[f32; 3]] {
        match self.order {
            Order::Random => &set.random,
            Order::Coherent => &set.coherent,
        }
    }

    pub(crate) fn family(&self) -> &'static str {
        match self.job {
            Job::Nearest(_) => "nearest",
            Job::Radius(_) => "radius",
            Job::Search(_) => "search",
        }
    }

    /// One word, by which the helper programs name a case.
    pub(crate) fn key(&self) -> String {
        format!("{}-{}-{:?}", self.family(), self.k, self.order)
    }
}

/// Each job in both orders.
pub(crate) fn cases(k: usize, radius: f32) -> impl Iterator<Item = Case> {
    let jobs = [Job::Nearest(k), Job::Radius(radius), Job::Search(radius)];
    let orders = [Order::Random, Order::Coherent];
    jobs.into_iter().flat_map(move |job| orders.map(|order| Case { k, job, order }))
}

/// The median distance to the k-th photon.
pub(crate) fn typical_radius(ours: &Ours, set: &PhotonSet, k: usize) -> f32 {
    let mut found = Neighbours::default();
    let kth = |&query: &[f32; 3]| ours.tree.kth_distance_squared(query, k, f32::INFINITY, &mut found);
    let mut distances: Vec<f32> = set.random.iter().step_by(37).filter_map(kth).collect();
    distances.sort_by(f32::total_cmp);
    distances.get(distances.len() / 2).map_or(0.0, |d| d.sqrt())
}
