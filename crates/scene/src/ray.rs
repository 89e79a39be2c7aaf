//! Rays.

use glam::DVec3;

/// A half-line in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, metres.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

impl Ray {
    /// From a start and a unit vector.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction }
    }

    /// From a start through a point that differs from it.
    pub fn towards(origin: DVec3, target: DVec3) -> Self {
        Self { origin, direction: (target - origin).normalize() }
    }

    /// The point at a distance in metres.
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + distance * self.direction
    }
}
