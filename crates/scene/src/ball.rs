//! Spheres.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use crate::ray::Ray;

/// A sphere's surface with its polar axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre, metres.
    pub centre: DVec3,
    /// Radius, metres.
    pub radius: f64,
    /// Rotation from the axes in which (u, v) are azimuth over 2 pi and polar angle over pi.
    pub axes: DMat3,
    /// True if the front side is the inside.
    pub inwards: bool,
}

impl Ball {
    /// Distance along the ray to the surface beyond `t_min`.
    ///
    /// A ray that starts on this sphere (`starts_here`) can meet it again only at the chord's other end, which is
    /// -2 (o - c).d away; no tolerance is involved, so chords of any length and spheres of any size are right.
    pub fn intersect(&self, ray: &Ray, t_min: f64, starts_here: bool) -> Option<f64> {
        let offset = ray.origin - self.centre;
        let b = offset.dot(ray.direction);
        if starts_here {
            let chord = -2.0 * b;
            return (chord > 0.0).then_some(chord);
        }
        // The distance from the centre to the line, formed from the offset's own part across the ray, keeps its digits
        // where |offset|^2 - b^2 would lose them.
        let across = (offset - b * ray.direction).length_squared();
        let half_chord2 = self.radius * self.radius - across;
        if half_chord2 < 0.0 {
            return None;
        }
        let half_chord = half_chord2.sqrt();
        let c = offset.length_squared() - self.radius * self.radius;
        let q = -b + if b <= 0.0 { half_chord } else { -half_chord };
        let (near, far) = if b <= 0.0 { (c / q, q) } else { (q, c / q) };
        if near > t_min { Some(near) } else { (far > t_min).then_some(far) }
    }

    /// Unit normal of the front side at a point of the surface.
    pub fn normal(&self, position: DVec3) -> DVec3 {
        let outwards = (position - self.centre).normalize();
        if self.inwards { -outwards } else { outwards }
    }

    /// The point of the surface nearest to a given one.
    pub fn project(&self, position: DVec3) -> DVec3 {
        self.centre + self.radius * (position - self.centre).normalize()
    }

    /// (u, v) of a point of the surface: azimuth over 2 pi, polar angle over pi.
    pub fn uv(&self, position: DVec3) -> DVec2 {
        let local = self.axes.transpose() * (position - self.centre).normalize();
        let azimuth = local.y.atan2(local.x);
        let u = if azimuth < 0.0 { azimuth / TAU + 1.0 } else { azimuth / TAU };
        DVec2::new(u, local.z.clamp(-1.0, 1.0).acos() / PI)
    }

    /// The point at azimuth 2 pi u whose polar angle has the given cosine.
    pub fn point(&self, u: f64, cos_polar: f64) -> DVec3 {
        let sin_polar = (1.0 - cos_polar * cos_polar).max(0.0).sqrt();
        let (sin, cos) = (TAU * u).sin_cos();
        self.centre + self.radius * (self.axes * DVec3::new(sin_polar * cos, sin_polar * sin, cos_polar))
    }

    /// Area in square metres.
    pub fn area(&self) -> f64 {
        4.0 * PI * self.radius * self.radius
    }

    /// Distance in metres from any point to the surface.
    pub fn distance(&self, position: DVec3) -> f64 {
        ((position - self.centre).length() - self.radius).abs()
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.centre - self.radius, self.centre + self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball() -> Ball {
        Ball { centre: DVec3::new(1.0, -2.0, 0.5), radius: 2.0, axes: DMat3::IDENTITY, inwards: false }
    }

    #[test]
    fn roots_from_outside_inside_and_behind() {
        let ball = ball();
        let outside = Ray::new(DVec3::new(-9.0, -2.0, 0.5), DVec3::X);
        assert!((ball.intersect(&outside, 0.0, false).unwrap() - 8.0).abs() < 1e-12);
        let inside = Ray::new(ball.centre, DVec3::Y);
        assert!((ball.intersect(&inside, 0.0, false).unwrap() - 2.0).abs() < 1e-12);
        let behind = Ray::new(DVec3::new(9.0, -2.0, 0.5), DVec3::X);
        assert!(ball.intersect(&behind, 0.0, false).is_none());
    }

    #[test]
    fn a_chord_ends_on_the_sphere_however_short() {
        let ball = ball();
        let start = ball.point(0.3, 0.2);
        for grazing in [1.0, 1e-3, 1e-6] {
            let tangent = (start - ball.centre).any_orthonormal_vector();
            let direction = (tangent - grazing * ball.normal(start)).normalize();
            let t = ball.intersect(&Ray::new(start, direction), 0.0, true).unwrap();
            let end = start + t * direction;
            assert!(((end - ball.centre).length() - ball.radius).abs() < 1e-12);
            assert!(t > 0.0);
        }
    }

    #[test]
    fn uv_and_point_are_inverse() {
        let ball = ball();
        for (u, cos_polar) in [(0.1, 0.9), (0.6, -0.4), (0.95, 0.0)] {
            let uv = ball.uv(ball.point(u, cos_polar));
            assert!((uv.x - u).abs() < 1e-12 && ((PI * uv.y).cos() - cos_polar).abs() < 1e-12);
        }
    }
}
