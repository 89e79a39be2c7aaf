//! What a test of the side from which photons arrived leaves of another face's light.

use crate::edge_laws;

/// Share of the flux on an evenly and diffusely lit face that would arrive on the front of another face too, whose normal
/// makes an angle of this cosine with the first one's: `(1 + cosine) / 2`.
///
/// Seen along the first normal the hemisphere of directions is a disc, on which diffuse light lies evenly. The plane of the
/// other face cuts the hemisphere along half of a great circle, which is seen as half of an ellipse with the half axes 1
/// and `|cosine|`. Exact.
pub fn seen_from_both(cosine: f64) -> f64 {
    0.5 * (1.0 + cosine)
}

/// Reading at distance `t` (in search radii) from the edge of two diffusely lit faces with irradiance 1 that meet at the
/// dihedral angle `theta` (radians, up to pi), with a ball that counts the photons of either face that travelled towards the front of the query's:
/// all of its own, and of the other face's the share [`seen_from_both`]. Exact.
pub fn crease_with_side_test(t: f64, theta: f64) -> f64 {
    let reading = edge_laws::crease(t, theta, 1.0, 1.0);
    // The normals make the angle pi - theta.
    reading.own + reading.leak * seen_from_both(-theta.cos())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Three comparisons at 4.5 standard errors.
    #[test]
    fn diffuse_directions_agree() {
        let mut random = Random::new(101);
        for angle in [0.4, 1.3, 2.5_f64] {
            let other = [angle.sin(), 0.0, angle.cos()];
            let mut share = Moments::default();
            for _ in 0..200_000 {
                let d = random.cosine_around([0.0, 0.0, 1.0]);
                share.add(f64::from(d[0] * other[0] + d[2] * other[2] > 0.0));
            }
            share.must_agree("both sides", seen_from_both(angle.cos()));
        }
    }

    #[test]
    fn a_flat_plane_keeps_all_and_a_right_angle_half_of_the_leak() {
        assert!((crease_with_side_test(0.3, std::f64::consts::PI) - 1.0).abs() < 1e-12);
        let right = edge_laws::crease(0.3, 0.5 * std::f64::consts::PI, 1.0, 1.0);
        let read = crease_with_side_test(0.3, 0.5 * std::f64::consts::PI);
        assert!((read - right.own - 0.5 * right.leak).abs() < 1e-12);
    }
}
