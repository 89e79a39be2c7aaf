//! The straight free edge.

use std::f64::consts::PI;

use statrs::function::beta::beta_reg;

/// Share of the unit disc on the lit side of a straight edge, the query at the signed distance `t` (in search radii) on
/// the lit side: `f(t) = 1 - [acos t - t sqrt(1 - t^2)] / pi`, the disc less a circular segment. Exact.
///
/// `f(0) = 1/2`; for `t < 0` it is the light that reaches the dark side, `f(-t) = 1 - f(t)`.
pub fn half_plane(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    1.0 - (t.acos() - t * (1.0 - t * t).sqrt()) / PI
}

/// The same for a kernel proportional to `(1 - rho^2)^n` on the disc: 0 is the plain disc, 1 Epanechnikov's kernel,
/// 2 the quartic.
///
/// The kernel's marginal is proportional to `(1 - x^2)^(n + 1/2)`, so that for `t >= 0`
/// `f_n(t) = 1 - I_{1 - t^2}(n + 3/2, 1/2) / 2` with the regularised incomplete beta function; good to 1e-12. At the edge
/// it is 1/2 for every `n`.
pub fn half_plane_kernel(t: f64, n: u32) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    let beyond = 0.5 * beta_reg(f64::from(n) + 1.5, 0.5, 1.0 - t * t);
    if t >= 0.0 { 1.0 - beyond } else { beyond }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edge_laws::polar;

    #[test]
    fn areas_agree_with_polar_integration() {
        for t in [0.0, 0.05, 0.3, 0.537, 0.9, 1.0, 1.4] {
            let brute = polar::area(&[(0.0, t)]);
            assert!((half_plane(t) - brute).abs() < 1e-8, "{t}");
            for n in 0..4 {
                let cumulative = |r: f64| 1.0 - (1.0 - r * r).powi(n as i32 + 1);
                let brute = polar::mean(&[(0.0, t)], cumulative);
                assert!((half_plane_kernel(t, n) - brute).abs() < 1e-8, "{t} {n}");
                let both = half_plane_kernel(t, n) + half_plane_kernel(-t, n);
                assert!((both - 1.0).abs() < 1e-14, "{t} {n}");
            }
            assert!((half_plane(t) - half_plane_kernel(t, 0)).abs() < 1e-12, "{t}");
        }
    }

    #[test]
    fn catalogue_values() {
        assert!((half_plane(0.5) - 0.80449889).abs() < 1e-8);
        assert!((half_plane_kernel(0.5, 1) - 0.873415).abs() < 1e-8);
        assert!((half_plane_kernel(0.3, 2) - 0.78357734).abs() < 1e-8);
    }
}
