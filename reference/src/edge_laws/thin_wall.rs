//! Light that leaks through a wall thinner than the search ball.

use super::half_plane;

/// What the dark face of a slab reads if its other face, `h` search radii behind, is lit with irradiance 1: the ball cuts
/// the lit face in a disc of radius `sqrt(1 - h^2)`, so `max(0, 1 - h^2)`. Exact; 0 with a normal test.
pub fn thin_wall(h: f64) -> f64 {
    (1.0 - h * h).max(0.0)
}

/// What the floor reads on the dark side of an infinitely thin wall standing on it, at distance `t >= 0` (search radii)
/// from the wall, if the floor on the other side has irradiance 1: `1 - f(t)`. A normal test does not help here. Exact.
pub fn wall_on_floor(t: f64) -> f64 {
    half_plane(-t)
}

/// What a dark floor reads of a sheet with irradiance 1 that hangs `h` search radii over it and faces the same way, if photons count up to
/// `flatness` of their distance off the tangent plane: those from `h / flatness` to 1 away, `max(0, 1 - (h / flatness)^2)`. Exact.
pub fn sheet_over_floor(h: f64, flatness: f64) -> f64 {
    (1.0 - (h / flatness).powi(2)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Points of the sheet inside the ball and the cone: 3 comparisons at 4.5 standard errors.
    #[test]
    fn random_points_on_the_sheet_agree() {
        let mut random = Random::new(7);
        for (h, flatness) in [(0.02, 0.1), (0.07, 0.1), (0.1, 0.2)] {
            let mut found = Moments::default();
            for _ in 0..200_000 {
                let (x, y) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                let away = (x * x + y * y + h * h).sqrt();
                let counts = away <= 1.0 && h <= flatness * away;
                found.add(if counts { 4.0 / std::f64::consts::PI } else { 0.0 });
            }
            found.must_agree(&format!("sheet {h}"), sheet_over_floor(h, flatness));
        }
        assert_eq!(sheet_over_floor(0.2, 0.1), 0.0);
    }

    /// Points of the lit face inside the ball: 5 comparisons at 4.5 standard errors.
    #[test]
    fn random_points_on_the_lit_face_agree() {
        let mut random = Random::new(6);
        for h in [0.1, 0.5, 0.75, 0.9] {
            let mut found = Moments::default();
            for _ in 0..200_000 {
                let (x, y) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                let inside = x * x + y * y + h * h <= 1.0;
                found.add(if inside { 4.0 / std::f64::consts::PI } else { 0.0 });
            }
            found.must_agree(&format!("wall {h}"), thin_wall(h));
        }
        assert_eq!(thin_wall(1.5), 0.0);
        assert!((wall_on_floor(0.25) - (1.0 - 0.65748118)).abs() < 1e-8);
    }
}
