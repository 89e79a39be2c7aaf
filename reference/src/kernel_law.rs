//! Density estimates with a kernel: what each kernel reads in even and in curved light, and with what noise.
//!
//! A photon at the share `rho` of the search radius counts `w(rho) / (Z pi r^2)`, where `Z = int_0^1 w 2 rho d rho` makes
//! the kernel's mean over the disc 1 (Silverman, "Density Estimation for Statistics and Data Analysis", 1986, chapter 4;
//! catalogue entries A3 and A5). All constants are found here by integrating the profiles; in units of the search
//! radius, relative to the true irradiance.

use crate::quadrature::Gauss;

/// A profile `w`, not normalised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelUsed {
    /// 1.
    Disc,
    /// `1 - rho`.
    Cone,
    /// `1 - rho^2`.
    Epanechnikov,
    /// `(1 - rho^2)^2`, Silverman's K2.
    Biweight,
    /// `exp(-2 rho^2)`: a standard deviation of half the radius.
    Gaussian,
}

impl KernelUsed {
    /// All of them.
    pub const ALL: [KernelUsed; 5] =
        [KernelUsed::Disc, KernelUsed::Cone, KernelUsed::Epanechnikov, KernelUsed::Biweight, KernelUsed::Gaussian];

    fn profile(self, rho: f64) -> f64 {
        match self {
            KernelUsed::Disc => 1.0,
            KernelUsed::Cone => 1.0 - rho,
            KernelUsed::Epanechnikov => 1.0 - rho * rho,
            KernelUsed::Biweight => (1.0 - rho * rho).powi(2),
            KernelUsed::Gaussian => (-2.0 * rho * rho).exp(),
        }
    }

    /// The integral of `w^power rho^moment` over the unit disc, over `pi`; good to 1e-14.
    fn integral(self, power: i32, moment: i32) -> f64 {
        Gauss::new(20).integrate(0.0, 1.0, |rho| 2.0 * rho * self.profile(rho).powi(power) * rho.powi(moment))
    }

    /// The normalisation `Z`.
    pub fn normalisation(self) -> f64 {
        self.integral(1, 0)
    }

    /// `m2`, the mean of `rho^2` under the kernel.
    pub fn second_moment(self) -> f64 {
        self.integral(1, 2) / self.normalisation()
    }

    /// `c = int w^2 2 rho d rho / Z^2`: the relative variance of the estimate is `c / mu` for a Poisson count of mean `mu`
    /// in the disc (Campbell's theorem).
    pub fn variance_factor(self) -> f64 {
        self.integral(2, 0) / self.normalisation().powi(2)
    }
}

/// Mean of the estimate at the origin of the irradiance `1 + bend rho^2`: exactly `1 + bend m2`.
pub fn quadratic(kernel: KernelUsed, bend: f64) -> f64 {
    1.0 + bend * kernel.second_moment()
}

/// Relative variance of the k-nearest estimate in even light when the k-th photon only sets the radius: given that, the
/// others lie evenly in its disc, so that the mean is 1 and the variance `c / (k - 2)`.
pub fn nearest_variance(kernel: KernelUsed, k: u32) -> f64 {
    kernel.variance_factor() / (f64::from(k) - 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// The catalogue's table A3, from closed forms.
    #[test]
    fn catalogue_values() {
        let table = [
            (KernelUsed::Disc, 1.0, 0.5, 1.0),
            (KernelUsed::Cone, 1.0 / 3.0, 0.3, 1.5),
            (KernelUsed::Epanechnikov, 0.5, 1.0 / 3.0, 4.0 / 3.0),
            (KernelUsed::Biweight, 1.0 / 3.0, 0.25, 1.8),
            (KernelUsed::Gaussian, 0.43233236, 0.34348236, 1.3130353),
        ];
        for (kernel, z, m2, c) in table {
            assert!((kernel.normalisation() - z).abs() < 1e-8, "{kernel:?}");
            assert!((kernel.second_moment() - m2).abs() < 1e-8, "{kernel:?}");
            assert!((kernel.variance_factor() - c).abs() < 1e-7, "{kernel:?}");
        }
    }

    /// Photons thrown on a disc around the query, in order of distance, by waiting times in area; 20 comparisons at
    /// 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let (mut random, k, bend) = (Random::new(12), 20usize, 0.7);
        for kernel in KernelUsed::ALL {
            let z = kernel.normalisation();
            let mut moments: [Moments; 4] = Default::default();
            let mu = 15.0;
            for _ in 0..20_000 {
                let (mut even, mut curved, mut area) = (0.0, 0.0, random.gap());
                while area < mu {
                    let rho = (area / mu).sqrt();
                    even += kernel.profile(rho) / (z * mu);
                    curved += (1.0 + bend * rho * rho) * kernel.profile(rho) / (z * mu);
                    area += random.gap();
                }
                let gaps: Vec<f64> = (0..k).map(|_| random.gap()).collect();
                let outer: f64 = gaps.iter().sum();
                let mut inner = 0.0;
                let nearest: f64 = gaps[..k - 1].iter().fold(0.0, |sum, gap| {
                    inner += gap;
                    sum + kernel.profile((inner / outer).sqrt()) / (z * outer)
                });
                moments[0].add((even - 1.0).powi(2));
                moments[1].add(curved);
                moments[2].add(nearest);
                moments[3].add((nearest - 1.0).powi(2));
            }
            moments[0].must_agree("variance", kernel.variance_factor() / mu);
            moments[1].must_agree("curved", quadratic(kernel, bend));
            moments[2].must_agree("nearest, mean", 1.0);
            moments[3].must_agree("nearest, variance", nearest_variance(kernel, k as u32));
        }
    }
}
