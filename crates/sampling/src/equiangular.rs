//! Draws around a lamp without extent in a medium.
//!
//! Where a ray passes such a lamp at a distance D, the light that is scattered into it goes like one over the squared distance
//! to the lamp, whose integral along the ray goes like 1 / D. Drawn by [`Equiangular`], every point of the ray counts alike;
//! drawn by [`AroundPoint`], so does every ray that starts where the last one was scattered. Both together keep the
//! variance of a path finite, where collisions drawn by the medium alone have none.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_scene::Ray;

use crate::{Stream, turn};

/// A ray that hits a lamp passes it at this share of the distance to it.
const MISS: f64 = 1e-9;

/// Distances along a ray, evenly in the angle under which they are seen from a point (Kulla and Fajardo, "Importance sampling
/// techniques for path tracing in participating media", 2012).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equiangular {
    /// Distance along the ray to where it is nearest to the point, and how near that is, metres.
    foot: f64,
    miss: f64,
    /// The angles of both ends of the ray.
    from: f64,
    to: f64,
}

impl Equiangular {
    /// Around a point, up to a distance that may be infinite. `None` if the point is where the ray starts.
    pub fn new(ray: &Ray, point: DVec3, reach: f64) -> Option<Self> {
        let offset = point - ray.origin;
        let foot = offset.dot(ray.direction);
        let miss = (offset - foot * ray.direction).length().max(MISS * offset.length());
        let [from, to] = [-foot, reach - foot].map(|along| (along / miss).atan());
        (miss > 0.0 && to > from).then_some(Self { foot, miss, from, to })
    }

    /// A distance in metres, from one number.
    pub fn draw(&self, xi: f64) -> f64 {
        self.foot + self.miss * (self.from + xi * (self.to - self.from)).tan()
    }

    /// Density per metre.
    pub fn pdf(&self, distance: f64) -> f64 {
        let along = distance - self.foot;
        self.miss / ((self.to - self.from) * (self.miss * self.miss + along * along))
    }
}

/// Directions towards a point and around it: as many in each step of the angle to it, so that the density per solid angle goes
/// like one over the sine of that angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AroundPoint {
    axis: DVec3,
}

impl AroundPoint {
    /// As seen from a position; `None` from the point itself.
    pub fn new(from: DVec3, point: DVec3) -> Option<Self> {
        (point - from).try_normalize().map(|axis| Self { axis })
    }

    /// A unit vector.
    pub fn draw(&self, stream: &mut Stream) -> DVec3 {
        let [angle, turn] = stream.next2();
        let (x, y) = self.axis.any_orthonormal_pair();
        let (sine, cosine) = (PI * angle).sin_cos();
        let (sin, cos) = turn::sin_cos(turn);
        (cosine * self.axis + sine * (cos * x + sin * y)).normalize()
    }

    /// Density per solid angle; infinite along the axis.
    pub fn pdf_solid_angle(&self, direction: DVec3) -> f64 {
        1.0 / (2.0 * PI * PI * self.axis.cross(direction).length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Purpose;

    /// What is drawn has the density that is told: its integral up to each draw is the number it was drawn from.
    #[test]
    fn distances_have_their_density() {
        let ray = Ray::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.6, 0.0, 0.8));
        for (point, reach) in [
            (DVec3::new(2.0, -1.5, 1.0), 3.0),
            (DVec3::new(-4.0, 0.0, 0.0), 0.7),
            (DVec3::new(1.3, -1.9, 1.1), f64::INFINITY),
        ] {
            let line = Equiangular::new(&ray, point, reach).expect("they differ");
            for xi in [0.1, 0.5, 0.83] {
                let distance = line.draw(xi);
                assert!((0.0..=reach).contains(&distance));
                let steps = 200_000;
                let at = |i: i32| distance * (f64::from(i) + 0.5) / f64::from(steps);
                let integral: f64 = (0..steps).map(|i| line.pdf(at(i)) * distance / f64::from(steps)).sum();
                assert!((integral - xi).abs() < 1e-6, "{xi}: {integral}");
            }
        }
        assert!(Equiangular::new(&ray, ray.origin, 1.0).is_none());
        let through = Equiangular::new(&ray, ray.at(2.0), 3.0).expect("a ray through the lamp");
        assert!((through.draw(0.5) - 2.0).abs() < 1e-6 && through.pdf(1.0).is_finite());
    }

    /// The mean of one over the density is the sphere's solid angle, over each half of it half of that. 3 comparisons at
    /// |z| < 5.
    #[test]
    fn directions_have_their_density() {
        let around = AroundPoint::new(DVec3::ZERO, DVec3::new(1.0, 2.0, -1.0)).expect("they differ");
        let mut stream = Stream::new(47, Purpose::Synthetic, 0, 0);
        let n = 200_000;
        let (mut sums, mut squares) = ([0.0; 3], [0.0; 3]);
        for _ in 0..n {
            let direction = around.draw(&mut stream);
            let inverse = 1.0 / around.pdf_solid_angle(direction);
            for (axis, side) in direction.to_array().into_iter().enumerate() {
                let part = if side > 0.0 { inverse } else { 0.0 };
                sums[axis] += part;
                squares[axis] += part * part;
            }
        }
        for axis in 0..3 {
            let mean = sums[axis] / f64::from(n);
            let error = ((squares[axis] / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
            assert!((mean - 2.0 * PI).abs() < 5.0 * error, "{axis}: {mean}");
        }
        assert!(AroundPoint::new(DVec3::ONE, DVec3::ONE).is_none());
    }
}
