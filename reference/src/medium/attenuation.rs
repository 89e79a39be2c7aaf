//! Light that an absorbing medium lets through.
//!
//! The share `exp(-sigma d)` of the light crosses the distance `d` (Beer and Lambert; catalogue entry F1). Exact.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft, Reads};
use crate::lamps::point::PointLamp;
use crate::mitsuba::{self, Medium, Place};
use crate::out_of_range::{OutOfRange, require_positive};

/// A medium that absorbs and does not scatter, and an isotropic lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Absorber {
    coefficient: f64,
    flux: f64,
}

impl Absorber {
    /// A medium with this extinction `coefficient` (1/m) and a lamp of `flux` (W or lm).
    pub fn new(coefficient: f64, flux: f64) -> Result<Self, OutOfRange> {
        require_positive("coefficient", coefficient)?;
        require_positive("flux", flux)?;
        Ok(Absorber { coefficient, flux })
    }

    /// Share of the light that crosses this distance (m).
    pub fn transmittance(&self, distance: f64) -> f64 {
        (-self.coefficient * distance).exp()
    }

    /// Irradiance of the inside of a sphere of this radius (m) around the lamp, the medium filling a concentric ball of the
    /// `depth` (m), in W/m^2 or lx.
    pub fn sphere_irradiance(&self, depth: f64, radius: f64) -> f64 {
        self.flux * self.transmittance(depth) / (4.0 * PI * radius * radius)
    }

    /// Irradiance of a plane `height` (m) below the lamp at `x` (m) from the point under it, with a layer of the medium
    /// `thickness` (m) between: the layer is crossed on the slant.
    pub fn plane_irradiance(&self, height: f64, thickness: f64, x: f64) -> Result<f64, OutOfRange> {
        let slant = thickness * height.hypot(x) / height;
        Ok(PointLamp::new(self.flux, height, None)?.irradiance(x) * self.transmittance(slant))
    }

    fn medium(&self) -> Medium {
        Medium { extinction: self.coefficient, albedo: 0.0, asymmetry: 0.0 }
    }

    /// The lamp in a ball of the medium of this optical depth, inside a sphere twice as large that reads its irradiance.
    fn ball_case(&self, optical_depth: f64) -> Case {
        let depth = optical_depth / self.coefficient;
        let ball = mitsuba::fog_ball([0.0; 3], depth, self.medium());
        let mut draft = Draft::with(ball + &mitsuba::point_lamp_in_fog([0.0; 3], &[self.flux / (4.0 * PI)]));
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::irradiance_meter("shell");
        draft.add(&mitsuba::sphere("wall", [0.0; 3], 2.0 * depth, true, &on_it));
        let value = self.sphere_irradiance(depth, 2.0 * depth);
        draft.expect("shell", Reads::Irradiance, &[value], 1e-12 * value);
        draft.case(format!("ball of optical depth {optical_depth}"))
    }

    /// A lamp 2 m above square meters, and between them a layer of this optical depth, 20 m wide.
    fn layer_case(&self, optical_depth: f64, distances: &[f64]) -> Result<Case, OutOfRange> {
        let (height, thickness) = (2.0, optical_depth / self.coefficient);
        let layer = mitsuba::fog_block([0.0, 0.0, 0.1 + 0.5 * thickness], [10.0, 10.0, 0.5 * thickness], self.medium());
        let lamp = mitsuba::point_lamp([0.0, 0.0, height], &[self.flux / (4.0 * PI)]);
        let mut draft = Draft::with(layer + &lamp);
        self.plane_irradiance(height, thickness, 0.0)?;
        for &x in distances {
            draft.square(Place::floor([x, 0.0, 0.0], [0.05; 2]), 1e-9 * self.flux, |p| {
                self.plane_irradiance(height, thickness, p[0].hypot(p[1])).expect("checked above")
            });
        }
        Ok(draft.case(format!("layer of optical depth {optical_depth}")))
    }
}

/// The catalogue's F1: 2.5 per metre, 100 W.
pub fn cases() -> Vec<Case> {
    let absorber = Absorber { coefficient: 2.5, flux: 100.0 };
    let balls = [0.1, 0.5, 1.0, 2.0, 5.0, 10.0].map(|depth| absorber.ball_case(depth)).into_iter();
    balls.chain([0.5, 2.0].into_iter().flat_map(|depth| absorber.layer_case(depth, &[0.0, 1.0, 2.0, 4.0]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    const ABSORBER: Absorber = Absorber { coefficient: 2.5, flux: 100.0 };

    #[test]
    fn catalogue_values() {
        for (depth, want) in [(0.1, 0.90483742), (1.0, 0.36787944), (5.0, 0.006737947), (10.0, 4.539993e-5)] {
            assert!((ABSORBER.transmittance(depth / 2.5) / want - 1.0).abs() < 1e-7);
        }
    }

    /// Photons with exponential free paths through the layer towards the plane: 1 comparison at 4.5 standard errors.
    #[test]
    fn photons_agree() {
        let (mut random, mut flux) = (Random::new(51), Moments::default());
        let radius = 1.5;
        for _ in 0..200_000 {
            let d = random.direction();
            let down = -d[2];
            let lands = down > 0.0 && 2.0 * d[0].hypot(d[1]) / down < radius && random.gap() / 2.5 > 0.4 / down;
            flux.add(if lands { 100.0 } else { 0.0 });
        }
        let at = |x: f64| ABSORBER.plane_irradiance(2.0, 0.4, x).expect("valid");
        let rule = crate::quadrature::Gauss::new(16);
        let exact = rule.composite(0.0, radius, 4, |x| 2.0 * PI * x * at(x));
        flux.must_agree("flux below the layer", exact);
        assert!(Absorber::new(-1.0, 1.0).is_err() && ABSORBER.plane_irradiance(0.0, 0.1, 0.0).is_err());
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        for case in cases() {
            mitsuba::assert_balanced(&case.xml);
            assert!(case.xml.contains("volpath") && case.xml.contains("name=\"sigma_t\" value=\"2.5\""));
        }
    }
}
