//! An integrating sphere with a port: the sphere multiplier.
//!
//! Diffuse light from any element of a sphere is even over the whole sphere ([`crate::integrating_sphere`]), so the share
//! `f` of it, that of the port's cap in the sphere's surface, leaves at each reflection and `1 - f` meets the wall again.
//! Light that meets the wall first and the port only after it comes back from it `M = rho / (1 - rho (1 - f))` times: every point,
//! of the port's cap too, receives `Phi M / (4 pi R^2)` by reflection, the port lets `Phi f M` out, and a point of the wall
//! that the lamp does not reach shines with `rho / pi` of that. What crosses the flat opening is what would meet the cap
//! behind it. (Goebel, "Generalized integrating-sphere theory", Appl. Opt. 6, 125, 1967.) Exact.

use std::f64::consts::PI;

/// A diffuse sphere with a port around +z, its lamp in the centre shining by the cosine towards -z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PortSphere {
    /// Radius of the sphere (m).
    pub radius: f64,
    /// Distance of the port's plane from the centre (m).
    pub port_height: f64,
    /// Reflectance of the wall.
    pub reflectance: f64,
    /// Flux of the lamp (W or lm).
    pub flux: f64,
}

impl PortSphere {
    /// `port-sphere.xml`: the port has a fiftieth of the sphere's surface.
    pub const SCENE: PortSphere = PortSphere { radius: 0.25, port_height: 0.24, reflectance: 0.95, flux: 1000.0 };

    /// Share `f` of the port in the sphere's surface.
    pub fn port_share(&self) -> f64 {
        0.5 * (1.0 - self.port_height / self.radius)
    }

    /// The sphere multiplier `M`.
    pub fn multiplier(&self) -> f64 {
        self.reflectance / (1.0 - self.reflectance * (1.0 - self.port_share()))
    }

    /// Flux out of the port, in W or lm.
    pub fn port_flux(&self) -> f64 {
        self.flux * self.port_share() * self.multiplier()
    }

    /// Radiance of a point of the wall, in W/(m^2 sr) or cd/m^2; `z` (m) is its height over the lamp.
    pub fn radiance(&self, z: f64) -> f64 {
        let area = 4.0 * PI * self.radius * self.radius;
        let direct = (-z / self.radius).max(0.0) * self.flux / PI / (self.radius * self.radius);
        self.reflectance / PI * (direct + self.flux * self.multiplier() / area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::random::{Moments, Random};
    use crate::vector::{along, dot};

    /// All light is absorbed or leaves by the port.
    #[test]
    fn the_flux_is_conserved() {
        let s = PortSphere::SCENE;
        let ring = |z: f64| 2.0 * PI * s.radius * PI * s.radiance(z) * (1.0 - s.reflectance) / s.reflectance;
        let rule = Gauss::new(8);
        let absorbed = rule.integrate(-s.radius, 0.0, ring) + rule.integrate(0.0, s.port_height, ring);
        assert!(((absorbed + s.port_flux()) / s.flux - 1.0).abs() < 1e-12);
        assert!((s.port_share() - 0.02).abs() < 1e-12 && (s.multiplier() - 0.95 / 0.069).abs() < 1e-9);
    }

    /// Random paths that end at the flat opening: 1 comparison at 4.5 standard errors.
    #[test]
    fn random_paths_agree() {
        let (s, mut random, mut out) = (PortSphere::SCENE, Random::new(82), Moments::default());
        for _ in 0..100_000 {
            let (mut p, mut d) = ([0.0; 3], random.cosine_around([0.0, 0.0, -1.0]));
            let leaves = loop {
                let b = dot(p, d);
                let q = along(p, -b + (b * b - dot(p, p) + s.radius * s.radius).sqrt(), d);
                if q[2] > s.port_height {
                    break true;
                }
                if random.unit() > s.reflectance {
                    break false;
                }
                p = q;
                d = random.cosine_around(p.map(|x| -x / s.radius));
            };
            out.add(if leaves { s.flux } else { 0.0 });
        }
        out.must_agree("flux out of the port", s.port_flux());
    }
}
