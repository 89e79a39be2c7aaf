//! Shares of photons that arrive where someone looks. A count of `n` independent photons of which the share `p` arrives has the
//! relative variance `(1 - p) / (n p)` ([`crate::fixed_radius_law::binomial_variance`]).

/// Share of the photons of a lamp that shines alike in all directions that leave through a round hole of this half-angle (radians):
/// `(1 - cos a) / 2`. Exact.
pub fn keyhole(half_angle: f64) -> f64 {
    // Keeps its digits for narrow holes.
    (0.5 * half_angle).sin().powi(2)
}

/// Share of cosine-distributed rays from a point that meet a disc of radius `radius` facing it at the distance `height` on its normal:
/// `a^2 / (a^2 + h^2)`. Exact.
pub fn disc_by_cosine(radius: f64, height: f64) -> f64 {
    radius * radius / (radius * radius + height * height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// 4 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_directions_agree() {
        let mut random = Random::new(109);
        for (angle, radius) in [(0.3, 0.2), (1.2, 2.0_f64)] {
            let (mut through, mut met) = (Moments::default(), Moments::default());
            for _ in 0..200_000 {
                through.add(f64::from(random.direction()[2] > f64::cos(angle)));
                let d = random.cosine_around([0.0, 0.0, 1.0]);
                met.add(f64::from(d[0].hypot(d[1]) <= radius * d[2]));
            }
            through.must_agree("keyhole", keyhole(angle));
            met.must_agree("disc", disc_by_cosine(radius, 1.0));
        }
    }
}
