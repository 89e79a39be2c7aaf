//! How much a photon counts by its distance from the point.

/// The weight of a photon at the share `rho` of the radius; beyond the radius none counts.
///
/// Each is normalised in the plane: its mean over the disc of the radius is 1, so that in even light every kernel reads
/// the same. Silverman, "Density Estimation for Statistics and Data Analysis", 1986, chapter 4, has the
/// Epanechnikov and biweight kernels of two dimensions; Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001,
/// section 7.2, the cone and a Gaussian, which as printed there is not normalised (it reads 0.531 of the truth).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Kernel {
    /// 1: every photon alike.
    #[default]
    Disc,
    /// 3 (1 - rho).
    Cone,
    /// 2 (1 - rho^2): the least mean squared error of all kernels at its best radius.
    Epanechnikov,
    /// 3 (1 - rho^2)^2: smooth at the rim too.
    Biweight,
    /// exp(-2 rho^2) over its mean, (1 - exp(-2)) / 2: a standard deviation of half the radius, cut off at two.
    Gaussian,
}

impl Kernel {
    /// The weight at a squared share of the radius, in [0, 1].
    #[inline(always)]
    pub fn weight(self, rho_squared: f64) -> f64 {
        match self {
            Kernel::Disc => 1.0,
            Kernel::Cone => 3.0 * (1.0 - rho_squared.sqrt()),
            Kernel::Epanechnikov => 2.0 * (1.0 - rho_squared),
            Kernel::Biweight => 3.0 * (1.0 - rho_squared) * (1.0 - rho_squared),
            Kernel::Gaussian => (-2.0 * rho_squared).exp() / GAUSSIAN_MEAN,
        }
    }

    /// The weights at squared shares, those beyond 1 taken for 1; compiled for the instructions of the caller.
    #[inline(always)]
    pub(crate) fn weights<const N: usize>(self, shares: &[f64; N]) -> [f64; N] {
        let mut weights = [1.0; N];
        match self {
            Kernel::Disc => {}
            Kernel::Cone => each(&mut weights, shares, |t| Kernel::Cone.weight(t)),
            Kernel::Epanechnikov => each(&mut weights, shares, |t| Kernel::Epanechnikov.weight(t)),
            Kernel::Biweight => each(&mut weights, shares, |t| Kernel::Biweight.weight(t)),
            Kernel::Gaussian => each(&mut weights, shares, |t| Kernel::Gaussian.weight(t)),
        }
        weights
    }

    /// The integral of the weight over the squared share, from 0 to `t`: what a disc of `t` times the area weighs.
    pub fn mass(self, t: f64) -> f64 {
        match self {
            Kernel::Disc => t,
            Kernel::Cone => t * (3.0 - 2.0 * t.sqrt()),
            Kernel::Epanechnikov => t * (2.0 - t),
            Kernel::Biweight => t * (3.0 - t * (3.0 - t)),
            Kernel::Gaussian => (1.0 - (-2.0 * t).exp()) / (2.0 * GAUSSIAN_MEAN),
        }
    }

    /// The integral of `t` times the weight from 0 to `t`.
    pub fn second(self, t: f64) -> f64 {
        match self {
            Kernel::Disc => t * t / 2.0,
            Kernel::Cone => t * t * (1.5 - 1.2 * t.sqrt()),
            Kernel::Epanechnikov => t * t * (1.0 - t * 2.0 / 3.0),
            Kernel::Biweight => t * t * (1.5 - t * (2.0 - t * 0.75)),
            Kernel::Gaussian => (1.0 - (1.0 + 2.0 * t) * (-2.0 * t).exp()) / (4.0 * GAUSSIAN_MEAN),
        }
    }

    /// The mean of `rho^2` under the kernel, `m2`: where the irradiance is smooth the bias is `m2 / 4 r^2` times its
    /// Laplacian, and exactly so where it is quadratic (catalogue A3; Silverman 1986, chapter 4).
    pub fn second_moment(self) -> f64 {
        match self {
            Kernel::Disc => 1.0 / 2.0,
            Kernel::Cone => 3.0 / 10.0,
            Kernel::Epanechnikov => 1.0 / 3.0,
            Kernel::Biweight => 1.0 / 4.0,
            Kernel::Gaussian => (1.0 - 3.0 * (-2.0f64).exp()) / (4.0 * GAUSSIAN_MEAN),
        }
    }

    /// The mean of the squared weight over the disc: the factor on the relative variance of the estimate. That is
    /// `c / mu` for `mu` photons of equal flux expected in the disc, and `c / (k - 2)` for the k nearest (catalogue A3, A5).
    pub fn variance_factor(self) -> f64 {
        match self {
            Kernel::Disc => 1.0,
            Kernel::Cone => 3.0 / 2.0,
            Kernel::Epanechnikov => 4.0 / 3.0,
            Kernel::Biweight => 9.0 / 5.0,
            Kernel::Gaussian => (1.0 - (-4.0f64).exp()) / (4.0 * GAUSSIAN_MEAN * GAUSSIAN_MEAN),
        }
    }
}

#[inline(always)]
fn each<const N: usize>(weights: &mut [f64; N], shares: &[f64; N], weight: impl Fn(f64) -> f64) {
    for lane in 0..N {
        weights[lane] = weight(if shares[lane] < 1.0 { shares[lane] } else { 1.0 });
    }
}

/// The mean of exp(-2 rho^2) over the unit disc, (1 - exp(-2)) / 2. A number, for compilers move a call out of every loop.
const GAUSSIAN_MEAN: f64 = 0.432_332_358_381_693_65;

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Kernel; 5] = [Kernel::Disc, Kernel::Cone, Kernel::Epanechnikov, Kernel::Biweight, Kernel::Gaussian];

    #[test]
    fn weights_are_each_weight() {
        let shares = [0.0, 0.3, 1.0, 7.0];
        for kernel in ALL {
            assert_eq!(kernel.weights(&shares), shares.map(|t| kernel.weight(t.min(1.0))), "{kernel:?}");
        }
    }

    /// Every constant is its integral over the disc, `2 rho d rho`, by the midpoint rule in `rho`.
    #[test]
    fn constants_are_their_integrals() {
        let n = 20_000;
        for kernel in ALL {
            let mean = |of: fn(f64, f64) -> f64| {
                let at = |i: usize| (i as f64 + 0.5) / n as f64;
                (0..n).map(|i| 2.0 * at(i) * of(kernel.weight(at(i) * at(i)), at(i))).sum::<f64>() / n as f64
            };
            assert!((mean(|w, _| w) - 1.0).abs() < 1e-8, "{kernel:?}");
            assert!((mean(|w, rho| w * rho * rho) - kernel.second_moment()).abs() < 1e-8, "{kernel:?}");
            assert!((mean(|w, _| w * w) - kernel.variance_factor()).abs() < 1e-8, "{kernel:?}");
            assert!((kernel.mass(1.0) - 1.0).abs() < 1e-15, "{kernel:?}");
            assert!((kernel.second(1.0) - kernel.second_moment()).abs() < 1e-15, "{kernel:?}");
            // Their slopes are the weight and its share.
            for t in [0.1, 0.4, 0.8] {
                let slope = |of: &dyn Fn(f64) -> f64| (of(t + 1e-5) - of(t - 1e-5)) / 2e-5;
                assert!((slope(&|t| kernel.mass(t)) - kernel.weight(t)).abs() < 1e-8, "{kernel:?}");
                assert!((slope(&|t| kernel.second(t)) - t * kernel.weight(t)).abs() < 1e-8, "{kernel:?}");
            }
        }
    }
}
