//! kiddo's immutable tree by its fastest exact doors: `nearest_n(k).unsorted()` and `within(radius).unsorted()`.

use std::num::NonZero;

use kiddo::{ImmutableKdTree, SquaredEuclidean};

use crate::contestant::{Checksum, Contestant, Job};
use crate::photons::PhotonSet;

pub(crate) struct Kiddo<'a> {
    tree: ImmutableKdTree<f32, 3>,
    payload: &'a [[f32; 3]],
}

impl<'a> Kiddo<'a> {
    pub(crate) fn build(set: &'a PhotonSet) -> Self {
        let tree = ImmutableKdTree::new_from_slice(&set.points).expect("finite points");
        Self { tree, payload: &set.payload }
    }

    fn sum(&self, items: impl Iterator<Item = usize>) -> [f32; 3] {
        items.fold([0.0; 3], |sum, item| std::array::from_fn(|c| sum[c] + self.payload[item][c]))
    }
}

impl Contestant for Kiddo<'_> {
    fn run(&mut self, job: Job, queries: &[[f32; 3]]) -> Option<Checksum> {
        let mut sum = Checksum::default();
        for query in queries {
            let ask = self.tree.query(query);
            match job {
                Job::Nearest(k) => {
                    let k = NonZero::new(k).expect("at least one");
                    let found = ask.nearest_n::<SquaredEuclidean<f32>>(k).unsorted().execute();
                    let farthest = found.iter().map(|f| f.distance).fold(0.0, f32::max);
                    sum.add(found.len(), farthest, self.sum(found.iter().map(|f| f.item as usize)));
                }
                Job::Radius(radius) => {
                    let found = ask.within::<SquaredEuclidean<f32>>(radius * radius).unsorted().execute();
                    sum.add(0, 0.0, self.sum(found.iter().map(|f| f.item as usize)));
                }
                Job::Search(radius) => {
                    let found = ask.within::<SquaredEuclidean<f32>>(radius * radius).unsorted().execute();
                    sum.add(found.len(), 0.0, [0.0; 3]);
                }
            }
        }
        Some(sum)
    }
}
