//! GGX microfacets: densities, masking, and how much a rough mirror loses when only single scattering is kept.
//!
//! For the roughness `alpha` (the slope's scale itself, not its root): `D = alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2)`,
//! Smith's `L = (sqrt(1 + alpha^2 tan^2) - 1) / 2`, masking `G1 = 1/(1 + L)`, both directions together
//! `1/(1 + L(o) + L(i))` (height-correlated) or `G1(o) G1(i)` (separable). Normals seen from `o` have the density
//! `G1(o) (o.h) D(h) / cos(o)`. (Walter and others 2007, eqs. 33, 34; Heitz 2014, eqs. 72, 99; catalogue entry G3.)
//!
//! The share of light from `o` that a lossless rough mirror sends back is the integral over normals of
//! `G2 (o.h) / (cos(o) cos(h))` times `D cos(h)`. It misses 1 by what is scattered twice or more.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crate::quadrature::Gauss;

/// Density of normals per steradian at this cosine from the surface's normal; `D cos` integrates to 1.
pub fn normal_density(cosine: f64, alpha: f64) -> f64 {
    let a2 = alpha * alpha;
    a2 / (PI * (cosine * cosine * (a2 - 1.0) + 1.0).powi(2))
}

/// Smith's auxiliary function of the cosine of a direction above the surface.
pub fn lambda(cosine: f64, alpha: f64) -> f64 {
    let tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    0.5 * ((1.0 + alpha * alpha * tan2).sqrt() - 1.0)
}

/// Share of the facets that face a direction and are seen from it.
pub fn masking(cosine: f64, alpha: f64) -> f64 {
    1.0 / (1.0 + lambda(cosine, alpha))
}

/// How masking and shadowing combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadowing {
    /// Both are likelier for low facets: `1 / (1 + L(o) + L(i))`.
    Correlated,
    /// As if they were independent: `G1(o) G1(i)`.
    Separable,
}

impl Shadowing {
    /// Share of the facets seen from both directions (cosines, above the surface).
    pub fn share(self, o: f64, i: f64, alpha: f64) -> f64 {
        match self {
            Shadowing::Correlated => 1.0 / (1.0 + lambda(o, alpha) + lambda(i, alpha)),
            Shadowing::Separable => masking(o, alpha) * masking(i, alpha),
        }
    }
}

/// Density per steradian of the normals seen from a direction with the cosine `o`, for a normal with the cosine `h` and
/// the cosine `between` it and that direction.
pub fn visible_normal_density(o: f64, h: f64, between: f64, alpha: f64) -> f64 {
    masking(o, alpha) * between.max(0.0) * normal_density(h, alpha) / o
}

/// Share of light at this cosine of incidence in `(0, 1]` that a lossless rough mirror sends back in single scattering.
///
/// Quadrature 1e-9 for `alpha` from 0.05 to 1.
pub fn directional_albedo(cosine: f64, alpha: f64, shadowing: Shadowing) -> f64 {
    over_normals(cosine, alpha, &[], |h, between| {
        let i = 2.0 * between * h - cosine;
        if i > 0.0 { shadowing.share(cosine, i, alpha) * between / (cosine * h) } else { 0.0 }
    })
}

/// The same for diffuse light: `2 int E mu dmu`. Precision 1e-7.
pub fn average_albedo(alpha: f64, shadowing: Shadowing) -> f64 {
    // mu = x^2: at grazing incidence the albedo is not smooth in mu.
    let at = |x: f64| 4.0 * x.powi(3) * directional_albedo(x * x, alpha, shadowing);
    Gauss::new(12).composite(0.0, 1.0, 3, at)
}

/// The integral over all normals, weighted with `D cos`, of `f(cos h, o.h)`, for light from the cosine `mu`.
///
/// `f` may change abruptly where the reflected ray grazes the surface, where `o.h = 0`, and at the cosines `o.h` in
/// `kinks`. Along each circle of constant `cos h` the azimuth is cut there, and each piece is integrated with nodes that
/// crowd to its ends; across the circles the same is done where a cut enters or leaves.
pub(super) fn over_normals(mu: f64, alpha: f64, kinks: &[f64], f: impl Fn(f64, f64) -> f64) -> f64 {
    let tilt = mu.acos();
    let mut ends = vec![0.0, FRAC_PI_2, FRAC_PI_4 - 0.5 * tilt, FRAC_PI_4 + 0.5 * tilt, FRAC_PI_2 - tilt];
    // The peak of the density, and the tilts at which a circle touches a kink.
    ends.extend([alpha.atan(), (0.3 * alpha).atan(), (3.0 * alpha).atan()]);
    ends.extend(kinks.iter().flat_map(|k| [(tilt - k.acos()).abs(), tilt + k.acos()]));
    let rule = Gauss::new(16);
    pieces(&rule, ends, [0.0, FRAC_PI_2], |theta| {
        let (sine, cosine) = theta.sin_cos();
        let t2 = (sine / cosine).powi(2);
        let a2 = alpha * alpha;
        let density = 2.0 * a2 * sine / (cosine.powi(3) * (a2 + t2).powi(2));
        let (level, swing) = (mu * cosine, (1.0 - mu * mu).sqrt() * sine);
        let cut = |between: f64| ((between - level) / swing).clamp(-1.0, 1.0).acos();
        let mut cuts = vec![0.0, PI, cut(0.0), cut(0.5 * mu / cosine)];
        cuts.extend(kinks.iter().map(|&k| cut(k)));
        let visible = |phi: f64| {
            let between = level + swing * phi.cos();
            if between > 0.0 { f(cosine, between) } else { 0.0 }
        };
        density / PI * pieces(&rule, cuts, [0.0, PI], visible)
    })
}

/// The integral between `from` and `to`, cut at the given ends, each piece with `x = sin^2`, which smooths square roots at
/// either end.
fn pieces(rule: &Gauss, mut ends: Vec<f64>, [from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    ends.retain(|x| x.is_finite() && (from..=to).contains(x));
    ends.sort_by(f64::total_cmp);
    let piece = |pair: &[f64]| {
        let (a, width) = (pair[0], pair[1] - pair[0]);
        let at = |x: f64| {
            let (sine, cosine) = (FRAC_PI_2 * x).sin_cos();
            PI * sine * cosine * f(a + width * sine * sine)
        };
        if width > 1e-12 { width * rule.composite(0.0, 1.0, 2, at) } else { 0.0 }
    };
    ends.windows(2).map(piece).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Catalogue G3 (its own precision 1e-5): alpha, cosine, correlated, separable.
    #[test]
    fn catalogue_directional_albedos() {
        for (alpha, mu, correlated, separable) in [
            (0.1, 1.0, 0.98830194, 0.98830194),
            (0.1, 0.5, 0.9692018, 0.96911193),
            (0.1, 0.05, 0.91176598, 0.8859734),
            (0.25, 0.2, 0.84816092, 0.83145912),
            (0.5, 0.8, 0.68204652, 0.67963813),
            (0.5, 0.05, 0.91254938, 0.79227677),
            (1.0, 1.0, 0.30685258, 0.30685258),
            (1.0, 0.5, 0.45069366, 0.40913697),
            (1.0, 0.05, 0.84777461, 0.58448189),
        ] {
            let got = [Shadowing::Correlated, Shadowing::Separable].map(|s| directional_albedo(mu, alpha, s));
            println!("{alpha} {mu}: {got:?}, {:e} {:e} from the table", got[0] - correlated, got[1] - separable);
            assert!((got[0] - correlated).abs() < 1e-5 && (got[1] - separable).abs() < 1e-5);
        }
        // alpha = 1 at normal incidence: 1 - ln 2.
        let exact = 1.0 - std::f64::consts::LN_2;
        assert!((directional_albedo(1.0, 1.0, Shadowing::Correlated) - exact).abs() < 1e-9);
    }

    /// Catalogue G3, its precision 1e-4.
    #[test]
    fn catalogue_average_albedos() {
        for (alpha, correlated, separable) in
            [(0.1, 0.97204626, 0.97155998), (0.5, 0.70023942, 0.68940173), (1.0, 0.40913725, 0.37663472)]
        {
            let got = [Shadowing::Correlated, Shadowing::Separable].map(|s| average_albedo(alpha, s));
            println!("{alpha}: {got:?}, {:e} {:e} from the table", got[0] - correlated, got[1] - separable);
            assert!((got[0] - correlated).abs() < 1e-4 && (got[1] - separable).abs() < 1e-4);
        }
    }

    /// Projected facets add up: all of them to the surface, the visible ones to the surface seen from the side.
    #[test]
    fn densities_are_normalised() {
        for (alpha, mu) in [(0.1, 0.9), (0.5, 0.3), (1.0, 0.05)] {
            let all = over_normals(mu, alpha, &[], |_, _| 1.0);
            let behind = 1.0 - all;
            assert!((-1e-9..0.6).contains(&behind), "{all}");
            let seen = over_normals(mu, alpha, &[], |h, between| {
                visible_normal_density(mu, h, between, alpha) / (normal_density(h, alpha) * h)
            });
            assert!((seen - 1.0).abs() < 1e-9, "{alpha} {mu}: {seen}");
            let rule = Gauss::new(32);
            let flat = rule.composite(0.0, 1.0, 64, |c| 2.0 * PI * c * normal_density(c, alpha));
            assert!((flat - 1.0).abs() < 1e-10, "{flat}");
        }
    }

    /// Facets drawn with the density `D cos` and weighted: 4 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_facets_agree() {
        let mut random = Random::new(63);
        for (alpha, mu) in [(0.25f64, 0.5f64), (1.0, 0.2)] {
            let mut albedo: [Moments; 2] = Default::default();
            let across = (1.0 - mu * mu).sqrt();
            for _ in 0..300_000 {
                let u = random.unit();
                let tan = alpha * (u / (1.0 - u)).sqrt();
                let h = 1.0 / 1f64.hypot(tan);
                let between = across * tan * h * (2.0 * PI * random.unit()).cos() + mu * h;
                let i = 2.0 * between * h - mu;
                let weight = if i > 0.0 && between > 0.0 { between / (mu * h) } else { 0.0 };
                for (m, shadowing) in albedo.iter_mut().zip([Shadowing::Correlated, Shadowing::Separable]) {
                    m.add(if weight > 0.0 { weight * shadowing.share(mu, i, alpha) } else { 0.0 });
                }
            }
            albedo[0].must_agree("correlated", directional_albedo(mu, alpha, Shadowing::Correlated));
            albedo[1].must_agree("separable", directional_albedo(mu, alpha, Shadowing::Separable));
        }
    }
}
