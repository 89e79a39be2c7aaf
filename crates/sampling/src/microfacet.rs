//! Distributions of microfacet normals, drawn as seen from a direction.
//!
//! All directions are in the local frame of the surface: z along its normal, unit length.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_scene::{Microfacets, Roughness};
use statrs::function::erf::{erf, erf_inv};

use crate::turn;

/// Isotropic microfacets, Smith's masking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    roughness: Roughness,
}

impl Facets {
    /// Facets of a roughness.
    pub fn new(roughness: Roughness) -> Self {
        Self { roughness }
    }

    fn alpha(&self) -> f64 {
        self.roughness.alpha
    }

    /// Density D of facet normals per area of the surface and solid angle, 1/sr (Walter et al. 2007, eqs. 25 and 33).
    pub fn density(&self, m: DVec3) -> f64 {
        if m.z <= 0.0 {
            return 0.0;
        }
        let (a2, cos2) = (self.alpha() * self.alpha(), m.z * m.z);
        let tan2 = (m.x * m.x + m.y * m.y) / cos2;
        match self.roughness.facets {
            Microfacets::Ggx => 1.0 / (PI * a2 * cos2 * cos2 * (1.0 + tan2 / a2).powi(2)),
            Microfacets::Beckmann => (-tan2 / a2).exp() / (PI * a2 * cos2 * cos2),
        }
    }

    /// Share of the facets that are seen from `v` and not masked by others (Smith's G1, exact for both distributions); the
    /// same for `v` and -`v`.
    pub fn unmasked(&self, v: DVec3) -> f64 {
        let tan = (v.x * v.x + v.y * v.y).sqrt() / v.z.abs();
        if tan == 0.0 {
            return 1.0;
        }
        let a = 1.0 / (self.alpha() * tan);
        match self.roughness.facets {
            Microfacets::Ggx => 2.0 / (1.0 + (1.0 + 1.0 / (a * a)).sqrt()),
            Microfacets::Beckmann => 2.0 / (1.0 + erf(a) + (-a * a).exp() / (a * PI.sqrt())),
        }
    }

    /// Density per solid angle of [`Facets::draw_visible`]: G1(w) max(0, w.m) D(m) / w.z (Heitz 2014).
    pub fn visible_pdf(&self, w: DVec3, m: DVec3) -> f64 {
        self.unmasked(w) * w.dot(m).max(0.0) * self.density(m) / w.z
    }

    /// A facet normal drawn in proportion to what is seen of it from `w`, above the surface (Heitz, "Sampling the GGX
    /// distribution of visible normals", 2018; for Beckmann the slopes as in Jakob, "An improved visible normal sampling
    /// routine for the Beckmann distribution", 2014).
    pub fn draw_visible(&self, w: DVec3, xi: [f64; 2]) -> DVec3 {
        let a = self.alpha();
        let stretched = DVec3::new(a * w.x, a * w.y, w.z).normalize();
        let normal = match self.roughness.facets {
            Microfacets::Ggx => visible_on_hemisphere(stretched, xi),
            Microfacets::Beckmann => visible_beckmann(stretched, xi),
        };
        DVec3::new(a * normal.x, a * normal.y, normal.z.max(0.0)).normalize()
    }
}

/// A normal of the unit hemisphere in proportion to its projection towards `w`.
fn visible_on_hemisphere(w: DVec3, xi: [f64; 2]) -> DVec3 {
    let across = w.x * w.x + w.y * w.y;
    let tangent = if across > 0.0 { DVec3::new(-w.y, w.x, 0.0) / across.sqrt() } else { DVec3::X };
    let bitangent = w.cross(tangent);
    let radius = xi[0].sqrt();
    let (sin, cos) = turn::sin_cos(xi[1]);
    let t1 = radius * cos;
    let share = 0.5 * (1.0 + w.z);
    let t2 = (1.0 - share) * (1.0 - t1 * t1).max(0.0).sqrt() + share * radius * sin;
    t1 * tangent + t2 * bitangent + (1.0 - t1 * t1 - t2 * t2).max(0.0).sqrt() * w
}

/// The same for facets of unit Gaussian slopes.
fn visible_beckmann(w: DVec3, xi: [f64; 2]) -> DVec3 {
    let across = (w.x * w.x + w.y * w.y).sqrt();
    let slope_across = erf_inv(2.0 * xi[1] - 1.0);
    let slope_along = visible_slope(across / w.z, xi[0]);
    let (cos, sin) = if across > 0.0 { (w.x / across, w.y / across) } else { (1.0, 0.0) };
    let slope_x = cos * slope_along - sin * slope_across;
    let slope_y = sin * slope_along + cos * slope_across;
    DVec3::new(-slope_x, -slope_y, 1.0).normalize()
}

/// The slope along the view whose visible share below it is `xi`. In b = erf(slope) that share is
/// (1 + b + tan exp(-slope^2) / sqrt(pi)) over its value at the horizon, b = erf(1 / tan); the root is bracketed, and
/// found by Newton steps that fall back on halving.
fn visible_slope(tan: f64, xi: f64) -> f64 {
    let gauss = |slope: f64| tan * (-slope * slope).exp() / PI.sqrt();
    let horizon = if tan > 0.0 { 1.0 / tan } else { f64::INFINITY };
    let top = erf(horizon);
    let whole = 1.0 + top + gauss(horizon);
    let (mut low, mut high) = (-1.0, top);
    let mut b = low + xi * (high - low);
    for _ in 0..60 {
        let slope = erf_inv(b);
        let error = 1.0 + b + gauss(slope) - xi * whole;
        if error.abs() < 1e-13 * whole {
            break;
        }
        if error > 0.0 {
            high = b
        } else {
            low = b
        }
        let newton = b - error / (1.0 - slope * tan);
        b = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
    }
    erf_inv(b.clamp(-1.0 + 1e-15, 1.0 - 1e-15))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Purpose, Stream};

    fn all() -> impl Iterator<Item = (Facets, DVec3)> {
        let facets = [Microfacets::Ggx, Microfacets::Beckmann];
        let each = facets.into_iter().flat_map(|facets| [0.05, 0.3, 1.0].map(|alpha| Roughness { facets, alpha }));
        each.flat_map(|roughness| {
            [0.02f64, 0.5, 1.2, 1.5].map(|theta| (Facets::new(roughness), DVec3::new(theta.sin(), 0.0, theta.cos())))
        })
    }

    /// Integral over the hemisphere of f(m) by the midpoint rule in slopes' polar coordinates.
    fn integral(alpha: f64, f: impl Fn(DVec3) -> f64) -> f64 {
        let (rings, turns) = (4000, 512);
        let mut sum = 0.0;
        for ring in 0..rings {
            // tan = alpha t / (1 - t)^2 reaches the horizon as t goes to 1.
            let t = (f64::from(ring) + 0.5) / f64::from(rings);
            let tan = alpha * t / (1.0 - t).powi(2);
            let slope = alpha * (1.0 + t) / (1.0 - t).powi(3) / f64::from(rings);
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            for turn in 0..turns {
                let phi = 2.0 * PI * (f64::from(turn) + 0.5) / f64::from(turns);
                let m = DVec3::new(tan * cos * phi.cos(), tan * cos * phi.sin(), cos);
                sum += f(m) * tan * cos.powi(3) * slope * 2.0 * PI / f64::from(turns);
            }
        }
        sum
    }

    #[test]
    fn facets_cover_the_surface_and_visible_ones_fill_the_view() {
        for (facets, w) in all() {
            let cover = integral(facets.alpha(), |m| facets.density(m) * m.z);
            assert!((cover - 1.0).abs() < 1e-3, "{facets:?} {cover}");
            let seen = integral(facets.alpha(), |m| facets.visible_pdf(w, m));
            assert!((seen - 1.0).abs() < 2e-3, "{facets:?} {w} {seen}");
        }
    }

    /// Two means of the draws against quadrature, by z-test: 48 comparisons at |z| < 5, false alarm 3e-5 in all.
    #[test]
    fn draws_follow_their_density() {
        let mut stream = Stream::new(5, Purpose::Synthetic, 0, 0);
        let n = 40_000;
        for (facets, w) in all() {
            for moment in [|m: DVec3| m.x, |m: DVec3| m.z] {
                let exact = integral(facets.alpha(), |m| moment(m) * facets.visible_pdf(w, m));
                let (mut sum, mut squares) = (0.0, 0.0);
                for _ in 0..n {
                    let x = moment(facets.draw_visible(w, stream.next2()));
                    sum += x;
                    squares += x * x;
                }
                let mean = sum / f64::from(n);
                let error = ((squares / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
                assert!(
                    (mean - exact).abs() < 5.0 * error + 1e-3 * exact.abs(),
                    "{facets:?} {w}: {mean} {exact} {error}"
                );
            }
        }
    }
}
