//! A Lambertian sphere and a small element turned anyhow, also where the horizon cuts the sphere.
//!
//! With `H = D / R >= 1` and `theta` between the element's normal and the direction to the centre, the share of the
//! exitance is `cos theta / H^2` while the whole sphere is in front (`H cos theta >= 1`), 0 while it is behind
//! (`H cos theta <= -1`), and between
//! `1/2 - asin(s / (H sin theta)) / pi + [cos theta acos(-s cot theta) - s sqrt(1 - H^2 cos^2 theta)] / (pi H^2)`,
//! `s = sqrt(H^2 - 1)`. (Howell's catalogue B-43, B-44; catalogue entry C4.) Exact to rounding, 1e-13.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_positive};
use crate::vector::{Vector, dot, length};

/// A sphere around the origin that radiates from its outside, black itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallLamp {
    radius: f64,
    exitance: f64,
}

impl BallLamp {
    /// A sphere of `radius` (m) with `exitance` in W/m^2 or lm/m^2.
    pub fn new(radius: f64, exitance: f64) -> Result<Self, OutOfRange> {
        require_positive("radius", radius)?;
        require_positive("exitance", exitance)?;
        Ok(BallLamp { radius, exitance })
    }

    /// Irradiance of an element at `point` (m, outside the sphere) with this unit normal, in W/m^2 or lx.
    pub fn irradiance(&self, point: Vector, normal: Vector) -> f64 {
        let distance = length(point);
        self.exitance * share(distance / self.radius, -dot(point, normal) / distance)
    }

    /// The sphere with one small meter for each angle (degrees) between normal and centre, all at this distance (m) and
    /// spread around a circle so that none shades another.
    pub fn case(&self, distance: f64, angles: &[f64]) -> Case {
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.exitance / PI]);
        let mut draft = Draft::with(mitsuba::sphere("lamp", [0.0; 3], self.radius, false, &on_it));
        for (i, angle) in angles.iter().enumerate() {
            let (sine, cosine) = (2.0 * PI * i as f64 / angles.len() as f64).sin_cos();
            let (tilt, inwards) = angle.to_radians().sin_cos();
            let normal = [-inwards * cosine, -inwards * sine, tilt];
            let centre = [distance * cosine, distance * sine, 0.0];
            let place = Place::facing(normal, centre, 0.03 * (distance - self.radius).min(self.radius));
            // A meter across the horizon's edge integrates a kink: 8 nodes leave 1e-5 of the fall over the meter.
            draft.square(place, 1e-6 * self.exitance, |p| self.irradiance(p, normal));
        }
        draft.case(format!("distance {distance} radii"))
    }
}

/// The share for `H` and `cos theta`.
fn share(h: f64, cosine: f64) -> f64 {
    if h * cosine >= 1.0 {
        return cosine / (h * h);
    }
    if h * cosine <= -1.0 {
        return 0.0;
    }
    // Both arcs from their sine and cosine, since one of them is small where the horizon touches the sphere.
    let s = (h * h - 1.0).max(0.0).sqrt();
    let q = ((1.0 - h * cosine) * (1.0 + h * cosine)).sqrt();
    let lune = cosine * q.atan2(-s * cosine) - s * q;
    (0.5 - s.atan2(q) / PI + lune / (PI * h * h)).max(0.0)
}

/// The catalogue's C4: radius 1 m, 1000 lm/m^2, three distances. At two of the angles the element faces away.
pub fn cases() -> Vec<Case> {
    let lamp = BallLamp { radius: 1.0, exitance: 1000.0 };
    let angles = [0.0, 30.0, 60.0, 75.0, 90.0, 100.0, 120.0];
    [1.25, 2.0, 4.0].map(|distance| lamp.case(distance, &angles)).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    #[test]
    fn catalogue_values() {
        let table = [
            (1.25, [0.64, 0.55425626, 0.34271305, 0.23557831, 0.14237849, 0.091446756, 0.022713054]),
            (2.0, [0.25, 0.21650635, 0.125, 0.070410427, 0.028834443, 0.011283772, 0.0]),
            (4.0, [0.0625, 0.054126588, 0.03125, 0.01617619, 0.0033800677, 0.00019957391, 0.0]),
        ];
        for (h, row) in table {
            for (angle, want) in [0.0f64, 30.0, 60.0, 75.0, 90.0, 100.0, 120.0].into_iter().zip(row) {
                let got = share(h, angle.to_radians().cos());
                assert!((got - want).abs() < 1e-8, "{h} {angle}: {got} {want}");
            }
        }
    }

    /// The projected solid angle of the part of the cone that is in front, over rings around the cone's axis: on the
    /// ring at `alpha` the cosine `a + b cos phi` is integrated over where it is positive.
    #[test]
    fn the_closed_form_is_the_projected_solid_angle() {
        let rule = Gauss::new(24);
        for h in [1.25f64, 2.0, 4.0] {
            for angle in [20.0f64, 62.0, 75.0, 90.0, 100.0, 118.0] {
                let (tilt, inwards) = angle.to_radians().sin_cos();
                let ring = |alpha: f64| {
                    let (a, b) = (alpha.cos() * inwards, alpha.sin() * tilt);
                    let end = (-a / b).clamp(-1.0, 1.0).acos();
                    2.0 * (a * end + b * end.sin()) * alpha.sin()
                };
                // The ring leaves or enters the horizon at |90 - angle|: a square-root kink, resolved by grading.
                let (edge, kink) = ((1.0 / h).asin(), (90.0 - angle).to_radians().abs());
                let kink = if kink < edge { kink } else { 0.0 };
                let graded = |from: f64, to: f64| {
                    rule.integrate(0.0, 1.0, |x| 3.0 * (to - from) * x * x * ring(from + (to - from) * x * x * x))
                };
                let brute = (graded(kink, edge) - graded(kink, 0.0)) / PI;
                let got = share(h, inwards);
                assert!((got - brute).abs() < 1e-8, "{h} {angle}: {got} {brute}");
            }
        }
    }

    #[test]
    fn the_scene_carries_the_parameters() {
        let lamp = BallLamp::new(0.5, 10.0).expect("valid");
        let case = lamp.case(2.0, &[0.0, 90.0]);
        mitsuba::assert_balanced(&case.xml);
        assert!(case.xml.contains("value=\"0.5\"") && case.xml.contains("flip_normals\" value=\"false\""));
        // Facing the sphere: a point source of the same intensity.
        assert!((lamp.irradiance([0.0, 0.0, 2.0], [0.0, 0.0, -1.0]) - 10.0 * 0.0625).abs() < 1e-14);
    }
}
