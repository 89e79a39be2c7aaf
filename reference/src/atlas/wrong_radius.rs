//! A fixed radius that is too small or too large.

use std::f64::consts::PI;

/// Light that bends around the query: `lambda` photons of flux `1 / lambda` to the area there, and `1 + bend x^2` as many at the distance `x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BentField {
    /// Photons per unit of area at the query.
    pub density: f64,
    /// Per unit of length squared, 0 or above.
    pub bend: f64,
}

impl BentField {
    /// Photons expected within a radius: `lambda pi (r^2 + bend r^4 / 2)`.
    fn expected(&self, radius: f64) -> f64 {
        let square = radius * radius;
        self.density * PI * (square + 0.5 * self.bend * square * square)
    }

    /// Mean squared error of the fixed-radius estimate relative to the irradiance squared: `(bend r^2 / 2)^2 + (1 + bend r^2 / 2) / (lambda pi
    /// r^2)`: noise falls with the radius and bias grows. Exact.
    pub fn squared_error(&self, radius: f64) -> f64 {
        let bias = 0.5 * self.bend * radius * radius;
        bias * bias + self.expected(radius) / (self.density * PI * radius * radius).powi(2)
    }

    /// The same of the estimate less the bias that a ball of twice the radius tells, a third of the difference: unbiased here, and
    /// photons inside count 5/4, those in the ring -1/12, so that the variance is `(25 A / 16 + B / 144) / (lambda pi r^2)^2` for `A`
    /// and `B` photons expected there. Exact.
    pub fn squared_error_of_corrected(&self, radius: f64) -> f64 {
        let inside = self.expected(radius);
        let ring = self.expected(2.0 * radius) - inside;
        (25.0 / 16.0 * inside + ring / 144.0) / (self.density * PI * radius * radius).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// 2 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let mut random = Random::new(110);
        let field = BentField { density: 60.0, bend: 2.0 };
        let (radius, side) = (0.4, 0.81);
        let most = 1.0 + field.bend * 2.0 * side * side;
        let (mut plain, mut corrected) = (Moments::default(), Moments::default());
        for _ in 0..20_000 {
            let (mut ball, mut ring, mut clock) = (0.0, 0.0, random.gap());
            while clock < field.density * most * 4.0 * side * side {
                let (x, y) = (random.between(-side, side), random.between(-side, side));
                let square = x * x + y * y;
                if random.unit() * most < 1.0 + field.bend * square {
                    ball += f64::from(square <= radius * radius);
                    ring += f64::from(square > radius * radius && square <= 4.0 * radius * radius);
                }
                clock += random.gap();
            }
            let disc = field.density * PI * radius * radius;
            let (own, wide) = (ball / disc, (ball + ring) / (4.0 * disc));
            plain.add((own - 1.0).powi(2));
            corrected.add((own - (wide - own) / 3.0 - 1.0).powi(2));
        }
        plain.must_agree("fixed radius", field.squared_error(radius));
        corrected.must_agree("less its bias", field.squared_error_of_corrected(radius));
    }
}
