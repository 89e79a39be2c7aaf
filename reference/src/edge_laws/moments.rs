//! What a straight edge leaves of the disc, with its moments, and what estimates that know them read.

use std::f64::consts::{FRAC_PI_2, PI};

use super::half_plane;

/// Moments of the part of the unit disc on the lit side of a straight edge, over pi; x runs from the query away from the
/// edge. Exact: integrals of `x^n 2 sqrt(1 - x^2)` from `-t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfPlaneMoments {
    /// Of 1: the share of the disc.
    pub area: f64,
    /// Of x.
    pub first: f64,
    /// Of x^2.
    pub across: f64,
    /// Of y^2, along the edge.
    pub along: f64,
    /// Of x^3.
    pub third: f64,
}

impl HalfPlaneMoments {
    /// For a query at the distance `t >= 0` (in search radii) from the edge.
    pub fn new(t: f64) -> Self {
        let t = t.clamp(0.0, 1.0);
        let (c, angle) = ((1.0 - t * t).sqrt(), t.asin());
        Self {
            area: half_plane(t),
            first: 2.0 * c.powi(3) / (3.0 * PI),
            across: (FRAC_PI_2 + angle - t * c * (1.0 - 2.0 * t * t)) / (4.0 * PI),
            along: (3.0 * (FRAC_PI_2 + angle) + t * c * (5.0 - 2.0 * t * t)) / (12.0 * PI),
            third: 2.0 * c.powi(3) * (3.0 * t * t + 2.0) / (15.0 * PI),
        }
    }

    /// What flux over the clipped area reads in the irradiance `1 + slope x + bend x^2`.
    pub fn clipped(&self, slope: f64, bend: f64) -> f64 {
        1.0 + (slope * self.first + bend * self.across) / self.area
    }

    /// What a local linear fit reads there: the slope is taken out, what curves is not (Jones, "Simple boundary correction
    /// for kernel density estimation", 1993).
    pub fn linear(&self, bend: f64) -> f64 {
        let Self { area, first, across, third, .. } = self;
        1.0 + bend * (across * across - first * third) / (area * across - first * first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    #[test]
    fn moments_are_their_integrals() {
        let rule = Gauss::new(20);
        for t in [0.0f64, 0.2, 0.5, 0.9, 1.0] {
            let m = HalfPlaneMoments::new(t);
            // In the angle whose sine is x, where the integrand is smooth.
            let of = |f: &dyn Fn(f64) -> f64| {
                rule.composite(-t.asin(), FRAC_PI_2, 8, |s| f(s.sin()) * 2.0 * s.cos().powi(2)) / PI
            };
            for (got, exact) in [
                (m.area, of(&|_| 1.0)),
                (m.first, of(&|x| x)),
                (m.across, of(&|x| x * x)),
                (m.along, of(&|x| (1.0 - x * x) / 3.0)),
                (m.third, of(&|x| x.powi(3))),
            ] {
                assert!((got - exact).abs() < 1e-12, "{t}: {got} {exact}");
            }
        }
    }

    /// The value at the query of the plane fitted with the disc's own weights, found by solving for it step by step.
    #[test]
    fn a_linear_fit_solves_its_own_equations() {
        for (t, bend) in [(0.0, 1.0), (0.3, -0.5), (0.8, 2.0)] {
            let m = HalfPlaneMoments::new(t);
            let data = [m.area + bend * m.across, m.first + bend * m.third];
            let slope = (data[1] * m.area - data[0] * m.first) / (m.area * m.across - m.first * m.first);
            let value = (data[0] - slope * m.first) / m.area;
            assert!((m.linear(bend) - value).abs() < 1e-12);
            assert!((m.clipped(0.7, bend) - (data[0] + 0.7 * m.first) / m.area).abs() < 1e-12);
        }
        assert!((HalfPlaneMoments::new(1.0).linear(1.0) - 1.25).abs() < 1e-12, "the disc's own bias in the open");
    }
}
