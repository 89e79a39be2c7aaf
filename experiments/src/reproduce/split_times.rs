//! CPU time of building and of asking, by split rule; no verdict rests on it.

use photonlab_measure::{Interval, Replicates, fit_log_log};

use super::{
    photon_set::PhotonSet,
    search::{Search, radius_holding},
    split_rules::{RULES, bare_tree, build_seconds},
};

/// How times are taken: the rules take turns, so that a slow spell of the machine meets all of them.
pub(super) struct Stopwatch {
    pub(super) seed: u64,
    pub(super) queries: usize,
    pub(super) rounds: usize,
    /// Each time is of work repeated for at least this long, for the clock is coarse.
    pub(super) least_seconds: f64,
}

/// Seconds of a build by every round.
pub(super) struct BuildTimes {
    pub(super) set: PhotonSet,
    pub(super) photons: Vec<usize>,
    /// By rule, then by photons.
    pub(super) rounds: Vec<Vec<Vec<f64>>>,
}

impl Stopwatch {
    /// Builds of every rule on one thread.
    pub(super) fn builds(&self, set: PhotonSet, photons: &[usize]) -> anyhow::Result<BuildTimes> {
        let lone = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
        let all = set.draw(photons.iter().copied().max().unwrap_or(0), self.seed, 0)?;
        let mut rounds = vec![vec![Vec::new(); photons.len()]; RULES.len()];
        // Twice as many as for queries: their scatter gives an exponent its interval.
        for _ in 0..2 * self.rounds {
            for (i, &count) in photons.iter().enumerate() {
                for (rounds, named) in rounds.iter_mut().zip(&RULES) {
                    let build = || build_seconds(&all[..count], named.rule, named.limit, self.least_seconds);
                    rounds[i].push(lone.install(build)?);
                }
            }
        }
        Ok(BuildTimes { set, photons: photons.into(), rounds })
    }

    /// Seconds per query of every rule, for the k nearest and for a radius that typically holds `held`: the best round.
    pub(super) fn queries(
        &self,
        set: PhotonSet,
        photons: usize,
        k: usize,
        held: usize,
    ) -> anyhow::Result<Vec<[f64; 2]>> {
        let all = set.draw(photons + self.queries, self.seed, 0)?;
        let (points, queries) = all.split_at(photons);
        let trees = RULES.map(|named| bare_tree(points, named.rule, named.limit));
        let trees = trees.into_iter().collect::<anyhow::Result<Vec<_>>>()?;
        let searches = [Search::Nearest(k), Search::Radius(radius_holding(&trees[0], queries, held))];
        let mut best = vec![[f64::INFINITY; 2]; trees.len()];
        for _ in 0..self.rounds {
            for (best, tree) in best.iter_mut().zip(&trees) {
                for (best, search) in best.iter_mut().zip(searches) {
                    *best = best.min(search.seconds(tree, queries, self.least_seconds));
                }
            }
        }
        Ok(best)
    }
}

impl BuildTimes {
    /// The best round.
    pub(super) fn best(&self, rule: usize, size: usize) -> f64 {
        self.rounds[rule][size].iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Exponent in the photons; its interval is that of the rounds' own exponents.
    pub(super) fn exponent(&self, rule: usize, confidence: f64) -> Option<Interval> {
        let photons: Vec<f64> = self.photons.iter().map(|&n| n as f64).collect();
        let one = |round: usize| {
            let seconds: Vec<f64> = self.rounds[rule].iter().map(|rounds| rounds[round]).collect();
            Some(fit_log_log(&photons, &seconds).ok()?.slope)
        };
        (0..self.rounds[rule][0].len()).map(one).collect::<Option<Replicates>>()?.interval(confidence)
    }
}
