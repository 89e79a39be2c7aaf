//! One sample of one cell.

use std::f64::consts::PI;

use photonlab_final_gather::{EyeLimits, Gatherer, Guide, InScattering, Light, Place, Spot, Start, follow};
use photonlab_gather::Scratch;
use photonlab_photometry::Colour;
use photonlab_sampling::{Optics, Purpose, Sight, Stream};
use photonlab_scene::{Ray, World};

use crate::{
    Cell, Direct, Method, Settings, Target,
    cached::Cache,
    caustic_cells::CausticCells,
    cells::{distant_ray, pixel_ray},
    lattice,
    maps::PassMaps,
    sample::Sample,
};

/// Points of a cell whose photons guide the rays of all.
const GUIDED_BY: u64 = 4;

/// Looks into one pass's light.
#[derive(Clone, Copy)]
pub(crate) struct Look<'p, const C: usize> {
    pub(crate) world: &'p World,
    pub(crate) optics: &'p Optics<C>,
    pub(crate) settings: &'p Settings,
    pub(crate) maps: &'p PassMaps<C>,
    /// False if no ray from a diffuse point can bring light of its own.
    pub(crate) looks_around: bool,
    pub(crate) pass: u32,
    /// Points per cell in this pass.
    pub(crate) samples: u64,
    /// Photons of a nearest-photon estimate.
    pub(crate) k: usize,
    /// Of so many points one tells the bias of its estimate; none if zero.
    pub(crate) told_of: u64,
    /// What the weight of each cell's points needs against rays from point lamps.
    pub(crate) shares: &'p [f64],
    /// Caustic light that is counted in cells.
    pub(crate) caustics: &'p CausticCells<C>,
    /// What guides each cell's rays; empty if nothing does.
    pub(crate) guides: &'p [Option<Guide>],
    /// What final gather has found at few places, if it caches.
    pub(crate) cache: Option<Cache<'p, C>>,
}

impl<const C: usize> Look<'_, C> {
    /// The offsets of a cell's quasi-random points in this pass.
    pub(crate) fn shift(&self, number: usize) -> [f64; lattice::DIMENSIONS] {
        let mut stream = Stream::new(self.settings.seed, Purpose::Offsets, self.pass, number as u64);
        std::array::from_fn(|_| stream.next())
    }

    /// Sample `sample` of cell `number`, which reads a map with a fixed `radius`, if at all.
    pub(crate) fn sample(
        &self,
        cell: &Cell,
        number: usize,
        sample: u64,
        shift: &[f64; lattice::DIMENSIONS],
        radius: f64,
        scratch: &mut Scratch,
    ) -> Sample<C> {
        let first = self.first_stream(number, sample);
        let ending = self.ending(cell, number, sample, shift);
        let mut found = Sample { light: ending.light, dark: ending.dark, ..Sample::default() };
        if let Some(End { spot, weight, share, caustics }) = ending.end {
            let guide = self.guides.get(number).and_then(Option::as_ref);
            let seed = Seed { first, sample, shift, share, caustics, guide };
            if self.settings.method.is_direct_view() {
                let estimate = self.read_map(&spot, radius, self.told(sample), scratch);
                found.add_estimate(&estimate.weighted(weight));
                found.light.irradiance += self.sampled_direct(&spot, &seed) * weight;
            } else {
                found.light.add(&self.irradiance(&spot, &seed, scratch).weighted(weight));
            }
        }
        found
    }

    /// Where a sample reads the light at a surface; `None` if it does not.
    pub(crate) fn spot(
        &self,
        cell: &Cell,
        number: usize,
        sample: u64,
        shift: &[f64; lattice::DIMENSIONS],
    ) -> Option<Spot<C>> {
        self.ending(cell, number, sample, shift).end.map(|end| end.spot)
    }

    /// The first of the streams of a sample's own.
    fn first_stream(&self, number: usize, sample: u64) -> u64 {
        (number as u64 * self.samples + sample) * (u64::from(self.settings.rays_per_sample()) + 1)
    }

    /// Where a sample comes to.
    fn ending(&self, cell: &Cell, number: usize, sample: u64, shift: &[f64; lattice::DIMENSIONS]) -> Ending<C> {
        let rays = u64::from(self.settings.rays_per_sample());
        let [x, y, z, _, _, _, _, _, last, on_the_way @ ..] = lattice::point(sample * rays, shift);
        let mut eye = self.stream(self.first_stream(number, sample)).with_prefix(on_the_way);
        let (start, reach) = match &cell.target {
            Target::Leaving { .. } => return Ending { end: None, light: Light::default(), dark: false },
            Target::Patch { shape, film, .. } => {
                let at = self.world.point_in_cell(*shape, cell.cell, [film.width, film.height], [x, y, z]);
                let surrounding = self.world.scene.sensors[cell.sensor].medium;
                let sight = Sight::meter(at.normal, self.world.medium_beside(at.primitive, true, surrounding));
                let (share, caustics) = (self.shares[number], self.caustics.of(number).is_none());
                let end = End { spot: Spot { at, sight, used: 0 }, weight: Colour::ONE, share, caustics };
                return Ending { end: Some(end), light: Light::default(), dark: false };
            }
            Target::Along(ray) => (*ray, f64::INFINITY),
            Target::Distant { direction, target } => {
                (distant_ray(self.world, *direction, *target, [x, y, z]), f64::INFINITY)
            }
            Target::Pixel { camera, film } => pixel_ray(camera, *film, cell.cell, [x, y], [z, last]),
        };
        let medium = self.world.scene.sensors[cell.sensor].medium;
        let in_scattering = self.in_scattering();
        let start = Start { ray: start, from: None, reach, used: 0, seeks_lamps: true, medium, in_scattering };
        let hides_lamps = self.world.scene.hides_lamps && matches!(cell.target, Target::Pixel { .. });
        let start = if hides_lamps { self.past_lamps(start) } else { Some(start) };
        let Some(start) = start else { return Ending { end: None, light: Light::default(), dark: true } };
        let landing = follow(self.world, self.optics, &self.limits(), start, &mut eye);
        let mut light = landing.scattered;
        light.irradiance += landing.emitted + landing.first_emission.map_or(Colour::ZERO, |lamp| lamp.radiance);
        let end = landing.matte.and_then(|(hit, sight, weight)| {
            let weight = sight.factor * weight * (1.0 / PI);
            let spot = Spot { at: hit.point, sight, used: landing.segments };
            (!weight.is_zero()).then_some(End { spot, weight, share: 0.0, caustics: true })
        });
        let may_be_lit = landing.met_rough || end.is_some() && self.limits().allows(landing.segments + 1);
        Ending { end, light, dark: light.irradiance.is_zero() && !may_be_lit }
    }

    /// How light that media scatter into a ray from an eye or a meter is found.
    fn in_scattering(&self) -> InScattering<'_, C> {
        let draws_lamps = self.settings.direct == Direct::Sampled;
        match (self.settings.method, self.maps.volume_maps()) {
            (Method::Path | Method::Bins, _) | (_, None) => InScattering::ByPaths,
            (Method::FinalGather { .. }, Some(maps)) => InScattering::ByLook(maps),
            (Method::Nearest { .. } | Method::Radius { .. } | Method::Adaptive, Some(maps)) => {
                InScattering::FromMap { map: maps.all, draws_lamps }
            }
        }
    }

    /// The ray from behind the shapes that shine before the first that does not; `None` if there is none.
    fn past_lamps<'m>(&self, mut start: Start<'m, C>) -> Option<Start<'m, C>> {
        loop {
            let hit = self.world.cast(&start.ray, start.from, start.reach)?;
            let primitive = hit.point.primitive;
            if self.world.shape_of(primitive).radiance.is_none() {
                return Some(start);
            }
            start.medium = self.world.medium_beside(primitive, !hit.front, start.medium);
            start.ray = Ray::new(hit.point.position, start.ray.direction);
            (start.from, start.reach) = (Some(primitive), start.reach - hit.distance);
        }
    }

    fn stream(&self, index: u64) -> Stream {
        Stream::new(self.settings.seed, Purpose::Readout, self.pass, index)
    }

    pub(crate) fn limits(&self) -> EyeLimits {
        self.settings.eye_limits()
    }

    /// Looks around; reads caustic light where it starts unless somebody else does.
    pub(crate) fn gatherer(&self, caustics_at_start: bool) -> Gatherer<'_, C> {
        Gatherer {
            world: self.world,
            optics: self.optics,
            maps: matches!(self.settings.method, Method::FinalGather { .. }).then(|| self.maps.gather_maps()),
            limits: self.limits(),
            looks_around: self.looks_around,
            caustics_at_start,
            guide: None,
        }
    }

    /// What the photons near a cell's first few points say of where its light comes from.
    pub(crate) fn guide(&self, cell: &Cell, number: usize, scratch: &mut Scratch) -> Option<Guide> {
        let map = self.maps.surface.as_ref()?;
        let shift = self.shift(number);
        let spots = (0..self.samples.min(GUIDED_BY)).filter_map(|sample| self.spot(cell, number, sample, &shift));
        let place = |Spot { at, sight, .. }: Spot<C>| {
            let place = Place { world: self.world, optics: self.optics, at: &at, sight: &sight };
            (place.gather_point(), sight.normals.shading)
        };
        Guide::new(map, spots.map(place), scratch)
    }

    /// The mean over the rays of one point, of methods that send them.
    fn irradiance(&self, spot: &Spot<C>, seed: &Seed<'_>, scratch: &mut Scratch) -> Light<C> {
        let Spot { at, sight, used } = spot;
        let rays = self.settings.rays_per_sample();
        let mut light = Light::default();
        for ray in 0..rays {
            let mut stream = self.ray_stream(seed, ray);
            let gatherer = Gatherer { guide: seed.guide, ..self.gatherer(seed.caustics) };
            light.add(&match self.cache.filter(|_| spot.is_plain()) {
                Some(cache) => cache.irradiance(&gatherer, spot, seed.share, &mut stream, scratch),
                None => gatherer.irradiance(at, *sight, *used, seed.share, &mut stream, scratch),
            });
        }
        light.over(f64::from(rays))
    }

    /// What one ray of a point is drawn by.
    pub(crate) fn ray_stream(&self, seed: &Seed<'_>, ray: u32) -> Stream {
        let rays = u64::from(self.settings.rays_per_sample());
        let [_, _, _, a, b, c, d, e, ..] = lattice::point(seed.sample * rays + u64::from(ray), seed.shift);
        self.stream(seed.first + 1 + u64::from(ray)).with_prefix([a, b, c, d, e])
    }
}

/// Where a sample comes to.
struct Ending<const C: usize> {
    /// Where it reads the light at a surface, if it does.
    end: Option<End<C>>,
    /// What it met on its way.
    light: Light<C>,
    /// See [`Sample::dark`].
    dark: bool,
}

/// A surface point whose irradiance counts with a weight.
struct End<const C: usize> {
    spot: Spot<C>,
    weight: Colour<C>,
    share: f64,
    caustics: bool,
}

/// What one reading of a cell goes by.
#[derive(Clone, Copy)]
pub(crate) struct Seed<'s> {
    first: u64,
    sample: u64,
    shift: &'s [f64; lattice::DIMENSIONS],
    /// See [`Look::shares`].
    pub(crate) share: f64,
    /// False if caustic light is counted in the cell.
    caustics: bool,
    /// What guides gather rays.
    guide: Option<&'s Guide>,
}
