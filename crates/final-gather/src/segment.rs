//! From a point or an eye along a ray, through specular surfaces, to where light is read.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_sampling::{
    Flight, Followed, Interaction, LightDraw, Matte, Optics, Sight, Stream, Volume, balance_pdf, goes_through,
    lamp_pdf_solid_angle, phase_pdf_solid_angle, scatter,
};
use photonlab_scene::{Hit, Ray, World};

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
    /// Radiance that the ray's surroundings scattered into it, and lamps seen from there.
    pub scattered: Colour<C>,
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

/// Where a ray that looks for light starts.
#[derive(Clone, Copy, Debug)]
pub struct Start {
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
}

/// A ray on its way.
struct Walk<'w, const C: usize> {
    world: &'w World,
    optics: &'w Optics<C>,
    ray: Ray,
    from: Option<u32>,
    medium: Option<u32>,
    /// Where it was bent last or started: from there lamps would have been drawn. Masks that it passes change nothing.
    seen_from: DVec3,
    weight: Colour<C>,
    /// Density per solid angle with which the last rough surface drew the ray; `None` if it sought no lamp.
    rough_pdf: Option<f64>,
    bent: bool,
    /// True once a medium has scattered the ray.
    scattered: bool,
    landing: Landing<C>,
}

/// Follows a ray through specular surfaces to the first matte one.
pub fn follow<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    limits: &EyeLimits,
    start: Start,
    stream: &mut Stream,
) -> Landing<C> {
    let landing = Landing {
        emitted: Colour::ZERO,
        scattered: Colour::ZERO,
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
        seen_from: start.ray.origin,
        weight: Colour::ONE,
        rough_pdf: None,
        bent: false,
        scattered: false,
        landing,
    };
    let mut specular = 0;
    while limits.allows(walk.landing.segments + 1) && specular <= limits.max_specular {
        let reach = if walk.bent { f64::INFINITY } else { start.reach - walk.landing.distance };
        let hit = world.cast(&walk.ray, walk.from, reach);
        if let Some(medium) = walk.medium {
            let reach = hit.map_or(reach, |hit| hit.distance);
            let volume = optics.volume(medium);
            let Flight { collision, factor } = volume.fly(walk.weight, reach, stream);
            walk.weight = walk.weight * factor;
            if let Some(distance) = collision {
                if !walk.collide(volume, distance, limits, stream) {
                    break;
                }
                specular = 0;
                continue;
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
                let seeks = (start.seeks_lamps || walk.scattered) && limits.allows(walk.landing.segments + 1);
                if !walk.go_on(&hit, followed, seeks, stream) {
                    break;
                }
            }
            Interaction::Dispersed(dispersive) => {
                walk.arrive(&hit);
                let seeks = (start.seeks_lamps || walk.scattered) && limits.allows(walk.landing.segments + 1);
                let (followed, factor) = dispersive.settle(walk.weight, stream);
                walk.weight = walk.weight * factor;
                if !walk.go_on(&hit, &followed, seeks, stream) {
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

impl<const C: usize> Walk<'_, C> {
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

    /// A lamp behind a specular surface. A rough one has drawn lamps as well: the balance heuristic (Veach and Guibas 1995)
    /// shares the work by both densities.
    fn behind_specular(&mut self, radiance: Colour<C>, pdfs: Option<(f64, f64)>) {
        let balance = pdfs.map_or(1.0, |(pdf, drawn)| pdf / (pdf + drawn));
        self.find(radiance * self.weight * balance);
    }

    /// Draws how the ray goes on, after looking for lamps if it `seeks` any; false if it ends.
    fn go_on(&mut self, hit: &Hit, followed: &Followed<C>, seeks: bool, stream: &mut Stream) -> bool {
        if seeks {
            self.seek_lamp(hit, followed, stream);
        }
        let Some(onward) = followed.draw(&self.ray, hit, stream) else { return false };
        let pdf = onward.pdf_solid_angle.filter(|_| seeks);
        self.turn(hit, onward.ray, onward.share * onward.compression, pdf);
        true
    }

    /// Counts light found behind a specular surface or in a medium.
    fn find(&mut self, radiance: Colour<C>) {
        if self.scattered {
            self.landing.scattered += radiance;
        } else {
            self.landing.emitted += radiance;
        }
    }

    /// Meets the matter of a medium: looks for a lamp, and goes on where the light came from; false if the ray ends.
    ///
    /// The lamp drawn and the lamp that the ray meets next share the work by the balance heuristic (Veach and Guibas 1995).
    fn collide(&mut self, volume: &Volume<C>, distance: f64, limits: &EyeLimits, stream: &mut Stream) -> bool {
        let at = self.ray.at(distance);
        self.landing.segments += 1;
        self.landing.distance += distance;
        (self.scattered, self.bent, self.landing.met_rough) = (true, true, true);
        let before = self.weight.max();
        self.weight = self.weight * volume.albedo;
        let survival = (self.weight.max() / before).min(1.0);
        if !limits.allows(self.landing.segments + 1) || survival <= 0.0 || stream.next() >= survival {
            return false;
        }
        self.weight = self.weight * (1.0 / survival);
        let xi = [stream.next(), stream.next(), stream.next()];
        if let Some(draw) = LightDraw::new(self.world, &self.optics.lamps, at, xi) {
            let phase = phase_pdf_solid_angle(volume.phase, draw.direction.dot(self.ray.direction));
            let pdf = draw.pdf_solid_angle;
            let balance = if pdf > 0.0 { pdf / (pdf + phase) } else { 1.0 };
            let reaches = draw.reaches(self.world, self.optics, at, None, self.medium);
            self.find(self.weight * draw.radiance_over_pdf * reaches * (phase * balance));
        }
        // Seen from the eye, light that goes on along the reversed ray came from the direction that is drawn here.
        let direction = scatter(volume.phase, self.ray.direction, stream);
        self.rough_pdf = Some(phase_pdf_solid_angle(volume.phase, direction.dot(self.ray.direction)));
        (self.ray, self.from, self.seen_from) = (Ray::new(at, direction), None, at);
        true
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
        self.bent = true;
    }

    /// Adds what a rough surface shows of one lamp.
    fn seek_lamp(&mut self, hit: &Hit, followed: &Followed<C>, stream: &mut Stream) {
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
        let reaches = draw.reaches(self.world, self.optics, at, Some(hit.point.primitive), medium);
        self.find(self.weight * shown * draw.radiance_over_pdf * reaches * balance);
    }
}
