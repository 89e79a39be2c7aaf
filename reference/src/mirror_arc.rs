//! A cylindrical mirror standing on a floor in parallel light: the caustic in a coffee cup.
//!
//! Seen from above, the ray at `y = R sin phi` hits the wall at `R (cos phi, sin phi)` and goes on along
//! `-(cos 2 phi, sin 2 phi)`; from the height `s tan e` (`e` the sun's elevation) it reaches the floor at
//! `P = R (cos phi, sin phi) - s (cos 2 phi, sin 2 phi)`. Relative to the unshaded horizontal irradiance `E_h` a strip
//! `dphi ds` of wall carries the flux `R cos phi`, so a box on the floor receives the integral of `R cos phi` times the
//! length of `s` for which `P` lies in it, and a point `1 / |1 - 2 s / (R cos phi)|` from every `phi` that leads there; both
//! whatever the elevation is, as long as the wall is high enough. The points `s = (R / 2) cos phi` are the caustic, a
//! nephroid with its cusp at `R / 2`. (Textbook; catalogue entry E4.)
//!
//! Within 45 degrees the mirror is met once, since the chord is longer than `R`.

use std::f64::consts::{FRAC_PI_4, SQRT_2};

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::quadrature::Gauss;

/// Reflected irradiance on the axis of the mirror of radius 1 and 45 degrees to either side, relative to `E_h`, at
/// `0 < u < 1/sqrt(2)` from the centre towards the mirror; infinite at the cusp, 1/2.
///
/// The middle ray gives `1 / |2u - 1|`; from the cusp on, two more rays with `cos phi = 1 / (2u)` give `1 / (4u^2 - 1)`
/// each. Exact.
pub fn axis_irradiance(u: f64) -> f64 {
    let side = if u > 0.5 { 2.0 / (4.0 * u * u - 1.0) } else { 0.0 };
    1.0 / (2.0 * u - 1.0).abs() + side
}

/// Reflected flux on the box `[x0, x1] x [y0, y1]` of the floor in units of `E_h` for the mirror of radius 1 and 45 degrees
/// to either side, lit up to the height from which a ray travels `reach` horizontally.
///
/// Quadrature over `phi` in 20 000 pieces; kinks where a ray leaves through a corner of the box cost below 1e-8.
pub fn box_flux([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], reach: f64) -> f64 {
    let length = |phi: f64| {
        let (y, x) = phi.sin_cos();
        let (dy, dx) = (2.0 * phi).sin_cos();
        let (mut from, mut to) = (0.0, reach);
        for (start, step, low, high) in [(x, dx, x0, x1), (y, dy, y0, y1)] {
            let ends = [(start - low) / step, (start - high) / step];
            from = ends[0].min(ends[1]).max(from);
            to = ends[0].max(ends[1]).min(to);
        }
        x * (to - from).max(0.0)
    };
    Gauss::new(3).composite(-FRAC_PI_4, FRAC_PI_4, 20_000, length)
}

/// The mirror of radius 1 and height 1 with the sun at 45 degrees, `E_h = 1`, and a meter that reads the flux on one box of
/// the floor, direct sun included.
///
/// The mirror is a whole cylinder; black plates at its near side keep the sun from all but 45 degrees to either side, and the
/// sun passes over the near wall, whose shadow ends before `x = 0.05` for `|y| < 0.3`.
fn case(x: [f64; 2], y: [f64; 2]) -> Case {
    let mut draft = cup();
    let half = [0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])];
    let place = Place::floor([0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1]), 0.0], half);
    let flux = box_flux(x, y, 1.0) + 4.0 * half[0] * half[1];
    draft.receiver(Reads::Flux, "rectangle", place, flux, 1e-7);
    draft.case(format!("box {} {} {} {}", x[0], x[1], y[0], y[1]))
}

/// The same with one black floor, `x` in `[0, 0.8]` and `y` in `[-0.4, 0.4]`, whose meter (`floor`) reads the flux, direct sun
/// included, on `cells` by `cells` equal cells: columns along x, rows along y.
pub fn floor_xml(cells: usize) -> String {
    let mut draft = cup();
    let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::film_meter(Reads::Flux, "floor", cells);
    draft.add(&mitsuba::flat("rectangle", "cells", Place::floor([0.4, 0.0, 0.0], [0.4; 2]), &on_it));
    draft.case("floor").xml
}

/// Sun, mirror and plates.
fn cup() -> Draft {
    let ends = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mut draft = Draft::with(mitsuba::parallel_light([1.0, 0.0, -1.0], &[SQRT_2]));
    draft.add(&mitsuba::inside_cylinder("mirror", ends, 1.0, mitsuba::PERFECT_MIRROR));
    let edge = FRAC_PI_4.sin();
    for side in [-1.0, 1.0] {
        let centre = [-1.001, side * (edge + 0.15), 1.75];
        draft.wall(Place { centre, normal: [-1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0], half: [0.15, 1.25] });
    }
    draft
}

/// The boxes of the catalogue's E4, as ends in x and in y.
pub const BOXES: [[[f64; 2]; 2]; 6] = [
    [[0.3, 0.4], [-0.05, 0.05]],
    [[0.45, 0.55], [-0.05, 0.05]],
    [[0.5, 0.6], [0.0, 0.1]],
    [[0.6, 0.65], [0.1, 0.15]],
    [[0.2, 0.4], [0.1, 0.3]],
    [[0.5, 0.7], [-0.2, 0.2]],
];

/// The catalogue's E4.
pub fn cases() -> Vec<Case> {
    BOXES.map(|[x, y]| case(x, y)).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use crate::vector::{along, dot};

    #[test]
    fn catalogue_values() {
        for (u, want) in [(0.2, 1.6666667), (0.45, 10.0), (0.52, 49.509804), (0.6, 9.5454545), (0.7, 4.5833333)] {
            assert!((axis_irradiance(u) / want - 1.0).abs() < 1e-7, "{u}");
        }
        let fluxes = [0.032155675, 0.092208911, 0.072261664, 0.0073297507, 0.051585124, 0.41339757];
        for ([x, y], want) in BOXES.into_iter().zip(fluxes) {
            let got = box_flux(x, y, 1.0);
            assert!((got - want).abs() < 1e-8, "{x:?} {y:?}: {got} {want}");
        }
    }

    /// A box shrunk onto a point of the axis reads the irradiance there.
    #[test]
    fn small_boxes_read_the_irradiance() {
        for u in [0.3, 0.62] {
            let d = 0.002;
            let mean = box_flux([u - d, u + d], [-d, d], 1.0) / (4.0 * d * d);
            assert!((mean / axis_irradiance(u) - 1.0).abs() < 1e-3, "{u}: {mean}");
        }
    }

    /// Rays traced in space through everything that the scene contains: 6 comparisons at 4.5 standard errors.
    #[test]
    fn traced_rays_agree() {
        let (mut random, area) = (Random::new(33), 4.0 * 4.0);
        let mut flux: [Moments; 6] = Default::default();
        for _ in 0..400_000 {
            // Sun through a point of the floor plane: E_h is the flux per area there.
            let target = [random.between(-1.5, 2.5), random.between(-2.0, 2.0), 0.0];
            let lands = land(target);
            for ([x, y], moments) in BOXES.into_iter().zip(&mut flux) {
                let inside = |p: [f64; 3]| x[0] < p[0] && p[0] < x[1] && y[0] < p[1] && p[1] < y[1];
                moments.add(if lands.is_some_and(inside) { area } else { 0.0 });
            }
        }
        for (case, moments) in cases().iter().zip(&flux) {
            moments.must_agree(&case.name, case.expected[0].value[0]);
        }
    }

    /// Where sunlight headed for a point of the floor plane ends on the floor.
    fn land(target: [f64; 3]) -> Option<[f64; 3]> {
        let mut d = [1.0, 0.0, -1.0];
        let mut p = along(target, -6.0, d);
        if target[1].abs() > FRAC_PI_4.sin() {
            return None;
        }
        for _ in 0..20 {
            let (a, b) = (d[0] * d[0] + d[1] * d[1], p[0] * d[0] + p[1] * d[1]);
            let root = (b * b - a * (p[0] * p[0] + p[1] * p[1] - 1.0)).max(0.0).sqrt();
            let hits = [(-b - root) / a, (-b + root) / a].into_iter();
            let on_wall = |t: &f64| *t > 1e-9 && root > 0.0 && (0.0..1.0).contains(&(p[2] + t * d[2]));
            let Some(t) = hits.into_iter().find(on_wall) else { return Some(along(p, -p[2] / d[2], d)) };
            p = along(p, t, d);
            let normal = [-p[0], -p[1], 0.0];
            if dot(d, normal) > 0.0 {
                return None;
            }
            d = along(d, -2.0 * dot(d, normal), normal);
        }
        None
    }
}
