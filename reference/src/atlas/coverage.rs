//! How often an interval made of few photons covers the truth.

use statrs::function::gamma::ln_gamma;

/// A count of photons: `photons` fall independently, each into the disc with the same probability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counts {
    /// Photons in all.
    pub photons: u64,
    /// Mean count in the disc.
    pub mean: f64,
}

/// How an interval is made of a count `n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Intervals {
    /// `n` plus and minus this many `sqrt(n)`.
    RootOfCount(f64),
    /// Clopper and Pearson's with this confidence: all probabilities that leave more than half the rest to `n` and beyond, on
    /// either side.
    ClopperPearson(f64),
}

impl Counts {
    /// Probability of the count `n`: binomial.
    fn probability(&self, n: u64) -> f64 {
        let (all, n) = (self.photons as f64, n as f64);
        let p = self.mean / all;
        let ways = ln_gamma(all + 1.0) - ln_gamma(n + 1.0) - ln_gamma(all - n + 1.0);
        (ways + n * p.ln() + (all - n) * (-p).ln_1p()).exp()
    }

    /// Probability that the interval holds the true mean: a sum over all counts. Exact; good to 1e-9.
    pub fn coverage(&self, intervals: Intervals) -> f64 {
        let probabilities: Vec<f64> = (0..=self.photons).map(|n| self.probability(n)).collect();
        let (mut below, mut covered) = (0.0, 0.0);
        for (n, &p) in probabilities.iter().enumerate() {
            let holds = match intervals {
                Intervals::RootOfCount(z) => (n as f64 - self.mean).abs() <= z * (n as f64).sqrt(),
                Intervals::ClopperPearson(confidence) => {
                    let rest = 0.5 * (1.0 - confidence);
                    below + p > rest && 1.0 - below > rest
                }
            };
            covered += if holds { p } else { 0.0 };
            below += p;
        }
        covered
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: of two photons, one in the mean; n = 0, 1, 2 with 1/4, 1/2, 1/4. From 0 the root's interval is empty but
    /// for 0 itself.
    #[test]
    fn two_photons_by_hand() {
        let two = Counts { photons: 2, mean: 1.0 };
        assert!((two.coverage(Intervals::RootOfCount(1.96)) - 0.75).abs() < 1e-12);
        assert!((two.coverage(Intervals::RootOfCount(0.5)) - 0.5).abs() < 1e-12);
        assert!((two.coverage(Intervals::ClopperPearson(0.95)) - 1.0).abs() < 1e-12);
        assert!((two.coverage(Intervals::ClopperPearson(0.4)) - 0.5).abs() < 1e-12);
    }

    /// Many photons are normal, and the exact interval never falls below what it promises.
    #[test]
    fn many_photons_are_normal_and_the_exact_interval_keeps_its_promise() {
        let many = Counts { photons: 4000, mean: 1500.0 };
        // The root of the count is the Poisson's, wider than the binomial's by 1 / sqrt(1 - 3/8).
        let wider = 1.959964 / (1.0f64 - 0.375).sqrt();
        let normal = 1.0 - statrs::function::erf::erfc(wider * std::f64::consts::FRAC_1_SQRT_2);
        assert!((many.coverage(Intervals::RootOfCount(1.959964)) - normal).abs() < 2e-3);
        for mean in [0.3, 1.0, 4.7, 20.0] {
            let few = Counts { photons: 500, mean };
            assert!(few.coverage(Intervals::ClopperPearson(0.95)) >= 0.95, "{mean}");
        }
    }
}
