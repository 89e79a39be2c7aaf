//! Skies without a sun: luminance by elevation, relative to the zenith.
//!
//! Uniform; the traditional overcast sky of Moon and Spencer, `(1 + 2 sin gamma) / 3`; and type 1 of the CIE general sky,
//! `(1 + 4 exp(-0.7 / sin gamma)) / (1 + 4 exp(-0.7))` with a constant indicatrix (ISO 15469:2004, gradation a = 4,
//! b = -0.7). A horizontal plane receives `2 pi int L sin gamma d(sin gamma)`: `pi`, `7 pi / 9`, and for type 1
//! `pi (1 + 8 E3(0.7)) / (1 + 4 exp(-0.7))`, `E3` the exponential integral. (Catalogue entry I4.)

use std::f64::consts::PI;

use crate::quadrature::Gauss;

/// A sky that is the same in all azimuths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sky {
    /// The same luminance everywhere.
    Uniform,
    /// Moon and Spencer 1942: three times as bright at the zenith as at the horizon.
    Overcast,
    /// CIE general sky, type 1.
    CieType1,
}

impl Sky {
    /// Luminance at this sine of the elevation, in `[0, 1]`, relative to the zenith. Exact.
    pub fn luminance(self, sine: f64) -> f64 {
        let gradation = |sine: f64| 1.0 + 4.0 * (-0.7 / sine).exp();
        match self {
            Sky::Uniform => 1.0,
            Sky::Overcast => (1.0 + 2.0 * sine) / 3.0,
            Sky::CieType1 => gradation(sine) / gradation(1.0),
        }
    }

    /// Illuminance of a horizontal plane under the whole sky for a zenith luminance of 1. Exact; type 1 by quadrature, 1e-13.
    pub fn horizontal_illuminance(self) -> f64 {
        match self {
            Sky::Uniform => PI,
            Sky::Overcast => 7.0 * PI / 9.0,
            Sky::CieType1 => 2.0 * PI * Gauss::new(40).composite(0.0, 1.0, 8, |s| s * self.luminance(s)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    const ALL: [Sky; 3] = [Sky::Uniform, Sky::Overcast, Sky::CieType1];

    #[test]
    fn zenith_horizon_and_norm() {
        for (sky, horizon) in ALL.into_iter().zip([1.0, 1.0 / 3.0, 1.0 / (1.0 + 4.0 * (-0.7f64).exp())]) {
            assert!((sky.luminance(1.0) - 1.0).abs() < 1e-15 && (sky.luminance(0.0) - horizon).abs() < 1e-15);
            let rule = Gauss::new(32);
            let brute = 2.0 * PI * rule.composite(0.0, 1.0, 16, |s| s * sky.luminance(s));
            assert!((sky.horizontal_illuminance() / brute - 1.0).abs() < 1e-12, "{sky:?}");
        }
        // E3 by its integral over t from 1 on: 2 pi int s exp(-0.7/s) ds = 2 pi E3(0.7).
        let e3 = Gauss::new(32).composite(1.0, 60.0, 60, |t: f64| (-0.7 * t).exp() / (t * t * t));
        let exact = PI * (1.0 + 8.0 * e3) / (1.0 + 4.0 * (-0.7f64).exp());
        assert!((Sky::CieType1.horizontal_illuminance() / exact - 1.0).abs() < 1e-12);
    }

    /// Directions drawn by their cosine: 2 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_directions_agree() {
        let mut random = Random::new(71);
        for sky in &ALL[1..] {
            let mut mean = Moments::default();
            for _ in 0..100_000 {
                mean.add(PI * sky.luminance(random.cosine_around([0.0, 0.0, 1.0])[2]));
            }
            mean.must_agree("horizontal illuminance", sky.horizontal_illuminance());
        }
    }
}
