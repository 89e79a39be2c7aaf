//! Dishes: caps of spheres and paraboloids around their vertices, flat discs included.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::{
    frame::{Frame, RIM, cylindrical, radial, roots, turn},
    ray::Ray,
};

/// The section of a dish through its axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Part of a circle: z = c r^2 / (1 + sqrt(1 - c^2 r^2)).
    Circle,
    /// z = c r^2 / 2.
    Parabola,
}

/// The points c (r^2 + k z^2) = 2 z around the vertex, the local origin, out to a rim; k is 1 for a circle and 0 for a
/// parabola. u is the distance from the axis over that of the rim, v the azimuth over 2 pi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dish {
    /// The vertex, and the axis of symmetry.
    pub frame: Frame,
    /// Its section.
    pub section: Section,
    /// Curvature c at the vertex in 1/m; positive if it opens towards local +z, zero if flat.
    pub curvature: f64,
    /// Radius of the rim, metres; at most 1 / |c| for a circle.
    pub rim: f64,
    /// True if the front side looks towards local +z at the vertex.
    pub front_up: bool,
}

impl Dish {
    /// Area in square metres.
    pub fn area(&self) -> f64 {
        TAU * self.area_within(self.rim)
    }

    /// Height in metres over the vertex's plane at a distance from the axis.
    pub fn sag(&self, r: f64) -> f64 {
        let c = self.curvature;
        match self.section {
            Section::Circle => c * r * r / (1.0 + self.cosine(r)),
            Section::Parabola => 0.5 * c * r * r,
        }
    }

    /// Distance along the ray to the dish beyond `t_min`.
    ///
    /// A ray that starts on this dish (`starts_here`) can meet it again only at the other root of its equation, which then
    /// follows without any tolerance.
    pub fn intersect(&self, ray: &Ray, t_min: f64, starts_here: bool) -> Option<f64> {
        let Ray { origin: o, direction: d } = self.frame.local_ray(ray);
        let (c, k) = (self.curvature, self.k());
        let weigh = DVec3::new(1.0, 1.0, k);
        let a = c * (weigh * d).dot(d);
        let b = c * (weigh * o).dot(d) - d.z;
        // Flat dishes and rays along a paraboloid's axis give infinities and NaNs, which fail here.
        let is_on = |t: f64, least: f64| {
            let at = o + t * d;
            let within = radial(at) <= self.rim * (1.0 + RIM) && 1.0 - c * k * at.z >= -RIM;
            t > least && t < f64::INFINITY && within
        };
        if starts_here {
            let chord = -2.0 * b / a;
            return is_on(chord, 0.0).then_some(chord);
        }
        let both = roots(a, b, c * (weigh * o).dot(o) - 2.0 * o.z);
        both.into_iter().find(|&t| is_on(t, t_min))
    }

    /// Unit normal of the front side at a point of the dish.
    pub fn normal(&self, position: DVec3) -> DVec3 {
        let up = -self.frame.axes * self.gradient(self.frame.local(position)).normalize();
        if self.front_up { up } else { -up }
    }

    /// The point of the dish beside one that is nearly on it.
    pub fn project(&self, position: DVec3) -> DVec3 {
        let (c, k) = (self.curvature, self.k());
        let local = self.frame.local(position);
        let value = 0.5 * c * (local.truncate().length_squared() + k * local.z * local.z) - local.z;
        let gradient = self.gradient(local);
        self.frame.world(local - gradient * (value / gradient.length_squared()))
    }

    /// (u, v) of a point of the dish.
    pub fn uv(&self, position: DVec3) -> DVec2 {
        let local = self.frame.local(position);
        DVec2::new(radial(local) / self.rim, turn(local))
    }

    /// The point at (u, v) in [0, 1]^2.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        let r = uv.x * self.rim;
        self.frame.world(cylindrical(r, uv.y, self.sag(r)))
    }

    /// The share of the area within u.
    pub fn share_within(&self, u: f64) -> f64 {
        self.area_within(u * self.rim) / self.area_within(self.rim)
    }

    /// The u within which a share of the area lies.
    pub fn u_of_share(&self, share: f64) -> f64 {
        let area = share * self.area_within(self.rim);
        let c2 = self.curvature * self.curvature;
        let r2 = match self.section {
            Section::Circle => area * (2.0 - c2 * area),
            Section::Parabola => ((3.0 * c2 * area).ln_1p() * (2.0 / 3.0)).exp_m1() / c2,
        };
        (r2.max(0.0).sqrt() / self.rim).min(1.0)
    }

    /// Distance in metres from a point on the dish to its rim.
    pub fn distance_to_edge(&self, position: DVec3) -> f64 {
        let local = self.frame.local(position);
        (self.rim - radial(local)).hypot(self.sag(self.rim) - local.z)
    }

    /// Largest radius, metres, of a ball around a point of the dish, within its rim, that cuts an area from it as good as
    /// that of a disc: up to the radius of a sphere exactly (Archimedes); of other surfaces 1 + (r (c1 - c2))^2 / 32 times
    /// that with c1 and c2 the curvatures, which differ most near a paraboloid's vertex and by less than c.
    pub fn flat_within(&self) -> f64 {
        match self.section {
            Section::Circle => 1.0 / self.curvature.abs(),
            Section::Parabola => crate::tube::FLAT_SHARE / self.curvature.abs(),
        }
    }

    /// Distance in metres from any point to the dish.
    pub fn distance(&self, position: DVec3) -> f64 {
        let local = self.frame.local(position);
        let at = DVec2::new(radial(local), local.z);
        let foot = match self.section {
            Section::Circle => self.foot_on_circle(at),
            Section::Parabola => self.foot_on_parabola(at),
        };
        let foot = foot.min(self.rim);
        (at - DVec2::new(foot, self.sag(foot))).length()
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let sag = self.sag(self.rim);
        self.frame.bounds([sag.min(0.0), sag.max(0.0)], self.rim)
    }

    /// Weight of z^2 in the equation.
    fn k(&self) -> f64 {
        match self.section {
            Section::Circle => 1.0,
            Section::Parabola => 0.0,
        }
    }

    /// Half the gradient of c (r^2 + k z^2) - 2 z.
    fn gradient(&self, local: DVec3) -> DVec3 {
        let c = self.curvature;
        DVec3::new(c * local.x, c * local.y, c * self.k() * local.z - 1.0)
    }

    /// sqrt(1 - c^2 r^2).
    fn cosine(&self, r: f64) -> f64 {
        ((1.0 - self.curvature * r) * (1.0 + self.curvature * r)).max(0.0).sqrt()
    }

    /// Area within a distance from the axis over 2 pi.
    fn area_within(&self, r: f64) -> f64 {
        match self.section {
            Section::Circle => r * r / (1.0 + self.cosine(r)),
            Section::Parabola => {
                let c2 = self.curvature * self.curvature;
                (1.5 * (c2 * r * r).ln_1p()).exp_m1() / (3.0 * c2)
            }
        }
    }

    /// Distance from the axis of the nearest point to one at (r, z), had the dish no rim.
    fn foot_on_circle(&self, at: DVec2) -> f64 {
        if self.curvature == 0.0 {
            return at.x;
        }
        let radius = 1.0 / self.curvature;
        let from_centre = DVec2::new(at.x, at.y - radius);
        // Beyond the centre the nearest point of the whole half sphere is on its rim.
        if from_centre.y * radius >= 0.0 { f64::INFINITY } else { radius.abs() * from_centre.x / from_centre.length() }
    }

    /// The same for a paraboloid: the largest root of (c^2 / 2) r^3 + (1 - c z) r = r0, by Newton's steps from above, where
    /// the cubic is convex and they cannot overshoot.
    fn foot_on_parabola(&self, at: DVec2) -> f64 {
        let c = self.curvature;
        let linear = 1.0 - c * at.y;
        let mut r = (2.0 * at.x / (c * c)).cbrt() + (2.0 * (-linear).max(0.0)).sqrt() / c.abs();
        for _ in 0..200 {
            let value = 0.5 * c * c * r * r * r + linear * r - at.x;
            let slope = 1.5 * c * c * r * r + linear;
            let next = r - value / slope;
            if !(next < r && next >= 0.0) {
                break;
            }
            r = next;
        }
        r
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    use glam::DMat3;

    fn dishes() -> Vec<Dish> {
        let frame =
            Frame { origin: DVec3::new(0.3, -1.0, 2.0), axes: DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.9) };
        let dish = |section, curvature, rim| Dish { frame, section, curvature, rim, front_up: true };
        vec![
            dish(Section::Circle, 0.5, 1.2),
            dish(Section::Circle, -0.5, 2.0),
            dish(Section::Circle, 0.0, 0.7),
            dish(Section::Circle, 1e-9, 0.7),
            dish(Section::Parabola, 1.0, 1.2),
            dish(Section::Parabola, 0.2, 3.0),
        ]
    }

    /// Triangles of a fine net against the area, and against the share within a part of it.
    #[test]
    fn areas_and_shares_agree_with_a_fine_net() {
        for dish in dishes() {
            let n = 600;
            let ring = |i: usize| i as f64 / n as f64;
            let band = |i: usize| {
                let [a, b] = [ring(i), ring(i + 1)].map(|u| DVec2::new(u * dish.rim, dish.sag(u * dish.rim)));
                PI * (a.x + b.x) * (b - a).length()
            };
            let whole: f64 = (0..n).map(band).sum();
            let half: f64 = (0..n / 2).map(band).sum();
            assert!((whole / dish.area() - 1.0).abs() < 3e-5, "{dish:?}: {whole} {}", dish.area());
            assert!((half / whole - dish.share_within(0.5)).abs() < 3e-5);
            for share in [0.01, 0.3, 0.9, 1.0] {
                assert!((dish.share_within(dish.u_of_share(share)) - share).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn rays_meet_the_points_they_are_aimed_at_and_chords_end_on_the_dish() {
        for dish in dishes() {
            for uv in [DVec2::new(0.1, 0.2), DVec2::new(0.9, 0.7), DVec2::new(0.5, 0.95)] {
                let target = dish.point(uv);
                assert!((dish.uv(target) - uv).length() < 1e-9);
                let origin = target + 0.3 * dish.normal(target) + 0.05 * dish.frame.axes.x_axis;
                let ray = Ray::towards(origin, target);
                let t = dish.intersect(&ray, 0.0, false).expect("it was aimed there");
                assert!((ray.at(t) - target).length() < 1e-12, "{dish:?} {uv}");
                assert!((dish.project(target + 1e-9 * dish.normal(target)) - target).length() < 1e-12);
                let [near, far] = [uv, DVec2::new(0.3, uv.y + 0.45)].map(|uv| dish.point(uv));
                let chord = Ray::towards(near, far);
                let meets = dish.intersect(&chord, 0.0, true);
                if dish.curvature == 0.0 {
                    assert!(meets.is_none());
                } else if dish.curvature.abs() > 1e-6 {
                    assert!((meets.expect("a chord") - (far - near).length()).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn distances_agree_with_a_dense_search() {
        for dish in dishes() {
            let probes = [[0.0, 0.0, 0.1], [0.3, -0.2, 0.5], [2.0, 1.0, 0.3], [0.1, 0.1, 4.0], [0.5, 0.0, -2.0]];
            for probe in probes.map(|p| dish.frame.world(DVec3::from_array(p))) {
                let n = 500;
                let nearest = (0..=n)
                    .flat_map(|i| (0..n).map(move |j| DVec2::new(i as f64, j as f64) / n as f64))
                    .map(|uv| (dish.point(uv) - probe).length())
                    .fold(f64::INFINITY, f64::min);
                let found = dish.distance(probe);
                assert!(found <= nearest + 1e-9 && nearest - found < 0.02, "{dish:?} {probe}: {found} {nearest}");
            }
        }
    }
}
