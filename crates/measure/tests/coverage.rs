//! The instruments measured: intervals cover the truth as often as they say, tests reject as often as they say.
//!
//! Seeds are fixed. Each of the six comparisons uses a Clopper-Pearson interval of confidence 1 - 1e-6, so the family
//! raises a false alarm with probability below 1e-5.

use photonlab_measure::{
    Replicates, binomial_interval, chi_square_test, fit_log_log_weighted, kolmogorov_smirnov_test, welch_test,
};

const SETS: u64 = 4000;
const CONFIDENCE: f64 = 0.9;

/// SplitMix64 (Steele, Lea and Flood 2014): small, and good enough to test instruments with.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let a = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let b = (a ^ (a >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((b ^ (b >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Box and Muller.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// How many of the sets satisfy `happens`, judged against its stated probability.
fn assert_rate(seed: u64, probability: f64, mut happens: impl FnMut(&mut Random) -> bool) {
    let mut random = Random(seed);
    let count = (0..SETS).filter(|_| happens(&mut random)).count() as u64;
    let rate = binomial_interval(count, SETS, 1.0 - 1e-6);
    assert!(rate.contains(probability), "{rate:?} does not contain {probability}");
}

#[test]
fn student_t_intervals_of_few_replicates_cover() {
    assert_rate(1, CONFIDENCE, |random| {
        let set: Replicates = (0..4).map(|_| 7.0 + 0.1 * random.normal()).collect();
        set.interval(CONFIDENCE).unwrap().contains(7.0)
    });
}

#[test]
fn welch_intervals_of_unequal_sets_cover() {
    assert_rate(2, CONFIDENCE, |random| {
        let a: Replicates = (0..10).map(|_| 2.0 + random.normal()).collect();
        let b: Replicates = (0..30).map(|_| 1.0 + 5.0 * random.normal()).collect();
        welch_test(&a, &b).unwrap().interval(CONFIDENCE).contains(1.0)
    });
}

/// The weighted fit is conservative (never narrowed, Student's t): it covers at least as often as it says.
#[test]
fn weighted_slopes_cover_at_least() {
    let x = [1e2, 1e3, 1e4, 1e5, 1e6];
    let mut random = Random(3);
    let covered = (0..SETS).filter(|_| {
        let y = x.map(|x: f64| x.powf(-0.5) * (0.05 * random.normal()).exp());
        let fit = fit_log_log_weighted(&x, &y, &y.map(|y| 0.05 * y)).unwrap();
        fit.slope_interval(CONFIDENCE).contains(-0.5)
    });
    let rate = binomial_interval(covered.count() as u64, SETS, 1.0 - 1e-6);
    assert!(rate.high >= CONFIDENCE && rate.value < 0.995, "{rate:?}");
}

/// Discrete counts make the interval conservative: it covers at least as often as it says.
#[test]
fn binomial_intervals_cover_at_least() {
    let mut random = Random(4);
    let covered = (0..SETS).filter(|_| {
        let hits = (0..40).filter(|_| random.uniform() < 0.03).count() as u64;
        binomial_interval(hits, 40, CONFIDENCE).contains(0.03)
    });
    let rate = binomial_interval(covered.count() as u64, SETS, 1.0 - 1e-6);
    assert!(rate.high >= CONFIDENCE && rate.value < 0.995, "{rate:?}");
}

#[test]
fn kolmogorov_smirnov_rejects_at_its_level() {
    assert_rate(5, 0.1, |random| {
        let values: Vec<f64> = (0..50).map(|_| random.uniform()).collect();
        kolmogorov_smirnov_test(&values, |x| x).unwrap().p_value < 0.1
    });
}

#[test]
fn chi_square_rejects_at_its_level() {
    assert_rate(6, 0.1, |random| {
        let mut counts = [0; 10];
        for _ in 0..500 {
            counts[(random.uniform() * 10.0) as usize] += 1;
        }
        chi_square_test(&counts, &[50.0; 10]).unwrap().p_value < 0.1
    });
}
