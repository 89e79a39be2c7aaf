//! Any density: edges, corners, creases, walls and curved fields.
//!
//! Write `x = lambda pi r^2` for the search area in photons of the flat field at the query, and `A(x)` for the photons
//! really expected inside the ball. Then `A(x_k)` is Gamma(k), so `P(x_k < x) = P(k, A(x))` (regularised incomplete
//! gamma), and for the estimate `m / x_k` with `m` counted
//! `E[1 / x_k] = int_0^inf P(k, A(x)) / x^2 dx`, `E[1 / x_k^2] = int_0^inf 2 P(k, A(x)) / x^3 dx`.
//! Neither the inverse nor the derivative of `A` is needed, only the places where it has kinks.

use statrs::function::gamma::gamma_lr;

use super::{Counted, RelativeMoments};
use crate::edge_laws;
use crate::quadrature::Gauss;

/// Moments of the k-nearest estimate where `expected(x)` photons are expected within the ball whose disc would hold `x`
/// in the flat field, relative to that field; `expected` is non-decreasing. `kinks` are the places where it is not smooth.
///
/// Quadrature good to 1e-9 for `k` from 3 to some thousands. For `k <= 2` the variance is infinite.
///
/// # Panics
/// If `k < 2`: the mean is infinite.
pub fn in_field(k: u32, counted: Counted, expected: impl Fn(f64) -> f64, kinks: &[f64]) -> RelativeMoments {
    assert!(k >= 2, "the mean is infinite for k = {k}");
    let shape = f64::from(k);
    let found = |x: f64| {
        let a = expected(x);
        if a > 0.0 { gamma_lr(shape, a) } else { 0.0 }
    };
    // Beyond `end` the k-th photon has been found for certain.
    let certain = shape + 12.0 * shape.sqrt() + 40.0;
    let mut end = shape;
    while expected(end) < certain {
        end *= 1.5;
    }
    let mut breaks = vec![0.0, end];
    breaks.extend(kinks.iter().copied().filter(|&x| x > 0.0 && x < end));
    breaks.sort_by(f64::total_cmp);
    let rule = Gauss::new(16);
    let (mut first, mut second) = (1.0 / end, 1.0 / (end * end));
    for pair in breaks.windows(2) {
        let integral = |power: i32| rule.composite(pair[0], pair[1], 96, |x| found(x) / x.powi(power));
        first += integral(2);
        second += 2.0 * integral(3);
    }
    let m = counted.of(k);
    let mean = m * first;
    let variance = if k > 2 { m * m * second - mean * mean } else { f64::INFINITY };
    RelativeMoments { mean, variance }
}

/// At distance `d` inside the straight edge of a lit half-plane, `d` in units of `r0 = sqrt(k / (pi lambda))`, the search
/// radius in the flat field. At the edge the mean is 1/2 for every `k` (with `k - 1` counted).
pub fn half_plane(k: u32, d: f64, counted: Counted) -> RelativeMoments {
    let t = |x: f64| d * (f64::from(k) / x).sqrt();
    in_field(k, counted, |x| x * edge_laws::half_plane(t(x)), &[kink(k, d)])
}

/// At distance `d` from both edges of a lit quadrant, in units of `r0`.
pub fn corner(k: u32, d: f64, counted: Counted) -> RelativeMoments {
    let t = |x: f64| d * (f64::from(k) / x).sqrt();
    in_field(k, counted, |x| x * edge_laws::corner(t(x), t(x)), &[kink(k, d), 2.0 * kink(k, d)])
}

/// On the centre line of a lit strip of width `2 d`, in units of `r0`.
pub fn strip_centre(k: u32, d: f64, counted: Counted) -> RelativeMoments {
    let t = |x: f64| d * (f64::from(k) / x).sqrt();
    in_field(k, counted, |x| x * edge_laws::strip(2.0 * t(x), t(x)), &[kink(k, d)])
}

/// At distance `d` (in units of `r0`) from a crease of two equally lit half-planes at the dihedral angle `theta` (radians),
/// found by a sphere without a normal test. At the crease the mean is 1 for every angle (with `k - 1` counted).
pub fn crease(k: u32, d: f64, theta: f64, counted: Counted) -> RelativeMoments {
    let t = |x: f64| d * (f64::from(k) / x).sqrt();
    let total = |x: f64| x * edge_laws::crease(t(x), theta, 1.0, 1.0).total();
    // The ball reaches the other plane at distance |sin| d, or the edge itself at d.
    in_field(k, counted, total, &[kink(k, d), kink(k, d) * theta.sin().powi(2)])
}

/// On the dark face of a slab whose lit face is `h` behind, in units of `r0`: `m E[1 / (eta + G)]` with
/// `eta = k h^2` and `G` from Gamma(k). Never 0: the k nearest are always found.
pub fn thin_wall(k: u32, h: f64, counted: Counted) -> RelativeMoments {
    in_field(k, counted, |x| (x - kink(k, h)).max(0.0), &[kink(k, h)])
}

/// At the origin of the density `lambda (1 + q r^2)` (`lambda` in photons/m^2, `q >= 0` in 1/m^2):
/// `A = lambda pi (r^2 + q r^4 / 2)`. Leading order of the bias with `k - 1` counted: `k q / (2 pi lambda)`.
pub fn quadratic(k: u32, lambda: f64, q: f64, counted: Counted) -> RelativeMoments {
    let bend = q / (2.0 * std::f64::consts::PI * lambda);
    in_field(k, counted, |x| x + bend * x * x, &[])
}

/// The search area, in photons of the flat field, whose radius is `d r0`.
fn kink(k: u32, d: f64) -> f64 {
    f64::from(k) * d * d
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, TAU};

    const OURS: Counted = Counted::AllButLast;

    #[test]
    fn the_flat_field_gives_the_closed_form() {
        for k in [2, 3, 5, 20, 200, 2000] {
            for counted in [Counted::All, OURS] {
                let (got, exact) = (in_field(k, counted, |x| x, &[]), super::super::uniform(k, counted));
                assert!((got.mean / exact.mean - 1.0).abs() < 1e-9, "{k}: {}", got.mean);
                assert!(k == 2 || (got.variance / exact.variance - 1.0).abs() < 1e-6, "{k}");
            }
        }
    }

    /// A few numbers of the catalogue's B3, B5, B7 and A7, computed there by inverting `A` instead.
    #[test]
    fn catalogue_values() {
        let near = |law: RelativeMoments, exact: f64| {
            assert!((law.mean - exact).abs() < 2e-7, "{} {exact}", law.mean);
        };
        near(half_plane(20, 0.5, OURS), 0.78397452);
        near(half_plane(200, 1.0, OURS), 0.99846128);
        near(corner(20, 0.25, OURS), 0.35739167);
        near(corner(50, 0.75, OURS), 0.79414325);
        near(strip_centre(20, 0.25, OURS), 0.11223074);
        near(strip_centre(50, 0.75, OURS), 0.78921277);
        near(crease(20, 0.5, FRAC_PI_2, OURS), 1.1766474);
        near(crease(50, 0.75, FRAC_PI_3, OURS), 1.3431517);
        near(crease(20, 0.25, 2.0 * FRAC_PI_3, OURS), 1.0586975);
        near(thin_wall(20, 1.0, OURS), 0.4808625);
        near(thin_wall(50, 4.0, OURS), 0.05765104);
        near(quadratic(20, 1000.0, 10.0, OURS), 1.0293361);
        near(quadratic(100, 1000.0, 10.0, OURS), 1.1382867);
    }

    #[test]
    fn edges_corners_and_creases_at_distance_zero() {
        for k in [3, 20, 200] {
            assert!((half_plane(k, 0.0, OURS).mean - 0.5).abs() < 1e-9);
            assert!((corner(k, 0.0, OURS).mean - 0.25).abs() < 1e-9);
            assert!((crease(k, 0.0, 1.0, OURS).mean - 1.0).abs() < 1e-9);
        }
    }

    /// Squared distances of photons on a plane at distance `h` from the query, in units where the flat field has one
    /// photon per `pi r^2`; `lit(x, y)` says which part is there.
    fn plane(random: &mut Random, h: f64, end: f64, lit: impl Fn(f64, f64) -> bool) -> Vec<f64> {
        let (mut found, mut area) = (Vec::new(), random.gap());
        while area + h * h < end {
            let (r, phi) = (area.sqrt(), random.between(0.0, TAU));
            if lit(r * phi.cos(), r * phi.sin()) {
                found.push(area + h * h);
            }
            area += random.gap();
        }
        found
    }

    /// Photons thrown on the surfaces themselves and sorted by distance; 10 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let (mut random, k, d) = (Random::new(11), 20u32, 0.6);
        let r0 = f64::from(k).sqrt();
        let (edge, end) = (d * r0, 400.0);
        let laws = [
            half_plane(k, d, OURS),
            corner(k, d, OURS),
            crease(k, d, FRAC_PI_3, OURS),
            thin_wall(k, d, OURS),
            quadratic(k, 1.0 / std::f64::consts::PI, 0.02, OURS),
        ];
        let mut mean: [Moments; 5] = Default::default();
        let mut square: [Moments; 5] = Default::default();
        for _ in 0..10_000 {
            let own = plane(&mut random, 0.0, end, |x, _| x > -edge);
            let quadrant = plane(&mut random, 0.0, end, |x, y| x > -edge && y > -edge);
            let (height, foot) = (edge * FRAC_PI_3.sin(), edge * FRAC_PI_3.cos());
            let mut both = plane(&mut random, height, end, |x, _| x > -foot);
            both.extend(&own);
            let wall = plane(&mut random, edge, end, |_, _| true);
            let bright = curved(&mut random, end);
            for (i, mut found) in [own, quadrant, both, wall, bright].into_iter().enumerate() {
                found.sort_by(f64::total_cmp);
                let x = f64::from(k - 1) / found[k as usize - 1];
                mean[i].add(x);
                square[i].add((x - laws[i].mean).powi(2));
            }
        }
        for i in 0..5 {
            mean[i].must_agree(&format!("law {i}, mean"), laws[i].mean);
            square[i].must_agree(&format!("law {i}, variance"), laws[i].variance);
        }
    }

    /// The density `(1 + 0.02 r^2) / pi` by thinning a denser field.
    fn curved(random: &mut Random, end: f64) -> Vec<f64> {
        let most = 1.0 + 0.02 * end;
        let (mut found, mut area) = (Vec::new(), random.gap() / most);
        while area < end && found.len() < 25 {
            if random.unit() * most < 1.0 + 0.02 * area {
                found.push(area);
            }
            area += random.gap() / most;
        }
        found
    }
}
