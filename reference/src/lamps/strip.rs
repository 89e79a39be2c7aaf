//! A Lambertian strip without end, facing down.
//!
//! Its cross-section decides: a horizontal element receives the share `(sin b2 - sin b1) / 2` of the exitance, `b1` and
//! `b2` the angles from the vertical to the strip's edges (Hottel's strings; catalogue entry C5). Exact to rounding.
//! A strip cut off at `|y| = l` loses at most `2 (x2 - x1) h^2 / (3 pi l^3)` of it, since a square metre at distance `r`
//! sends the share `h^2 / (pi r^4)`.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// A strip `x1 < x < x2` at height `height` along y, black itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StripLamp {
    edges: [f64; 2],
    height: f64,
    exitance: f64,
}

impl StripLamp {
    /// A strip between `edges` (m, ascending) at `height` (m) with `exitance` in W/m^2 or lm/m^2.
    pub fn new(edges: [f64; 2], height: f64, exitance: f64) -> Result<Self, OutOfRange> {
        require(edges[0] < edges[1], "second edge", edges[1], "above the first")?;
        require_positive("height", height)?;
        require_positive("exitance", exitance)?;
        Ok(StripLamp { edges, height, exitance })
    }

    /// Irradiance of the floor z = 0 at `x` (m), in W/m^2 or lx.
    pub fn irradiance(&self, x: f64) -> f64 {
        let sine = |edge: f64| (edge - x) / self.height.hypot(edge - x);
        0.5 * self.exitance * (sine(self.edges[1]) - sine(self.edges[0]))
    }

    /// The most that a strip of this half-length (m) lacks of [`StripLamp::irradiance`] at `y = 0`.
    pub fn truncation(&self, half_length: f64) -> f64 {
        let width = self.edges[1] - self.edges[0];
        2.0 * self.exitance * width * self.height * self.height / (3.0 * PI * half_length.powi(3))
    }

    /// The strip, 200 heights long, over a square meter at the origin.
    pub fn case(&self) -> Case {
        let half = [0.5 * (self.edges[1] - self.edges[0]), 100.0 * self.height];
        let place = Place::floor([0.5 * (self.edges[0] + self.edges[1]), 0.0, self.height], half).turned();
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.exitance / PI]);
        let mut draft = Draft::with(mitsuba::flat("rectangle", "lamp", place, &on_it));
        let meter = 0.05 * self.height;
        let uncertainty = self.truncation(half[1] - meter) + 1e-12 * self.exitance;
        draft.square(Place::floor([0.0; 3], [meter; 2]), uncertainty, |p| self.irradiance(p[0]));
        draft.case(format!("strip from {} to {} m", self.edges[0], self.edges[1]))
    }
}

/// The strips of the catalogue's C5: 1 m above the floor, 1000 lm/m^2.
pub fn cases() -> Vec<Case> {
    let edges = [[-0.5, 0.5], [0.0, 1.0], [1.0, 2.0], [-5.0, 5.0]];
    edges.map(|edges| StripLamp { edges, height: 1.0, exitance: 1000.0 }.case()).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;
    use crate::square_lamp::RectangularLamp;

    #[test]
    fn catalogue_values() {
        let rows = [(-0.5, 0.5, 0.4472136), (0.0, 1.0, 0.35355339), (1.0, 2.0, 0.093660205), (-5.0, 5.0, 0.98058068)];
        for (x1, x2, want) in rows {
            let got = StripLamp::new([x1, x2], 1.0, 1.0).expect("valid").irradiance(0.0);
            assert!((got - want).abs() < 1e-8, "{x1} {x2}: {got}");
        }
        assert!(StripLamp::new([1.0, 1.0], 1.0, 1.0).is_err());
    }

    /// The definition, and the closed form of the rectangle that the strip is cut to.
    #[test]
    fn the_closed_form_is_the_integral_and_the_bound_holds() {
        let strip = StripLamp::new([-0.7, 1.1], 0.8, 2.0).expect("valid");
        let lines = |u: f64| 0.8 * 0.8 / (2.0 * (u * u + 0.64).powf(1.5));
        let brute = 2.0 * Gauss::new(16).composite(-1.0, 0.8, 8, lines);
        assert!((strip.irradiance(0.3) / brute - 1.0).abs() < 1e-12);
        for length in [20.0, 80.0] {
            let cut = RectangularLamp::new([1.8, length], 0.8, 2.0 / PI).expect("valid");
            let lost = strip.irradiance(0.2) - cut.irradiance(0.0, 0.0);
            let bound = strip.truncation(0.5 * length);
            assert!(lost > 0.9 * bound && lost < bound, "{length}: {lost} {bound}");
        }
    }
}
