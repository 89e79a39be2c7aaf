//! A lit sphere about as small as the search ball, or smaller.

/// The outside of a sphere of even, diffuse irradiance 1, read by a ball around one of its points over the disc `pi r^2`.
///
/// A ball of radius `r` cuts out the area `pi r^2` of a sphere of radius `R` as long as `r <= 2 R` (Archimedes), and from there on
/// all of it, `4 pi R^2`. The point's normal and that of a place at the distance `d` make the angle of cosine `1 - d^2 / (2 R^2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallSphere {
    /// Search radius over the sphere's radius, above 0.
    pub ratio: f64,
}

impl SmallSphere {
    /// Without a test: 1, then `4 / x^2`. Exact.
    pub fn without_test(self) -> f64 {
        (4.0 / (self.ratio * self.ratio)).min(1.0)
    }

    /// With a test for normals that keeps those within the angle of this cosine: 1, then `2 (1 - cosine) / x^2`. Exact.
    pub fn with_normal_test(self, least_cosine: f64) -> f64 {
        (2.0 * (1.0 - least_cosine) / (self.ratio * self.ratio)).min(1.0)
    }

    /// With a test for the side of arrival: of a place's diffuse light the share `(1 + cosine) / 2` also comes from the point's
    /// front, and cosines are even over the area: `1 - x^2 / 8`, then `2 / x^2`. Exact.
    pub fn with_side_test(self) -> f64 {
        let square = self.ratio * self.ratio;
        if square < 4.0 { 1.0 - square / 8.0 } else { 2.0 / square }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Photons thrown on a unit sphere; 11 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let mut random = Random::new(103);
        for ratio in [0.5, 1.2, 1.9, 3.0] {
            let law = SmallSphere { ratio };
            let mut found: [Moments; 3] = Default::default();
            for _ in 0..200_000 {
                let p = random.direction();
                let from = random.cosine_around(p);
                let inside = 2.0 - 2.0 * p[2] <= ratio * ratio;
                for (moments, counts) in found.iter_mut().zip([true, p[2] >= 0.5, from[2] > 0.0]) {
                    moments.add(if inside && counts { 4.0 / (ratio * ratio) } else { 0.0 });
                }
            }
            // A ball that holds the whole sphere leaves nothing to chance.
            if ratio < 2.0 {
                found[0].must_agree("no test", law.without_test());
            } else {
                assert!((found[0].mean() - law.without_test()).abs() < 1e-12);
            }
            found[1].must_agree("normal test", law.with_normal_test(0.5));
            found[2].must_agree("side test", law.with_side_test());
        }
    }
}
