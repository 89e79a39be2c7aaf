//! What one ray from a diffuse point brings.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::Scratch;
use photonlab_photometry::Colour;
use photonlab_sampling::{Sight, Stream, warp};
use photonlab_scene::{Ray, SurfacePoint};

use crate::{
    Gatherer, InScattering, Landing, Light, Start, collision::around_lamp_in_medium, segment, segment::Emitted,
};

/// Bounces without a map after which roulette decides whether a walk goes on.
const FREE_BOUNCES: u32 = 3;

/// Whether a ray counts lamps that it meets first: where they are drawn too.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lamps {
    Counted,
    Known,
}

/// What one ray from a diffuse point brings.
pub(crate) struct Seen<const C: usize> {
    pub(crate) light: Light<C>,
    /// How far the first thing lies that it meets or comes to behind specular surfaces, metres; infinite if there is none.
    pub(crate) distance: f64,
}

impl<const C: usize> Gatherer<'_, C> {
    /// One sample of what [`Self::without_reflected`] leaves out.
    pub(crate) fn reflected(
        &self,
        at: &SurfacePoint,
        sight: Sight<C>,
        used: u32,
        direction: DVec3,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Seen<C> {
        if !self.looks_on(used) {
            return Seen { light: Light::default(), distance: f64::INFINITY };
        }
        self.look(at, sight, used, (direction, 1.0), Lamps::Known, stream, scratch)
    }

    /// What a ray from a point brings, that goes out in a direction, `share` being the density by the cosine over that by which it was
    /// drawn. It gathers where it lands, or goes on.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn look(
        &self,
        at: &SurfacePoint,
        sight: Sight<C>,
        used: u32,
        turned: (DVec3, f64),
        lamps: Lamps,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Seen<C> {
        let mut light = Light::default();
        let mut first = f64::INFINITY;
        let (mut at, mut sight, mut used, mut turned) = (*at, sight, used, turned);
        let mut weight = Colour::ONE;
        for bounce in 0.. {
            let (direction, share) = turned;
            let cosine = sight.normals.cosine(direction);
            if cosine == 0.0 {
                break;
            }
            weight = weight * (share * sight.weight(cosine));
            let start = self.start(&at, &sight, used, direction);
            let landing = segment::follow(self.world, self.optics, &self.limits, start, stream);
            if bounce == 0 && landing.segments > used {
                first = landing.distance;
            }
            if bounce > 0 || lamps == Lamps::Counted {
                light.irradiance += met_by_chance(&landing, cosine) * weight;
            }
            light.add(&landing.scattered.weighted(weight * PI));
            light.glints += f64::from(u8::from(!landing.emitted.is_zero()));
            if self.maps.is_none() {
                // Light that came through specular surfaces alone; with maps it is in the caustic map.
                light.irradiance += landing.emitted * PI * weight;
            }
            let Some((hit, seen, carried)) = landing.matte else {
                break;
            };
            weight = weight * seen.factor * carried;
            used = landing.segments;
            if weight.is_zero() {
                break;
            }
            if let Some(gathered) = self.far_landing(&hit, &seen, landing.distance, used, scratch) {
                light.add(&gathered.weighted(weight));
                break;
            }
            if bounce >= FREE_BOUNCES {
                let survival = weight.max().min(1.0);
                if survival <= 0.0 || stream.next() >= survival {
                    break;
                }
                weight = weight * (1.0 / survival);
            }
            (at, sight) = (hit.point, seen);
            light.add(&self.known(&at, &sight, (used, 0.0), true, stream, scratch).weighted(weight));
            if !self.looks_on(used) {
                break;
            }
            let direction = warp::square_to_cosine_hemisphere(stream.next2(), sight.normals.shading);
            stream.leave_prefix();
            turned = self.turned_to_lamp(&at, &sight, direction, stream);
        }
        Seen { light, distance: first }
    }

    /// The same in a direction that is drawn by the cosine.
    pub fn reflected_once(
        &self,
        at: &SurfacePoint,
        sight: Sight<C>,
        used: u32,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Light<C> {
        let direction = warp::square_to_cosine_hemisphere(stream.next2(), sight.normals.shading);
        self.reflected(at, sight, used, direction, stream, scratch).light
    }

    /// How far that lies which a ray meets first, metres, or what it comes to behind specular surfaces; infinite if there is nothing.
    pub(crate) fn first_distance(
        &self,
        at: &SurfacePoint,
        sight: &Sight<C>,
        used: u32,
        direction: DVec3,
        stream: &mut Stream,
    ) -> f64 {
        let landing =
            segment::follow(self.world, self.optics, &self.limits, self.start(at, sight, used, direction), stream);
        if landing.segments > used { landing.distance } else { f64::INFINITY }
    }

    /// True if a ray from a point so many segments behind the sensor can bring anything.
    pub(crate) fn looks_on(&self, used: u32) -> bool {
        self.looks_around && self.limits.allows(used + 1)
    }

    /// A ray from a diffuse point.
    pub(crate) fn start(&self, at: &SurfacePoint, sight: &Sight<C>, used: u32, direction: DVec3) -> Start<'_, C> {
        Start {
            ray: Ray::new(at.position, direction),
            from: Some(at.primitive),
            reach: f64::INFINITY,
            used,
            seeks_lamps: self.maps.is_none(),
            medium: sight.medium,
            in_scattering: self.in_scattering(),
        }
    }

    /// Without maps, half of the rays from a point are drawn around a lamp without extent, if one that stands in a medium is
    /// chosen (see [`AroundPoint`](photonlab_sampling::AroundPoint)): the direction, and its density by the cosine over that by
    /// which it was drawn.
    pub(crate) fn turned_to_lamp(
        &self,
        at: &SurfacePoint,
        sight: &Sight<C>,
        drawn: DVec3,
        stream: &mut Stream,
    ) -> (DVec3, f64) {
        let lamps = &self.optics.lamps;
        if self.maps.is_some() || self.world.scene.media.is_empty() || lamps.lamps.is_empty() {
            return (drawn, 1.0);
        }
        let lamp = lamps.choose(stream.next());
        let Some(around) = around_lamp_in_medium(self.optics, lamp, at.position) else { return (drawn, 1.0) };
        let direction = if stream.next() < 0.5 { around.draw(stream) } else { drawn };
        let by_cosine = warp::cosine_hemisphere_pdf_solid_angle(sight.normals.cosine(direction));
        (direction, by_cosine / (0.5 * by_cosine + 0.5 * around.pdf_solid_angle(direction)))
    }

    /// How light that media scatter into a gather ray is found.
    fn in_scattering(&self) -> InScattering<'_, C> {
        self.maps.and_then(|maps| maps.volume).map_or(InScattering::ByPaths, InScattering::Gathered)
    }
}

/// Irradiance by a lamp that a ray of cosine density met by chance, shared with the draw of lamps by the balance heuristic (Veach and
/// Guibas 1995).
pub(crate) fn met_by_chance<const C: usize>(landing: &Landing<C>, cosine: f64) -> Colour<C> {
    let Some(Emitted { radiance, shared_pdf: Some(drawn) }) = landing.first_emission else { return Colour::ZERO };
    let by_chance = warp::cosine_hemisphere_pdf_solid_angle(cosine);
    radiance * (PI * by_chance / (by_chance + drawn))
}
