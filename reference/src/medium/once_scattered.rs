//! Light scattered exactly once, from an isotropic point lamp in an isotropically scattering medium.
//!
//! Lengths in mean free paths, albedo `c`, lamp of flux 1. The fluence of the light that was scattered once is
//! `c / (8 pi r) int_0^inf exp(-r (1 + v)) 2/(1 + v) ln((2 + v)/v) dv` (bipolar coordinates). A line of sight that passes
//! the lamp at the distance `h` collects `c / (16 pi^2) int exp(-path to the eye - d) / d^2 dt`, with
//! `d = sqrt(h^2 + t^2)`. (Airlight integral; catalogue entry F2.) Quadrature, 1e-10 relative.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Medium};
use crate::quadrature::Gauss;

/// Fluence (W/m^2 in a medium of one mean free path per metre) of the light scattered once, at `r` mean free paths from a
/// lamp of 1 W, per unit of albedo.
pub fn fluence(r: f64) -> f64 {
    let rule = Gauss::new(32);
    let at = |v: f64| (-r * (1.0 + v)).exp() * 2.0 / (1.0 + v) * ((2.0 + v) / v).ln();
    // v = exp(s): the logarithm at v = 0 is tamed by the factor v; the tail ends with the exponential.
    let integrand = |s: f64| s.exp() * at(s.exp());
    rule.composite(-36.0, (1.0 + 45.0 / r).ln(), 40, integrand) / (8.0 * PI * r)
}

/// Fluence of the light that was not scattered: `exp(-r) / (4 pi r^2)`.
pub fn uncollided_fluence(r: f64) -> f64 {
    (-r).exp() / (4.0 * PI * r * r)
}

/// Radiance towards an eye on a line that passes a lamp of 1 W at the distance `h`, collected from `from` to `to` along the
/// line (0 nearest to the lamp, the eye at the lower end or before it in the clear), per unit of albedo; mean free paths.
pub fn radiance(h: f64, from: f64, to: f64) -> f64 {
    // t = h sinh s turns dt / (h^2 + t^2) into ds / (h cosh s).
    let [a, b] = [from, to].map(|t| (t / h).asinh());
    let pieces = (4.0 * (b - a)).ceil() as usize;
    let integrand = |s: f64| (-(h * s.sinh() - from) - h * s.cosh()).exp() / (h * s.cosh());
    Gauss::new(16).composite(a, b, pieces, integrand) / (16.0 * PI * PI)
}

/// A ball of fog with a lamp of 1 W in its centre, looked at from outside along lines at these distances from the centre,
/// paths cut off after the first scattering.
fn case(albedo: f64, radius: f64, distances: &[f64]) -> Case {
    let medium = Medium { extinction: 1.0, albedo, asymmetry: 0.0 };
    let lamp = mitsuba::point_lamp_in_fog([0.0; 3], &[1.0 / (4.0 * PI)]);
    let mut draft = Draft::with(mitsuba::fog_ball([0.0; 3], radius, medium) + &lamp);
    draft.max_depth(2);
    for &h in distances {
        let half_chord = (radius * radius - h * h).sqrt();
        let value = albedo * radiance(h, -half_chord, half_chord);
        draft.radiance([-2.0 * radius, h, 0.0], [0.0, h, 0.0], &[value], 1e-9 * value);
    }
    draft.case(format!("albedo {albedo}, ball of radius {radius}"))
}

/// The catalogue's F2, its endless medium replaced by balls, in which the answer is as exact.
pub fn cases() -> Vec<Case> {
    vec![case(1.0, 3.0, &[0.25, 0.5, 1.0, 2.0]), case(0.5, 1.5, &[0.25, 0.5, 1.0])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn catalogue_values() {
        for (r, none, once) in
            [(0.25, 0.99159995, 0.43766841), (1.0, 0.029274916, 0.034538227), (4.0, 9.1094515e-5, 0.00022040924)]
        {
            assert!((uncollided_fluence(r) / none - 1.0).abs() < 1e-7);
            assert!((fluence(r) / once - 1.0).abs() < 1e-7, "{r}: {}", fluence(r));
        }
        for (h, t0, want) in
            [(0.25, 1.0, 0.017815514), (0.5, 3.0, 0.00098321511), (1.0, 1.0, 0.0013893144), (2.0, 3.0, 5.5973133e-5)]
        {
            let got = radiance(h, -t0, 60.0);
            assert!((got / want - 1.0).abs() < 1e-7, "{h} {t0}: {got}");
        }
    }

    /// Every photon that was scattered once collides once more: the fluence's integral over space is 1.
    #[test]
    fn the_fluence_counts_the_second_collisions() {
        let rule = Gauss::new(16);
        let shell = |r: f64| 4.0 * PI * r * r * fluence(r);
        let total = rule.composite(0.0, 4.0, 16, shell) + rule.composite(4.0, 50.0, 30, shell);
        assert!((total - 1.0).abs() < 1e-9, "{total}");
    }

    /// Second collisions of random walks inside three balls: 3 comparisons at 4.5 standard errors.
    #[test]
    fn random_walks_agree() {
        let (mut random, cuts) = (Random::new(53), [0.5, 1.0, 2.0]);
        let mut inside: [Moments; 3] = Default::default();
        for _ in 0..200_000 {
            let mut p = [0.0; 3];
            for _ in 0..2 {
                p = crate::vector::along(p, random.gap(), random.direction());
            }
            let r = crate::vector::length(p);
            cuts.iter().zip(&mut inside).for_each(|(&cut, m)| m.add(f64::from(r < cut)));
        }
        for (cut, moments) in cuts.into_iter().zip(&inside) {
            let exact = Gauss::new(16).composite(0.0, cut, 8, |r| 4.0 * PI * r * r * fluence(r));
            moments.must_agree("second collisions within a radius", exact);
        }
    }

    /// The line integral as written, without substitution.
    #[test]
    fn the_radiance_is_its_integral() {
        let (h, t0) = (0.5f64, 2.0);
        let plain = |t: f64| (-(t + t0) - h.hypot(t)).exp() / (h * h + t * t);
        let brute = Gauss::new(16).composite(-t0, 1.5, 200, plain) / (16.0 * PI * PI);
        assert!((radiance(h, -t0, 1.5) / brute - 1.0).abs() < 1e-11);
        assert!(cases()[0].xml.contains("name=\"max_depth\" value=\"2\""));
    }
}
