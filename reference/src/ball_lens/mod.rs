//! A glass ball in parallel light above a floor: the caustic on the floor.
//!
//! A ray keeps its plane and its distance `b` from the ball's centre. With `sin i = b`, `sin r = b / n` (lengths in ball
//! radii) the order `p` (0 reflected outside, 1 straight through, `p` with `p - 1` reflections inside) leaves turned by
//! `theta = 2 i - 2 p r + (p - 1) pi` towards the axis and meets the floor, `H` below the centre, at the signed distance
//! `x = b / cos theta - H tan theta` from the axis, if `cos theta > 0`. Its share is `F` for `p = 0` and
//! `(1 - F)^2 F^(p-1)` else, `F` Fresnel's reflectance at the angle `i`, unpolarised anew at each interface (as renderers
//! without polarisation have it). Flux is conserved along the map `b -> |x|`. (Optics textbook; van de Hulst, "Light
//! Scattering by Small Particles", chapter 12; catalogue entry E2 for `p = 1`.)
//!
//! The floor's own reflection is left out and bounded by [`BallLens::floor_return_bound`].

mod blur;
mod encircled;
mod floor_return;
mod flux;
mod ray_map;
mod under_lamp;

use crate::catalogue::Reads;
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

pub use encircled::cases;
pub use flux::Fold;
pub use under_lamp::DiscLamp;

/// A ball of glass above the floor z = 0, its centre on the z axis, in light of irradiance 1 along -z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallLens {
    radius: f64,
    index: f64,
    height: f64,
}

impl BallLens {
    /// The benchmark: radius 0.5 m, index 1.5, centre 1 m above the floor.
    pub const BENCHMARK: BallLens = BallLens { radius: 0.5, index: 1.5, height: 1.0 };

    /// A ball of `radius` (m) and refractive `index` above 1, its centre `height` (m, at least the radius) above the floor.
    pub fn new(radius: f64, index: f64, height: f64) -> Result<Self, OutOfRange> {
        require_positive("radius", radius)?;
        require(index > 1.0 && index.is_finite(), "index", index, "finite and above 1")?;
        require(height >= radius && height.is_finite(), "height", height, "at least the radius")?;
        Ok(BallLens { radius, index, height })
    }

    /// Height of the centre in ball radii.
    fn height_in_radii(&self) -> f64 {
        self.height / self.radius
    }

    /// The scene as Mitsuba 3 XML: light, ball, floor `[-1, 1]^2` of this reflectance, and a camera between floor and ball
    /// whose `cells` by `cells` pixels are equal cells of the floor over `[-half_width, half_width]^2`.
    pub fn xml(&self, floor_reflectance: f64, half_width: f64, cells: usize) -> String {
        let below = 0.8 * (self.height - self.radius);
        let floor = mitsuba::diffuse(&[floor_reflectance]);
        let glass = mitsuba::dielectric(self.index);
        let centre = [0.0, 0.0, self.height];
        mitsuba::scene(
            &(mitsuba::floor_camera(below, half_width, cells)
                + &mitsuba::parallel_light([0.0, 0.0, -1.0], &[1.0])
                + &mitsuba::rectangle("floor", "", &floor)
                + &mitsuba::sphere("ball", centre, self.radius, false, &glass)),
        )
    }

    /// The scene with a black floor `[-half_width, half_width]^2` whose meter (`floor`) reads the irradiance of `cells` by `cells`
    /// equal cells, in parallel light or under a lamp.
    pub fn metered_xml(&self, lamp: Option<DiscLamp>, half_width: f64, cells: usize) -> String {
        let light = lamp.map_or(mitsuba::parallel_light([0.0, 0.0, -1.0], &[1.0]), |lamp| lamp.xml());
        let on_floor = mitsuba::diffuse(&[0.0]) + &mitsuba::film_meter(Reads::Irradiance, "floor", cells);
        let (centre, glass) = ([0.0, 0.0, self.height], mitsuba::dielectric(self.index));
        mitsuba::scene(
            &(light
                + &mitsuba::flat("rectangle", "cells", Place::floor([0.0; 3], [half_width; 2]), &on_floor)
                + &mitsuba::sphere("ball", centre, self.radius, false, &glass)),
        )
    }
}

#[cfg(test)]
mod checks;
