//! A paraboloid mirror with an isotropic point lamp in its focus: a beam in closed form.
//!
//! The mirror `z = r^2 / (4 f) - f` around the focus sends the ray at the angle `theta` from its axis to the distance
//! `r = 2 f tan(theta / 2)` and along the axis. The beam's irradiance is `I / (f + r^2 / (4 f))^2`, the lamp's intensity
//! over the squared distance to the mirror, wherever the screen is; the flux within `r` is
//! `2 pi I (1 - cos theta)`. (Textbook; catalogue entry E3.) Exact to rounding.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft, Reads};
use crate::lamps::point::PointLamp;
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_positive};

/// A perfect mirror that opens towards +z, its focus and lamp in the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paraboloid {
    focal_length: f64,
    flux: f64,
}

impl Paraboloid {
    /// A mirror of `focal_length` (m) and a lamp of `flux` (W or lm).
    pub fn new(focal_length: f64, flux: f64) -> Result<Self, OutOfRange> {
        require_positive("focal_length", focal_length)?;
        require_positive("flux", flux)?;
        Ok(Paraboloid { focal_length, flux })
    }

    /// Irradiance by the reflected beam at `r` metres from the axis, inside the mirror's rim, in W/m^2 or lx.
    pub fn irradiance(&self, r: f64) -> f64 {
        let f = self.focal_length;
        self.flux / (4.0 * PI) / (f + r * r / (4.0 * f)).powi(2)
    }

    /// Flux of the reflected beam within `r` metres of the axis, in W or lm.
    pub fn flux_within(&self, r: f64) -> f64 {
        let theta = 2.0 * (0.5 * r / self.focal_length).atan();
        0.5 * self.flux * (1.0 - theta.cos())
    }

    /// Lamp and mirror of this rim radius (m).
    fn start(&self, rim: f64) -> Draft {
        let mirror = mitsuba::paraboloid("mirror", [0.0, 0.0, -self.focal_length], self.focal_length, rim);
        Draft::with(mitsuba::point_lamp([0.0; 3], &[self.flux / (4.0 * PI)]) + &mirror)
    }

    /// Meters of 0.2 by 0.5 m at these distances (m) from the axis on a screen `height` (m) above the focus: beam and direct light.
    pub fn irradiance_case(&self, rim: f64, height: f64, distances: &[f64]) -> Result<Case, OutOfRange> {
        let (mut draft, lamp) = (self.start(rim), PointLamp::new(self.flux, height, None)?);
        for &x in distances {
            let place = Place::floor([x, 0.0, height], [0.1, 0.25]).turned();
            draft.square(place, 1e-9 * self.irradiance(0.0), |p| {
                let r = p[0].hypot(p[1]);
                self.irradiance(r) + lamp.irradiance(r)
            });
        }
        Ok(draft.case(format!("irradiance at {height} m")))
    }

    /// A disc of this radius (m, below the rim) on such a screen: flux of beam and direct light.
    pub fn flux_case(&self, rim: f64, height: f64, radius: f64) -> Result<Case, OutOfRange> {
        let (mut draft, lamp) = (self.start(rim), PointLamp::new(self.flux, height, None)?);
        let flux = self.flux_within(radius) + lamp.flux_within(radius);
        let place = Place::floor([0.0, 0.0, height], [radius; 2]).turned();
        draft.receiver(Reads::Flux, "disk", place, flux, 1e-9 * self.flux);
        Ok(draft.case(format!("flux within {radius} m at {height} m")))
    }
}

/// The catalogue's E3: focal length 0.5 m, 100 lm, with a rim of 1.2 m; the same beam near and far.
pub fn cases() -> Vec<Case> {
    let mirror = Paraboloid { focal_length: 0.5, flux: 100.0 };
    let places = [1.0, 3.0].into_iter();
    let irradiance = places.map(|height| mirror.irradiance_case(1.2, height, &[0.0, 0.2, 0.5, 0.8, 1.0]));
    let flux = [0.2, 0.5, 1.0].into_iter().map(|radius| mirror.flux_case(1.2, 1.0, radius));
    irradiance.chain(flux).flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::random::{Moments, Random};
    use crate::vector::{along, dot, unit};

    const MIRROR: Paraboloid = Paraboloid { focal_length: 0.5, flux: 100.0 };

    #[test]
    fn catalogue_values() {
        for (r, want) in [(0.0, 31.830989), (0.2, 29.429538), (0.5, 20.371833), (0.8, 11.834841), (1.0, 7.9577472)] {
            assert!((MIRROR.irradiance(r) / want - 1.0).abs() < 1e-7, "{r}");
        }
        for (r, want) in [(0.2, 3.8461538), (0.5, 20.0), (1.0, 50.0)] {
            assert!((MIRROR.flux_within(r) / want - 1.0).abs() < 1e-7, "{r}");
        }
    }

    #[test]
    fn the_flux_is_the_integral_of_the_irradiance() {
        let integral = Gauss::new(16).composite(0.0, 0.9, 9, |r| 2.0 * PI * r * MIRROR.irradiance(r));
        assert!((integral / MIRROR.flux_within(0.9) - 1.0).abs() < 1e-12);
    }

    /// Rays from the focus, met and reflected by the law of reflection, land on a screen 2 m up: 3 comparisons at 4.5
    /// standard errors.
    #[test]
    fn traced_rays_agree() {
        let (mut random, f, cuts) = (Random::new(31), 0.5, [0.2, 0.5, 1.0]);
        let mut within: [Moments; 3] = Default::default();
        for _ in 0..100_000 {
            let d = random.direction();
            // z = r^2 / (4 f) - f along t d.
            let (a, b) = ((d[0] * d[0] + d[1] * d[1]) / (4.0 * f), d[2]);
            let t = (b + (b * b + 4.0 * a * f).sqrt()) / (2.0 * a);
            let p = d.map(|x| t * x);
            let n = unit([-p[0] / (2.0 * f), -p[1] / (2.0 * f), 1.0]);
            let out = along(d, -2.0 * dot(d, n), n);
            let s = (2.0 - p[2]) / out[2];
            let r = (p[0] + s * out[0]).hypot(p[1] + s * out[1]);
            cuts.iter().zip(&mut within).for_each(|(&cut, m)| m.add(if r < cut { 100.0 } else { 0.0 }));
        }
        for (cut, moments) in cuts.into_iter().zip(&within) {
            moments.must_agree("flux in the beam", MIRROR.flux_within(cut));
        }
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        let case = MIRROR.flux_case(1.2, 1.0, 0.5).expect("valid");
        mitsuba::assert_balanced(&case.xml);
        assert!(case.xml.contains("name=\"focal_length\" value=\"0.5\""), "{}", case.xml);
        assert!(case.expected[0].value[0] > 20.0);
        assert!(Paraboloid::new(0.0, 1.0).is_err());
    }
}
