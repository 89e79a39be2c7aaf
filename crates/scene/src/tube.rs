//! Open tubes: the wall of a circular cylinder without its ends.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::{
    frame::{Frame, RIM, cylindrical, radial, turn},
    ray::Ray,
};

/// A ball of radius r around a point cuts the area pi r^2 (1 + (r / R)^2 / 32 + ...) from a tube of radius R: up to this
/// share of R, that is within 0.05 % of the disc that a density estimate assumes.
pub(crate) const FLAT_SHARE: f64 = 0.125;

/// The points at `radius` from the local z axis with z in [0, length]; u is azimuth over 2 pi, v is z over length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// The middle of one end, and the axis.
    pub frame: Frame,
    /// Metres.
    pub radius: f64,
    /// Metres.
    pub length: f64,
    /// True if the front side is the inside.
    pub inwards: bool,
}

impl Tube {
    /// Area in square metres.
    pub fn area(&self) -> f64 {
        TAU * self.radius * self.length
    }

    /// Distance along the ray to the wall beyond `t_min`.
    ///
    /// A ray that starts on this wall (`starts_here`) can meet it again only at the other end of the chord across the
    /// axis, whose length follows without any tolerance.
    pub fn intersect(&self, ray: &Ray, t_min: f64, starts_here: bool) -> Option<f64> {
        let Ray { origin, direction } = self.frame.local_ray(ray);
        let (o, d) = (origin.truncate(), direction.truncate());
        let d2 = d.length_squared();
        let nearest = -o.dot(d) / d2;
        // A ray along the axis gives infinities and NaNs, which fail here.
        let is_on = |t: f64, least: f64| {
            let v = (origin.z + t * direction.z) / self.length;
            t > least && t < f64::INFINITY && (-RIM..=1.0 + RIM).contains(&v)
        };
        if starts_here {
            let chord = 2.0 * nearest;
            return is_on(chord, 0.0).then_some(chord);
        }
        let across = o.perp_dot(d).abs() / d2.sqrt();
        if across > self.radius {
            return None;
        }
        let half_chord = ((self.radius - across) * (self.radius + across) / d2).sqrt();
        [nearest - half_chord, nearest + half_chord].into_iter().find(|&t| is_on(t, t_min))
    }

    /// Unit normal of the front side at a point of the wall.
    pub fn normal(&self, position: DVec3) -> DVec3 {
        let local = self.frame.local(position);
        let outwards = self.frame.axes * local.truncate().normalize().extend(0.0);
        if self.inwards { -outwards } else { outwards }
    }

    /// The point of the wall beside a given one.
    pub fn project(&self, position: DVec3) -> DVec3 {
        let local = self.frame.local(position);
        self.frame.world((self.radius * local.truncate().normalize()).extend(local.z.clamp(0.0, self.length)))
    }

    /// (u, v) of a point of the wall.
    pub fn uv(&self, position: DVec3) -> DVec2 {
        let local = self.frame.local(position);
        DVec2::new(turn(local), local.z / self.length)
    }

    /// The point at (u, v) in [0, 1]^2.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.frame.world(cylindrical(self.radius, uv.x, uv.y * self.length))
    }

    /// Distance in metres from a point on the wall to its nearer end.
    pub fn distance_to_edge(&self, position: DVec3) -> f64 {
        let z = self.frame.local(position).z;
        z.min(self.length - z)
    }

    /// Distance in metres from any point to the wall.
    pub fn distance(&self, position: DVec3) -> f64 {
        let local = self.frame.local(position);
        let beyond = (-local.z).max(local.z - self.length).max(0.0);
        (radial(local) - self.radius).hypot(beyond)
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.frame.bounds([0.0, self.length], self.radius)
    }
}
