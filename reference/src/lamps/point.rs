//! A point lamp over a plane: isotropic, or a `cos^n` lobe straight down.
//!
//! With intensity `I(theta)` a horizontal element at lateral distance `x`, `h` below the lamp, receives
//! `I(theta) h / (h^2 + x^2)^(3/2)` (inverse square and cosine). An isotropic lamp has `I = Phi / (4 pi)`, a lobe
//! `I = Phi (n + 1) / (2 pi) cos^n theta`. Inside a cone of half-angle `theta` are the shares `(1 - cos theta) / 2` and
//! `1 - cos^(n+1) theta` of the flux. (Textbook; catalogue entry C1.) Exact to rounding, 1e-14.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// A point lamp above the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLamp {
    flux: f64,
    height: f64,
    exponent: Option<f64>,
}

impl PointLamp {
    /// A lamp of `flux` (W or lm) at `height` (m). With an `exponent` `n >= 0` it sends `cos^n` into the lower
    /// hemisphere, without one the same into every direction.
    pub fn new(flux: f64, height: f64, exponent: Option<f64>) -> Result<Self, OutOfRange> {
        require_positive("flux", flux)?;
        require_positive("height", height)?;
        exponent.map_or(Ok(()), |n| require(n >= 0.0 && n.is_finite(), "exponent", n, "finite and at least 0"))?;
        Ok(PointLamp { flux, height, exponent })
    }

    /// Intensity straight down, in W/sr or cd.
    pub fn intensity(&self) -> f64 {
        match self.exponent {
            None => self.flux / (4.0 * PI),
            Some(n) => self.flux * (n + 1.0) / (2.0 * PI),
        }
    }

    /// Irradiance of the plane z = 0 at distance `x` (m) from the point below the lamp, in W/m^2 or lx.
    pub fn irradiance(&self, x: f64) -> f64 {
        let r2 = self.height * self.height + x * x;
        let cosine = self.height / r2.sqrt();
        self.intensity() * cosine.powf(self.exponent.unwrap_or(0.0)) * cosine / r2
    }

    /// Flux on the plane within `radius` (m) of the point below the lamp, in W or lm.
    pub fn flux_within(&self, radius: f64) -> f64 {
        let cosine = self.height / self.height.hypot(radius);
        match self.exponent {
            None => 0.5 * self.flux * (1.0 - cosine),
            Some(n) => self.flux * (1.0 - cosine.powf(n + 1.0)),
        }
    }

    fn lamp_xml(&self) -> String {
        let position = [0.0, 0.0, self.height];
        match self.exponent {
            None => mitsuba::point_lamp(position, &[self.intensity()]),
            Some(n) => mitsuba::lobe_lamp(position, [0.0, 0.0, -1.0], n, &[self.intensity()]),
        }
    }

    /// The lamp over square meters of half-edge 0.05 m whose centres have these distances (m) from the point below it.
    pub fn irradiance_case(&self, distances: &[f64]) -> Case {
        let mut draft = Draft::with(self.lamp_xml());
        for &x in distances {
            let place = Place::floor([x, 0.0, 0.0], [0.05; 2]);
            draft.square(place, 1e-12 * self.flux, |p| self.irradiance(p[0].hypot(p[1])));
        }
        draft.case(format!("{}: irradiance", self.name()))
    }

    /// The lamp over horizontal discs in its cones with these radii (m) on the plane, ascending: each disc lies 0.1 m
    /// above the next larger one and shades it, so that each meter reads the flux between two cones.
    pub fn flux_case(&self, radii: &[f64]) -> Case {
        let mut draft = Draft::with(self.lamp_xml());
        let mut inside = 0.0;
        for (i, &radius) in radii.iter().enumerate() {
            let z = 0.1 * (radii.len() - 1 - i) as f64;
            let half = radius * (1.0 - z / self.height);
            let place = Place::floor([0.0, 0.0, z], [half; 2]);
            let flux = self.flux_within(radius);
            draft.receiver(Reads::Flux, "disk", place, flux - inside, 1e-12 * self.flux);
            inside = flux;
        }
        draft.case(format!("{}: flux in rings", self.name()))
    }

    fn name(&self) -> String {
        self.exponent.map_or("isotropic".to_string(), |n| format!("cos^{n}"))
    }
}

/// The catalogue's C1: 1000 lm, 2 m above the plane, isotropic and five lobes.
pub fn cases() -> Vec<Case> {
    let exponents = [None, Some(0.0), Some(1.0), Some(2.0), Some(5.0), Some(20.0)];
    let lamps = exponents.map(|exponent| PointLamp { flux: 1000.0, height: 2.0, exponent });
    let both =
        |lamp: &PointLamp| [lamp.irradiance_case(&[0.0, 0.5, 1.0, 2.0, 4.0]), lamp.flux_case(&[0.5, 1.0, 2.0, 4.0])];
    lamps.iter().flat_map(both).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::random::{Moments, Random};

    fn lamp(exponent: Option<f64>) -> PointLamp {
        PointLamp::new(1000.0, 2.0, exponent).expect("valid")
    }

    /// Rows of the catalogue: exponent, axial intensity, irradiance at 0.5 and 4 m, flux within 1 m.
    #[test]
    fn catalogue_values() {
        for (exponent, intensity, half, four, flux) in [
            (None, 79.577472, 18.165056, 1.7794064, 52.786405),
            (Some(0.0), 159.15494, 36.330112, 3.5588127, 105.57281),
            (Some(1.0), 318.30989, 70.490771, 3.1830989, 200.0),
            (Some(2.0), 477.46483, 102.57914, 2.1352876, 284.45825),
            (Some(5.0), 954.92966, 187.32495, 0.38197186, 488.0),
            (Some(20.0), 3342.2538, 416.09897, 7.6528709e-6, 903.96161),
        ] {
            let l = lamp(exponent);
            for (got, want) in [
                (l.intensity(), intensity),
                (l.irradiance(0.5), half),
                (l.irradiance(4.0), four),
                (l.flux_within(1.0), flux),
            ] {
                assert!((got / want - 1.0).abs() < 1e-7, "{exponent:?}: {got} {want}");
            }
        }
    }

    /// The flux within a radius is the integral of the irradiance.
    #[test]
    fn flux_is_the_integral_of_irradiance() {
        for exponent in [None, Some(0.0), Some(3.5), Some(20.0)] {
            let l = lamp(exponent);
            let integral = Gauss::new(16).composite(0.0, 3.0, 30, |x| 2.0 * PI * x * l.irradiance(x));
            assert!((integral / l.flux_within(3.0) - 1.0).abs() < 1e-12, "{exponent:?}");
        }
    }

    /// Directions drawn by the normal of a sphere touching the lamp: cosine-distributed, weighted to the lobe. Six
    /// comparisons at 4.5 standard errors.
    #[test]
    fn thrown_light_lands_where_the_law_says() {
        let mut random = Random::new(11);
        let exponents = [None, Some(0.0), Some(1.0), Some(2.0), Some(5.0), Some(20.0)];
        let mut within: [Moments; 6] = Default::default();
        for _ in 0..200_000 {
            let d = random.direction();
            for (exponent, moments) in exponents.iter().zip(&mut within) {
                let down = -d[2];
                let weight = exponent.map_or(1.0, |n| if down > 0.0 { 2.0 * (n + 1.0) * down.powf(n) } else { 0.0 });
                let lands = down > 0.0 && 2.0 * d[0].hypot(d[1]) / down < 1.0;
                moments.add(if lands { 1000.0 * weight } else { 0.0 });
            }
        }
        for (exponent, moments) in exponents.into_iter().zip(&within) {
            moments.must_agree("flux within 1 m", lamp(exponent).flux_within(1.0));
        }
    }

    #[test]
    fn the_scene_carries_the_parameters() {
        let case = lamp(Some(5.0)).flux_case(&[1.0, 2.0]);
        mitsuba::assert_balanced(&case.xml);
        assert!(case.xml.contains("name=\"exponent\" value=\"5\"") && case.xml.contains("954.929"), "{}", case.xml);
        assert!((case.expected[1].value[0] - (875.0 - 488.0)).abs() < 1e-9);
        assert!(PointLamp::new(1.0, 1.0, Some(-1.0)).is_err());
    }
}
