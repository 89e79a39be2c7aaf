//! A checker of shadow and light, and what a disc makes of it.
//!
//! Parallel light straight down passes square gaps between square plates; the floor is lit in a checker of sharp squares. With the
//! pattern `T` of 1 and 0 as the Fourier series `1/2 + 1/2 sum a_mn sin(pi m x / p) sin(pi n y / p)` over odd `m`, `n`, `a_mn = 16 / (pi^2 m n)`,
//! a disc of radius `r` multiplies each term by `H = 2 J_1(t) / t`, `t = pi r sqrt(m^2 + n^2) / p` (catalogue A3). Relative to the mean irradiance
//! squared a term has the mean square `c_mn = 64 / (pi^4 m^2 n^2)`, which sum to 1.

use std::f64::consts::PI;

use crate::catalogue::Reads;
use crate::disc_response::disc_response;
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// Terms of the series in each direction. What is left out falls as the power -2.5.
const TERMS: u32 = 60;

/// A floor of `tiles` by `tiles` squares around the origin, lit with irradiance 1 or dark in turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    side: f64,
    tiles: u32,
}

/// Photons that fall alike on an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shower {
    /// How many.
    pub photons: f64,
    /// On how many square metres, plates and all around included.
    pub area: f64,
}

impl Checker {
    /// Squares of this side (m); their number along the floor is even, so that four of them meet at the origin.
    pub fn new(side: f64, tiles: u32) -> Result<Self, OutOfRange> {
        require_positive("side", side)?;
        require(tiles > 0 && tiles.is_multiple_of(2), "tiles", f64::from(tiles), "even and above 0")?;
        Ok(Self { side, tiles })
    }

    /// Half the width of the floor (m).
    pub fn half_width(&self) -> f64 {
        0.5 * self.side * f64::from(self.tiles)
    }

    /// Irradiance of the floor at a point (m) that is on no square's edge: 1 or 0.
    pub fn irradiance(&self, x: f64, y: f64) -> f64 {
        let odd = (x / self.side).floor() as i64 + (y / self.side).floor() as i64;
        if odd.rem_euclid(2) == 0 { 1.0 } else { 0.0 }
    }

    /// Sums of `c_mn H` and of `c_mn H^2`.
    fn sums(&self, radius: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for m in (1..2 * TERMS).step_by(2).map(f64::from) {
            for n in (1..2 * TERMS).step_by(2).map(f64::from) {
                let share = 64.0 / (PI.powi(4) * m * m * n * n);
                let passed = disc_response(PI * radius / self.side * m.hypot(n));
                sums[0] += share * passed;
                sums[1] += share * passed * passed;
            }
        }
        sums
    }

    /// Mean over the floor of the squared bias of a fixed-radius reading, relative to the mean irradiance squared: `sum c_mn (1 - H)^2`; 1 where the
    /// squares are much smaller than the disc. The floor's edges are left out. Good to 1e-4.
    pub fn squared_bias(&self, radius: f64) -> f64 {
        let [first, second] = self.sums(radius);
        1.0 - 2.0 * first + second
    }

    /// The same with the noise of photons of equal flux: a disc whose share `q` of the shower's area is lit holds a binomial count of variance `n q (1 -
    /// q)`; the mean of `q` is half the disc's share of the area, and that of its square a quarter of the share's times `1 + sum c_mn H^2`.
    pub fn squared_error(&self, radius: f64, shower: Shower) -> f64 {
        let disc = PI * radius * radius / shower.area;
        let [first, second] = self.sums(radius);
        let noise = (2.0 / disc - 1.0 - second) / shower.photons;
        1.0 - 2.0 * first + second + noise
    }

    /// The scene: black plates at a height (m) over a black floor whose meter (`floor`) reads the irradiance of `cells` by `cells` equal cells.
    pub fn xml(&self, height: f64, cells: usize) -> String {
        let on_floor = mitsuba::diffuse(&[0.0]) + &mitsuba::film_meter(Reads::Irradiance, "floor", cells);
        let half = self.half_width();
        let mut body = mitsuba::parallel_light([0.0, 0.0, -1.0], &[1.0]);
        body += &mitsuba::flat("rectangle", "cells", Place::floor([0.0; 3], [half; 2]), &on_floor);
        let middle = |tile: u32| (f64::from(tile) + 0.5) * self.side - half;
        for (i, j) in (0..self.tiles).flat_map(|i| (0..self.tiles).map(move |j| (i, j))) {
            let (x, y) = (middle(i), middle(j));
            if self.irradiance(x, y) == 0.0 {
                let place = Place::floor([x, y, height], [0.5 * self.side; 2]);
                let id = format!("plate-{i}-{j}");
                body += &mitsuba::flat("rectangle", &id, place, &mitsuba::diffuse(&[0.0]));
            }
        }
        mitsuba::scene(&body)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn the_scene_has_half_as_many_plates_as_tiles() {
        let checker = Checker::new(0.5, 6).expect("in range");
        assert_eq!(checker.xml(2.0, 12).matches("plate-").count(), 18);
        assert_eq!(
            (checker.irradiance(0.1, 0.1), checker.irradiance(-0.1, 0.1), checker.half_width()),
            (1.0, 0.0, 1.5)
        );
        assert!(Checker::new(0.5, 3).is_err());
    }

    /// Two random points of a disc around a random place have the bias squared in the mean of their product; 4 comparisons at 4.5 standard
    /// errors.
    #[test]
    fn thrown_points_agree() {
        let mut random = Random::new(113);
        for side in [0.3, 1.0, 2.0, 6.0] {
            let checker = Checker::new(side, 2).expect("in range");
            let mut square = Moments::default();
            for _ in 0..400_000 {
                let place = [0; 2].map(|_| random.between(0.0, 2.0 * side));
                let truth = checker.irradiance(place[0], place[1]);
                let mut off = || {
                    let (s, phi) = (random.unit().sqrt(), random.between(0.0, 2.0 * PI));
                    checker.irradiance(place[0] + s * phi.cos(), place[1] + s * phi.sin()) - truth
                };
                square.add(4.0 * off() * off());
            }
            square.must_agree(&format!("squares of {side}"), checker.squared_bias(1.0));
        }
    }

    /// Photons thrown on a patch of plates, read in its middle part; 2 comparisons at 4.5 standard errors.
    #[test]
    fn thrown_photons_agree() {
        let mut random = Random::new(114);
        for side in [0.5, 2.0] {
            let checker = Checker::new(side, 2).expect("in range");
            let half = side + 1.0;
            let shower = Shower { photons: 200.0, area: 4.0 * half * half };
            let mut square = Moments::default();
            for _ in 0..30_000 {
                let [x, y] = [0; 2].map(|_| random.between(-side, side));
                let mut found = 0.0;
                for _ in 0..shower.photons as u32 {
                    let [u, v] = [0; 2].map(|_| random.between(-half, half));
                    let near = (u - x).powi(2) + (v - y).powi(2) < 1.0;
                    found += if near { checker.irradiance(u, v) } else { 0.0 };
                }
                let read = found * shower.area / (shower.photons * PI);
                square.add(4.0 * (read - checker.irradiance(x, y)).powi(2));
            }
            square.must_agree(&format!("squares of {side}"), checker.squared_error(1.0, shower));
        }
    }
}
