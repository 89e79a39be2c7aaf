//! Light from all around: its radiance by direction, and directions drawn by it.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use photonlab_photometry::{Colour, Palette};
use photonlab_scene::{EnvironmentLight, Sky};

use crate::{Stream, environment_table::Table, warp};

/// An environment ready for draws. Directions point from the scene outwards, to where the light comes from.
#[derive(Clone, Debug)]
pub struct Environment<const C: usize> {
    kind: Kind<C>,
    /// Integral of radiance over all directions, W/m^2 or lx.
    pub total: Colour<C>,
}

#[derive(Clone, Debug)]
enum Kind<const C: usize> {
    /// The same from everywhere.
    Constant(Colour<C>),
    /// The upper half of a sky, drawn evenly.
    Sky { radiance: Colour<C>, sky: Sky },
    /// A picture of all directions, drawn by its brightness.
    Map(Table<C>),
}

impl<const C: usize> Environment<C> {
    /// Prepares an environment.
    pub fn new(light: &EnvironmentLight, palette: &Palette<C>) -> Self {
        match light {
            EnvironmentLight::Constant { radiance } => {
                let radiance = palette.emission(radiance);
                Self { kind: Kind::Constant(radiance), total: radiance * (4.0 * PI) }
            }
            EnvironmentLight::Sky { radiance, sky } => {
                let radiance = palette.emission(radiance);
                Self { kind: Kind::Sky { radiance, sky: *sky }, total: radiance * sky.integral() }
            }
            EnvironmentLight::Map(map) => {
                let table = Table::new(map, palette);
                Self { total: table.total(), kind: Kind::Map(table) }
            }
        }
    }

    /// Radiance that comes from a direction.
    pub fn radiance(&self, direction: DVec3) -> Colour<C> {
        match &self.kind {
            Kind::Constant(radiance) => *radiance,
            Kind::Sky { radiance, sky } => *radiance * sky.relative_luminance(direction),
            Kind::Map(table) => table.radiance(direction),
        }
    }

    /// The largest radiance, of a sky as a close look finds it; in each channel.
    pub(crate) fn brightest(&self) -> Colour<C> {
        const LOOKS: usize = 128;
        match &self.kind {
            Kind::Constant(radiance) => *radiance,
            Kind::Sky { radiance, sky } => {
                let at = |i: usize, of: usize| (i as f64 + 0.5) / of as f64;
                let looks = (0..LOOKS * LOOKS).map(|i| [at(i % LOOKS, LOOKS), at(i / LOOKS, LOOKS)]);
                let luminance = |xi| sky.relative_luminance(warp::square_to_uniform_cone(xi, sky.zenith, 1.0));
                *radiance * looks.map(luminance).fold(0.0, f64::max)
            }
            Kind::Map(table) => table.brightest(),
        }
    }

    /// True if it may shine from small places that a coarse look misses.
    pub(crate) fn has_details(&self) -> bool {
        matches!(self.kind, Kind::Map(_))
    }

    /// A direction, from two numbers.
    pub fn draw(&self, xi: [f64; 2]) -> DVec3 {
        match &self.kind {
            Kind::Constant(_) => warp::square_to_uniform_sphere(xi),
            Kind::Sky { sky, .. } => warp::square_to_uniform_cone(xi, sky.zenith, 1.0),
            Kind::Map(table) => table.draw(xi),
        }
    }

    /// Density per solid angle of [`Environment::draw`].
    pub fn pdf_solid_angle(&self, direction: DVec3) -> f64 {
        match &self.kind {
            Kind::Constant(_) => 1.0 / (4.0 * PI),
            Kind::Sky { sky, .. } => {
                if direction.dot(sky.zenith) > 0.0 {
                    1.0 / TAU
                } else {
                    0.0
                }
            }
            Kind::Map(table) => table.pdf_solid_angle(direction),
        }
    }

    /// A direction and what a photon from there carries over the mean: radiance over density and total.
    pub fn emit(&self, stream: &mut Stream) -> (DVec3, Colour<C>) {
        let direction = self.draw(stream.next2());
        let over_pdf = self.radiance(direction) * (1.0 / self.pdf_solid_angle(direction));
        let share = |c: usize| if self.total[c] > 0.0 { over_pdf[c] / self.total[c] } else { 0.0 };
        (direction, Colour(std::array::from_fn(share)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Purpose;
    use glam::DMat3;
    use photonlab_photometry::Spectrum;
    use photonlab_scene::{SkyLaw, SkyMap};

    fn picture() -> EnvironmentLight {
        let (width, height) = (7, 5);
        let pixel = |i: usize| [(i % 3) as f32, 0.1 + (i % 5) as f32, ((i * i) % 11) as f32 * 0.3];
        let pixels = (0..width * height).map(pixel).collect();
        let to_world = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
        EnvironmentLight::Map(SkyMap { width, height, pixels, to_world })
    }

    fn all() -> [EnvironmentLight; 3] {
        let law = SkyLaw::General { kind: 12, sun: DVec3::new(0.6, 0.0, 0.8) };
        let sky = Sky { zenith: DVec3::new(0.0, 0.6, 0.8), law };
        let constant = EnvironmentLight::Constant { radiance: Spectrum::Rgb([1.0, 2.0, 3.0]) };
        [constant, EnvironmentLight::Sky { radiance: Spectrum::Uniform(1.0), sky }, picture()]
    }

    /// Means over draws and over uniform directions, weighted by their densities: the total, and a first moment. 18
    /// comparisons at |z| < 5, false alarm 1e-5 in all.
    #[test]
    fn draws_densities_and_totals_agree() {
        let n = 400_000;
        for light in all() {
            let environment = Environment::<3>::new(&light, &Palette::Channels);
            let mut stream = Stream::new(29, Purpose::Synthetic, 0, 0);
            for c in 0..3 {
                for test in [|_: DVec3| 1.0, |d: DVec3| d.x - 0.5 * d.y] {
                    let (mut drawn, mut weighed) = ([0.0; 2], [0.0; 2]);
                    for _ in 0..n {
                        let (d, share) = environment.emit(&mut stream);
                        let x = test(d) * share[c] * environment.total[c];
                        let d = warp::square_to_uniform_sphere(stream.next2());
                        let y = test(d) * environment.radiance(d)[c] * 4.0 * PI;
                        drawn = [drawn[0] + x, drawn[1] + x * x];
                        weighed = [weighed[0] + y, weighed[1] + y * y];
                    }
                    let mean = |s: [f64; 2]| s[0] / f64::from(n);
                    let error2 = |s: [f64; 2]| (s[1] / f64::from(n) - mean(s).powi(2)).max(0.0) / f64::from(n);
                    let z = (mean(drawn) - mean(weighed)) / (error2(drawn) + error2(weighed)).sqrt().max(1e-9);
                    assert!(z.abs() < 5.0, "{light:?} {c}: {} {}", mean(drawn), mean(weighed));
                }
            }
        }
    }

    /// The density integrates to one, and is that of the draws, by uniform directions: |z| < 5.
    #[test]
    fn the_density_is_one() {
        for light in all() {
            let environment = Environment::<3>::new(&light, &Palette::Channels);
            let mut stream = Stream::new(31, Purpose::Synthetic, 0, 0);
            let n = 200_000;
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..n {
                let p = environment.pdf_solid_angle(warp::square_to_uniform_sphere(stream.next2())) * 4.0 * PI;
                sum += p;
                squares += p * p;
            }
            let mean = sum / f64::from(n);
            let error = ((squares / f64::from(n) - mean * mean).max(0.0) / f64::from(n)).sqrt();
            assert!((mean - 1.0).abs() < 5.0 * error + 1e-12, "{light:?} {mean} {error}");
        }
    }
}
