//! The corner of a room: three faces that meet at right angles.

use super::{corner, half_plane};

/// What a gather sphere reads on one face of a room's corner, by the face the light comes from.
///
/// Sources: the face itself is the quadrant law ([`corner`]); each neighbour is cut in a disc of radius
/// `sqrt(1 - a^2)` centred on the shared edge, of which the half on the face's side of that edge is there, less what lies
/// beyond the third face. Exact for a corner whose faces reach further than the sphere. At the corner itself: 1/4 from
/// each face, 3/4 in all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConcaveCorner {
    /// From the face that holds the query. A perfect normal test leaves this alone.
    pub own: f64,
    /// From the face at distance `a`.
    pub leak_a: f64,
    /// From the face at distance `b`.
    pub leak_b: f64,
}

impl ConcaveCorner {
    /// The reading at distances `a`, `b >= 0` (in search radii) from the two other faces, which are lit with the
    /// irradiances `beyond = [E_a, E_b]`, the face itself with `own`.
    pub fn new(a: f64, b: f64, own: f64, beyond: [f64; 2]) -> Self {
        let leak = |to: f64, along: f64| {
            let rho2 = 1.0 - to * to;
            if rho2 > 0.0 { 0.5 * rho2 * half_plane(along / rho2.sqrt()) } else { 0.0 }
        };
        ConcaveCorner { own: own * corner(a, b), leak_a: beyond[0] * leak(a, b), leak_b: beyond[1] * leak(b, a) }
    }

    /// What a sphere without a normal test reads.
    pub fn total(&self) -> f64 {
        self.own + self.leak_a + self.leak_b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn three_quarters_in_the_corner_and_the_crease_law_away_from_it() {
        let reading = ConcaveCorner::new(0.0, 0.0, 1.0, [1.0, 1.0]);
        assert!((reading.total() - 0.75).abs() < 1e-15 && (reading.own - 0.25).abs() < 1e-15);
        for t in [0.0, 0.3, 0.537, 1.0] {
            let far = ConcaveCorner::new(t, 1.0, 1.0, [1.0, 1.0]);
            let crease = super::super::crease(t, std::f64::consts::FRAC_PI_2, 1.0, 1.0);
            assert!((far.total() - crease.total()).abs() < 1e-14, "{t}");
        }
    }

    /// Random points on the three faces x = 0, y = 0, z = 0 of the corner, the query at (a, b, 0): 15 comparisons at 4.5
    /// standard errors.
    #[test]
    fn random_points_on_the_faces_agree() {
        let mut random = Random::new(5);
        let side = 2.0;
        for (a, b) in [(0.0, 0.0), (0.2, 0.5), (0.6, 0.6), (0.1, 0.95), (0.8, 0.0)] {
            let mut found: [Moments; 3] = Default::default();
            for _ in 0..200_000 {
                for (axis, moments) in found.iter_mut().enumerate() {
                    let mut p = [0; 3].map(|_| random.between(0.0, side));
                    p[axis] = 0.0;
                    let d2 = (p[0] - a).powi(2) + (p[1] - b).powi(2) + p[2] * p[2];
                    let area = side * side / std::f64::consts::PI;
                    moments.add(if d2 <= 1.0 { area } else { 0.0 });
                }
            }
            let reading = ConcaveCorner::new(a, b, 1.0, [1.0, 1.0]);
            for (moments, exact) in found.iter().zip([reading.leak_a, reading.leak_b, reading.own]) {
                moments.must_agree(&format!("corner ({a}, {b})"), exact);
            }
        }
    }
}
