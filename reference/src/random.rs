//! Random numbers and running moments for the checks of this crate, its own so that nothing it judges is used.
//!
//! Every random check has a fixed seed and rejects at 4.5 standard errors: 6.8e-6 per comparison if the estimate is
//! normal, below 1e-3 for all comparisons of the crate together if the seeds were drawn anew.

/// SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom number generators", OOPSLA 2014).
pub(crate) struct Random(u64);

impl Random {
    /// A stream for this seed.
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// 64 random bits.
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `(0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        ((self.bits() >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    /// Uniform in `(a, b)`.
    pub(crate) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// Exponential with mean 1: the gap between points of a Poisson process of rate 1.
    pub(crate) fn gap(&mut self) -> f64 {
        -self.unit().ln()
    }

    /// Uniform on the unit sphere.
    pub(crate) fn direction(&mut self) -> [f64; 3] {
        let (z, phi) = (self.between(-1.0, 1.0), self.between(0.0, std::f64::consts::TAU));
        let s = (1.0 - z * z).sqrt();
        [s * phi.cos(), s * phi.sin(), z]
    }

    /// Cosine-distributed around the unit vector `n`: normal plus a uniform point of the sphere.
    pub(crate) fn cosine_around(&mut self, n: [f64; 3]) -> [f64; 3] {
        let d = self.direction();
        let v = [n[0] + d[0], n[1] + d[1], n[2] + d[2]];
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    }
}

/// Mean and variance of numbers that arrive one by one (Welford 1962).
#[derive(Default)]
pub(crate) struct Moments {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Moments {
    /// Adds one number.
    pub(crate) fn add(&mut self, x: f64) {
        self.count += 1.0;
        let before = x - self.mean;
        self.mean += before / self.count;
        self.squares += before * (x - self.mean);
    }

    /// The mean so far.
    pub(crate) fn mean(&self) -> f64 {
        self.mean
    }

    /// The sample variance (divisor n - 1).
    pub(crate) fn variance(&self) -> f64 {
        self.squares / (self.count - 1.0)
    }

    /// The standard error of the mean.
    pub(crate) fn error(&self) -> f64 {
        (self.variance() / self.count).sqrt()
    }

    /// Fails unless the mean agrees with `exact` within 4.5 standard errors.
    pub(crate) fn must_agree(&self, what: &str, exact: f64) {
        let z = (self.mean - exact) / self.error();
        println!("{what}: exact {exact}, simulated {} +- {:.1e}, z = {z:+.2}", self.mean, self.error());
        assert!(z.abs() < 4.5, "{what}: exact {exact}, simulated {} +- {}", self.mean, self.error());
    }
}

#[test]
fn the_instruments_are_right() {
    let mut random = Random::new(1);
    let (mut uniform, mut gaps, mut cosines) = Default::default();
    let mut variance: Moments = Moments::default();
    for _ in 0..200_000 {
        let x = random.unit();
        Moments::add(&mut uniform, x);
        variance.add(12.0 * (x - 0.5) * (x - 0.5));
        Moments::add(&mut gaps, random.gap());
        Moments::add(&mut cosines, random.cosine_around([0.0, 0.0, 1.0])[2]);
    }
    uniform.must_agree("mean of a uniform", 0.5);
    gaps.must_agree("mean gap", 1.0);
    cosines.must_agree("mean cosine of a cosine distribution", 2.0 / 3.0);
    variance.must_agree("variance of a uniform", 1.0);
    assert!((12.0 * uniform.variance() - 1.0).abs() < 0.01);
}
