//! An image with an edge: one half of the torus is lit with the irradiance 2, the other dark.
//!
//! At the distance `t r` from an edge the disc reads `2 s(t)` too much or too little, `s(t) = (acos t - t sqrt(1 - t^2)) / pi`. Over the
//! two edges and both sides of each the squared bias integrates to `16 c r`, `c = int_0^1 s^2 dt`; the variance to
//! `(1 / (pi r^2) - int mean^2) / N`, where `int mean^2 = 2 - 16 S r + 16 c r`, `S = int_0^1 s dt = 2 / (3 pi)`. All of it is exact up to
//! `r = 1/4`, where discs begin to reach both edges. (Catalogue entry H5.)

use std::f64::consts::PI;

use super::least::least;
use crate::{edge_laws::half_plane, quadrature::Gauss};

/// Discs wider than this (m) reach both edges.
pub const WIDEST: f64 = 0.25;

/// The error of a whole image, integrated over the torus, in units of the mean irradiance squared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageError {
    /// Of the bias.
    pub squared_bias: f64,
    /// Of the noise.
    pub variance: f64,
}

impl ImageError {
    /// Both: the mean integrated squared error.
    pub fn mean_squared(&self) -> f64 {
        self.squared_bias + self.variance
    }
}

/// The image's error with a radius (m, up to [`WIDEST`]) from this many photons. Exact.
pub fn fixed_radius(photons: f64, radius: f64) -> ImageError {
    let squared_bias = 16.0 * edge_constant() * radius;
    let mean_square = 2.0 - 32.0 / (3.0 * PI) * radius + squared_bias;
    ImageError { squared_bias, variance: (1.0 / (PI * radius * radius) - mean_square) / photons }
}

/// The radius with the least error of the image.
pub fn best_radius(photons: f64) -> f64 {
    least(1e-5, WIDEST, |radius| fixed_radius(photons, radius).mean_squared())
}

/// `c`, by quadrature over the angle `acos t`, in which it is smooth; good to 1e-14.
fn edge_constant() -> f64 {
    Gauss::new(20).integrate(0.0, 0.5 * PI, |angle| (1.0 - half_plane(angle.cos())).powi(2) * angle.sin())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// The catalogue's table H5.
    #[test]
    fn catalogue_values() {
        assert!((edge_constant() - 0.068105352).abs() < 1e-9);
        for (photons, radius, squared_bias, variance) in [
            (1e3, 0.083538568, 0.091030777, 0.043804289),
            (1e6, 0.0083597415, 0.0091094902, 0.0045527681),
            (1e8, 0.0018010521, 0.0019625806, 0.00098127047),
        ] {
            let best = best_radius(photons);
            assert!((best / radius - 1.0).abs() < 1e-6, "{best}");
            let error = fixed_radius(photons, best);
            assert!((error.squared_bias / squared_bias - 1.0).abs() < 1e-6);
            assert!((error.mean_squared() / (squared_bias + variance) - 1.0).abs() < 1e-8);
        }
    }

    /// Bias and binomial variance of every point, integrated along a row through both edges.
    #[test]
    fn the_integrals_are_the_points() {
        let (rule, photons) = (Gauss::new(20), 700.0);
        for radius in [0.03, 0.11, WIDEST] {
            let disc = PI * radius * radius;
            let mut image = ImageError { squared_bias: 0.0, variance: 0.0 };
            let mut add = |width: f64, truth: f64, mean: f64| {
                image.squared_bias += width * (mean - truth).powi(2);
                image.variance += width * mean * (1.0 - disc * mean) / (photons * disc);
            };
            add(0.5 - 2.0 * radius, 2.0, 2.0);
            for (angle, weight) in rule.nodes.iter().zip(&rule.weights).map(|(x, w)| (0.5 * PI * x, 0.5 * PI * w)) {
                let width = 2.0 * radius * weight * angle.sin();
                add(width, 2.0, 2.0 * half_plane(angle.cos()));
                add(width, 0.0, 2.0 * half_plane(-angle.cos()));
            }
            let exact = fixed_radius(photons, radius);
            assert!((image.squared_bias / exact.squared_bias - 1.0).abs() < 1e-9, "{radius}");
            assert!((image.variance / exact.variance - 1.0).abs() < 1e-9, "{radius}");
        }
    }

    /// Photons thrown on the lit half, read at random points; 1 comparison at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let (mut random, photons, radius) = (Random::new(142), 200, 0.12);
        let mut square = Moments::default();
        let round = |x: f64| x - x.round();
        for _ in 0..40_000 {
            let place = random.unit();
            let inside = |random: &mut Random| {
                let (x, y) = (round(random.between(0.0, 0.5) - place), random.between(-0.5, 0.5));
                f64::from(x * x + y * y < radius * radius)
            };
            let held: f64 = (0..photons).map(|_| inside(&mut random)).sum();
            let truth = if place < 0.5 { 2.0 } else { 0.0 };
            square.add((held / (f64::from(photons) * PI * radius * radius) - truth).powi(2));
        }
        square.must_agree("image", fixed_radius(f64::from(photons), radius).mean_squared());
    }
}
