//! Openings through which an environment's light is aimed.
//!
//! A portal is a rectangle without a coating in an opening. It takes part in two ways, and neither needs it to be right:
//!
//! - *Photons.* Every ray from infinity that crosses a portal along its normal, before it meets any surface, belongs to that
//!   portal (to the first in the file of those it crosses), every other ray to the environment's disc. A photon that starts
//!   as another's is dark. So light that comes by other ways is counted, and no light twice, however the portals stand.
//! - *Direct light* is drawn through portals and by the environment, with weights by the balance heuristic (Veach and Guibas
//!   1995): every direction in which the environment shines keeps a density above zero.
//!
//! Both leave the environment a small part of the photons and draws. Portals pay where little light comes by other ways.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Ray, Surface, World};

use crate::{Environment, Stream, warp::Frame};

/// Parts of the hemisphere, even in the squared sine of the angle to the normal and in the azimuth, so that all have the same
/// projected solid angle.
const RINGS: usize = 16;
const SECTORS: usize = 64;
/// Looks at the environment in each part, each way.
const LOOKS: usize = 3;
/// Share of the mean weight that a part has at least: light may hide between the looks.
const LEAST: f64 = 0.1;
/// Irradiance that is reckoned with where no look found light, over the environment's total.
const HIDDEN: f64 = 1e-3;

/// What an environment sends through a portal.
#[derive(Clone, Debug)]
pub struct Portal<const C: usize> {
    environment: Arc<Environment<C>>,
    /// Around the way out.
    frame: Frame,
    outwards: DVec3,
    /// Running sum of the parts' weights.
    cumulative: Vec<f64>,
    /// Share of the directions that the environment draws, to find what is small and bright.
    by_environment: f64,
    /// Irradiance through it as the looks found it, W/m^2 or lx.
    pub(crate) irradiance: Colour<C>,
}

impl<const C: usize> Portal<C> {
    /// A portal whose light goes along `normal`.
    pub(crate) fn new(environment: &Arc<Environment<C>>, normal: DVec3) -> Self {
        let by_environment = if environment.has_details() { 0.5 } else { 0.0 };
        let mut portal = Self {
            environment: environment.clone(),
            frame: Frame::around(-normal),
            outwards: -normal,
            cumulative: Vec::with_capacity(RINGS * SECTORS),
            by_environment,
            irradiance: Colour::ZERO,
        };
        let mut brightest = Vec::with_capacity(RINGS * SECTORS);
        for part in 0..RINGS * SECTORS {
            let mut most: f64 = 0.0;
            for look in 0..LOOKS * LOOKS {
                let at = [look % LOOKS, look / LOOKS].map(|i| (i as f64 + 0.5) / LOOKS as f64);
                let radiance = environment.radiance(portal.direction(part, at));
                portal.irradiance += radiance * (PI / (RINGS * SECTORS * LOOKS * LOOKS) as f64);
                most = most.max(radiance.max());
            }
            brightest.push(most);
        }
        // What no look has found may be there all the same.
        for c in 0..C {
            if portal.irradiance[c] == 0.0 {
                portal.irradiance[c] = HIDDEN * environment.total[c];
            }
        }
        let mean = brightest.iter().sum::<f64>() / brightest.len() as f64;
        let least = if mean > 0.0 { LEAST * mean } else { 1.0 };
        let mut sum = 0.0;
        for weight in brightest {
            sum += weight.max(least);
            portal.cumulative.push(sum);
        }
        portal
    }

    /// The direction, outwards, at a place in [0, 1)^2 of a part.
    fn direction(&self, part: usize, at: [f64; 2]) -> DVec3 {
        let sine2 = ((part / SECTORS) as f64 + at[0]) / RINGS as f64;
        let (sin, cos) = (TAU * ((part % SECTORS) as f64 + at[1]) / SECTORS as f64).sin_cos();
        let sine = sine2.sqrt();
        self.frame.world(DVec3::new(sine * cos, sine * sin, (1.0 - sine2).max(0.0).sqrt()))
    }

    /// Density per projected solid angle of the parts' draws.
    fn pdf_of_parts(&self, outwards: DVec3) -> f64 {
        let local = self.frame.local(outwards);
        let turn = local.y.atan2(local.x) / TAU;
        let ring = ((local.x * local.x + local.y * local.y) * RINGS as f64) as usize;
        let sector = ((turn - turn.floor()) * SECTORS as f64) as usize;
        let part = ring.min(RINGS - 1) * SECTORS + sector.min(SECTORS - 1);
        let before = if part > 0 { self.cumulative[part - 1] } else { 0.0 };
        let share = (self.cumulative[part] - before) / self.cumulative[RINGS * SECTORS - 1];
        share * (RINGS * SECTORS) as f64 / PI
    }

    /// A direction into the scene and what a photon along it carries over the mean.
    pub(crate) fn emit(&self, stream: &mut Stream) -> (DVec3, Colour<C>) {
        let outwards = if stream.next() < self.by_environment {
            self.environment.draw(stream.next2())
        } else {
            let total = self.cumulative[RINGS * SECTORS - 1];
            let wanted = stream.next() * total;
            let part = self.cumulative.partition_point(|&sum| sum <= wanted).min(RINGS * SECTORS - 1);
            self.direction(part, stream.next2())
        };
        let cosine = outwards.dot(self.outwards);
        if cosine <= 0.0 {
            return (-outwards, Colour::ZERO);
        }
        let of_environment = if self.by_environment > 0.0 {
            self.by_environment * self.environment.pdf_solid_angle(outwards) / cosine
        } else {
            0.0
        };
        let pdf = of_environment + (1.0 - self.by_environment) * self.pdf_of_parts(outwards);
        let over_pdf = self.environment.radiance(outwards) * (1.0 / pdf);
        let share = |c: usize| if self.irradiance[c] > 0.0 { over_pdf[c] / self.irradiance[c] } else { 0.0 };
        (-outwards, Colour(std::array::from_fn(share)))
    }
}

/// True if a line crosses one of these portals along its normal nearer than `limit` along the ray; behind its start counts.
pub(crate) fn crosses(world: &World, portals: &[u32], ray: &Ray, limit: impl FnOnce() -> f64) -> bool {
    let nearest = portals.iter().filter_map(|&portal| distance(world, portal, ray)).reduce(f64::min);
    nearest.is_some_and(|nearest| nearest <= 0.0 || nearest < limit())
}

fn distance(world: &World, portal: u32, ray: &Ray) -> Option<f64> {
    let Surface::Parallelogram(face) = &world.primitives[portal as usize].surface else { return None };
    let along = face.normal.dot(ray.direction) > 0.0;
    along.then(|| face.intersect(ray, f64::NEG_INFINITY)).flatten().map(|(t, _)| t)
}

/// Where a ray goes out through a portal.
pub(crate) fn way_out(world: &World, portal: u32, ray: &Ray) -> Option<DVec3> {
    let Surface::Parallelogram(face) = &world.primitives[portal as usize].surface else { return None };
    let out = face.normal.dot(ray.direction) < 0.0;
    out.then(|| face.intersect(ray, 0.0)).flatten().map(|(t, _)| ray.at(t))
}

#[cfg(test)]
mod tests {
    use photonlab_photometry::{Palette, Spectrum};
    use photonlab_scene::{EnvironmentLight, Sky, SkyLaw, SkyMap};

    use super::*;
    use crate::{Purpose, warp};

    fn lights() -> [EnvironmentLight; 3] {
        let law = SkyLaw::General { kind: 12, sun: DVec3::new(0.6, 0.0, 0.8) };
        let sky = Sky { zenith: DVec3::Z, law };
        // One pixel in 2048 is a sun.
        let (width, height) = (64, 32);
        let mut pixels = vec![[0.2, 0.5, 0.0]; width * height];
        pixels[10 * width + 40] = [300.0, 200.0, 100.0];
        let map = SkyMap { width, height, pixels, to_world: glam::DMat3::from_rotation_x(0.4) };
        [
            EnvironmentLight::Constant { radiance: Spectrum::Rgb([1.0, 2.0, 0.0]) },
            EnvironmentLight::Sky { radiance: Spectrum::Uniform(2.0), sky },
            EnvironmentLight::Map(map),
        ]
    }

    /// Means over draws, and over directions even in projected solid angle weighed by the radiance: the irradiance, and a
    /// first moment. A window in a wall, one in a roof and one facing the ground: 54 comparisons at |z| < 5.5, false alarm
    /// 2e-6 in all.
    #[test]
    fn draws_are_what_the_environment_sends_through() {
        let n = 200_000;
        let mut stream = Stream::new(37, Purpose::Synthetic, 0, 0);
        for light in lights() {
            let environment = Arc::new(Environment::<3>::new(&light, &Palette::Channels));
            for normal in [DVec3::new(0.6, -0.8, 0.0), DVec3::NEG_Z, DVec3::Z] {
                let portal = Portal::new(&environment, normal);
                for c in 0..3 {
                    for test in [|_: DVec3| 1.0, |d: DVec3| d.x + 0.5 * d.y - 0.2 * d.z] {
                        let (mut drawn, mut weighed) = ([0.0; 2], [0.0; 2]);
                        for _ in 0..n {
                            let (direction, share) = portal.emit(&mut stream);
                            let x = test(direction) * share[c] * portal.irradiance[c];
                            let direction = warp::square_to_cosine_hemisphere(stream.next2(), normal);
                            let y = test(direction) * environment.radiance(-direction)[c] * PI;
                            drawn = [drawn[0] + x, drawn[1] + x * x];
                            weighed = [weighed[0] + y, weighed[1] + y * y];
                        }
                        let mean = |s: [f64; 2]| s[0] / f64::from(n);
                        let error2 = |s: [f64; 2]| (s[1] / f64::from(n) - mean(s).powi(2)).max(0.0) / f64::from(n);
                        let z = (mean(drawn) - mean(weighed)) / (error2(drawn) + error2(weighed)).sqrt().max(1e-9);
                        assert!(z.abs() < 5.5, "{light:?} {normal} {c}: {} {}", mean(drawn), mean(weighed));
                    }
                }
            }
        }
    }

    /// Even light leaves by Lambert's law, and every photon carries the same.
    #[test]
    fn even_light_needs_no_weights() {
        let environment = Arc::new(Environment::<3>::new(&lights()[0], &Palette::Channels));
        let portal = Portal::new(&environment, DVec3::X);
        let mut stream = Stream::new(38, Purpose::Synthetic, 0, 0);
        for _ in 0..1000 {
            let (direction, share) = portal.emit(&mut stream);
            assert!(direction.x > 0.0 && (share[0] - 1.0).abs() < 1e-9 && (share[1] - 1.0).abs() < 1e-9);
        }
    }
}
