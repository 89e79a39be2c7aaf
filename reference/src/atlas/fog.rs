//! Photons in a medium read by a ball.

/// Reading of a ball at the middle of light that falls off as `exp(-s z)`, `s` per search radius: `3 (s cosh s - sinh s) / s^3`, the
/// mean over the ball. Exact.
pub fn exponential_over_ball(s: f64) -> f64 {
    if s.abs() < 0.02 {
        // The series; what is left out is below 1e-11.
        return 1.0 + s * s / 10.0 + s.powi(4) / 280.0;
    }
    3.0 * (s * s.cosh() - s.sinh()) / s.powi(3)
}

/// The same less the bias that a second ball of twice the radius tells, a third of their difference. Exact.
pub fn exponential_over_two_balls(s: f64) -> f64 {
    let ball = exponential_over_ball(s);
    ball - (exponential_over_ball(2.0 * s) - ball) / 3.0
}

/// Share of a ball on the lit side of a plane, its centre at the signed distance `t` (in search radii) on that side:
/// `(2 + 3 t - t^3) / 4`. Exact.
pub fn share_of_ball(t: f64) -> f64 {
    let t = t.clamp(-1.0, 1.0);
    (2.0 + 3.0 * t - t.powi(3)) / 4.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    /// By slices of the ball.
    #[test]
    fn slices_agree() {
        let slices =
            |from: f64, f: &dyn Fn(f64) -> f64| Gauss::new(20).composite(from, 1.0, 4, |z| 0.75 * (1.0 - z * z) * f(z));
        for s in [0.01, 0.02, 0.5, 2.0, 6.0] {
            let mean = slices(-1.0, &|z| (-s * z).exp());
            assert!((exponential_over_ball(s) / mean - 1.0).abs() < 1e-9, "{s}");
        }
        for t in [-0.7, 0.0, 0.3, 1.0] {
            assert!((share_of_ball(t) - slices(-t, &|_| 1.0)).abs() < 1e-12, "{t}");
        }
    }
}
