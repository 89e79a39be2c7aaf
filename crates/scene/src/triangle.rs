//! Flat three-sided surfaces: the faces of meshes.

use glam::DVec3;

use crate::ray::Ray;

/// A face of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Metres, counter-clockwise seen from the side of the vertices' order.
    pub corners: [DVec3; 3],
    /// Unit normal of the front side.
    pub normal: DVec3,
    /// True for the sides, each from a corner to the next, at which the surface ends or bends: those that no other face of
    /// the mesh shares, or one that lies at an angle.
    pub edges: [bool; 3],
}

impl Triangle {
    /// Area in square metres.
    pub fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(c - a).length()
    }

    /// Distance along the ray where it meets the face beyond `t_min`.
    ///
    /// Each side is judged by the volume that it spans with the ray, computed from the corners in such a way that the two
    /// faces of a shared side get the same number with opposite signs: no ray slips between them (Woop et al. 2013).
    pub fn intersect(&self, ray: &Ray, t_min: f64) -> Option<f64> {
        let t = (self.corners[0] - ray.origin).dot(self.normal) / ray.direction.dot(self.normal);
        // A ray in the plane gives a NaN or an infinity, which fails here.
        if !(t > t_min && t < f64::INFINITY) {
            return None;
        }
        let [a, b, c] = self.corners.map(|corner| corner - ray.origin);
        let volumes = [a.cross(b), b.cross(c), c.cross(a)].map(|side| side.dot(ray.direction));
        let inside = volumes.iter().all(|&v| v >= 0.0) || volumes.iter().all(|&v| v <= 0.0);
        inside.then_some(t)
    }

    /// The point of shares u and v of the sides: even by area for even numbers.
    pub fn point(&self, [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c] = self.corners;
        // Points beyond the diagonal are folded back (Shirley et al. 1996).
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        a + u * (b - a) + v * (c - a)
    }

    /// Weights of the corners that make up a point of the face; they add up to 1.
    pub fn weights(&self, position: DVec3) -> DVec3 {
        let [a, b, c] = self.corners;
        let cross = (b - a).cross(c - a);
        let share = |p: DVec3, q: DVec3| (p - position).cross(q - position).dot(cross) / cross.length_squared();
        DVec3::new(share(b, c), share(c, a), share(a, b))
    }

    /// Distance in metres from any point to the face.
    pub fn distance(&self, position: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        let normal = (b - a).cross(c - a);
        let inside = |from: DVec3, to: DVec3| (to - from).cross(position - from).dot(normal) >= 0.0;
        if inside(a, b) && inside(b, c) && inside(c, a) {
            return (position - a).dot(self.normal).abs();
        }
        self.sides().into_iter().map(|(from, to)| to_segment(position, from, to)).fold(f64::INFINITY, f64::min)
    }

    /// Distance in metres from any point to the nearest side at which the surface ends or bends; infinite if none does.
    pub(crate) fn distance_to_edge(&self, position: DVec3) -> f64 {
        let sharp = self.sides().into_iter().zip(self.edges).filter(|(_, sharp)| *sharp);
        sharp.map(|((from, to), _)| to_segment(position, from, to)).fold(f64::INFINITY, f64::min)
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let [a, b, c] = self.corners;
        (a.min(b).min(c), a.max(b).max(c))
    }

    fn sides(&self) -> [(DVec3, DVec3); 3] {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)]
    }
}

/// Distance from a point to a segment.
fn to_segment(position: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let share = ((position - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (position - from - share * along).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face() -> Triangle {
        let corners = [DVec3::new(1.0, 0.0, 0.5), DVec3::new(3.0, 1.0, 0.0), DVec3::new(0.5, 2.0, 1.0)];
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        Triangle { corners, normal, edges: [true; 3] }
    }

    #[test]
    fn a_ray_meets_what_it_is_aimed_at() {
        let face = face();
        for uv in [[0.1, 0.2], [0.7, 0.2], [0.9, 0.8]] {
            let target = face.point(uv);
            let origin = DVec3::new(4.0, -3.0, 9.0);
            let t = face.intersect(&Ray::towards(origin, target), 0.0).expect("it was aimed there");
            assert!((t - (target - origin).length()).abs() < 1e-12);
        }
        let beyond = face.corners[0] + 1.01 * (face.corners[1] - face.corners[0]);
        assert!(face.intersect(&Ray::towards(DVec3::new(0.0, 0.0, 5.0), beyond), 0.0).is_none());
    }

    #[test]
    fn distances_agree_with_a_dense_search() {
        let face = face();
        for probe in [DVec3::ZERO, DVec3::new(1.2, 0.9, 4.0), DVec3::new(9.0, 2.0, 3.0), DVec3::new(1.5, 1.0, 0.5)] {
            let n = 400;
            let share = |i: i32| f64::from(i) / f64::from(n);
            let nearest = (0..=n)
                .flat_map(|i| (0..=n - i).map(move |j| [share(i), share(j)]))
                .map(|uv| (face.point(uv) - probe).length())
                .fold(f64::INFINITY, f64::min);
            assert!((face.distance(probe) - nearest).abs() < 0.01, "{probe}: {} {nearest}", face.distance(probe));
        }
    }

    /// A point on a shared side belongs to one face or both, never to none.
    #[test]
    fn no_ray_slips_between_two_faces() {
        let [a, b] = [DVec3::new(0.1, 0.3, 0.7), DVec3::new(1.3, 0.9, 0.2)];
        let face = |third: DVec3, flip: bool| {
            let corners = if flip { [b, a, third] } else { [a, b, third] };
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
            Triangle { corners, normal, edges: [false; 3] }
        };
        let pair = [face(DVec3::new(0.2, 1.5, 0.4), false), face(DVec3::new(1.0, -0.4, 0.3), true)];
        for i in 1..20_000 {
            let target = a + (b - a) * (f64::from(i) / 20_000.0);
            let ray = Ray::towards(DVec3::new(0.3, 0.2, 5.0 + 0.001 * f64::from(i % 7)), target);
            assert!(pair.iter().any(|face| face.intersect(&ray, 0.0).is_some()), "{i}");
        }
    }
}
