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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

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
