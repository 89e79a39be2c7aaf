//! Skies whose luminance follows a law.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

/// Luminance of the upper half of all directions, relative to that at the zenith; below the horizon there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Unit vector upwards.
    pub zenith: DVec3,
    /// The law.
    pub law: SkyLaw,
}

/// Laws of luminance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SkyLaw {
    /// The same everywhere.
    Uniform,
    /// (1 + 2 sin height) / 3: the traditional overcast sky (Moon and Spencer 1942; CIE S 011 type 16).
    Overcast,
    /// One of the fifteen skies of CIE S 011 / ISO 15469.
    General {
        /// 1 (overcast, steep) to 15 (white-blue turbid).
        kind: u8,
        /// Unit vector to the sun, above the horizon.
        sun: DVec3,
    },
}

/// Parameters a to e of the fifteen general skies (CIE S 011 / ISO 15469:2004, table 1).
const GENERAL: [[f64; 5]; 15] = [
    [4.0, -0.7, 0.0, -1.0, 0.0],
    [4.0, -0.7, 2.0, -1.5, 0.15],
    [1.1, -0.8, 0.0, -1.0, 0.0],
    [1.1, -0.8, 2.0, -1.5, 0.15],
    [0.0, -1.0, 0.0, -1.0, 0.0],
    [0.0, -1.0, 2.0, -1.5, 0.15],
    [0.0, -1.0, 5.0, -2.5, 0.3],
    [0.0, -1.0, 10.0, -3.0, 0.45],
    [-1.0, -0.55, 2.0, -1.5, 0.15],
    [-1.0, -0.55, 5.0, -2.5, 0.3],
    [-1.0, -0.55, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 16.0, -3.0, 0.3],
    [-1.0, -0.15, 16.0, -3.0, 0.3],
    [-1.0, -0.15, 24.0, -2.8, 0.15],
];

impl Sky {
    /// Luminance in a unit direction over that at the zenith.
    pub fn relative_luminance(&self, direction: DVec3) -> f64 {
        let up = direction.dot(self.zenith);
        if up <= 0.0 {
            return 0.0;
        }
        match self.law {
            SkyLaw::Uniform => 1.0,
            SkyLaw::Overcast => (1.0 + 2.0 * up) / 3.0,
            SkyLaw::General { kind, sun } => {
                let [a, b, c, d, e] = GENERAL[usize::from(kind.clamp(1, 15)) - 1];
                let gradation = |up: f64| 1.0 + a * (b / up).exp();
                let scattering =
                    |angle: f64| 1.0 + c * ((d * angle).exp() - (d * FRAC_PI_2).exp()) + e * angle.cos().powi(2);
                let angle = |from: DVec3| from.dot(sun).clamp(-1.0, 1.0).acos();
                scattering(angle(direction)) * gradation(up) / (scattering(angle(self.zenith)) * gradation(1.0))
            }
        }
    }

    /// Irradiance of an unobstructed horizontal surface over the zenith's luminance, sr: by the midpoint rule in squared
    /// sine of height and azimuth, to better than 1e-4.
    pub fn horizontal_irradiance(&self) -> f64 {
        self.mean(|_, ring| ((ring + 0.5) / RINGS as f64).sqrt()) * PI
    }

    /// Integral of the relative luminance over the upper half, sr, by the midpoint rule in sine of height and azimuth.
    pub fn integral(&self) -> f64 {
        self.mean(|_, ring| (ring + 0.5) / RINGS as f64) * 2.0 * PI
    }

    /// Mean luminance over rings at the heights whose sines are given and over azimuth.
    fn mean(&self, sine: impl Fn(&Self, f64) -> f64) -> f64 {
        let (tangent, bitangent) = self.zenith.any_orthonormal_pair();
        let mut sum = 0.0;
        for ring in 0..RINGS {
            let up = sine(self, ring as f64);
            let along = (1.0 - up * up).sqrt();
            for turn in 0..TURNS {
                let (sin, cos) = (2.0 * PI * (turn as f64 + 0.5) / TURNS as f64).sin_cos();
                sum += self.relative_luminance(along * (cos * tangent + sin * bitangent) + up * self.zenith);
            }
        }
        sum / (RINGS * TURNS) as f64
    }
}

const RINGS: usize = 1024;
const TURNS: usize = 720;

#[cfg(test)]
mod tests {
    use super::*;

    fn sky(law: SkyLaw) -> Sky {
        Sky { zenith: DVec3::Z, law }
    }

    #[test]
    fn laws_with_known_integrals() {
        // Overcast: horizontal irradiance 7 pi / 9, integral 4 pi / 3 of the zenith's luminance.
        assert!((sky(SkyLaw::Uniform).horizontal_irradiance() - PI).abs() < 1e-9);
        assert!((sky(SkyLaw::Overcast).horizontal_irradiance() / (7.0 * PI / 9.0) - 1.0).abs() < 1e-5);
        assert!((sky(SkyLaw::Overcast).integral() / (4.0 * PI / 3.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn general_skies_are_one_at_the_zenith_and_brightest_at_the_sun() {
        let sun = DVec3::new(0.6, 0.0, 0.8);
        for kind in 1..=15 {
            let sky = sky(SkyLaw::General { kind, sun });
            assert!((sky.relative_luminance(DVec3::Z) - 1.0).abs() < 1e-12);
            assert_eq!(sky.relative_luminance(DVec3::NEG_Z), 0.0);
            let mirrored = DVec3::new(-0.6, 0.0, 0.8);
            let (near, far) = (sky.relative_luminance(sun), sky.relative_luminance(mirrored));
            assert!(if GENERAL[kind as usize - 1][2] > 0.0 { near > far } else { (near - far).abs() < 1e-12 });
        }
    }
}
