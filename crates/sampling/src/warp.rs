//! Maps from the unit square to directions and points, each with its density.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::turn;

/// A right-handed orthonormal frame, z along a unit normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    tangent: DVec3,
    bitangent: DVec3,
    normal: DVec3,
}

impl Frame {
    /// Of a unit normal.
    pub fn around(normal: DVec3) -> Self {
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        Self { tangent, bitangent, normal }
    }

    /// A vector in the frame's axes.
    pub fn local(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.tangent), v.dot(self.bitangent), v.dot(self.normal))
    }

    /// The unit vector, in the scene's axes, of a vector in the frame's.
    pub fn world(&self, v: DVec3) -> DVec3 {
        (v.x * self.tangent + v.y * self.bitangent + v.z * self.normal).normalize()
    }
}

/// Unit square to the hemisphere around a unit normal, density cos / pi per solid angle.
pub fn square_to_cosine_hemisphere(xi: [f64; 2], normal: DVec3) -> DVec3 {
    let radius = xi[0].sqrt();
    let (sin, cos) = turn::sin_cos(xi[1]);
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    radius * cos * tangent + radius * sin * bitangent + (1.0 - xi[0]).max(0.0).sqrt() * normal
}

/// Density per solid angle of [`square_to_cosine_hemisphere`]; zero below the horizon.
pub fn cosine_hemisphere_pdf_solid_angle(cosine: f64) -> f64 {
    cosine.max(0.0) / PI
}

/// Unit square to the sphere of directions, density 1 / (4 pi) per solid angle.
pub fn square_to_uniform_sphere(xi: [f64; 2]) -> DVec3 {
    let z = 1.0 - 2.0 * xi[0];
    let radius = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = turn::sin_cos(xi[1]);
    DVec3::new(radius * cos, radius * sin, z)
}

/// Unit square to the unit disc across a unit vector, density 1 / pi per area.
pub(crate) fn square_to_uniform_disc(xi: [f64; 2], across: DVec3) -> DVec3 {
    let (sin, cos) = turn::sin_cos(xi[1]);
    let (tangent, bitangent) = across.any_orthonormal_pair();
    xi[0].sqrt() * (cos * tangent + sin * bitangent)
}

/// 1 - cos of the half-angle under which a sphere is seen from outside, its centre at an offset; from within, of a hemisphere.
pub(crate) fn cone_of_sphere(radius: f64, offset: DVec3) -> f64 {
    let sine2 = (radius * radius / offset.length_squared()).min(1.0);
    sine2 / (1.0 + (1.0 - sine2).sqrt())
}

/// Unit square to the cone of half-angle theta around a unit axis, density 1 / (2 pi (1 - cos theta)) per solid angle.
/// `one_minus_cos` is 1 - cos theta, which keeps its digits for narrow cones.
pub fn square_to_uniform_cone(xi: [f64; 2], axis: DVec3, one_minus_cos: f64) -> DVec3 {
    let drop = xi[0] * one_minus_cos;
    let radius = (drop * (2.0 - drop)).max(0.0).sqrt();
    let (sin, cos) = turn::sin_cos(xi[1]);
    let (tangent, bitangent) = axis.any_orthonormal_pair();
    radius * cos * tangent + radius * sin * bitangent + (1.0 - drop) * axis
}

/// Density per solid angle of [`square_to_uniform_cone`] inside its cone.
pub fn uniform_cone_pdf_solid_angle(one_minus_cos: f64) -> f64 {
    1.0 / (TAU * one_minus_cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Purpose, Stream};

    /// Chi-square of the draws against a density that depends on the cosine to the axis alone, in 32 cells of equal
    /// probability by cosine times 8 by azimuth (255 degrees of freedom). False alarm below 1e-5 each.
    fn chi_square(cdf_of_cosine: impl Fn(f64) -> f64, axis: DVec3, draw: impl Fn([f64; 2]) -> DVec3) -> f64 {
        let mut stream = Stream::new(11, Purpose::Synthetic, 0, 0);
        let (tangent, bitangent) = axis.any_orthonormal_pair();
        let mut cells = [0u32; 256];
        let n = 256_000;
        for _ in 0..n {
            let d = draw(stream.next2());
            assert!((d.length() - 1.0).abs() < 1e-12);
            let row = (cdf_of_cosine(d.dot(axis)) * 32.0).clamp(0.0, 31.0) as usize;
            let turn = d.dot(bitangent).atan2(d.dot(tangent)) / TAU + 0.5;
            cells[row * 8 + ((turn * 8.0) as usize).min(7)] += 1;
        }
        let expected = f64::from(n) / 256.0;
        cells.iter().map(|&c| (f64::from(c) - expected).powi(2) / expected).sum()
    }

    /// Chi-square with 255 degrees of freedom exceeds 360 with probability 1.5e-5.
    const LIMIT: f64 = 360.0;

    #[test]
    fn draws_follow_their_densities() {
        let axis = DVec3::new(0.36, -0.48, 0.8);
        assert!(chi_square(|c| c * c, axis, |xi| square_to_cosine_hemisphere(xi, axis)) < LIMIT);
        assert!(chi_square(|c| 0.5 * (c + 1.0), DVec3::Z, square_to_uniform_sphere) < LIMIT);
        let narrow = 0.01;
        let cone = |xi| square_to_uniform_cone(xi, axis, narrow);
        assert!(chi_square(|c| (1.0 - c) / narrow, axis, cone) < LIMIT);
        // A wrong density must be noticed: uniform by angle instead of by cosine.
        let wrong = |xi: [f64; 2]| square_to_cosine_hemisphere([(xi[0] * PI / 2.0).sin().powi(2), xi[1]], axis);
        assert!(chi_square(|c| c, axis, wrong) > 2.0 * LIMIT);
    }
}
