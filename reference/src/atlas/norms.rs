//! Kernels divided by the plain disc instead of their own norm.

/// What a cone `1 - rho / k` over `pi r^2` alone reads of even light: `1 - 2 / (3 k)`, `k >= 1` (Jensen, "Realistic Image Synthesis Using
/// Photon Mapping", 2001, section 7.2.1, where the estimate is divided by it). Exact.
pub fn cone_norm(k: f64) -> f64 {
    1.0 - 2.0 / (3.0 * k)
}

/// What the Gaussian `alpha (1 - (1 - exp(-beta rho^2 / 2)) / (1 - exp(-beta)))` over `pi r^2` reads of even light, as printed there (section
/// 7.2.2) with `alpha = 0.918` and `beta = 1.953`, for any `beta`: `alpha (1 - (1 - (1 - exp(-beta / 2)) / (beta / 2)) / (1 - exp(-beta)))`. Exact.
pub fn printed_gaussian(beta: f64) -> f64 {
    let half = 0.5 * beta;
    0.918 * (1.0 - (1.0 + (-half).exp_m1() / half) / -(-beta).exp_m1())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    #[test]
    fn norms_are_means_over_the_disc() {
        let mean = |w: &dyn Fn(f64) -> f64| Gauss::new(20).integrate(0.0, 1.0, |rho| 2.0 * rho * w(rho));
        for k in [1.0, 1.1, 2.0, 5.0] {
            assert!((cone_norm(k) - mean(&|rho| 1.0 - rho / k)).abs() < 1e-13, "{k}");
        }
        for beta in [0.5, 1.953, 6.0_f64] {
            let printed = |rho: f64| {
                let falls = 1.0 - (-0.5 * beta * rho * rho).exp();
                0.918 * (1.0 - falls / (1.0 - (-beta).exp()))
            };
            assert!((printed_gaussian(beta) - mean(&printed)).abs() < 1e-13, "{beta}");
        }
        // Catalogue A3.
        assert!((printed_gaussian(1.953) - 0.53115493).abs() < 1e-8);
    }
}
