//! A flat four-sided surface: rectangles and the faces of cubes.

use glam::{DVec2, DVec3};

use crate::ray::Ray;

/// Rays that meet the plane this far outside the edges (in half-edges) still hit, so that neighbouring faces of a cube
/// overlap by a few rounding errors instead of leaving a slit between them.
const RIM: f64 = 1e-12;

/// The points `centre + a edge_u + b edge_v` for a, b in [-1, 1]; (u, v) = ((a + 1) / 2, (b + 1) / 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// Middle of the surface, metres.
    pub centre: DVec3,
    /// From the middle to the middle of the edge u = 1, metres.
    pub edge_u: DVec3,
    /// From the middle to the middle of the edge v = 1, metres.
    pub edge_v: DVec3,
    /// Unit normal of the front side.
    pub normal: DVec3,
    /// Dual to `edge_u`: its scalar product with an offset from the centre is `a`.
    dual_u: DVec3,
    /// Dual to `edge_v`: its scalar product with an offset from the centre is `b`.
    dual_v: DVec3,
}

impl Parallelogram {
    /// From the middle and the two half-edges, which must not be parallel; `front` is any vector on the front side.
    pub fn new(centre: DVec3, edge_u: DVec3, edge_v: DVec3, front: DVec3) -> Self {
        let cross = edge_u.cross(edge_v);
        let area2 = cross.length_squared();
        let normal = cross.normalize() * if cross.dot(front) < 0.0 { -1.0 } else { 1.0 };
        Self {
            centre,
            edge_u,
            edge_v,
            normal,
            dual_u: edge_v.cross(cross) / area2,
            dual_v: cross.cross(edge_u) / area2,
        }
    }

    /// Area in square metres.
    pub fn area(&self) -> f64 {
        4.0 * self.edge_u.cross(self.edge_v).length()
    }

    /// True if its edges meet at right angles.
    pub fn is_rectangle(&self) -> bool {
        self.edge_u.dot(self.edge_v).abs() <= 1e-9 * self.edge_u.length() * self.edge_v.length()
    }

    /// The point at (u, v) in [0, 1]^2.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.centre + (2.0 * uv.x - 1.0) * self.edge_u + (2.0 * uv.y - 1.0) * self.edge_v
    }

    /// (u, v) of a point on the surface.
    pub fn uv(&self, position: DVec3) -> DVec2 {
        let offset = position - self.centre;
        0.5 * DVec2::new(offset.dot(self.dual_u) + 1.0, offset.dot(self.dual_v) + 1.0)
    }

    /// Distance along the ray and (u, v) where it meets the surface beyond `t_min`.
    pub fn intersect(&self, ray: &Ray, t_min: f64) -> Option<(f64, DVec2)> {
        let denominator = self.normal.dot(ray.direction);
        let t = self.normal.dot(self.centre - ray.origin) / denominator;
        // A ray in the plane gives a NaN or an infinity, which fails here.
        if !(t > t_min && t < f64::INFINITY) {
            return None;
        }
        let offset = ray.at(t) - self.centre;
        let (a, b) = (offset.dot(self.dual_u), offset.dot(self.dual_v));
        (a.abs() <= 1.0 + RIM && b.abs() <= 1.0 + RIM).then(|| (t, 0.5 * DVec2::new(a + 1.0, b + 1.0)))
    }

    /// Distance in metres from a point on the surface to its nearest edge.
    pub fn distance_to_edge(&self, position: DVec3) -> f64 {
        let offset = position - self.centre;
        let from_u = (1.0 - offset.dot(self.dual_u).abs()) / self.dual_u.length();
        let from_v = (1.0 - offset.dot(self.dual_v).abs()) / self.dual_v.length();
        from_u.min(from_v)
    }

    /// Distance in metres from any point to the surface.
    pub fn distance(&self, position: DVec3) -> f64 {
        let offset = position - self.centre;
        let (a, b) = (offset.dot(self.dual_u), offset.dot(self.dual_v));
        if a.abs() <= 1.0 && b.abs() <= 1.0 {
            return offset.dot(self.normal).abs();
        }
        let side = |middle: DVec3, along: DVec3| {
            let s = ((offset - middle).dot(along) / along.length_squared()).clamp(-1.0, 1.0);
            (offset - middle - s * along).length()
        };
        side(self.edge_u, self.edge_v)
            .min(side(-self.edge_u, self.edge_v))
            .min(side(self.edge_v, self.edge_u))
            .min(side(-self.edge_v, self.edge_u))
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let reach = self.edge_u.abs() + self.edge_v.abs();
        (self.centre - reach, self.centre + reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn skewed() -> Parallelogram {
        Parallelogram::new(DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 0.0, 0.5), DVec3::new(0.5, 1.0, 0.0), DVec3::Z)
    }

    #[test]
    fn a_ray_meets_the_point_it_is_aimed_at() {
        let surface = skewed();
        for (u, v) in [(0.1, 0.9), (0.5, 0.5), (0.999, 0.001)] {
            let target = surface.point(DVec2::new(u, v));
            let origin = DVec3::new(4.0, -3.0, 9.0);
            let (t, uv) = surface.intersect(&Ray::towards(origin, target), 0.0).expect("it was aimed there");
            assert!((t - (target - origin).length()).abs() < 1e-12);
            assert!((uv - DVec2::new(u, v)).length() < 1e-12);
        }
        let outside = surface.point(DVec2::new(1.001, 0.5));
        assert!(surface.intersect(&Ray::towards(DVec3::ZERO, outside), 0.0).is_none());
    }

    #[test]
    fn distances_agree_with_a_dense_search() {
        let surface = skewed();
        for probe in [DVec3::ZERO, DVec3::new(1.2, 2.1, 4.0), DVec3::new(9.0, 2.0, 3.0), DVec3::new(3.3, 3.2, 3.2)] {
            let n = 400;
            let nearest = (0..=n)
                .flat_map(|i| (0..=n).map(move |j| DVec2::new(i as f64, j as f64) / n as f64))
                .map(|uv| (surface.point(uv) - probe).length())
                .fold(f64::INFINITY, f64::min);
            assert!((surface.distance(probe) - nearest).abs() < 0.02, "{probe}");
        }
    }
}
