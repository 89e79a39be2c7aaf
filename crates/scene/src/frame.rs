//! The axes of a surface of revolution.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use crate::ray::Ray;

/// Share of a length by which round surfaces reach over their rims, so that parts which meet there overlap by a few rounding
/// errors instead of leaving a slit between them.
pub(crate) const RIM: f64 = 1e-12;

/// Where a surface of revolution stands: local +z is its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The local origin, metres.
    pub origin: DVec3,
    /// The local axes as columns: orthonormal, possibly left-handed.
    pub axes: DMat3,
}

impl Frame {
    /// A position in local coordinates, metres.
    pub fn local(&self, position: DVec3) -> DVec3 {
        self.axes.transpose() * (position - self.origin)
    }

    /// The position at local coordinates, metres.
    pub fn world(&self, local: DVec3) -> DVec3 {
        self.origin + self.axes * local
    }

    /// The ray in local coordinates; distances along it stay the same.
    pub(crate) fn local_ray(&self, ray: &Ray) -> Ray {
        Ray::new(self.local(ray.origin), self.axes.transpose() * ray.direction)
    }

    /// Smallest and largest world coordinates of the cylinder of a radius between two heights.
    pub(crate) fn bounds(&self, heights: [f64; 2], radius: f64) -> (DVec3, DVec3) {
        let (x, y, axis) = (self.axes.x_axis, self.axes.y_axis, self.axes.z_axis);
        let reach = radius * (x * x + y * y).map(f64::sqrt);
        let ends = heights.map(|height| self.origin + height * axis);
        (ends[0].min(ends[1]) - reach, ends[0].max(ends[1]) + reach)
    }
}

/// Azimuth over 2 pi of a local position, in [0, 1).
pub(crate) fn turn(local: DVec3) -> f64 {
    let share = local.y.atan2(local.x) / TAU;
    if share < 0.0 { (share + 1.0).min(1.0f64.next_down()) } else { share }
}

/// Distance from the axis.
pub(crate) fn radial(local: DVec3) -> f64 {
    local.truncate().length()
}

/// The local position at a distance from the axis, an azimuth over 2 pi and a height.
pub(crate) fn cylindrical(radius: f64, turn: f64, height: f64) -> DVec3 {
    let (sin, cos) = (TAU * turn).sin_cos();
    DVec3::new(radius * cos, radius * sin, height)
}

/// The roots of a t^2 + 2 b t + c in rising order; NaN where there is none, infinite where a is zero.
pub(crate) fn roots(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - a * c).sqrt();
    // Adding numbers of one sign keeps the digits that the textbook formula loses.
    let q = -(b + root.copysign(b));
    let (first, second) = (q / a, c / q);
    if first <= second { [first, second] } else { [second, first] }
}
