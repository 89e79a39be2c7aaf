//! The integrating sphere: a diffuse sphere with a lamp inside.
//!
//! Between two elements of a sphere both cosines equal `d / (2 R)`, `d` their distance, so that the share of diffusely
//! reflected flux from one to the other is `dA / (4 pi R^2)` wherever they are. The first reflection is therefore
//! uniform over the wall for any lamp, and so is every later one: bounce `n` brings `Phi rho^n / (4 pi R^2)`. (Textbook:
//! Walsh, "Photometry", 1926; catalogue entry D1.) Exact.
//!
//! A ball of radius `r` around a point of the sphere cuts out exactly the area `pi r^2` (Archimedes), so a gather by
//! search ball has no bias here at all: any deviation comes from transport or normalisation.

use std::f64::consts::PI;

use photonlab_photometry::Colour;

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba;
use crate::out_of_range::{OutOfRange, require, require_albedo, require_positive};

/// A diffuse sphere around the origin with an isotropic point lamp inside, in `C` channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntegratingSphere<const C: usize> {
    radius: f64,
    source: [f64; 3],
    flux: Colour<C>,
    reflectance: Colour<C>,
}

impl<const C: usize> IntegratingSphere<C> {
    /// A sphere of `radius` (m) whose lamp at `source` (m, strictly inside) sends out `flux` (W or lm); the wall's
    /// `reflectance` is in `[0, 1)` in every channel.
    pub fn new(radius: f64, source: [f64; 3], flux: Colour<C>, reflectance: Colour<C>) -> Result<Self, OutOfRange> {
        require_positive("radius", radius)?;
        let off_centre = length(source);
        require(off_centre < radius, "distance of the source", off_centre, "below the radius")?;
        flux.0.into_iter().try_for_each(|x| require_positive("flux", x))?;
        reflectance.0.into_iter().try_for_each(|x| require_albedo("reflectance", x))?;
        Ok(IntegratingSphere { radius, source, flux, reflectance })
    }

    /// Irradiance straight from the lamp at a point of the wall: `Phi / (4 pi) cos / d^2`, in W/m^2 or lx.
    ///
    /// `towards` is any vector from the centre to that point; its length does not matter.
    pub fn direct(&self, towards: [f64; 3]) -> Colour<C> {
        let normal = towards.map(|x| x / length(towards));
        let to_wall = [0, 1, 2].map(|i| normal[i] * self.radius - self.source[i]);
        let cosine_times_d: f64 = (0..3).map(|i| to_wall[i] * normal[i]).sum();
        self.flux * (cosine_times_d / (4.0 * PI * length(to_wall).powi(3)))
    }

    /// Mean of the direct irradiance over the wall, for any lamp inside: `Phi / (4 pi R^2)`.
    pub fn mean_direct(&self) -> Colour<C> {
        self.flux * (1.0 / (4.0 * PI * self.radius * self.radius))
    }

    /// Irradiance by light reflected exactly `n` times: `Phi rho^n / (4 pi R^2)`, uniform for `n >= 1`; for `n = 0` the
    /// mean of the direct part.
    pub fn bounce(&self, n: u32) -> Colour<C> {
        self.mean_direct() * self.reflectance.map(|rho| rho.powi(n as i32))
    }

    /// Irradiance by light reflected at least once: `Phi rho / (4 pi R^2 (1 - rho))`, uniform.
    pub fn indirect(&self) -> Colour<C> {
        self.mean_direct() * self.reflectance.map(|rho| rho / (1.0 - rho))
    }

    /// Irradiance by light reflected once to `n` times, what a bounce limit leaves: `indirect (1 - rho^n)`.
    pub fn indirect_up_to(&self, n: u32) -> Colour<C> {
        self.indirect() * self.reflectance.map(|rho| 1.0 - rho.powi(n as i32))
    }

    /// Total irradiance at a point of the wall, `towards` as in [`IntegratingSphere::direct`].
    pub fn irradiance(&self, towards: [f64; 3]) -> Colour<C> {
        self.direct(towards) + self.indirect()
    }

    /// Mean total irradiance over the wall: `Phi / (4 pi R^2 (1 - rho))`.
    pub fn mean_irradiance(&self) -> Colour<C> {
        self.mean_direct() + self.indirect()
    }

    /// Radiance of the wall by reflected light at a point, `rho E / pi`.
    pub fn radiance(&self, towards: [f64; 3]) -> Colour<C> {
        self.irradiance(towards) * self.reflectance * (1.0 / PI)
    }

    /// The scene as Mitsuba 3 XML, with an irradiance meter (`wall-irradiance`) that averages over the whole wall.
    pub fn xml(&self) -> String {
        let intensity = self.flux * (1.0 / (4.0 * PI));
        let wall = mitsuba::diffuse(&self.reflectance.0) + &mitsuba::irradiance_meter("wall-irradiance");
        mitsuba::scene(
            &(mitsuba::point_lamp(self.source, &intensity.0)
                + &mitsuba::sphere("wall", [0.0; 3], self.radius, true, &wall)),
        )
    }
}

impl IntegratingSphere<1> {
    /// Mean irradiance of the whole wall, and its radiance from the centre towards these directions.
    fn case(&self, towards: &[[f64; 3]]) -> Case {
        let wall = mitsuba::diffuse(&self.reflectance.0) + &mitsuba::irradiance_meter("wall-irradiance");
        let intensity = self.flux * (1.0 / (4.0 * PI));
        let mut draft = Draft::with(
            mitsuba::point_lamp(self.source, &intensity.0)
                + &mitsuba::sphere("wall", [0.0; 3], self.radius, true, &wall),
        );
        let precision = 1e-12 * self.mean_irradiance()[0];
        draft.expect("wall-irradiance", Reads::Irradiance, &self.mean_irradiance().0, precision);
        for &at in towards {
            draft.radiance([0.0; 3], at.map(|x| x * self.radius), &self.radiance(at).0, precision);
        }
        draft.case(format!("reflectance {}", self.reflectance[0]))
    }
}

/// The catalogue's D1: radius 1 m, 1000 lm, the lamp 0.6 m off the centre.
pub fn cases() -> Vec<Case> {
    [0.1, 0.3, 0.5, 0.8, 0.9, 0.95, 0.98]
        .map(|rho| {
            let (source, flux, reflectance) = ([0.0, 0.0, 0.6], Colour([1000.0]), Colour([rho]));
            let sphere = IntegratingSphere { radius: 1.0, source, flux, reflectance };
            sphere.case(&[[0.6, 0.8, 0.0], [0.8, 0.0, 0.6], [0.0, 0.28, -0.96]])
        })
        .to_vec()
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::random::{Moments, Random};

    fn sphere() -> IntegratingSphere<3> {
        let (flux, reflectance) = (Colour([1000.0, 10.0, 3.0]), Colour([0.8, 0.5, 0.1]));
        IntegratingSphere::new(2.0, [0.0, 0.0, 1.2], flux, reflectance).expect("valid")
    }

    #[test]
    fn bounces_sum_to_the_indirect_part() {
        let s = sphere();
        for c in 0..3 {
            let series: f64 = (1..400).map(|n| s.bounce(n)[c]).sum();
            assert!((series / s.indirect()[c] - 1.0).abs() < 1e-13);
            let first: f64 = (1..=7).map(|n| s.bounce(n)[c]).sum();
            assert!((first / s.indirect_up_to(7)[c] - 1.0).abs() < 1e-13);
        }
    }

    /// The catalogue's D1: R = 1 m, 1000 lm, reflectance 0.8.
    #[test]
    fn catalogue_value() {
        let s = IntegratingSphere::new(1.0, [0.0; 3], Colour([1000.0]), Colour([0.8])).expect("valid");
        assert!((s.indirect()[0] - 318.30989).abs() < 1e-5);
        assert!((s.indirect_up_to(10)[0] - 284.13162).abs() < 1e-5);
    }

    #[test]
    fn the_direct_part_has_its_mean_and_limit() {
        let s = sphere();
        let over_z = |z: f64| s.direct([(1.0 - z * z).sqrt(), 0.0, z])[0];
        let mean = 0.5 * Gauss::new(16).composite(-1.0, 1.0, 20, over_z);
        assert!((mean / s.mean_direct()[0] - 1.0).abs() < 1e-10, "{mean}");
        // Straight above the lamp, 0.8 m away: the inverse-square law.
        assert!((s.direct([0.0, 0.0, 5.0])[1] - 10.0 / (4.0 * PI) / 0.64).abs() < 1e-12);
    }

    /// Random paths: 4 caps and 3 bounces, 12 comparisons at 4.5 standard errors.
    #[test]
    fn random_paths_agree() {
        let (s, paths) = (sphere(), 400_000);
        let mut random = Random::new(2);
        let cut = [1.0, 0.8, 0.1, -0.7];
        let mut share: [[Moments; 4]; 3] = Default::default();
        for _ in 0..paths {
            let mut p = hit(s.source, random.direction(), s.radius);
            for bounce in &mut share {
                for (cap, &cut) in bounce.iter_mut().zip(&cut[1..]) {
                    cap.add(f64::from(p[2] > cut * s.radius));
                }
                p = hit(p, random.cosine_around(p.map(|x| -x / s.radius)), s.radius);
            }
        }
        for cap in 0..3 {
            let direct = |z: f64| s.direct([(1.0 - z * z).sqrt(), 0.0, z])[0];
            let from = cut[cap + 1];
            let exact = 0.5 * Gauss::new(16).composite(from, 1.0, 20, direct) / s.mean_direct()[0];
            share[0][cap].must_agree("direct share of a cap", exact);
            for bounce in &share[1..] {
                bounce[cap].must_agree("reflected share of a cap", 0.5 * (1.0 - from));
            }
        }
    }

    /// Where a ray from inside leaves the sphere.
    fn hit(p: [f64; 3], d: [f64; 3], radius: f64) -> [f64; 3] {
        let b: f64 = (0..3).map(|i| p[i] * d[i]).sum();
        let c: f64 = p.iter().map(|x| x * x).sum::<f64>() - radius * radius;
        let t = -b + (b * b - c).max(0.0).sqrt();
        let q = [0, 1, 2].map(|i| p[i] + t * d[i]);
        q.map(|x| x * radius / length(q))
    }

    #[test]
    fn the_scene_file_carries_the_parameters() {
        let xml = sphere().xml();
        mitsuba::assert_balanced(&xml);
        assert!(xml.contains("0.8, 0.5, 0.1") && xml.contains("z=\"1.2\""), "{xml}");
        assert!(IntegratingSphere::new(1.0, [1.0, 0.0, 0.0], Colour([1.0]), Colour([0.5])).is_err());
        assert!(IntegratingSphere::new(1.0, [0.0; 3], Colour([1.0]), Colour([1.0])).is_err());
    }
}
