//! From a point or an eye along a ray, through specular surfaces, to where light is read.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_sampling::{
    Followed, Interaction, LightDraw, Matte, Optics, Sight, Stream, balance_pdf, goes_through, lamp_pdf_solid_angle,
};
use photonlab_scene::{Hit, Ray, World};

use crate::{
    Light,
    in_scattering::{Crossing, InScattering},
};

/// When a ray that looks for light gives up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EyeLimits {
    /// Longest path from sensor to lamp in segments; `None` is unlimited.
    pub max_segments: Option<u32>,
    /// Longest run of specular interactions.
    pub max_specular: u32,
}

impl EyeLimits {
    /// True if a path may have this many segments.
    pub fn allows(&self, segments: u32) -> bool {
        self.max_segments.is_none_or(|max| segments <= max)
    }
}

/// Where a ray that looks for light ended.
#[derive(Clone, Copy, Debug)]
pub struct Landing<const C: usize> {
    /// Radiance that reached the ray from lamps behind at least one specular surface, lamps seen from rough surfaces
    /// included.
    pub emitted: Colour<C>,
    /// Radiance that media scattered into the ray, and lamps seen from there; in radiance, not irradiance.
    pub scattered: Light<C>,
    /// What the very first surface, or the environment behind no surface, emits towards the ray.
    pub first_emission: Option<Emitted<C>>,
    /// The matte point it ended on, what is seen of it, and the weight of radiance from there.
    pub matte: Option<(Hit, Sight<C>, Colour<C>)>,
    /// Segments travelled.
    pub segments: u32,
    /// Distance travelled, metres.
    pub distance: f64,
    /// True if a rough surface was met, which shows light from anywhere: darkness along this ray proves nothing.
    pub met_rough: bool,
}

/// A lamp met by a ray.
#[derive(Clone, Copy, Debug)]
pub struct Emitted<const C: usize> {
    /// Its radiance towards the ray's start.
    pub radiance: Colour<C>,
    /// Density per solid angle with which a draw of lamps finds it from there; `None` if such draws do all the work.
    pub shared_pdf: Option<f64>,
}

/// Where a ray that looks for light starts, and how.
#[derive(Clone, Copy)]
pub struct Start<'m, const C: usize> {
    /// The ray.
    pub ray: Ray,
    /// The primitive it starts on, if any.
    pub from: Option<u32>,
    /// Nothing beyond this distance is seen before the first specular surface, metres; usually infinite.
    pub reach: f64,
    /// Segments between the sensor and here.
    pub used: u32,
    /// True if lamps seen behind specular surfaces count: then rough surfaces look for lamps themselves.
    pub seeks_lamps: bool,
    /// The medium in which it starts.
    pub medium: Option<u32>,
    /// How light that media scatter into it is found.
    pub in_scattering: InScattering<'m, C>,
}

/// A ray on its way.
pub(crate) struct Walk<'w, 'm, const C: usize> {
    pub(crate) world: &'w World,
    pub(crate) optics: &'w Optics<C>,
    pub(crate) ray: Ray,
    pub(crate) from: Option<u32>,
    pub(crate) medium: Option<u32>,
    pub(crate) in_scattering: InScattering<'m, C>,
    /// The lamp that is drawn in media, once one is met.
    pub(crate) lamp: Option<usize>,
    /// Where it was bent last or started: from there lamps would have been drawn. Masks that it passes change nothing.
    pub(crate) seen_from: DVec3,
    pub(crate) weight: Colour<C>,
    /// Density per solid angle of the ray as the last rough surface or medium draws it; `None` if it sought no lamp.
    pub(crate) rough_pdf: Option<f64>,
    pub(crate) bent: bool,
    /// True once a medium has scattered the ray.
    pub(crate) scattered: bool,
    /// True if a surface has bent the ray since a medium scattered it or it started.
    pub(crate) turned: bool,
    pub(crate) landing: Landing<C>,
}

/// Follows a ray through specular surfaces to the first matte one.
pub fn follow<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    limits: &EyeLimits,
    start: Start<'_, C>,
    stream: &mut Stream,
) -> Landing<C> {
    let landing = Landing {
        emitted: Colour::ZERO,
        scattered: Light::default(),
        first_emission: None,
        matte: None,
        segments: start.used,
        distance: 0.0,
        met_rough: false,
    };
    let mut walk = Walk {
        world,
        optics,
        ray: start.ray,
        from: start.from,
        medium: start.medium,
        in_scattering: start.in_scattering,
        lamp: None,
        seen_from: start.ray.origin,
        weight: Colour::ONE,
        rough_pdf: None,
        bent: false,
        scattered: false,
        turned: false,
        landing,
    };
    let mut specular = 0;
    while limits.allows(walk.landing.segments + 1) && specular <= limits.max_specular {
        let reach = if walk.bent { f64::INFINITY } else { start.reach - walk.landing.distance };
        let hit = world.cast(&walk.ray, walk.from, reach);
        if let Some(medium) = walk.medium {
            match walk.cross(medium, hit.map_or(reach, |hit| hit.distance), limits, stream) {
                Crossing::Passed => {}
                Crossing::Turned => {
                    specular = 0;
                    continue;
                }
                Crossing::Ended => break,
            }
        }
        let Some(hit) = hit else {
            walk.escape();
            break;
        };
        walk.landing.distance += hit.distance;
        let (interaction, opacity) = optics.interaction(world, &hit);
        match if goes_through(opacity, stream) { &Interaction::Passed } else { interaction } {
            Interaction::Passed => {
                walk.medium = world.medium_beside(hit.point.primitive, !hit.front, walk.medium);
                walk.ray = Ray::new(hit.point.position, walk.ray.direction);
                walk.from = Some(hit.point.primitive);
                continue;
            }
            Interaction::Absorbed => {
                walk.arrive(&hit);
                break;
            }
            Interaction::Matte(matte) => {
                walk.arrive(&hit);
                let beside = |front| world.medium_beside(hit.point.primitive, front, walk.medium);
                match matte.look(&walk.ray, &hit, [beside(hit.front), beside(!hit.front)], stream) {
                    Ok(sight) => {
                        walk.landing.matte = Some((hit, sight, walk.weight));
                        break;
                    }
                    Err(mirrored) => match Matte::<C>::mirrored(&walk.ray, &hit) {
                        Some((ray, _)) => walk.turn(&hit, ray, mirrored, None),
                        None => break,
                    },
                }
            }
            Interaction::Followed(followed) => {
                walk.arrive(&hit);
                let seeks = walk.seeks_lamps(start.seeks_lamps) && limits.allows(walk.landing.segments + 1);
                if !walk.go_on(&hit, followed, seeks, limits, stream) {
                    break;
                }
            }
            Interaction::Dispersed(dispersive) => {
                walk.arrive(&hit);
                let seeks = walk.seeks_lamps(start.seeks_lamps) && limits.allows(walk.landing.segments + 1);
                let (followed, factor) = dispersive.settle(walk.weight, stream);
                walk.weight = walk.weight * factor;
                if !walk.go_on(&hit, &followed, seeks, limits, stream) {
                    break;
                }
            }
        }
        specular += 1;
        if walk.weight.is_zero() {
            break;
        }
    }
    walk.landing
}

impl<const C: usize> Walk<'_, '_, C> {
    /// Counts the segment and what the surface emits.
    fn arrive(&mut self, hit: &Hit) {
        self.landing.segments += 1;
        let radiance = self.optics.lamps.emitted(hit.point.primitive, hit.front);
        if radiance.is_zero() {
            return;
        }
        let (primitive, from, to) = (hit.point.primitive, self.seen_from, hit.point.position);
        if self.bent {
            let drawn =
                self.rough_pdf.map(|pdf| (pdf, balance_pdf(self.world, &self.optics.lamps, primitive, from, to)));
            self.behind_specular(radiance, drawn);
        } else {
            let shared_pdf = lamp_pdf_solid_angle(self.world, &self.optics.lamps, primitive, from, to);
            let radiance = radiance * self.weight;
            self.landing.first_emission = Some(Emitted { radiance, shared_pdf });
        }
    }

    /// Counts what comes from infinity.
    fn escape(&mut self) {
        let seen = Ray::new(self.seen_from, self.ray.direction);
        let Some((radiance, drawn)) = self.optics.lamps.from_infinity(self.world, &seen) else { return };
        if self.bent {
            self.behind_specular(radiance, self.rough_pdf.map(|pdf| (pdf, drawn)));
        } else {
            let radiance = radiance * self.weight;
            self.landing.first_emission = Some(Emitted { radiance, shared_pdf: Some(drawn) });
        }
    }

    /// True if rough surfaces look for lamps: where the ray started for that, or since a medium scattered it, unless caustic
    /// light is read from a map there.
    fn seeks_lamps(&self, from_start: bool) -> bool {
        if self.scattered { matches!(self.in_scattering, InScattering::ByPaths) } else { from_start }
    }

    /// A lamp behind a specular surface. A rough one has drawn lamps as well: the balance heuristic (Veach and Guibas 1995)
    /// shares the work by both densities.
    fn behind_specular(&mut self, radiance: Colour<C>, pdfs: Option<(f64, f64)>) {
        let balance = pdfs.map_or(1.0, |(pdf, drawn)| pdf / (pdf + drawn));
        self.find(radiance * self.weight * balance);
    }

    /// Draws how the ray goes on, after looking for lamps if it `seeks` any; false if it ends.
    fn go_on(
        &mut self,
        hit: &Hit,
        followed: &Followed<C>,
        seeks: bool,
        limits: &EyeLimits,
        stream: &mut Stream,
    ) -> bool {
        if seeks {
            self.seek_lamp(hit, followed, limits, stream);
        }
        let Some(onward) = followed.draw(&self.ray, hit, stream) else { return false };
        if onward.straight && self.optics.is_pane(self.world, hit.point.primitive) {
            self.pass(hit, onward.share);
            return true;
        }
        let pdf = onward.pdf_solid_angle.filter(|_| seeks);
        self.turn(hit, onward.ray, onward.share * onward.compression, pdf);
        true
    }

    /// Counts light found behind a specular surface or in a medium. What came to a medium through specular surfaces was read
    /// from the map, if there is one.
    fn find(&mut self, radiance: Colour<C>) {
        if !self.scattered {
            self.landing.emitted += radiance;
        } else if !self.turned || matches!(self.in_scattering, InScattering::ByPaths) {
            self.landing.scattered.irradiance += radiance;
        }
    }

    /// Goes on straight through a pane: whatever is seen behind is seen from where it was.
    fn pass(&mut self, hit: &Hit, share: Colour<C>) {
        self.weight = self.weight * share;
        self.medium = self.world.medium_beside(hit.point.primitive, !hit.front, self.medium);
        self.ray = Ray::new(hit.point.position, self.ray.direction);
        self.from = Some(hit.point.primitive);
    }

    /// Goes on along another ray.
    fn turn(&mut self, hit: &Hit, ray: Ray, share: Colour<C>, rough_pdf: Option<f64>) {
        self.weight = self.weight * share;
        let front = ray.direction.dot(hit.point.normal) > 0.0;
        self.medium = self.world.medium_beside(hit.point.primitive, front, self.medium);
        self.seen_from = ray.origin;
        self.ray = ray;
        self.from = Some(hit.point.primitive);
        self.rough_pdf = rough_pdf;
        (self.bent, self.turned) = (true, true);
    }

    /// Adds what a rough surface shows of one lamp.
    fn seek_lamp(&mut self, hit: &Hit, followed: &Followed<C>, limits: &EyeLimits, stream: &mut Stream) {
        let Followed::Rough(_) = followed else { return };
        self.landing.met_rough = true;
        let xi = [stream.next(), stream.next(), stream.next()];
        let Some(draw) = LightDraw::new(self.world, &self.optics.lamps, hit.point.position, xi) else { return };
        let Some((shown, pdf)) = followed.eval(&self.ray, hit, draw.direction) else { return };
        if shown.is_zero() {
            return;
        }
        let balance =
            if draw.pdf_solid_angle > 0.0 { draw.pdf_solid_angle / (draw.pdf_solid_angle + pdf) } else { 1.0 };
        let front = draw.direction.dot(hit.point.normal) > 0.0;
        let medium = self.world.medium_beside(hit.point.primitive, front, self.medium);
        let at = hit.point.position;
        let (reaches, panes) = draw.reaches(self.world, self.optics, at, Some(hit.point.primitive), medium);
        if !limits.allows(self.landing.segments + 1 + panes) {
            return;
        }
        self.find(self.weight * shown * draw.radiance_over_pdf * reaches * balance);
    }
}
