//! A V-groove without end whose two faces emit and reflect.
//!
//! Faces of length 1 meet at the angle `theta`; both send out the exitance 1 and reflect `rho`; the top is open and dark. In
//! the cross-section the irradiance at the distance `x` from the apex is `E(x) = int_0^1 K(x, z) (1 + rho E(z)) dz` with
//! `K = (1/2) sin^2(theta) x z / (x^2 + z^2 - 2 x z cos theta)^(3/2)`, and of the light that leaves `x` the share
//! `F(x) = (1/2) [1 - (x - cos theta) / sqrt(1 + x^2 - 2 x cos theta)]` meets the other face. (Two-dimensional radiosity;
//! catalogue entry D6.)
//!
//! In `t = -ln x` the kernel is a bump of width `theta` that depends on the difference alone, so panels of equal length in
//! `t` resolve it everywhere. Near the apex `E` departs from its limit like `x^alpha`; at 90 degrees an infinite wedge
//! with emission `x^a` has `K x^a = m(a) x^a`, `m(a) = Beta(1 + a/2, (1 - a)/2) / 4`, and `rho m(alpha) = 1`.

use std::f64::consts::PI;

use statrs::function::beta::beta;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_albedo};
use crate::quadrature::Gauss;

/// A groove, solved. Precision: 1e-6 for angles from 30 degrees up, from the difference of two meshes.
pub struct Groove {
    angle: f64,
    reflectance: f64,
    nodes: Vec<f64>,
    /// Weights for integrals over the distance from the apex.
    weights: Vec<f64>,
    irradiance: Vec<f64>,
}

/// Depth of the mesh in `t`: what lies nearer to the apex than `exp(-DEPTH)` is left out.
const DEPTH: f64 = 24.0;

impl Groove {
    /// A groove that opens by `angle` (radians, from 0.5 to below pi), its faces of this reflectance.
    pub fn new(angle: f64, reflectance: f64) -> Result<Self, OutOfRange> {
        require((0.5..PI).contains(&angle), "angle", angle, "at least 0.5 and below pi")?;
        require_albedo("reflectance", reflectance)?;
        Ok(Groove::on_mesh(angle, reflectance, 8))
    }

    fn on_mesh(angle: f64, reflectance: f64, order: usize) -> Self {
        let (rule, panels) = (Gauss::new(order), (DEPTH / (0.6 * angle.min(1.0))).ceil());
        let step = DEPTH / panels;
        let (mut nodes, mut weights) = (Vec::new(), Vec::new());
        for panel in 0..panels as usize {
            for (x, w) in rule.nodes.iter().zip(&rule.weights) {
                let z = (-step * (panel as f64 + x)).exp();
                nodes.push(z);
                weights.push(step * w * z);
            }
        }
        let mut groove = Groove { angle, reflectance, irradiance: vec![0.0; nodes.len()], nodes, weights };
        let rows: Vec<Vec<f64>> = groove.nodes.iter().map(|&x| groove.row(x)).collect();
        for _ in 0..400 {
            let exitance: Vec<f64> = groove.irradiance.iter().map(|e| 1.0 + reflectance * e).collect();
            let next: Vec<f64> = rows.iter().map(|row| row.iter().zip(&exitance).map(|(k, b)| k * b).sum()).collect();
            let change = next.iter().zip(&groove.irradiance).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            groove.irradiance = next;
            if change < 1e-14 {
                break;
            }
        }
        groove
    }

    fn row(&self, x: f64) -> Vec<f64> {
        let (sine, cosine) = self.angle.sin_cos();
        let kernel = |z: f64| 0.5 * sine * sine * x * z / (x * x + z * z - 2.0 * x * z * cosine).powf(1.5);
        self.nodes.iter().zip(&self.weights).map(|(&z, w)| w * kernel(z)).collect()
    }

    /// Irradiance of either face at this distance from the apex, in `(1e-6, 1]` face lengths, per unit of exitance.
    pub fn irradiance(&self, x: f64) -> f64 {
        let terms = self.row(x).into_iter().zip(&self.irradiance);
        terms.map(|(k, e)| k * (1.0 + self.reflectance * e)).sum()
    }

    /// Flux out of the groove's top per area of the top, per unit of exitance.
    pub fn apparent_exitance(&self) -> f64 {
        let leaves = |x: f64| 0.5 * (1.0 + (x - self.angle.cos()) / (1.0 + x * x - 2.0 * x * self.angle.cos()).sqrt());
        let face = self.nodes.iter().zip(&self.weights).zip(&self.irradiance);
        let flux: f64 = face.map(|((&x, w), e)| w * leaves(x) * (1.0 + self.reflectance * e)).sum();
        flux / (0.5 * self.angle).sin()
    }

    /// The most that a groove cut off at this distance (face lengths) to either side lacks of [`Groove::irradiance`] in its
    /// middle: what is cut off is seen under `x z / (pi y^4)` and shines with at most `1 / (1 - rho)`, and the
    /// loss is passed on by at most the same factor.
    pub fn truncation(&self, half_length: f64) -> f64 {
        1.0 / (3.0 * PI * half_length.powi(3) * (1.0 - self.reflectance).powi(2))
    }

    /// The groove along y with its apex at the bottom, and radiance meters at its open top that look at these distances
    /// from the apex on one face.
    fn case(&self, distances: &[f64]) -> Case {
        let (half, mut draft) = (100.0, Draft::default());
        let on_it = mitsuba::diffuse(&[self.reflectance]) + &mitsuba::area_lamp(&[1.0 / PI]);
        let (sine, cosine) = (0.5 * self.angle).sin_cos();
        for (i, side) in [-1.0, 1.0].into_iter().enumerate() {
            let (up, normal) = ([side * sine, 0.0, cosine], [-side * cosine, 0.0, sine]);
            let place = Place { centre: up.map(|x| 0.5 * x), normal, up, half: [half, 0.5] };
            draft.add(&mitsuba::flat("rectangle", &format!("face-{i}"), place, &on_it));
        }
        for &x in distances {
            let radiance = (1.0 + self.reflectance * self.irradiance(x)) / PI;
            let target = [x * sine, 0.0, x * cosine];
            draft.radiance([-0.2 * sine, 0.1, 0.9 * cosine], target, &[radiance], 1e-6 + self.truncation(half));
        }
        draft.case(format!("{:.0} degrees, reflectance {}", self.angle.to_degrees(), self.reflectance))
    }
}

/// The factor by which the infinite 90-degree wedge multiplies an exitance `x^a`, `-2 < a < 1`.
pub fn right_angle_symbol(a: f64) -> f64 {
    0.25 * beta(1.0 + 0.5 * a, 0.5 * (1.0 - a))
}

/// The exponent with which the irradiance departs from its limit at the apex of a 90-degree wedge of this reflectance, in
/// `(0, 1)`: bisection, 1e-12.
pub fn right_angle_exponent(reflectance: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0 - 1e-9);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if reflectance * right_angle_symbol(middle) < 1.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The catalogue's D6: four angles, two reflectances.
pub fn cases() -> Vec<Case> {
    let solve = |degrees: f64, rho: f64| Groove::on_mesh(degrees.to_radians(), rho, 8);
    let all = [30.0, 60.0, 90.0, 120.0].into_iter().flat_map(|angle| [0.5, 0.9].map(|rho| solve(angle, rho)));
    all.map(|groove| groove.case(&[0.01, 0.1, 0.5, 0.9])).collect()
}

#[cfg(test)]
mod checks;
