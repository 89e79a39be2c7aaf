//! A Lambertian rectangle standing on the floor: a lamp, or a wall that reflects.
//!
//! A rectangle of width `W` and height `H` with one bottom corner at distance `c` straight in front of a horizontal
//! element on the floor sends it the share
//! `F = 1/(2 pi) [atan(W/c) - c/sqrt(H^2 + c^2) atan(W/sqrt(H^2 + c^2))]` of its exitance (Lambert's boundary integral;
//! Howell's catalogue B-4; catalogue entries C2 and I3). `F` is odd in `W`, so any place in front is a difference of two.
//! Exact to rounding, 1e-14.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_positive};

/// A rectangle in the plane y = 0, standing on z = 0 with its middle at x = 0 and its front towards +y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandingPatch {
    width: f64,
    height: f64,
    exitance: f64,
}

impl StandingPatch {
    /// A patch of this width and height (m) that sends out `exitance` (W/m^2 or lm/m^2), evenly and diffusely.
    pub fn new(width: f64, height: f64, exitance: f64) -> Result<Self, OutOfRange> {
        require_positive("width", width)?;
        require_positive("height", height)?;
        require_positive("exitance", exitance)?;
        Ok(StandingPatch { width, height, exitance })
    }

    /// Irradiance of the floor at `x` along the patch from its middle and `y > 0` in front of it (m).
    pub fn irradiance(&self, x: f64, y: f64) -> f64 {
        let share = |w: f64| corner(w, self.height, y);
        self.exitance * (share(0.5 * self.width - x) + share(0.5 * self.width + x))
    }

    fn place(&self) -> Place {
        let half = [0.5 * self.width, 0.5 * self.height];
        Place { centre: [0.0, 0.0, half[1]], normal: [0.0, 1.0, 0.0], up: [0.0, 0.0, 1.0], half }
    }

    /// As a lamp, with square meters on the floor at these `(x, y)`, their half-edge a fifth of `y`.
    pub fn lamp_case(&self, at: &[[f64; 2]]) -> Case {
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.exitance / PI]);
        let body = mitsuba::flat("rectangle", "lamp", self.place(), &on_it);
        self.with_meters(body, at).case(format!("{} by {} m", self.width, self.height))
    }

    /// As a wall of this reflectance in horizontal parallel light of irradiance `exitance / reflectance` along -y, with
    /// meters as in [`StandingPatch::lamp_case`]. The light passes along the floor without falling on it.
    pub fn wall_case(&self, reflectance: f64, at: &[[f64; 2]]) -> Case {
        let body = mitsuba::parallel_light([0.0, -1.0, 0.0], &[self.exitance / reflectance])
            + &mitsuba::flat("rectangle", "wall", self.place(), &mitsuba::diffuse(&[reflectance]));
        self.with_meters(body, at).case(format!("wall {} by {} m, reflectance {reflectance}", self.width, self.height))
    }

    fn with_meters(&self, body: String, at: &[[f64; 2]]) -> Draft {
        let mut draft = Draft::with(body);
        for &[x, y] in at {
            let place = Place::floor([x, y, 0.0], [0.2 * y; 2]);
            draft.square(place, 1e-9 * self.exitance, |p| self.irradiance(p[0], p[1]));
        }
        draft
    }
}

/// The perpendicular part of the catalogue's C2: the element in front of a bottom corner, 1000 lm/m^2.
pub fn lamp_cases() -> Vec<Case> {
    let patch = |width, height| StandingPatch { width, height, exitance: 1000.0 };
    vec![
        patch(1.0, 1.0).lamp_case(&[[0.5, 0.1], [0.5, 0.5], [0.5, 1.0]]),
        patch(2.0, 1.0).lamp_case(&[[1.0, 0.5]]),
        patch(0.5, 2.0).lamp_case(&[[0.25, 0.25]]),
    ]
}

/// The catalogue's I3: square walls of 0.5 and 4 m, reflectance 0.3, in 1000 lx.
pub fn wall_cases() -> Vec<Case> {
    let at = [0.25, 0.5, 1.0, 2.0, 4.0].map(|y| [0.0, y]);
    [0.5, 4.0].map(|side| StandingPatch { width: side, height: side, exitance: 300.0 }.wall_case(0.3, &at)).to_vec()
}

/// Share received in front of one bottom corner of a patch of width `w` and height `h`, at distance `c`.
fn corner(w: f64, h: f64, c: f64) -> f64 {
    let far = h.hypot(c);
    ((w / c).atan() - c / far * (w / far).atan()) / (2.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    /// Catalogue C2 (share at a corner) and I3 (illuminance on the axis).
    #[test]
    fn catalogue_values() {
        for (w, h, c, share) in [
            (1.0, 1.0, 1.0, 0.055734197),
            (1.0, 1.0, 0.5, 0.12426891),
            (1.0, 1.0, 0.1, 0.22173867),
            (2.0, 1.0, 0.5, 0.1354884),
            (0.5, 2.0, 0.25, 0.17140802),
        ] {
            assert!((StandingPatch::new(w, h, 1.0).expect("valid").irradiance(0.5 * w, c) - share).abs() < 1e-8);
        }
        let small = [57.040765, 21.328032, 4.6042348, 0.69515072, 0.091583709];
        let large = [135.36781, 121.15125, 95.264883, 57.040765, 21.328032];
        for (side, row) in [(0.5, small), (4.0, large)] {
            let patch = StandingPatch::new(side, side, 300.0).expect("valid");
            for (c, want) in [0.25, 0.5, 1.0, 2.0, 4.0].into_iter().zip(row) {
                assert!((patch.irradiance(0.0, c) / want - 1.0).abs() < 1e-7, "{side} {c}");
            }
        }
    }

    /// The definition on the patch's area: both cosines over distance squared.
    #[test]
    fn the_closed_form_is_the_integral() {
        let (patch, rule) = (StandingPatch::new(1.5, 0.8, 1.0).expect("valid"), Gauss::new(16));
        for (x, y) in [(0.0, 0.5), (0.75, 0.2), (-2.0, 1.0), (0.3, 5.0)] {
            let kernel = |u: f64, z: f64| y * z / (PI * ((u - x).powi(2) + y * y + z * z).powi(2));
            let row = |u: f64| rule.composite(0.0, 0.8, 6, |z| kernel(u, z));
            let brute = rule.composite(-0.75, 0.75, 12, row);
            let got = patch.irradiance(x, y);
            assert!((got / brute - 1.0).abs() < 1e-9, "({x}, {y}): {got} {brute}");
        }
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        let case = StandingPatch::new(2.0, 1.0, 300.0).expect("valid").wall_case(0.3, &[[0.0, 1.0]]);
        mitsuba::assert_balanced(&case.xml);
        assert!(case.xml.contains("value=\"1000\"") && case.xml.contains("scale x=\"1\" y=\"0.5\""), "{}", case.xml);
        assert!(StandingPatch::new(1.0, 0.0, 1.0).is_err());
    }
}
