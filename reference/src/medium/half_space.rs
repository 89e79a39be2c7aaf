//! A medium that fills half of space and scatters isotropically: Chandrasekhar's H function.
//!
//! For albedo `w` and cosine `mu`: `1/H(mu) = sqrt(1 - w) + (w/2) int_0^1 nu H(nu) / (mu + nu) dnu`. Of a beam that falls in at
//! `mu` the share `1 - sqrt(1 - w) H(mu)` comes back, of diffuse light `1 - 2 sqrt(1 - w) int H mu dmu`; the reflected
//! radiance at `nu` for a beam of flux 1 per area across it is `w/(4 pi) mu/(mu + nu) H(mu) H(nu)`. (Chandrasekhar,
//! "Radiative Transfer", 1960, chapters 4 and 5; catalogue entry F6.) Solved by iteration on graded nodes, 1e-9.

use std::f64::consts::PI;

use crate::catalogue::Case;
use crate::medium::infinite::InfiniteMedium;
use crate::medium::slab::tray;
use crate::mitsuba::Medium;
use crate::out_of_range::{OutOfRange, require};
use crate::quadrature::Gauss;

/// The half-space of one albedo.
pub struct HalfSpace {
    albedo: f64,
    /// Cosines, weights and values of H.
    nodes: Vec<[f64; 3]>,
}

impl HalfSpace {
    /// A half-space of this `albedo`, from 0 to 1.
    pub fn new(albedo: f64) -> Result<Self, OutOfRange> {
        require((0.0..=1.0).contains(&albedo), "albedo", albedo, "between 0 and 1")?;
        // mu = u^3 grades the nodes towards 0, where H has a logarithm in its slope.
        let rule = Gauss::new(80);
        let node = |(u, w): (&f64, &f64)| [u.powi(3), 3.0 * u * u * w, 1.0];
        let mut half = HalfSpace { albedo, nodes: rule.nodes.iter().zip(&rule.weights).map(node).collect() };
        for _ in 0..2000 {
            let next: Vec<f64> = half.nodes.iter().map(|[mu, ..]| half.h(*mu)).collect();
            let change = half.nodes.iter().zip(&next).map(|(node, h)| (node[2] - h).abs()).fold(0.0, f64::max);
            // The average of both steps: without loss the iteration alone swings.
            half.nodes.iter_mut().zip(next).for_each(|(node, h)| node[2] = 0.5 * (node[2] + h));
            if change < 1e-14 {
                break;
            }
        }
        Ok(half)
    }

    /// `H(mu)`.
    pub fn h(&self, mu: f64) -> f64 {
        let integral: f64 = self.nodes.iter().map(|[nu, w, h]| w * nu * h / (mu + nu)).sum();
        1.0 / ((1.0 - self.albedo).sqrt() + 0.5 * self.albedo * integral)
    }

    /// Share of a beam that comes back, for the cosine of incidence `mu`.
    pub fn plane_albedo(&self, mu: f64) -> f64 {
        1.0 - (1.0 - self.albedo).sqrt() * self.h(mu)
    }

    /// Share of diffuse light that comes back.
    pub fn spherical_albedo(&self) -> f64 {
        let moment: f64 = self.nodes.iter().map(|[mu, w, h]| w * mu * h).sum();
        1.0 - 2.0 * (1.0 - self.albedo).sqrt() * moment
    }

    /// Radiance at the cosine `nu` by a beam of flux 1 per area across it at the cosine of incidence `mu`.
    pub fn radiance(&self, mu: f64, nu: f64) -> f64 {
        self.albedo / (4.0 * PI) * mu / (mu + nu) * self.h(mu) * self.h(nu)
    }

    /// A deep, wide block under an environment of radiance 1: by reciprocity it shows its plane albedo in every direction.
    fn case(&self, cosines: &[f64]) -> Result<Case, OutOfRange> {
        // Light dies away like exp(-k depth) on the way down, and again on the way back or sideways.
        let depth = 14.0 / InfiniteMedium::new(self.albedo)?.decay();
        let medium = Medium { extinction: 1.0, albedo: self.albedo, asymmetry: 0.0 };
        let mut draft = tray(depth, depth, medium);
        draft.add(&crate::mitsuba::constant_light(&[1.0]));
        for &mu in cosines {
            let from = [2.0 * (1.0 - mu * mu).sqrt(), 0.0, depth + 2.0 * mu];
            draft.radiance(from, [0.0, 0.0, depth], &[self.plane_albedo(mu)], 4.0 * (-14f64).exp());
        }
        Ok(draft.case(format!("albedo {}", self.albedo)))
    }
}

/// The catalogue's F6 below albedo 1, at which no finite block is deep enough.
pub fn cases() -> Vec<Case> {
    let albedos = [0.5, 0.9, 0.99].into_iter();
    albedos.flat_map(|albedo| HalfSpace::new(albedo).and_then(|half| half.case(&[1.0, 0.5, 0.1]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Catalogue F6: albedo, H at 1, 0.5 and 0.1, spherical albedo.
    #[test]
    fn catalogue_values() {
        for (w, values, spherical) in [
            (0.5, [1.2512596, 1.1877351, 1.0723688], 0.14654438),
            (0.9, [1.8500985, 1.5560338, 1.1721431], 0.47802449),
            (0.99, [2.4727928, 1.848601, 1.2248753], 0.79456365),
            (1.0, [2.9078105, 2.0127788, 1.2473504], 1.0),
        ] {
            let half = HalfSpace::new(w).expect("valid");
            for (mu, want) in [1.0, 0.5, 0.1].into_iter().zip(values) {
                assert!((half.h(mu) / want - 1.0).abs() < 1e-7, "{w} {mu}: {}", half.h(mu));
            }
            assert!((half.spherical_albedo() - spherical).abs() < 1e-8, "{w}: {}", half.spherical_albedo());
        }
        assert!(HalfSpace::new(1.1).is_err());
    }

    /// The closed form of H (Fox 1961): a single integral over the angle.
    #[test]
    fn the_single_integral_agrees() {
        for (w, mu) in [(0.5, 1.0), (0.9, 0.3), (0.99, 0.05)] {
            let half = HalfSpace::new(w).expect("valid");
            let at = |x: f64| (1.0 - w * x / x.tan()).ln() / (x.cos().powi(2) + mu * mu * x.sin().powi(2));
            let integral = Gauss::new(32).composite(0.0, 0.5 * PI, 40, at);
            let h = (-mu / PI * integral).exp();
            assert!((half.h(mu) / h - 1.0).abs() < 1e-9, "{w} {mu}: {} {h}", half.h(mu));
        }
    }

    /// The reflected radiance carries the plane albedo.
    #[test]
    fn the_radiance_adds_up() {
        let half = HalfSpace::new(0.9).expect("valid");
        let flux = 2.0 * PI * Gauss::new(32).composite(0.0, 1.0, 16, |nu| nu * half.radiance(0.4, nu));
        assert!((flux - 0.4 * half.plane_albedo(0.4)).abs() < 1e-8, "{flux}");
    }

    /// Random walks that start at two cosines: 2 comparisons at 4.5 standard errors.
    #[test]
    fn random_walks_agree() {
        let (half, mut random) = (HalfSpace::new(0.9).expect("valid"), Random::new(56));
        for mu in [1.0, 0.1] {
            let mut back = Moments::default();
            for _ in 0..100_000 {
                let (mut depth, mut cosine, mut weight) = (0.0, mu, 1.0);
                loop {
                    depth += cosine * random.gap();
                    if depth < 0.0 || weight < 1e-6 {
                        break;
                    }
                    weight *= 0.9;
                    cosine = random.between(-1.0, 1.0);
                }
                back.add(if depth < 0.0 { weight } else { 0.0 });
            }
            back.must_agree("plane albedo", half.plane_albedo(mu));
        }
    }
}
