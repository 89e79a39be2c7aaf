//! A ray from an eye meets the matter of a medium.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_sampling::{
    AroundPoint, Equiangular, Flight, LampKind, LightDraw, Optics, Stream, Volume, balance_pdf, phase_pdf_solid_angle,
    scatter,
};
use photonlab_scene::Ray;

use crate::{
    EyeLimits,
    in_scattering::{Crossing, InScattering},
    segment::Walk,
};

impl<const C: usize> Walk<'_, '_, C> {
    /// Draws how far the ray flies. Where it collides and light `counts`, it looks for a lamp and goes on where the light
    /// came from; elsewhere that light is known and the ray ends.
    pub(crate) fn fly(
        &mut self,
        volume: &Volume<C>,
        reach: f64,
        counts: impl Fn(f64) -> bool,
        limits: &EyeLimits,
        stream: &mut Stream,
    ) -> Crossing {
        let flight = self.draw_lamp_along(volume, reach, &counts, limits, stream);
        self.land(volume, flight, counts, limits, stream)
    }

    /// Ends a flight.
    pub(crate) fn land(
        &mut self,
        volume: &Volume<C>,
        Flight { collision, factor }: Flight<C>,
        counts: impl Fn(f64) -> bool,
        limits: &EyeLimits,
        stream: &mut Stream,
    ) -> Crossing {
        let before = self.weight * factor;
        let Some(distance) = collision else {
            self.weight = before;
            return Crossing::Passed;
        };
        self.landing.segments += 1;
        self.landing.distance += distance;
        self.weight = before * volume.albedo;
        let survival = (self.weight.max() / before.max()).min(1.0);
        let ends = !counts(distance) || !limits.allows(self.landing.segments + 1);
        if ends || survival <= 0.0 || stream.next() >= survival {
            return Crossing::Ended;
        }
        self.weight = self.weight * (1.0 / survival);
        self.scatter_on(volume, self.ray.at(distance), stream);
        Crossing::Turned
    }

    /// Light that one lamp sends into the ray straight, where the ray is read from the map otherwise.
    pub(crate) fn draw_once(&mut self, volume: &Volume<C>, reach: f64, limits: &EyeLimits, stream: &mut Stream) {
        let Flight { collision, factor } = self.draw_lamp_along(volume, reach, |_| true, limits, stream);
        let Some(distance) = collision.filter(|_| limits.allows(self.landing.segments + 2)) else { return };
        let at = self.ray.at(distance);
        let direction = scatter(volume.phase, self.ray.direction, stream);
        let pdf = phase_pdf_solid_angle(volume.phase, direction.dot(self.ray.direction));
        let met = self.lamps_straight_ahead(&Ray::new(at, direction), pdf, limits);
        self.landing.scattered.irradiance += self.weight * factor * volume.albedo * met;
    }

    /// Draws a flight, and light of one lamp that is scattered into the ray where it `counts`.
    ///
    /// A lamp without extent is drawn from where the flight collides and from a place drawn around it; the balance heuristic
    /// (Veach and Guibas 1995) shares the work. A lamp with extent is drawn from the collision alone and shares the work with the
    /// ray that is scattered there.
    pub(crate) fn draw_lamp_along(
        &mut self,
        volume: &Volume<C>,
        reach: f64,
        counts: impl Fn(f64) -> bool,
        limits: &EyeLimits,
        stream: &mut Stream,
    ) -> Flight<C> {
        let lamp = self.lamp(stream).filter(|_| limits.allows(self.landing.segments + 2));
        let around = lamp.and_then(|lamp| self.place_of(lamp)).and_then(|at| Equiangular::new(&self.ray, at, reach));
        if let (Some(lamp), Some(line)) = (lamp, &around) {
            let along = line.draw(stream.next()).clamp(0.0, reach);
            if counts(along) {
                let pdf = line.pdf(along) + volume.flight_pdf(self.weight, along);
                let share = volume.transmittance(along) * volume.sigma_t * volume.albedo * (1.0 / pdf);
                self.draw_lamp(volume, lamp, (along, share), limits, stream);
            }
        }
        let flight = volume.fly(self.weight, reach, stream);
        if let (Some(lamp), Some(along)) = (lamp, flight.collision.filter(|&along| counts(along))) {
            let by_flight = volume.flight_pdf(self.weight, along);
            let balance = around.map_or(1.0, |line| by_flight / (by_flight + line.pdf(along)));
            let share = flight.factor * volume.albedo * balance;
            self.draw_lamp(volume, lamp, (along, share), limits, stream);
        }
        flight
    }

    /// Counts what a lamp sends to a place along the ray, of which a share is scattered and arrives.
    fn draw_lamp(
        &mut self,
        volume: &Volume<C>,
        lamp: usize,
        (along, share): (f64, Colour<C>),
        limits: &EyeLimits,
        stream: &mut Stream,
    ) {
        let at = self.ray.at(along);
        let Some(draw) = LightDraw::of_lamp(self.world, &self.optics.lamps, lamp, at, stream.next2()) else { return };
        let phase = phase_pdf_solid_angle(volume.phase, draw.direction.dot(self.ray.direction));
        let pdf = draw.pdf_solid_angle;
        let balance = if pdf > 0.0 { pdf / (pdf + phase) } else { 1.0 };
        let (reaches, panes) = draw.reaches(self.world, self.optics, at, None, self.medium);
        if !limits.allows(self.landing.segments + 2 + panes) {
            return;
        }
        self.landing.scattered.irradiance += self.weight * share * draw.radiance_over_pdf * reaches * (phase * balance);
    }

    /// What lamps straight ahead send, each with the weight that the balance heuristic gives to a ray drawn with this density.
    fn lamps_straight_ahead(&self, ray: &Ray, pdf: f64, limits: &EyeLimits) -> Colour<C> {
        let (world, lamps) = (self.world, &self.optics.lamps);
        let (mut rest, mut from, mut medium) = (*ray, None, self.medium);
        let (mut share, mut found, mut panes) = (Colour::ONE, Colour::ZERO, 0);
        while !share.is_zero() && limits.allows(self.landing.segments + 2 + panes) {
            let hit = world.cast(&rest, from, f64::INFINITY);
            if let Some(medium) = medium {
                let flown = hit.map_or(f64::INFINITY, |hit| hit.distance);
                share = share * self.optics.volume(medium).transmittance(flown);
            }
            let Some(hit) = hit else {
                if let Some((radiance, drawn)) = lamps.from_infinity(world, ray) {
                    found += radiance * share * (pdf / (pdf + drawn));
                }
                break;
            };
            let (primitive, position) = (hit.point.primitive, hit.point.position);
            let (straight, segments) = self.optics.straight(world, &rest, &hit);
            let radiance = lamps.emitted(primitive, hit.front);
            if !radiance.is_zero() {
                let drawn = balance_pdf(world, lamps, primitive, ray.origin, position);
                // Shapes that shine are no masks and no panes.
                found += radiance * share * (pdf / (pdf + drawn));
            }
            share = share * straight;
            panes += segments;
            medium = world.medium_beside(primitive, !hit.front, medium);
            (rest, from) = (Ray::new(position, ray.direction), Some(primitive));
        }
        found
    }

    /// Turns the ray, as the medium scatters it at a place. Seen from the eye, light that goes on along the reversed ray came from
    /// the direction that is drawn here.
    ///
    /// As many rays are drawn around the next lamp, if that has no extent and stands in a medium: see [`AroundPoint`].
    fn scatter_on(&mut self, volume: &Volume<C>, at: DVec3, stream: &mut Stream) {
        let before = self.ray.direction;
        self.lamp = None;
        if let InScattering::ByLook(maps) = self.in_scattering {
            self.in_scattering = InScattering::Gathered(maps);
        }
        let around = self.lamp(stream).and_then(|lamp| around_lamp_in_medium(self.optics, lamp, at));
        let direction = match &around {
            Some(around) if stream.next() < 0.5 => around.draw(stream),
            _ => scatter(volume.phase, before, stream),
        };
        let phase = phase_pdf_solid_angle(volume.phase, direction.dot(before));
        if let Some(around) = &around {
            self.weight = self.weight * (phase / (0.5 * phase + 0.5 * around.pdf_solid_angle(direction)));
        }
        // What lamps that the ray meets weigh depends on the direction alone, not on how it was drawn.
        self.rough_pdf = Some(phase);
        (self.scattered, self.bent, self.turned) = (true, true, false);
        (self.ray, self.from, self.seen_from) = (Ray::new(at, direction), None, at);
    }

    /// The lamp that is drawn until the ray is scattered again.
    fn lamp(&mut self, stream: &mut Stream) -> Option<usize> {
        let lamps = &self.optics.lamps;
        if self.lamp.is_none() && !lamps.lamps.is_empty() {
            self.lamp = Some(lamps.choose(stream.next()));
        }
        self.lamp
    }

    /// Where a lamp without extent stands.
    fn place_of(&self, lamp: usize) -> Option<DVec3> {
        match self.optics.lamps.lamps[lamp].kind {
            LampKind::Point { position, .. } => Some(position),
            _ => None,
        }
    }
}

/// Directions around a lamp without extent, if it stands in a medium that scatters.
pub(crate) fn around_lamp_in_medium<const C: usize>(
    optics: &Optics<C>,
    lamp: usize,
    from: DVec3,
) -> Option<AroundPoint> {
    let lamp = &optics.lamps.lamps[lamp];
    match lamp.kind {
        LampKind::Point { position, .. } => {
            let in_haze = lamp.medium.is_some_and(|medium| optics.volume(medium).scatters());
            AroundPoint::new(from, position).filter(|_| in_haze)
        }
        _ => None,
    }
}
