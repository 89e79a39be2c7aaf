//! An isotropic point lamp in an endless, isotropically scattering medium: exact transport.
//!
//! Lengths in mean free paths, albedo `c` in `(0, 1)`, lamp of flux 1. The fluence is a pole and a branch cut of its
//! Fourier transform: `phi = A exp(-k r) / (4 pi r) + (1/(4 pi r)) int_1^inf exp(-s r) ds / N(s)` with
//! `c atanh(k) / k = 1`, `A = 2 k^2 (1 - k^2) / (c (c - 1 + k^2))` and
//! `N = (1 - (c/s) atanh(1/s))^2 + (pi c / (2 s))^2`. (Case, de Hoffmann and Placzek 1953; Davison, "Neutron Transport
//! Theory"; catalogue entry F3.) With `1/s = tanh y` the integral is
//! `int_0^inf exp(-r coth y) / sinh^2 y / [(1 - c y tanh y)^2 + (pi c tanh y / 2)^2] dy`, smooth everywhere.
//!
//! Along a line the medium shows the radiance `c / (4 pi) int phi exp(-t) dt`.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Medium};
use crate::out_of_range::{OutOfRange, require};
use crate::quadrature::Gauss;

/// An endless medium. Fluence by quadrature, 1e-10 relative from 0.05 mean free paths on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InfiniteMedium {
    albedo: f64,
    decay: f64,
}

impl InfiniteMedium {
    /// A medium with this `albedo`, from 0.1 to below 1.
    pub fn new(albedo: f64) -> Result<Self, OutOfRange> {
        require((0.1..1.0).contains(&albedo), "albedo", albedo, "at least 0.1 and below 1")?;
        // atanh(k) = y, so that c y = tanh y; the root lies where the difference changes sign.
        let (mut low, mut high) = (1e-9, 1.0 / albedo + 1.0);
        for _ in 0..100 {
            let y = 0.5 * (low + high);
            if albedo * y < f64::tanh(y) { low = y } else { high = y }
        }
        Ok(InfiniteMedium { albedo, decay: (0.5 * (low + high)).tanh() })
    }

    /// The rate `k` at which the light dies away far from the lamp, per mean free path.
    pub fn decay(&self) -> f64 {
        self.decay
    }

    /// The pole's part of the fluence at `r` mean free paths from a lamp of 1 W.
    pub fn asymptotic_fluence(&self, r: f64) -> f64 {
        let (c, k2) = (self.albedo, self.decay * self.decay);
        2.0 * k2 * (1.0 - k2) / (c * (c - 1.0 + k2)) * (-self.decay * r).exp() / (4.0 * PI * r)
    }

    /// What classical diffusion makes of it: `3 exp(-sqrt(3 (1 - c)) r) / (4 pi r)`.
    pub fn diffusion_fluence(&self, r: f64) -> f64 {
        3.0 * (-(3.0 * (1.0 - self.albedo)).sqrt() * r).exp() / (4.0 * PI * r)
    }

    /// The fluence at `r` mean free paths from a lamp of 1 W, in W per square mean free path.
    pub fn fluence(&self, r: f64) -> f64 {
        let c = self.albedo;
        let cut = |y: f64| {
            let t = y.tanh();
            let size = (1.0 - c * y * t).powi(2) + (0.5 * PI * c * t).powi(2);
            (-r / t).exp() / (y.sinh().powi(2) * size)
        };
        // Below r / 60 the exponential leaves nothing; for small r the peak sits at y of the order of r.
        let (rule, near) = (Gauss::new(12), (r / 60.0).min(1.0));
        let log = rule.composite(near.ln(), 0.0, 24, |s: f64| s.exp() * cut(s.exp()));
        self.asymptotic_fluence(r) + (log + rule.composite(1.0, 24.0, 40, cut)) / (4.0 * PI * r)
    }

    /// Radiance that an eye in the medium sees along a line that passes the lamp at the distance `h`, `ahead` the way to
    /// the point nearest to the lamp. Quadrature, 1e-8 relative.
    pub fn radiance(&self, h: f64, ahead: f64) -> f64 {
        // t = ahead + h sinh s, since near the lamp the fluence goes like one over the squared distance.
        let at = |s: f64| self.fluence(h * s.cosh()) * h * s.cosh() * (-(ahead + h * s.sinh())).exp();
        let [from, to] = [-ahead, 28.0 - ahead].map(|t| (t / h).asinh());
        let integral = Gauss::new(12).composite(from, to, (3.0 * (to - from)).ceil() as usize, at);
        self.albedo / (4.0 * PI) * integral
    }

    /// The most by which a ball of this radius around the lamp, in the dark, lowers a reading taken within `reach` of it.
    ///
    /// A photon that leaves the ball in the endless medium could come back: photons leave at most as often as the
    /// fluence there times the area says, and at least `radius - reach` away each adds at most `c phi` of that distance
    /// to the fluence, and so to `4 pi / c` times a radiance; the line of sight itself ends at the ball.
    pub fn truncation(&self, radius: f64, reach: f64) -> f64 {
        let left = (4.0 * PI * radius * radius * self.fluence(radius)).min(1.0);
        let returned = left * self.albedo * self.fluence(radius - reach);
        self.albedo / (4.0 * PI) * (returned + (reach - radius).exp() * self.fluence(radius))
    }

    /// A ball of the medium with radiance meters in it; `(h, ahead)` each as in [`InfiniteMedium::radiance`].
    fn case(&self, radius: f64, lines: &[[f64; 2]]) -> Case {
        let medium = Medium { extinction: 1.0, albedo: self.albedo, asymmetry: 0.0 };
        let lamp = mitsuba::point_lamp_in_fog([0.0; 3], &[1.0 / (4.0 * PI)]);
        let mut draft = Draft::with(mitsuba::fog_ball([0.0; 3], radius, medium) + &lamp);
        for &[h, ahead] in lines {
            let value = self.radiance(h, ahead);
            let uncertainty = 1e-8 * value + self.truncation(radius, h.hypot(ahead));
            draft.radiance_in_fog([-ahead, h, 0.0], [0.0, h, 0.0], value, uncertainty);
        }
        draft.case(format!("albedo {}", self.albedo))
    }
}

/// The catalogue's F3, read as radiance along three lines.
pub fn cases() -> Vec<Case> {
    let lines = [[0.25, 1.0], [1.0, 1.0], [0.5, 3.0]];
    let media = [(0.5, 20.0), (0.9, 30.0), (0.99, 60.0)].into_iter();
    media.flat_map(|(albedo, radius)| InfiniteMedium::new(albedo).map(|medium| medium.case(radius, &lines))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use crate::vector::{along, length};

    fn medium(albedo: f64) -> InfiniteMedium {
        InfiniteMedium::new(albedo).expect("valid")
    }

    /// Catalogue F3: albedo, distance, fluence, pole, diffusion.
    #[test]
    fn catalogue_values() {
        for (c, r, exact, pole, diffusion) in [
            (0.5, 0.1, 8.0321038, 0.52924369, 2.1121337),
            (0.5, 2.0, 0.0079276237, 0.0042907394, 0.010305795),
            (0.5, 10.0, 4.608671e-7, 4.0443844e-7, 1.1452808e-7),
            (0.9, 0.25, 1.6393113, 0.70406221, 0.83272799),
            (0.9, 3.0, 0.014140036, 0.013832611, 0.015387621),
            (0.99, 1.0, 0.22019457, 0.19769193, 0.20076564),
            (0.99, 10.0, 0.0041850924, 0.0041850774, 0.0042236827),
        ] {
            let m = medium(c);
            for (got, want) in
                [(m.fluence(r), exact), (m.asymptotic_fluence(r), pole), (m.diffusion_fluence(r), diffusion)]
            {
                assert!((got / want - 1.0).abs() < 1e-7, "{c} {r}: {got} {want}");
            }
        }
        for (c, decay) in [(0.5, 0.95750402), (0.9, 0.52542951), (0.99, 0.17251107)] {
            assert!((medium(c).decay() - decay).abs() < 1e-8);
        }
        assert!(InfiniteMedium::new(1.0).is_err());
    }

    /// Every photon collides `1 / (1 - c)` times on average.
    #[test]
    fn the_fluence_counts_the_collisions() {
        for c in [0.5, 0.9] {
            let (m, rule) = (medium(c), Gauss::new(12));
            let shell = |r: f64| 4.0 * PI * r * r * m.fluence(r);
            let total = rule.composite(0.0, 1.0, 10, shell) + rule.composite(1.0, 70.0, 60, shell);
            assert!((total * (1.0 - c) - 1.0).abs() < 1e-8, "{c}: {total}");
        }
    }

    /// Random walks: collisions in three shells. 3 comparisons at 4.5 standard errors.
    #[test]
    fn random_walks_agree() {
        let (m, mut random) = (medium(0.9), Random::new(54));
        let shells = [[0.0, 0.5], [0.9, 1.1], [1.1, 2.0]];
        let mut counts: [Moments; 3] = Default::default();
        for _ in 0..100_000 {
            let (mut p, mut weight, mut sums) = ([0.0; 3], 1.0, [0.0; 3]);
            while weight > 1e-5 {
                p = along(p, random.gap(), random.direction());
                let r = length(p);
                shells
                    .iter()
                    .zip(&mut sums)
                    .for_each(|([a, b], sum)| *sum += if (*a..*b).contains(&r) { weight } else { 0.0 });
                weight *= 0.9;
            }
            counts.iter_mut().zip(sums).for_each(|(m, sum)| m.add(sum));
        }
        for ([a, b], count) in shells.into_iter().zip(&counts) {
            let exact = Gauss::new(12).composite(a, b, 8, |r| 4.0 * PI * r * r * m.fluence(r));
            count.must_agree("collisions in a shell", exact);
        }
    }

    /// The transport equation: the radiance from all directions and the light straight from the lamp are the fluence.
    #[test]
    fn the_radiance_adds_up_to_the_fluence() {
        for (c, r) in [(0.5, 1.0f64), (0.9, 1.6)] {
            let m = medium(c);
            let ring = |theta: f64| 2.0 * PI * theta.sin() * m.radiance(r * theta.sin(), r * theta.cos());
            let sum = Gauss::new(16).composite(0.0, PI, 4, ring) + (-r).exp() / (4.0 * PI * r * r);
            assert!((sum / m.fluence(r) - 1.0).abs() < 1e-6, "{c}: {sum} {}", m.fluence(r));
        }
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        for case in cases() {
            mitsuba::assert_balanced(&case.xml);
            assert!(case.expected.iter().all(|e| e.uncertainty < 1e-6 * e.value[0]), "{:?}", case.expected);
        }
    }
}
