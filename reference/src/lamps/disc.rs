//! A Lambertian disc facing down.
//!
//! A horizontal element `h` below the disc's plane and `x` from its axis receives the share
//! `F = (1/2) [1 - (x^2 + h^2 - R^2) / s]`, `s^2 = (x^2 + h^2 + R^2)^2 - 4 R^2 x^2`, of the exitance; a vertical one that
//! faces the axis, with the whole disc in front of it (`x >= R`), `h/(2x) [(x^2 + h^2 + R^2) / s - 1]`. (Foote 1915;
//! Walsh, "Photometry"; Howell's catalogue B-12, B-13; catalogue entry C3.) Exact to rounding; far away the brackets
//! cancel, at 5 radii to 1e-13.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// A disc at height `height` around the z axis that radiates downwards, black itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscLamp {
    radius: f64,
    height: f64,
    exitance: f64,
}

impl DiscLamp {
    /// A disc of `radius` at `height` (m) with `exitance` in W/m^2 or lm/m^2.
    pub fn new(radius: f64, height: f64, exitance: f64) -> Result<Self, OutOfRange> {
        require_positive("radius", radius)?;
        require_positive("height", height)?;
        require_positive("exitance", exitance)?;
        Ok(DiscLamp { radius, height, exitance })
    }

    /// `(x^2 + h^2 - R^2, x^2 + h^2 + R^2, s)` at `x` metres from the axis and `h` below the disc.
    fn terms(&self, x: f64, h: f64) -> (f64, f64, f64) {
        let (r2, d2) = (self.radius * self.radius, x * x + h * h);
        let sum = d2 + r2;
        (d2 - r2, sum, (sum * sum - 4.0 * r2 * x * x).sqrt())
    }

    /// Irradiance of the floor z = 0 at `x` metres from the axis, in W/m^2 or lx.
    pub fn irradiance(&self, x: f64) -> f64 {
        let (difference, _, s) = self.terms(x, self.height);
        0.5 * self.exitance * (1.0 - difference / s)
    }

    /// Irradiance of a vertical element that faces the axis, at `x` metres from it and height `z` above the floor.
    pub fn irradiance_sideways(&self, x: f64, z: f64) -> Result<f64, OutOfRange> {
        require(x >= self.radius, "x", x, "at least the disc's radius")?;
        require(z < self.height, "z", z, "below the disc")?;
        let h = self.height - z;
        let (_, sum, s) = self.terms(x, h);
        Ok(0.5 * self.exitance * h / x * (sum / s - 1.0))
    }

    /// The disc over small square meters on the floor at these distances (m) from the axis.
    pub fn floor_case(&self, distances: &[f64]) -> Case {
        let mut draft = Draft::with(self.lamp_xml());
        for &x in distances {
            let place = Place::floor([x, 0.0, 0.0], [0.05 * self.height; 2]);
            draft.square(place, 1e-10 * self.exitance, |p| self.irradiance(p[0].hypot(p[1])));
        }
        draft.case("horizontal")
    }

    /// The disc and vertical square meters at these distances (m) from its axis, above the radius, spread around it so
    /// that none shades another. Off its middle line a meter does not quite face the axis; the irradiance is a vector
    /// wherever the whole disc is in front, so the cosine accounts for it exactly.
    pub fn vertical_case(&self, distances: &[f64]) -> Case {
        let mut draft = Draft::with(self.lamp_xml());
        for (i, &x) in distances.iter().enumerate() {
            let (sine, cosine) = (2.0 * PI * i as f64 / distances.len() as f64).sin_cos();
            let place = Place::facing([-cosine, -sine, 0.0], [x * cosine, x * sine, 0.0], 0.05 * self.height);
            draft.square(place, 1e-10 * self.exitance, |p| {
                let from_axis = p[0].hypot(p[1]);
                self.irradiance_sideways(from_axis, p[2]).expect("outside the disc's cylinder, below it") * x
                    / from_axis
            });
        }
        draft.case("vertical")
    }

    fn lamp_xml(&self) -> String {
        let place = Place::floor([0.0, 0.0, self.height], [self.radius; 2]).turned();
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.exitance / PI]);
        mitsuba::flat("disk", "lamp", place, &on_it)
    }
}

/// The catalogue's C3: radius and height 1 m, 1000 lm/m^2. Its vertical element at `x = R` is moved to 1.1 m, since a
/// meter across the edge of the disc's cylinder would see part of the disc from behind.
pub fn cases() -> Vec<Case> {
    let lamp = DiscLamp { radius: 1.0, height: 1.0, exitance: 1000.0 };
    vec![lamp.floor_case(&[0.0, 0.5, 1.0, 2.0, 5.0]), lamp.vertical_case(&[1.1, 2.0, 5.0])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    const LAMP: DiscLamp = DiscLamp { radius: 1.0, height: 1.0, exitance: 1.0 };

    #[test]
    fn catalogue_values() {
        for (x, want) in [(0.0, 0.5), (0.5, 0.43798263), (1.0, 0.2763932), (2.0, 0.052786405), (5.0, 0.0015923607)] {
            assert!((LAMP.irradiance(x) - want).abs() < 1e-8, "{x}");
        }
        for (x, want) in [(1.0, 0.17082039), (2.0, 0.085410197), (5.0, 0.0076560501)] {
            assert!((LAMP.irradiance_sideways(x, 0.0).expect("outside") - want).abs() < 1e-8, "{x}");
        }
        assert!(LAMP.irradiance_sideways(0.9, 0.0).is_err());
    }

    /// The definition on the disc's area, in polar coordinates; the integrand is periodic in the angle.
    #[test]
    fn closed_forms_are_the_integrals() {
        let (lamp, rule) = (DiscLamp::new(0.7, 1.3, 2.0).expect("valid"), Gauss::new(24));
        let integral = |x: f64, h: f64, cosines: &dyn Fn(f64) -> f64| {
            let ring = |rho: f64| {
                let at = |k: usize| {
                    let u = rho * (2.0 * PI * (k as f64 + 0.5) / 400.0).cos();
                    let d2 = x * x + rho * rho - 2.0 * x * u + h * h;
                    cosines(x - u) / (d2 * d2)
                };
                rho * 2.0 * PI / 400.0 * (0..400).map(at).sum::<f64>()
            };
            2.0 / PI * rule.integrate(0.0, 0.7, ring)
        };
        for x in [0.0, 0.4, 0.8, 2.5] {
            let brute = integral(x, 1.3, &|_| 1.3 * 1.3);
            assert!((lamp.irradiance(x) / brute - 1.0).abs() < 1e-11, "{x}");
            if x > 0.7 {
                let brute = integral(x, 1.0, &|across| 1.0 * across);
                let got = lamp.irradiance_sideways(x, 0.3).expect("outside");
                assert!((got / brute - 1.0).abs() < 1e-11, "{x}: {got} {brute}");
            }
        }
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        for case in cases() {
            mitsuba::assert_balanced(&case.xml);
            assert!(case.xml.contains("origin=\"0 0 1\" target=\"0 0 0\""), "{}", case.xml);
        }
    }
}
