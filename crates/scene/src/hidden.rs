//! Whether flat surfaces in a ball can hide parts of one another from light.

use glam::DVec3;

/// A flat surface in a ball: its corners, in order, and a unit normal.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    pub(crate) corners: Vec<DVec3>,
    pub(crate) normal: DVec3,
    /// True if its area counts.
    pub(crate) counts: bool,
}

/// A ball around a point of a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around {
    pub(crate) centre: DVec3,
    /// Unit normal of the plane, on the side that is read.
    pub(crate) normal: DVec3,
    pub(crate) radius: f64,
    /// Lengths below this are nothing.
    pub(crate) tolerance: f64,
}

/// More pairs of faces than this are not looked at.
const MOST_PAIRS: usize = 256;

impl Around {
    /// True if what counts of these faces lies open in the ball: it is all in the plane, and every other face is behind that, or comes
    /// out of it where the ones that count end, as a wall beside a floor does. A body that stands on the floor, or hangs above it,
    /// hides some of it; and the point's own body hides some of a floor that it stands on.
    pub(crate) fn lies_open(&self, faces: &[Face]) -> bool {
        let standing = || faces.iter().filter(|face| !self.is_behind(face));
        let counted = || faces.iter().filter(|face| face.counts);
        if standing().count() * counted().count() > MOST_PAIRS {
            return false;
        }
        counted().all(|face| self.is_in_plane(face))
            && standing().all(|wall| self.comes_out(wall) && counted().all(|face| self.ends_at(face, wall)))
    }

    fn is_in_plane(&self, face: &Face) -> bool {
        face.corners.iter().all(|&corner| self.height(corner).abs() <= self.tolerance)
    }

    fn height(&self, point: DVec3) -> f64 {
        (point - self.centre).dot(self.normal)
    }

    fn is_behind(&self, face: &Face) -> bool {
        face.corners.iter().all(|&corner| self.height(corner) <= self.tolerance)
    }

    fn comes_out(&self, wall: &Face) -> bool {
        wall.corners.iter().any(|&corner| self.height(corner) <= self.tolerance)
    }

    /// True if nothing of a face within the ball lies beyond the plane of a wall, seen from the centre.
    fn ends_at(&self, face: &Face, wall: &Face) -> bool {
        let side = (self.centre - wall.corners[0]).dot(wall.normal);
        if side.abs() <= self.tolerance {
            return false;
        }
        let beyond = |point: DVec3| -(point - wall.corners[0]).dot(wall.normal) * side.signum() - self.tolerance;
        let rest = clipped(&face.corners, beyond);
        let sides = (0..rest.len()).map(|i| (rest[i], rest[(i + 1) % rest.len()]));
        sides.map(|(from, to)| distance_to_segment(self.centre, from, to)).fold(f64::INFINITY, f64::min) >= self.radius
    }
}

/// The part of a convex polygon where a linear function is positive (Sutherland and Hodgman 1974).
fn clipped(corners: &[DVec3], inside: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % corners.len()];
        let (here, there) = (inside(from), inside(to));
        if here > 0.0 {
            kept.push(from);
        }
        if (here > 0.0) != (there > 0.0) {
            kept.push(from + (to - from) * (here / (here - there)));
        }
    }
    kept
}

fn distance_to_segment(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    // A side without length has no share.
    point.distance(if share.is_nan() { from } else { from + share * along })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(corners: [[f64; 3]; 4], counts: bool) -> Face {
        let corners = corners.map(DVec3::from);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        Face { corners: corners.to_vec(), normal, counts }
    }

    /// A point of a floor one metre square, 0.1 from the side at x = 1.
    fn beside(faces: &[Face]) -> bool {
        let around = Around { centre: DVec3::new(0.9, 0.5, 0.0), normal: DVec3::Z, radius: 0.2, tolerance: 1e-7 };
        let floor = face([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], true);
        around.lies_open(&[&[floor], faces].concat())
    }

    fn wall(x: f64, z: [f64; 2]) -> Face {
        face([[x, 0.0, z[0]], [x, 1.0, z[0]], [x, 1.0, z[1]], [x, 0.0, z[1]]], false)
    }

    #[test]
    fn walls_at_the_edge_hide_nothing_and_bodies_on_the_floor_do() {
        assert!(beside(&[]));
        assert!(beside(&[wall(1.0, [0.0, 1.0])]), "a wall at the edge");
        assert!(beside(&[wall(1.0, [-1.0, 1.0])]), "one that goes on below");
        assert!(beside(&[wall(0.95, [-1.0, -0.1])]), "one below the floor");
        assert!(!beside(&[wall(0.95, [0.0, 1.0])]), "a wall on the floor");
        assert!(beside(&[wall(0.6, [0.0, 1.0])]), "one out of reach");
        assert!(!beside(&[wall(1.0, [0.01, 1.0])]), "one that light passes under");
        let lid = face([[0.0, 0.0, 0.1], [1.0, 0.0, 0.1], [1.0, 1.0, 0.1], [0.0, 1.0, 0.1]], true);
        assert!(!beside(&[lid]), "a lid");
        let slope = |counts| face([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.9, 1.0, 0.4], [0.9, 0.0, 0.4]], counts);
        assert!(beside(&[slope(false)]), "a wall that leans over the floor");
        let tile = face([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 0.0]], true);
        assert!(beside(std::slice::from_ref(&tile)), "the next tile");
        let below = face([[0.0, 0.0, -0.1], [2.0, 0.0, -0.1], [2.0, 1.0, -0.1], [0.0, 1.0, -0.1]], true);
        assert!(!beside(&[below]), "a floor under the table");
        assert!(!beside(&[tile, wall(1.0, [0.0, 1.0])]), "a wall between two tiles");
    }
}
