//! Two half-planes that share an edge, gathered by a sphere.

use std::f64::consts::PI;

use super::half_plane;

/// What a gather sphere reads near a crease: its own plane's part and the part that leaks in from the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreaseReading {
    /// From the plane that holds the query: `E_A f(t)`. A perfect normal test leaves this alone.
    pub own: f64,
    /// From the other plane.
    pub leak: f64,
}

impl CreaseReading {
    /// What a sphere without a normal test reads.
    pub fn total(&self) -> f64 {
        self.own + self.leak
    }
}

/// The reading at distance `t` (in search radii) from the edge in which two half-planes meet at the dihedral angle
/// `theta` (radians; `pi/2` is a room's corner, `pi` flat), uniformly lit with irradiance `own` and `other`.
///
/// The sphere cuts the other plane in a disc of radius `rho = sqrt(1 - t^2 sin^2 theta)` around the query's foot, which
/// is `t cos theta` inside the lit half: `leak = other rho^2 f(t cos theta / rho)`. Exact. At the edge and for equal
/// irradiance the sum is 1 for every angle. Only `cos theta` and `|sin theta|` enter: a box's convex edge (`3 pi/2`)
/// leaks like a room's corner.
pub fn crease(t: f64, theta: f64, own: f64, other: f64) -> CreaseReading {
    let (sine, cosine) = theta.sin_cos();
    let rho2 = 1.0 - (t * sine).powi(2);
    let leak = if rho2 > 0.0 { rho2 * half_plane(t * cosine / rho2.sqrt()) } else { 0.0 };
    CreaseReading { own: own * half_plane(t), leak: other * leak }
}

/// Where the reading at a 90-degree crease with equal irradiance is largest, and that largest reading:
/// `t = 2 / sqrt(pi^2 + 4) = 0.537` and 1.1805, the maximum of `f(t) + (1 - t^2) / 2`.
pub fn right_angle_maximum() -> (f64, f64) {
    let t = 2.0 / (PI * PI + 4.0).sqrt();
    (t, crease(t, 0.5 * PI, 1.0, 1.0).total())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second plane in space, on a grid: the edge is the y axis, the query at (t, 0, 0), the plane's points
    /// `s (cos theta, 0, sin theta) + y`, `s > 0`.
    fn leak_on_a_grid(t: f64, theta: f64) -> f64 {
        let n = 4000;
        let step = 2.4 / n as f64;
        let chord = |i: usize| {
            let s = (i as f64 + 0.5) * step;
            let y2 = 1.0 - (s * theta.cos() - t).powi(2) - (s * theta.sin()).powi(2);
            2.0 * y2.max(0.0).sqrt() * step
        };
        (0..n).map(chord).sum::<f64>() / PI
    }

    #[test]
    fn the_leak_is_an_area_in_space() {
        for degrees in [10.0, 45.0, 60.0, 90.0, 120.0, 150.0, 180.0, 270.0_f64] {
            for t in [0.0, 0.1, 0.5, 0.9, 1.0, 1.3] {
                let theta = degrees.to_radians();
                let (got, brute) = (crease(t, theta, 1.0, 1.0).leak, leak_on_a_grid(t, theta));
                assert!((got - brute).abs() < 2e-5, "{degrees} {t}: {got} {brute}");
            }
        }
    }

    #[test]
    fn darkening_and_leaking_cancel_at_the_edge() {
        for theta in [0.1, 1.0, 2.0, 3.0, 5.0] {
            assert!((crease(0.0, theta, 1.0, 1.0).total() - 1.0).abs() < 1e-14);
        }
        assert!((crease(0.3, PI, 1.0, 1.0).total() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_maximum_is_the_maximum() {
        let (at, most) = right_angle_maximum();
        assert!((at - 0.537029).abs() < 1e-6 && (most - 1.180454).abs() < 1e-6);
        for i in 0..=1000 {
            let t = f64::from(i) / 1000.0;
            assert!(crease(t, 0.5 * PI, 1.0, 1.0).total() <= most);
        }
        assert!((crease(0.75, (60.0_f64).to_radians(), 1.0, 1.0).total() - 1.3907808).abs() < 1e-7);
    }
}
