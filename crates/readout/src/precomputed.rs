//! Where final gather's map is read once, for all rays that land near.

use glam::DVec3;
use photonlab_final_gather::Gatherer;
use photonlab_gather::{Precomputed, Scratch};
use photonlab_photometry::PackedDirection;
use photonlab_sampling::{Optics, Sight};
use photonlab_scene::{Ray, SurfacePoint};
use photonlab_trace::Classes;
use rayon::prelude::*;

use crate::{Draws, Method, ReadError, Session, maps::PassMaps, run::Run, trace_pass};

/// One place for so many photons of a pass (Christensen 1999).
const PHOTONS_PER_PLACE: u64 = 4;
/// Whose photons are places: a pass that no run reads, the same whatever the run's seed, for a place that its own photons had chosen would count
/// them.
const SEED: u64 = 0;
const PASS: u32 = u32::MAX - 5;
/// A photon's surface is sought from so far, over the scene's size: its place is known to some 1e-7.
const AWAY: f64 = 1e-5;

/// A place on a surface and the side of it.
pub(crate) type PlaceOnSide<const C: usize> = (SurfacePoint, Sight<C>);

impl<const C: usize> Session<'_, C> {
    /// True if rays land where a map was read before.
    pub(crate) fn precomputes(&self) -> bool {
        let gathers = matches!(self.settings.method, Method::FinalGather { .. });
        self.settings.aids.precompute && gathers && self.needs.indirect
    }

    /// The point of the scene, and its side, where a photon was stored.
    pub(crate) fn where_it_lies(&self, stored: [f32; 3], normal: PackedDirection) -> Option<PlaceOnSide<C>> {
        let (low, high) = self.world.bounds();
        let away = AWAY * (high - low).length();
        let normal = DVec3::from(normal.unpack().map(f64::from));
        let at = self.world.middle() + DVec3::from(stored.map(f64::from));
        let hit = self.world.cast(&Ray::new(at + away * normal, -normal), None, 2.0 * away)?;
        let sight = Sight::meter(hit.facing_normal(), None);
        (hit.facing_normal().dot(normal) > 0.5).then_some((hit.point, sight))
    }

    /// Reads the map at all places, which are chosen before the first pass: where the photons of a pass lie that is read by nobody.
    pub(crate) fn precomputed(
        &self,
        run: &mut Run<C>,
        optics: &Optics<C>,
        maps: &PassMaps<C>,
        photons: u64,
    ) -> Result<Precomputed<C>, ReadError> {
        let places = match run.places.take() {
            Some(places) => places,
            None => self.places(optics, photons)?,
        };
        let gatherer = Gatherer {
            world: self.world,
            optics,
            maps: Some(maps.gather_maps()),
            limits: self.settings.eye_limits(),
            looks_around: true,
            caustics_at_start: true,
            guide: None,
        };
        let read = |scratch: &mut Scratch, (at, sight): &PlaceOnSide<C>| gatherer.precompute(at, sight, scratch);
        let known: Vec<_> = places.par_iter().map_init(Scratch::default, read).flatten().collect();
        run.places = Some(places);
        Ok(Precomputed::new(known, self.settings.estimator.kernel)?)
    }

    fn places(&self, optics: &Optics<C>, photons: u64) -> Result<Vec<PlaceOnSide<C>>, ReadError> {
        let settings = crate::Settings { seed: SEED, draws: Draws::Independent, ..self.settings };
        let count = (photons / PHOTONS_PER_PLACE).max(optics.lamps.lamps.len() as u64);
        let pilot = trace_pass(self.world, optics, &settings, (self.sought(), Classes::ALL), PASS, count)?;
        let lying = pilot.positions.par_iter().zip(&pilot.photons);
        Ok(lying.filter_map(|(&at, photon)| self.where_it_lies(at, photon.normal)).collect())
    }
}
