//! A paraboloid mirror with a point lamp beside its focus, on its axis: flux within circles far away.
//!
//! By symmetry each ray stays in a plane through the axis: it leaves the lamp at an angle, meets the mirror
//! `z = r^2 / (4 f)`, is reflected by its normal `(-r / (2 f), 1)` and lands in a plane across the axis at a signed distance, or under an
//! angle. Light that misses the mirror goes straight. (Law of reflection.) Summed over 200 000 rays even in the cosine at the
//! lamp; each circle is off by at most a few rays, 2e-5 of the flux.

/// The mirror opens towards +z from its vertex in the origin and loses nothing; the lamp shines evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflector {
    /// Focal length `f` (m).
    pub focal_length: f64,
    /// Radius of the rim (m).
    pub rim: f64,
    /// Height of the lamp over the vertex (m).
    pub lamp: f64,
    /// Its flux (W or lm).
    pub flux: f64,
}

/// Where a ray leaves the reflector, `[r, z]` with a sign, and its direction.
type Leaving = ([f64; 2], [f64; 2]);

impl Reflector {
    /// `reflector.xml`.
    pub const SCENE: Reflector = Reflector { focal_length: 0.05, rim: 0.1, lamp: 0.055, flux: 1000.0 };

    /// Flux within `radius` (m) of the axis in the plane at `height` (m), in W or lm.
    pub fn flux_within(&self, radius: f64, height: f64) -> f64 {
        self.share(|([r, z], [dr, dz])| dz > 0.0 && (r + (height - z) * dr / dz).abs() < radius)
    }

    /// Flux within an angle (radians) of the axis, in W or lm: what the same circle gets from a point that shines as the
    /// reflector does from afar.
    pub fn far_flux_within(&self, angle: f64) -> f64 {
        self.share(|(_, [dr, dz])| dr.abs().atan2(dz) < angle)
    }

    fn share(&self, keep: impl Fn(Leaving) -> bool) -> f64 {
        const RAYS: u32 = 200_000;
        let cosine = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(RAYS) - 1.0;
        let kept = (0..RAYS).filter(|&i| keep(self.leaves(cosine(i)))).count();
        self.flux * kept as f64 / f64::from(RAYS)
    }

    /// The ray that leaves the lamp at this cosine to +z.
    fn leaves(&self, cosine: f64) -> Leaving {
        let (f, d) = (self.focal_length, [(1.0 - cosine * cosine).sqrt(), cosine]);
        // (t sine)^2 = 4 f (lamp + t cosine)
        let (a, b, c) = (d[0] * d[0], -4.0 * f * d[1], -4.0 * f * self.lamp);
        let t = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
        let r = t * d[0];
        if r > self.rim {
            return ([0.0, self.lamp], d);
        }
        let slope = r / (2.0 * f);
        let along = 2.0 * (-slope * d[0] + d[1]) / (slope * slope + 1.0);
        ([r, r * r / (4.0 * f)], [d[0] + along * slope, d[1] - along])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paraboloid::Paraboloid;
    use crate::random::{Moments, Random};
    use crate::vector::{along, dot, unit};

    /// With the lamp in the focus the beam has a closed form, from the reflected light alone: far away next to none is direct.
    #[test]
    fn a_lamp_in_the_focus_makes_the_known_beam() {
        let focused = Reflector { lamp: 0.05, ..Reflector::SCENE };
        let beam = Paraboloid::new(0.05, 1000.0).expect("valid");
        for radius in [0.02, 0.05, 0.09] {
            let (got, want) = (focused.flux_within(radius, 100.0), beam.flux_within(radius));
            assert!((got - want).abs() < 0.03, "{radius}: {got} {want}");
        }
        assert!((focused.far_flux_within(0.01) - 500.0).abs() < 0.05, "all of the beam, and 2.5e-5 of the lamp's own");
    }

    /// Rays in space, met by Newton's steps and reflected as often as they meet the mirror: 3 comparisons at 4.5 standard
    /// errors.
    #[test]
    fn rays_in_space_agree() {
        let (reflector, mut random) = (Reflector::SCENE, Random::new(83));
        let f = reflector.focal_length;
        let circles = [2.0, 5.0, 10.0];
        let mut within: [Moments; 3] = Default::default();
        for _ in 0..100_000 {
            let (mut p, mut d) = ([0.0, 0.0, reflector.lamp], random.direction());
            // Over the mirror (z > r^2 / 4f) a ray can meet it again only where it is below, so step until it is.
            for _ in 0..4 {
                let gap = |t: f64| {
                    let q = along(p, t, d);
                    q[2] - (q[0] * q[0] + q[1] * q[1]) / (4.0 * f)
                };
                let Some(k) = (1..400).find(|&k| gap(0.001 * f64::from(k)) < 0.0) else { break };
                let (mut low, mut high) = (0.001 * f64::from(k - 1), 0.001 * f64::from(k));
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if gap(middle) > 0.0 { low = middle } else { high = middle }
                }
                let q = along(p, low, d);
                if q[0].hypot(q[1]) > reflector.rim {
                    break;
                }
                let normal = unit([-q[0] / (2.0 * f), -q[1] / (2.0 * f), 1.0]);
                (p, d) = (q, along(d, -2.0 * dot(d, normal), normal));
                p = along(p, 1e-9, d);
            }
            let lands = (d[2] > 0.0).then(|| along(p, (100.0 - p[2]) / d[2], d)).map(|q| q[0].hypot(q[1]));
            for (moments, circle) in within.iter_mut().zip(circles) {
                moments.add(if lands.is_some_and(|r| r < circle) { reflector.flux } else { 0.0 });
            }
        }
        for (moments, circle) in within.iter().zip(circles) {
            moments.must_agree(&format!("within {circle} m"), reflector.flux_within(circle, 100.0));
        }
    }
}
