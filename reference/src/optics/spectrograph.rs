//! Collimator, slit, prism of N-BK7 and screen: where each wavelength lands.
//!
//! The mirror makes a parallel beam of the lamp in its focus ([`crate::paraboloid`]); across the slit it is refracted as by
//! [`crate::prism`]. In the plane of the drawing the ray at `w` beside the beam's middle meets the first face `w / cos i` nearer to the
//! apex, leaves the second one at the sine rule's distance from the apex under `sin e = n sin(A - r)` and lands on the
//! screen, which faces the symmetric ray, at a place linear in `w`. So the flux in a strip of the screen is that in a strip of
//! the slit, times what Fresnel lets through both faces, for each wavelength of each line. Gauss quadrature, 1e-6 of the flux.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_6, PI};

use crate::prism::bk7;
use crate::quadrature::Gauss;
use crate::scattering::fresnel;

/// An equilateral prism, apex up, the middle of its entrance face in the beam and of its exit face before the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrograph {
    /// Angle of the beam and of the screen's axis to the base (radians): the incidence less 30 degrees.
    pub tilt: f64,
    /// Edge of the prism (m).
    pub edge: f64,
    /// Half width and half height of the slit (m).
    pub slit: [f64; 2],
    /// Focal length of the collimating mirror (m).
    pub focal_length: f64,
    /// Exponent of the lamp's cosine towards the mirror.
    pub exponent: f64,
    /// Intensity of each line on the lamp's axis (W/sr).
    pub intensity: f64,
    /// Distance of the screen from the middle of the exit face (m).
    pub distance: f64,
}

/// Half the width at the foot of each line, nm: its spectrum is a triangle.
const HALF_LINE: f64 = 0.1;

impl Spectrograph {
    /// `spectrograph.xml`: least deviation near 600 nm.
    pub const SCENE: Spectrograph = Spectrograph {
        tilt: 19.3 * PI / 180.0,
        edge: 0.1,
        slit: [0.002, 0.03],
        focal_length: 0.1,
        exponent: 8.0,
        intensity: 1.0,
        distance: 1.0,
    };

    /// The lines of its lamp, nm: mercury's g, hydrogen's F and C, helium's d.
    pub const LINES: [f64; 4] = [435.8, 486.1, 587.6, 656.3];

    /// Flux of a line (nm) on the strip of the screen between two heights over its middle (m), in W.
    pub fn flux(&self, line: f64, strip: [f64; 2]) -> f64 {
        let rule = Gauss::new(12);
        let of_wavelength = |nm: f64| {
            let weight = (1.0 - (nm - line).abs() / HALF_LINE) / HALF_LINE;
            weight * self.flux_at(bk7(nm / 1000.0), strip)
        };
        rule.composite(line - HALF_LINE, line + HALF_LINE, 8, of_wavelength)
    }

    /// The middle of a line on the screen, metres over the screen's middle.
    pub fn lands(&self, line: f64) -> f64 {
        self.place(bk7(line / 1000.0), 0.0)
    }

    fn flux_at(&self, index: f64, strip: [f64; 2]) -> f64 {
        let ([zero, one], half) = ([0.0, 1.0].map(|w| self.place(index, w * self.slit[0])), self.slit[0]);
        let mut within = strip.map(|v| ((v - zero) / (one - zero) * half).clamp(-half, half));
        within.sort_by(f64::total_cmp);
        let (first, last) = self.angles(index);
        let lost = [FRAC_PI_6 + self.tilt, last].map(|angle| fresnel::unpolarised(angle.cos(), index));
        debug_assert!(first < FRAC_PI_3);
        (1.0 - lost[0]) * (1.0 - lost[1]) * self.slit_flux(within)
    }

    /// Angles to the normals: inside the first face, outside the second.
    fn angles(&self, index: f64) -> (f64, f64) {
        let inside = ((FRAC_PI_6 + self.tilt).sin() / index).asin();
        (inside, (index * (FRAC_PI_3 - inside).sin()).asin())
    }

    /// Height over the screen's middle where the ray at `w` (m) over the beam's middle lands.
    fn place(&self, index: f64, w: f64) -> f64 {
        let (incidence, (inside, exit)) = (FRAC_PI_6 + self.tilt, self.angles(index));
        let from_apex = 0.5 * self.edge - w / incidence.cos();
        let leaves = 0.5 * self.edge - from_apex * inside.cos() / (FRAC_PI_3 - inside).cos();
        let down = exit - FRAC_PI_6 - self.tilt;
        leaves * incidence.cos() - (self.distance + leaves * incidence.sin()) * down.tan()
    }

    /// Flux of the beam through the slit between two heights.
    fn slit_flux(&self, [from, to]: [f64; 2]) -> f64 {
        let (rule, f) = (Gauss::new(8), self.focal_length);
        let irradiance = |w: f64, y: f64| {
            let r = w.hypot(y);
            let theta = 2.0 * (0.5 * r / f).atan();
            self.intensity * theta.cos().powf(self.exponent) / (f + r * r / (4.0 * f)).powi(2)
        };
        2.0 * rule.integrate(from, to, |w| rule.integrate(0.0, self.slit[1], |y| irradiance(w, y)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prism::Prism;
    use crate::random::{Moments, Random};
    use crate::vector::{Vector, along, dot, unit};

    const WHOLE: [f64; 2] = [-0.1, 0.1];

    /// Two wavelengths lie apart as their deviations say; the least deviated one lands in the screen's middle.
    #[test]
    fn places_follow_the_deviations() {
        let s = Spectrograph::SCENE;
        let deviation = |n: f64| Prism::new(n, FRAC_PI_6 + s.tilt).expect("valid").deviation();
        let least = (FRAC_PI_6 + s.tilt).sin() / 0.5;
        assert!(s.place(least, 0.0).abs() < 1e-15 && (deviation(least) - 2.0 * s.tilt).abs() < 1e-12);
        for line in Spectrograph::LINES {
            let n = bk7(line / 1000.0);
            let by_angle = -(deviation(n) - deviation(least)).tan() * s.distance;
            println!("{line} nm: {:.3} mm, {:.6} W", 1e3 * s.lands(line), s.flux(line, WHOLE));
            assert!((s.lands(line) - by_angle).abs() < 3e-4, "{line}: {} {by_angle}", s.lands(line));
        }
    }

    /// Rays from the lamp by mirror, slit and prism in vectors: 8 comparisons at 4.5 standard errors, the flux of two lines on
    /// four strips each.
    #[test]
    fn traced_rays_agree() {
        let (s, mut random) = (Spectrograph::SCENE, Random::new(84));
        let strips = |line: f64| {
            let middle = s.lands(line);
            [[-9e-3, -1e-3], [-1e-3, 0.0], [0.0, 1.5e-3], [1.5e-3, 9e-3]].map(|ends| ends.map(|end| middle + end))
        };
        for line in [435.8, 656.3] {
            let mut found: [Moments; 4] = Default::default();
            for _ in 0..150_000 {
                let nm = line + HALF_LINE * (random.unit() + random.unit() - 1.0);
                let cosine = random.unit().powf(1.0 / (s.exponent + 1.0));
                let (sine, phi) = ((1.0 - cosine * cosine).sqrt(), random.between(0.0, 2.0 * PI));
                let place = lands(&s, bk7(nm / 1000.0), [-cosine, sine * phi.cos(), sine * phi.sin()]);
                let emitted = s.intensity * 2.0 * PI / (s.exponent + 1.0);
                for (moments, [from, to]) in found.iter_mut().zip(strips(line)) {
                    moments.add(place.map_or(0.0, |(v, share)| if from < v && v < to { share * emitted } else { 0.0 }));
                }
            }
            for (moments, strip) in found.iter().zip(strips(line)) {
                moments.must_agree(&format!("{line} nm in {strip:?}"), s.flux(line, strip));
            }
        }
    }

    /// Where on the screen a ray lands that leaves the lamp along `d`, the beam's axis being +x and the plane of the drawing
    /// y = 0, and what share passes the faces.
    fn lands(s: &Spectrograph, index: f64, d: Vector) -> Option<(f64, f64)> {
        // The mirror 4 f (x + 3 f) = y^2 + z^2 with the lamp in the focus at x = -2 f.
        let f = s.focal_length;
        let (a, b) = (d[1] * d[1] + d[2] * d[2], -4.0 * f * d[0]);
        let t = if a < 1e-12 { f } else { (-b + (b * b + 16.0 * a * f * f).sqrt()) / (2.0 * a) };
        let p = along([-2.0 * f, 0.0, 0.0], t, d);
        let normal = unit([1.0, -p[1] / (2.0 * f), -p[2] / (2.0 * f)]);
        let d = along(d, -2.0 * dot(d, normal), normal);
        if p[1].abs() > s.slit[1] || p[2].abs() > s.slit[0] {
            return None;
        }
        // Into the prism's frame, its entrance face's middle in the origin.
        let (sine, cosine) = s.tilt.sin_cos();
        let turn = |v: Vector| [cosine * v[0] - sine * v[2], v[1], sine * v[0] + cosine * v[2]];
        let faces = [([0.0; 3], [-0.75f64.sqrt(), 0.0, 0.5]), ([0.5 * s.edge, 0.0, 0.0], [0.75f64.sqrt(), 0.0, 0.5])];
        let (mut p, mut d, mut share) = (turn(p), turn(d), 1.0);
        for ((middle, normal), (eta, facing)) in faces.into_iter().zip([(1.0 / index, 1.0), (index, -1.0)]) {
            p = along(p, dot(along(middle, -1.0, p), normal) / dot(d, normal), d);
            let normal = normal.map(|x| facing * x);
            let near = -dot(d, normal);
            share *= 1.0 - fresnel::unpolarised(near, 1.0 / eta);
            let far = (1.0 - eta * eta * (1.0 - near * near)).sqrt();
            d = along(d.map(|x| eta * x), eta * near - far, normal);
        }
        let axis = [cosine, 0.0, -sine];
        let from = along(p, -1.0, [0.5 * s.edge, 0.0, 0.0]);
        let at = along(from, (s.distance - dot(from, axis)) / dot(d, axis), d);
        Some((dot(at, [sine, 0.0, cosine]), share))
    }
}
