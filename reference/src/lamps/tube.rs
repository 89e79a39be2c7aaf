//! Line sources, and the Lambertian tube that is one in the limit.
//!
//! A line that sends `I'` per metre (W/(sr m) or cd/m) lights an element at distance `h` that faces it. Isotropic:
//! `2 l I' / (h sqrt(h^2 + l^2))` for the half-length `l`, `2 I' / h` without end. With the cosine of the angle from the
//! line's normal, as a thin Lambertian tube: `(I' / h) [atan(l/h) + h l / (h^2 + l^2)]`, without end `pi I' / (2 h)`.
//! (Elementary integrals; catalogue entry C5.) Exact to rounding.
//!
//! An endless tube of any radius `a` and exitance `M` sends `M a / h` to an element that faces its axis from the distance
//! `h` (crossed strings), just as the line with `I' = 2 a M / pi` does.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// How a line source's intensity depends on direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineLaw {
    /// The same in all directions.
    Isotropic,
    /// The cosine of the angle from the plane perpendicular to the line: a thin Lambertian tube.
    Cosine,
}

/// Irradiance of an element that faces the middle of a line source from the distance `h` (m), per unit of its intensity
/// per metre; `half_length` (m) may be infinite.
pub fn line_irradiance(law: LineLaw, h: f64, half_length: f64) -> f64 {
    let sine = if half_length.is_infinite() { 1.0 } else { half_length / h.hypot(half_length) };
    match law {
        LineLaw::Isotropic => 2.0 * sine / h,
        LineLaw::Cosine => (sine.asin() + sine * (1.0 - sine * sine).sqrt()) / h,
    }
}

/// An endless Lambertian cylinder along the y axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    radius: f64,
    exitance: f64,
}

impl Tube {
    /// A tube of `radius` (m) with `exitance` in W/m^2 or lm/m^2.
    pub fn new(radius: f64, exitance: f64) -> Result<Self, OutOfRange> {
        require_positive("radius", radius)?;
        require_positive("exitance", exitance)?;
        Ok(Tube { radius, exitance })
    }

    /// Irradiance of an element that faces the axis from the distance `h` (m), in W/m^2 or lx.
    pub fn irradiance(&self, h: f64) -> f64 {
        self.exitance * self.radius / h
    }

    /// The most that a tube of this half-length (m) lacks of [`Tube::irradiance`] opposite its middle: beyond it a metre of
    /// tube shows at most `2 a`, seen and seeing under cosines of at most `h / r`.
    pub fn truncation(&self, h: f64, half_length: f64) -> f64 {
        4.0 * self.exitance * self.radius * h * h / (3.0 * PI * half_length.powi(3))
    }

    /// The tube, 100 m to either side, and square meters that face it from these distances (m) in different directions.
    pub fn case(&self, distances: &[f64]) -> Result<Case, OutOfRange> {
        let half_length = 100.0;
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.exitance / PI]);
        let ends = [[0.0, -half_length, 0.0], [0.0, half_length, 0.0]];
        let mut draft = Draft::with(mitsuba::cylinder("lamp", ends, self.radius, &on_it));
        for (i, &h) in distances.iter().enumerate() {
            require(h > self.radius, "distance", h, "above the radius")?;
            let (sine, cosine) = (2.0 * PI * i as f64 / distances.len() as f64).sin_cos();
            let place = Place::facing([-cosine, 0.0, -sine], [h * cosine, 0.0, h * sine], 0.05 * h);
            let uncertainty = self.truncation(h, half_length - 0.05 * h) + 1e-12 * self.exitance;
            draft.square(place, uncertainty, |p| {
                let distance = p[0].hypot(p[2]);
                self.irradiance(distance) * h / distance
            });
        }
        Ok(draft.case(format!("tube of radius {} m", self.radius)))
    }
}

/// The catalogue's C5 lines as tubes of 1 cd/m: a thin one and a thick one, which gives the same.
pub fn cases() -> Vec<Case> {
    let tube = |radius: f64| Tube { radius, exitance: 0.5 * PI / radius }.case(&[0.5, 1.0, 2.0]);
    [0.01, 0.2].into_iter().flat_map(tube).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};

    use super::*;
    use crate::lamps::strip::StripLamp;
    use crate::quadrature::Gauss;

    #[test]
    fn catalogue_values() {
        let endless = f64::INFINITY;
        for (h, l, isotropic, cosine) in [
            (0.5, endless, 4.0, PI),
            (1.0, endless, 2.0, FRAC_PI_2),
            (2.0, endless, 1.0, FRAC_PI_4),
            (1.0, 0.5, 0.89442719, 0.86364761),
            (1.0, 1.0, SQRT_2, 1.2853982),
            (1.0, 5.0, 1.9611614, 1.5657085),
        ] {
            assert!((line_irradiance(LineLaw::Isotropic, h, l) / isotropic - 1.0).abs() < 1e-7);
            assert!((line_irradiance(LineLaw::Cosine, h, l) / cosine - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn lines_are_their_integrals() {
        let (h, l) = (0.7, 2.3);
        for (law, power) in [(LineLaw::Isotropic, 1.5), (LineLaw::Cosine, 2.0)] {
            let factor = if law == LineLaw::Cosine { h } else { 1.0 };
            let brute = Gauss::new(16).composite(-l, l, 20, |y: f64| h * factor / (h * h + y * y).powf(power));
            assert!((line_irradiance(law, h, l) / brute - 1.0).abs() < 1e-12);
        }
    }

    /// The tube as narrow strips: along a direction `b` from the vertical it is seen or not, so that a strip between its
    /// tangents, of the same radiance, gives the same; and as a line of `I' = 2 a M / pi`.
    #[test]
    fn a_tube_is_the_strip_between_its_tangents_and_a_line() {
        let (tube, h) = (Tube::new(0.4, 3.0).expect("valid"), 1.3);
        let half_width = h * (0.4f64 / h).asin().tan();
        let strip = StripLamp::new([-half_width, half_width], h, 3.0).expect("valid");
        assert!((tube.irradiance(h) / strip.irradiance(0.0) - 1.0).abs() < 1e-12);
        let line = 0.8 * 3.0 / PI * line_irradiance(LineLaw::Cosine, h, f64::INFINITY);
        assert!((tube.irradiance(h) / line - 1.0).abs() < 1e-12);
        let cut = 0.8 * 3.0 / PI * line_irradiance(LineLaw::Cosine, h, 30.0);
        let (lost, bound) = (line - cut, tube.truncation(h, 30.0));
        assert!(lost < bound && lost > 0.9 * bound, "{lost} {bound}");
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        assert_eq!(cases().len(), 2);
        for case in cases() {
            mitsuba::assert_balanced(&case.xml);
            assert!((case.expected[1].value[0] - 0.5 * PI).abs() < 2e-3, "{:?}", case.expected);
        }
        assert!(Tube::new(0.4, 3.0).expect("valid").case(&[0.3]).is_err());
    }
}
