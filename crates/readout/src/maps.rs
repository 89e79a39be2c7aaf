//! The photons of one pass and the maps made of them.

use photonlab_final_gather::{GatherMaps, MapWithRadius, VolumeMaps};
use photonlab_gather::{Kernel, PhotonMap, Precomputed, Scratch, VolumeMap};
use photonlab_kdtree::SplitRule;
use photonlab_photometry::{PathClass, Photon, VolumePhoton};
use photonlab_sampling::{Optics, Sought};
use photonlab_scene::{Needs, World};
use photonlab_trace::{Classes, Job, Ledger, VolumeRecords, trace};

use crate::{Cell, Method, ReadError, Settings, caustic_cells::CausticCells};

/// Photons that a surface map's disc holds on average where photons are: few, because many rays average them, so that
/// the disc and its bias stay small.
const FINAL_GATHER_COUNT: usize = 16;
/// The same where the map is read at the point itself.
pub(crate) const DIRECT_VIEW_COUNT: usize = 50;
/// The same in the caustic map.
const CAUSTIC_COUNT: usize = 32;
/// Photons that a cylinder around a gather ray holds on average along a free path: fewer still, for the bias and the cost of a
/// ray fall with it and the error does not rise. In a point lamp's fog (catalogue F3) a radius of 0.05 instead of 0.44 left
/// the error as it was and took a quarter of the time.
const BEAM_COUNT: usize = 4;
/// In whole runs the median's quick build gains more than a cost rule's quicker queries: CUBE from 4e6 photons 5.0 against 5.9
/// CPU seconds, the Cornell box 4.3 against 4.2.
const MAP_RULE: SplitRule = SplitRule::Median;
/// Photons asked for their neighbours to find a radius.
const PROBES: usize = 255;
/// An automatic radius shrinks as pass^-SHRINK, so r^2 falls as pass^(-1/3) (Knaus and Zwicker 2011, alpha = 2/3):
/// both the bias and the noise of the mean go to zero.
pub const SHRINK: f64 = 1.0 / 6.0;

/// An automatic radius over that of the first pass, which is number 0.
pub(crate) fn shrinkage(pass: u32) -> f64 {
    f64::from(pass + 1).powf(-SHRINK)
}

/// What one pass's photons left, before any map is built.
#[derive(Clone, Debug)]
pub struct PassPhotons<const C: usize> {
    /// Metres.
    pub positions: Vec<[f32; 3]>,
    /// The records.
    pub photons: Vec<Photon<C>>,
    /// Those in media.
    pub volume: VolumeRecords<C>,
    /// Where the flux went.
    pub ledger: Ledger<C>,
    /// Emitted paths.
    pub emitted: u64,
}

/// Traces one pass that finds the light that is sought and keeps some classes of it.
pub fn trace_pass<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    settings: &Settings,
    (sought, keep): (Sought, Classes),
    pass: u32,
    photons: u64,
) -> Result<PassPhotons<C>, ReadError> {
    let plan = settings.plan(&optics.lamps, photons, sought, pass)?;
    let job = Job { seed: settings.seed, pass, limits: settings.limits, keep };
    let traced = trace(world, optics, &plan, &job)?;
    Ok(PassPhotons {
        positions: traced.positions,
        photons: traced.photons,
        volume: traced.volume,
        ledger: traced.ledger,
        emitted: plan.photons(),
    })
}

/// The maps of one pass.
pub(crate) struct PassMaps<const C: usize> {
    pub(crate) surface: Option<PhotonMap<C>>,
    pub(crate) surface_radius: f64,
    pub(crate) caustic: Option<PhotonMap<C>>,
    pub(crate) caustic_radius: f64,
    volume: Option<VolumeMap<C>>,
    volume_radius: f64,
    volume_caustic: Option<VolumeMap<C>>,
    volume_caustic_radius: f64,
    kernel: Kernel,
    /// What the surface map says at places of its own, if that is asked once.
    pub(crate) precomputed: Option<Precomputed<C>>,
    /// Caustic light that cells of meters count for themselves.
    pub(crate) in_cells: CausticCells<C>,
}

/// Radii of the first pass, from which those of all others follow.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Radii {
    pub(crate) surface: Option<f64>,
    caustic: Option<f64>,
    volume: Option<f64>,
    volume_caustic: Option<f64>,
}

impl<const C: usize> PassMaps<C> {
    pub(crate) fn none() -> Self {
        Self {
            surface: None,
            surface_radius: 0.0,
            caustic: None,
            caustic_radius: 0.0,
            volume: None,
            volume_radius: 0.0,
            volume_caustic: None,
            volume_caustic_radius: 0.0,
            kernel: Kernel::Disc,
            precomputed: None,
            in_cells: CausticCells::none(),
        }
    }

    /// Builds what the method reads; chooses radii in the first pass and shrinks them in later ones.
    pub(crate) fn build(
        mut photons: PassPhotons<C>,
        (world, needs): (&World, &Needs),
        cells: &[Cell],
        settings: &Settings,
        pass: u32,
        radii: &mut Radii,
    ) -> Result<Self, ReadError> {
        let classes = settings.classes();
        let final_gather = matches!(settings.method, Method::FinalGather { .. });
        let caustic = (final_gather && needs.caustic)
            .then(|| select(&photons, |class| class == PathClass::Caustic))
            .map(|(positions, photons)| PhotonMap::build(positions, photons, MAP_RULE))
            .transpose()?;
        let fixed = match settings.method {
            Method::Radius { radius } | Method::FinalGather { radius } => radius,
            Method::Nearest { .. } | Method::Adaptive | Method::Path | Method::Bins => None,
        };
        let count = match settings.method {
            Method::FinalGather { .. } => FINAL_GATHER_COUNT,
            _ => DIRECT_VIEW_COUNT,
        };
        let shrink = shrinkage(pass);
        let radius = |map: &Option<PhotonMap<C>>, first: &mut Option<f64>, count: usize| match (fixed, map) {
            (Some(radius), _) => radius,
            (None, None) => 0.0,
            (None, Some(map)) => *first.get_or_insert_with(|| first_radius(map, count, world)) * shrink,
        };
        let caustic_radius = radius(&caustic, &mut radii.caustic, CAUSTIC_COUNT);
        let in_cells = if caustic.is_some() {
            CausticCells::count(world, cells, &photons, caustic_radius, settings.limits.max_segments)
        } else {
            CausticCells::none()
        };
        let wants_surface = !final_gather || needs.indirect;
        let surface = wants_surface
            .then(|| take(&mut photons, |class| classes.has(class)))
            .map(|(positions, photons)| PhotonMap::build(positions, photons, MAP_RULE))
            .transpose()?;
        let surface_radius = radius(&surface, &mut radii.surface, count);
        let of_volume = |wanted: bool, keep: &dyn Fn(PathClass) -> bool| {
            wanted
                .then(|| select_in_volume(&photons.volume, keep))
                .map(|(p, v)| VolumeMap::build(p, v, MAP_RULE))
                .transpose()
        };
        let volume = of_volume(needs.in_scattering, &|class| classes.has(class))?;
        let is_caustic = |class| class == PathClass::Caustic;
        let volume_caustic = of_volume(needs.in_scattering && final_gather && needs.caustic, &is_caustic)?;
        let count = match settings.method {
            Method::Nearest { k } => k.unwrap_or(DIRECT_VIEW_COUNT),
            Method::FinalGather { .. } => BEAM_COUNT,
            Method::Radius { .. } | Method::Adaptive | Method::Path | Method::Bins => DIRECT_VIEW_COUNT,
        };
        let radius = |map: &Option<VolumeMap<C>>, first: &mut Option<f64>, count: usize| match (fixed, map) {
            (Some(radius), _) => radius,
            (None, None) => 0.0,
            (None, Some(map)) => *first.get_or_insert_with(|| first_volume_radius(map, count, world)) * shrink,
        };
        let volume_radius = radius(&volume, &mut radii.volume, count);
        let volume_caustic_radius = radius(&volume_caustic, &mut radii.volume_caustic, CAUSTIC_COUNT);
        Ok(Self {
            surface,
            surface_radius,
            caustic,
            caustic_radius,
            volume,
            volume_radius,
            volume_caustic,
            volume_caustic_radius,
            kernel: settings.estimator.kernel,
            precomputed: None,
            in_cells,
        })
    }

    /// The maps of photons in media; `None` if no medium scatters.
    pub(crate) fn volume_maps(&self) -> Option<VolumeMaps<'_, C>> {
        let all = MapWithRadius { map: self.volume.as_ref()?, radius: self.volume_radius };
        let caustic = |map| MapWithRadius { map, radius: self.volume_caustic_radius };
        Some(VolumeMaps { all, caustic: self.volume_caustic.as_ref().map(caustic) })
    }

    pub(crate) fn gather_maps(&self) -> GatherMaps<'_, C> {
        GatherMaps {
            surface: self.surface.as_ref().map(|map| MapWithRadius { map, radius: self.surface_radius }),
            caustic: self.caustic.as_ref().map(|map| MapWithRadius { map, radius: self.caustic_radius }),
            volume: self.volume_maps(),
            kernel: self.kernel,
            precomputed: self.precomputed.as_ref(),
        }
    }
}

fn select<const C: usize>(
    pass: &PassPhotons<C>,
    wanted: impl Fn(PathClass) -> bool,
) -> (Vec<[f32; 3]>, Vec<Photon<C>>) {
    let chosen = pass.positions.iter().zip(&pass.photons).filter(|(_, photon)| wanted(photon.class));
    chosen.map(|(position, photon)| (*position, *photon)).unzip()
}

/// The same of a pass whose photons on surfaces nobody asks for again.
fn take<const C: usize>(
    pass: &mut PassPhotons<C>,
    wanted: impl Fn(PathClass) -> bool,
) -> (Vec<[f32; 3]>, Vec<Photon<C>>) {
    if !pass.photons.iter().all(|photon| wanted(photon.class)) {
        return select(pass, wanted);
    }
    (std::mem::take(&mut pass.positions), std::mem::take(&mut pass.photons))
}

fn select_in_volume<const C: usize>(
    records: &VolumeRecords<C>,
    wanted: &dyn Fn(PathClass) -> bool,
) -> (Vec<[f32; 3]>, Vec<VolumePhoton<C>>) {
    let chosen = records.positions.iter().zip(&records.photons).filter(|(_, photon)| wanted(photon.class));
    chosen.map(|(position, photon)| (*position, *photon)).unzip()
}

/// As [`first_radius`], of a cylinder around a ray that is as long as a free path, or the scene where that is smaller.
fn first_volume_radius<const C: usize>(map: &VolumeMap<C>, count: usize, world: &World) -> f64 {
    let (low, high) = world.bounds();
    let count = count.min(map.len() / 4).max(2);
    let free_path = |medium: u32| (1.0 / world.scene.media[medium as usize].sigma_t.max()).min((high - low).length());
    let radius = map.typical_radius(count, free_path, PROBES, &mut Scratch::default());
    radius.unwrap_or(0.01 * (high - low).max_element())
}

/// The radius that holds about `count` photons, fewer where the map is small; a hundredth of the scene for a map with
/// next to nothing in it.
fn first_radius<const C: usize>(map: &PhotonMap<C>, count: usize, world: &World) -> f64 {
    let (low, high) = world.bounds();
    let count = count.min(map.len() / 4).max(2);
    map.typical_radius(count, PROBES, &mut Scratch::default()).unwrap_or(0.01 * (high - low).max_element())
}
