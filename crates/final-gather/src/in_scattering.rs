//! Light that a medium scatters into a ray.

use photonlab_gather::{Beam, CHECK, Scattered, VolumeMap};
use photonlab_photometry::{Colour, PathClass, VolumePhoton};
use photonlab_sampling::{Stream, phase_pdf_solid_angle};
use photonlab_scene::{Ray, World};

use crate::{EyeLimits, Light, MapWithRadius, segment::Walk, stretches::Stretches};

/// The volume maps.
#[derive(Clone, Copy)]
pub struct VolumeMaps<'m, const C: usize> {
    /// All photons.
    pub all: MapWithRadius<'m, VolumeMap<C>>,
    /// Photons that came through specular surfaces alone; `None` if there are none, or where `all` serves for them too.
    pub caustic: Option<MapWithRadius<'m, VolumeMap<C>>>,
}

/// How light that media scatter into a ray is found.
#[derive(Clone, Copy)]
pub enum InScattering<'m, const C: usize> {
    /// Without maps: the ray collides, draws a lamp and is scattered, on and on.
    ByPaths,
    /// Final gather: light scattered once comes from lamps that are drawn and from caustic photons along the ray; all other is
    /// seen by the ray as its first collision scatters it on, from then on by `Gathered`. The kernel of the map then
    /// blurs what a collision sees, which is even, not what the ray sees, which may pass close to a lamp.
    ByLook(VolumeMaps<'m, C>),
    /// From the map, but within reach of surfaces, where the kernel would reach over them, as by `ByLook`.
    Gathered(VolumeMaps<'m, C>),
    /// From the map, all along the ray.
    FromMap {
        /// Photons of every class are in it, or all but direct ones.
        map: MapWithRadius<'m, VolumeMap<C>>,
        /// True if lamps are drawn, and direct photons left out.
        draws_lamps: bool,
    },
}

/// What became of a ray in a medium.
pub(crate) enum Crossing {
    /// It reaches what lies ahead.
    Passed,
    /// It was scattered and goes on from there.
    Turned,
    /// It ended.
    Ended,
}

impl<const C: usize> Walk<'_, '_, C> {
    /// Takes the ray through a medium to the next surface at a distance, which may be infinite.
    pub(crate) fn cross(&mut self, medium: u32, reach: f64, limits: &EyeLimits, stream: &mut Stream) -> Crossing {
        let volume = self.optics.volume(medium);
        if !volume.scatters() {
            self.weight = self.weight * volume.transmittance(reach);
            return Crossing::Passed;
        }
        // What scatters light is never proved dark, whatever is found.
        self.landing.met_rough = true;
        if self.weight.is_zero() {
            return Crossing::Ended;
        }
        let depth = reach.min(volume.depth());
        let piece = Piece { ray: self.ray, world: self.world, medium, depth, limits };
        let all_of_it = |along| volume.transmittance(along);
        match self.in_scattering {
            InScattering::ByPaths => self.fly(volume, reach, |_| true, limits, stream),
            InScattering::ByLook(maps) => {
                if let Some(caustic) = maps.caustic {
                    let near = piece.near_surfaces([0.0, depth], caustic.radius);
                    self.read_along(&piece, caustic, &near, all_of_it, |class, _| class == PathClass::Caustic);
                }
                self.fly(volume, reach, |_| true, limits, stream)
            }
            InScattering::Gathered(maps) => self.gather(&piece, reach, maps, stream),
            InScattering::FromMap { map, draws_lamps } => {
                let near = piece.near_surfaces([0.0, depth], map.radius);
                self.read_along(&piece, map, &near, all_of_it, |class, _| !draws_lamps || class != PathClass::Direct);
                if draws_lamps {
                    self.draw_once(volume, reach, limits, stream);
                }
                self.weight = self.weight * volume.transmittance(reach);
                Crossing::Passed
            }
        }
    }

    /// Reads the map as far as the ray flies, and collides only where the map's kernel would reach over a surface.
    ///
    /// Of many rays each needs little: photons count up to the collision alone, by their transmittance over the share of rays
    /// that fly so far, which costs a short query instead of one as deep as light reaches.
    fn gather(&mut self, piece: &Piece<'_>, reach: f64, maps: VolumeMaps<'_, C>, stream: &mut Stream) -> Crossing {
        let (volume, weight) = (self.optics.volume(piece.medium), self.weight);
        let left_out = |along: f64| piece.near_surfaces([along; 2], maps.all.radius).has(along);
        let flight = self.draw_lamp_along(volume, reach, left_out, piece.limits, stream);
        let flown = flight.collision.unwrap_or(reach).min(piece.depth);
        let share = |along| volume.transmittance(along) * (1.0 / volume.share_that_flies(weight, along));
        let near = piece.near_surfaces([0.0, flown], maps.all.radius);
        let short = Piece { depth: flown, ..*piece };
        // Near surfaces all along, nothing rests on photons: none found there is no doubt.
        if !near.cover([0.0, flown]) {
            self.read_along(&short, maps.all, &near, share, |_, along| !near.has(along));
        }
        if let Some(caustic) = maps.caustic.filter(|_| !near.is_empty()) {
            let doubtful = piece.near_surfaces([0.0, flown], caustic.radius);
            let counts = |class, along| class == PathClass::Caustic && near.has(along);
            self.read_along(&short, caustic, &doubtful, share, counts);
        }
        self.land(volume, flight, left_out, piece.limits, stream)
    }

    /// The beam radiance estimate along the ray, of the photons that count by their class and their place along it, of each the
    /// share that is left after a distance.
    fn read_along(
        &mut self,
        piece: &Piece<'_>,
        source: MapWithRadius<'_, VolumeMap<C>>,
        near: &Stretches,
        left: impl Fn(f64) -> Colour<C>,
        counts: impl Fn(PathClass, f64) -> bool,
    ) {
        let (ray, volume) = (piece.ray, self.optics.volume(piece.medium));
        let most = piece.limits.max_segments.map(|max| max.saturating_sub(self.landing.segments + 1));
        // No photon's path is so short: nothing rests on them.
        if most == Some(0) {
            return;
        }
        let scattered = |photon: &VolumePhoton<C>, along: f64| {
            let wanted = photon.medium == piece.medium
                && counts(photon.class, along)
                && most.is_none_or(|most| u32::from(photon.segments) <= most);
            wanted.then(|| {
                let towards_eye = -ray.direction.dot(photon.direction.unpack().map(f64::from).into());
                let phase = phase_pdf_solid_angle(volume.phase, towards_eye);
                Scattered { share: volume.albedo * left(along) * phase, resolved: !near.has(along) }
            })
        };
        let origin = (ray.origin - self.world.middle()).to_array();
        let beam = Beam { origin, direction: ray.direction.to_array(), length: piece.depth };
        let found = source.map.along(&beam, source.radius, scattered);
        let light = Light {
            irradiance: found.radiance,
            bias: found.bias,
            noise: 0.0,
            noise_of_bias: 0.0,
            unresolved: found.unresolved,
            photons: found.photons as f64,
            reads: 1.0,
            glints: 0.0,
            astray: 0.0,
            remedied: 0.0,
        };
        self.landing.scattered.add(&light.weighted(self.weight));
    }
}

/// A piece of a ray in a medium.
#[derive(Clone, Copy)]
struct Piece<'p> {
    ray: Ray,
    world: &'p World,
    medium: u32,
    /// Metres of it that can be seen.
    depth: f64,
    limits: &'p EyeLimits,
}

impl Piece<'_> {
    /// Where, in a window, the kernel that checks a radius would reach over a surface.
    fn near_surfaces(&self, window: [f64; 2], radius: f64) -> Stretches {
        Stretches::near_surfaces(self.world, &self.ray, self.depth, window, CHECK * radius)
    }
}
