//! Points of a rectangle, uniform in the solid angle under which it is seen.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_scene::Parallelogram;

/// Below this solid angle the formulae lose their digits and the rectangle is so far or so edge-on that drawing by area
/// is as good.
const SMALLEST: f64 = 1e-5;

/// A rectangle seen from a point (Ureña, Fajardo and King, "An area-preserving parametrization for spherical
/// rectangles", EGSR 2013).
///
/// *Numerics*: the solid angle is a difference of angles, good to about 1e-15 absolutely, hence [`SMALLEST`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SphericalRectangle {
    from: DVec3,
    axes: [DVec3; 3],
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    b0: f64,
    b1: f64,
    k: f64,
    /// In steradians.
    pub(crate) solid_angle: f64,
}

impl SphericalRectangle {
    /// `None` for a face that is no rectangle, or one seen under next to no solid angle.
    pub(crate) fn new(face: &Parallelogram, from: DVec3) -> Option<Self> {
        let (half_x, half_y) = (face.edge_u.length(), face.edge_v.length());
        if !face.is_rectangle() {
            return None;
        }
        let (x_axis, y_axis) = (face.edge_u / half_x, face.edge_v / half_y);
        let offset = face.centre - from;
        let mut z_axis = x_axis.cross(y_axis);
        let mut z = offset.dot(z_axis);
        if z > 0.0 {
            (z_axis, z) = (-z_axis, -z);
        }
        let x = [offset.dot(x_axis) - half_x, offset.dot(x_axis) + half_x];
        let y = [offset.dot(y_axis) - half_y, offset.dot(y_axis) + half_y];
        // Normals of the four planes through the point and an edge, and the inner angles between them.
        let corner = |i: usize, j: usize| DVec3::new(x[i], y[j], z);
        let [v00, v10, v11, v01] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        let plane = |a: DVec3, b: DVec3| a.cross(b).normalize_or_zero();
        let n = [plane(v00, v10), plane(v10, v11), plane(v11, v01), plane(v01, v00)];
        let angle = |i: usize| (-n[i].dot(n[(i + 1) % 4])).clamp(-1.0, 1.0).acos();
        let k = 2.0 * PI - angle(2) - angle(3);
        let solid_angle = angle(0) + angle(1) - k;
        (solid_angle > SMALLEST).then_some(Self {
            from,
            axes: [x_axis, y_axis, z_axis],
            x,
            y,
            z,
            b0: n[0].z,
            b1: n[2].z,
            k,
            solid_angle,
        })
    }

    /// Unit square to the rectangle, density 1 / solid angle per solid angle.
    pub(crate) fn point(&self, xi: [f64; 2]) -> DVec3 {
        let turn = xi[0] * self.solid_angle + self.k;
        let f = (turn.cos() * self.b0 - self.b1) / turn.sin();
        let c = (f.signum() / (f * f + self.b0 * self.b0).sqrt()).clamp(-1.0, 1.0);
        let x = (-(c * self.z) / (1.0 - c * c).max(1e-24).sqrt()).clamp(self.x[0], self.x[1]);
        let d2 = x * x + self.z * self.z;
        let height = |y: f64| y / (d2 + y * y).sqrt();
        let (low, high) = (height(self.y[0]), height(self.y[1]));
        let h = low + xi[1] * (high - low);
        let y = (h * d2.sqrt() / (1.0 - h * h).max(1e-24).sqrt()).clamp(self.y[0], self.y[1]);
        self.from + x * self.axes[0] + y * self.axes[1] + self.z * self.axes[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Purpose, Stream};

    /// The integral of a function of direction over the rectangle's solid angle, by the draws and by a midpoint rule over
    /// the rectangle's area (error below 1e-5 here); z below 4.5 for 12 comparisons, false alarm below 1e-4.
    #[test]
    fn draws_are_uniform_in_solid_angle() {
        let face = Parallelogram::new(
            DVec3::new(0.2, -0.1, 1.0),
            0.7 * DVec3::new(0.8, 0.6, 0.0),
            0.3 * DVec3::new(-0.6, 0.8, 0.0),
            -DVec3::Z,
        );
        for from in [DVec3::ZERO, DVec3::new(0.3, 0.2, 0.6), DVec3::new(-2.0, 1.0, 0.4), DVec3::new(0.2, 0.0, 2.5)] {
            let seen = SphericalRectangle::new(&face, from).unwrap();
            let tests: [fn(DVec3) -> f64; 3] = [|_| 1.0, |d| d.x * d.y + 0.3 * d.z, |d| (3.0 * d.x).sin() + d.y * d.y];
            for f in tests {
                let n = 1000;
                let by_area: f64 = (0..n * n)
                    .map(|i| {
                        let uv = glam::DVec2::new((i % n) as f64 + 0.5, (i / n) as f64 + 0.5) / n as f64;
                        let offset = face.point(uv) - from;
                        let cosine = (offset.dot(face.normal) / offset.length()).abs();
                        f(offset.normalize()) * cosine / offset.length_squared()
                    })
                    .sum::<f64>()
                    * face.area()
                    / (n * n) as f64;
                let mut stream = Stream::new(5, Purpose::Synthetic, 0, 0);
                let draws = 200_000;
                let (mut sum, mut squares) = (0.0, 0.0);
                for _ in 0..draws {
                    let value = f((seen.point(stream.next2()) - from).normalize()) * seen.solid_angle;
                    sum += value;
                    squares += value * value;
                }
                let mean = sum / draws as f64;
                let error =
                    ((squares / draws as f64 - mean * mean).max(0.0) / draws as f64).sqrt() + 1e-5 * by_area.abs();
                assert!((mean - by_area).abs() < 4.5 * error, "{from}: {mean} against {by_area}, error {error}");
            }
        }
    }
}
