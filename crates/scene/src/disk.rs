//! Disks, and the ellipses that uneven scale makes of them.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::{
    frame::{RIM, turn},
    parallelogram::Parallelogram,
    ray::Ray,
};

/// The ellipse inscribed in a parallelogram: the points `centre + a edge_u + b edge_v` with a^2 + b^2 <= 1.
///
/// As in Mitsuba, u is the radius in (a, b) and v its azimuth over 2 pi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// The parallelogram around it, with its middle, conjugate half-axes and normal.
    pub around: Parallelogram,
    /// Half of the smallest diameter, metres.
    smallest_radius: f64,
}

impl Disk {
    /// From the middle and two conjugate half-axes, which must not be parallel; `front` is any vector on the front side.
    pub fn new(centre: DVec3, edge_u: DVec3, edge_v: DVec3, front: DVec3) -> Self {
        let (e, f, g) = (edge_u.length_squared(), edge_u.dot(edge_v), edge_v.length_squared());
        let largest2 = 0.5 * (e + g) + (0.25 * (e - g).powi(2) + f * f).sqrt();
        let smallest_radius = edge_u.cross(edge_v).length() / largest2.sqrt();
        Self { around: Parallelogram::new(centre, edge_u, edge_v, front), smallest_radius }
    }

    /// Its radius in metres; `None` for an ellipse.
    pub(crate) fn circle_radius(&self) -> Option<f64> {
        let (u, v) = (self.around.edge_u.length(), self.around.edge_v.length());
        (self.around.is_rectangle() && (u - v).abs() <= 1e-9 * u).then_some(u)
    }

    /// Area in square metres.
    pub fn area(&self) -> f64 {
        0.25 * PI * self.around.area()
    }

    /// Distance along the ray where it meets the disk beyond `t_min`.
    pub fn intersect(&self, ray: &Ray, t_min: f64) -> Option<f64> {
        let (t, square) = self.around.intersect(ray, t_min)?;
        ((2.0 * square - 1.0).length() <= 1.0 + RIM).then_some(t)
    }

    /// (u, v) of a point on the disk.
    pub fn uv(&self, position: DVec3) -> DVec2 {
        let local = self.local(position);
        DVec2::new(local.length(), turn(local.extend(0.0)))
    }

    /// The point at (u, v) in [0, 1]^2.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.around.point(0.5 + 0.5 * uv.x * DVec2::from_angle(TAU * uv.y))
    }

    /// The share of the area within u.
    pub(crate) fn share_within(&self, u: f64) -> f64 {
        u * u
    }

    /// The u within which a share of the area lies.
    pub(crate) fn u_of_share(&self, share: f64) -> f64 {
        share.sqrt()
    }

    /// Distance in metres from a point on the disk to its edge: exact for circles, a lower bound for ellipses.
    pub fn distance_to_edge(&self, position: DVec3) -> f64 {
        self.smallest_radius * (1.0 - self.local(position).length())
    }

    /// Distance in metres from any point to the disk: exact for circles, a lower bound for ellipses.
    pub fn distance(&self, position: DVec3) -> f64 {
        let height = (position - self.around.centre).dot(self.around.normal);
        let beyond = self.smallest_radius * (self.local(position).length() - 1.0).max(0.0);
        height.hypot(beyond)
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let (u, v) = (self.around.edge_u, self.around.edge_v);
        let reach = (u * u + v * v).map(f64::sqrt);
        (self.around.centre - reach, self.around.centre + reach)
    }

    /// (a, b) of a point's shadow on the plane.
    fn local(&self, position: DVec3) -> DVec2 {
        2.0 * self.around.uv(position) - 1.0
    }
}
