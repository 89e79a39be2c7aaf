//! A glossy surface read by gathering.

/// Factor on the relative variance of a gathered radiance if the surface weighs photons by `cos^n` of the angle to its
/// normal (an eye on the normal, a Phong lobe) and light comes alike from all directions: `E[w^2] / E[w]^2 = (n + 2)^2 / (4 (n + 1))`,
/// near n / 4 for narrow lobes: of the photons near the point only those in the lobe tell anything.
///
/// The cosines of diffuse light have the density `2 cos`, so that `E[cos^m] = 2 / (m + 2)`. Exact.
pub fn lobe_variance_factor(exponent: f64) -> f64 {
    (exponent + 2.0).powi(2) / (4.0 * (exponent + 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    #[test]
    fn quadrature_agrees() {
        for exponent in [0.0, 1.0, 8.0, 40.0] {
            let mean = |power: f64| Gauss::new(60).integrate(0.0, 1.0, |c| 2.0 * c * c.powf(power));
            let factor = mean(2.0 * exponent) / mean(exponent).powi(2);
            assert!((factor / lobe_variance_factor(exponent) - 1.0).abs() < 1e-10, "{exponent}");
        }
    }
}
