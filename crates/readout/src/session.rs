//! Passes until the error, the clock or the count ends them.

use std::time::{Duration, Instant};

use photonlab_photometry::Channels;
use photonlab_sampling::{NothingCounts, PassOptics, PlanError, Sought};
use photonlab_scene::{Needs, World};
use photonlab_trace::{Classes, TraceError};

use crate::{
    Cell, Demands, Direct, ErrorOver, MapFile, Method, Ongoing, Outcome, Schedule, Settings, compiled::runner,
    run::Run, trace_pass,
};

/// Passes that a time limit should hold at least, and by how much the pilot that plans them is smaller than a usual pass.
const PASSES_IN_TIME: f64 = 20.0;
const PILOT: u64 = 64;
/// Photons that try whether light in a medium ends.
const STEADY_PHOTONS: u64 = 64;

/// Where a session's photons come from.
#[derive(Clone, Copy)]
pub enum Source<'f, const C: usize> {
    /// Traced as the passes need them.
    Trace,
    /// A saved map, one pass for each of its replicates.
    Map(&'f MapFile<C>),
}

impl<const C: usize> Source<'_, C> {
    /// The seed by which the photons' wavelengths were drawn, or are to be.
    pub(crate) fn seed(&self, of_run: u64) -> u64 {
        match self {
            Source::Trace => of_run,
            Source::Map(file) => file.header.seed,
        }
    }
}

/// Watches a run.
pub trait Observer: Sync {
    /// Called after each pass with the passes done, the time since the start and the error so far.
    fn pass_done(&self, passes: u64, elapsed: Duration, error: Option<f64>);
}

/// Watches nothing.
#[derive(Clone, Copy, Debug)]
pub struct Silent;

impl Observer for Silent {
    fn pass_done(&self, _: u64, _: Duration, _: Option<f64>) {}
}

/// Why a run has no result.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// Photons could not be shared among lamps.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// Photons could not be followed to an end.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// Nothing that the lamps emit counts.
    #[error(transparent)]
    Dark(#[from] NothingCounts),
    /// Photons could not be ordered.
    #[error("the photon map cannot be built: {0}")]
    Map(#[from] photonlab_kdtree::BuildError),
}

/// A scene being read.
#[derive(Clone, Copy)]
pub struct Session<'w, const C: usize> {
    /// The scene.
    pub world: &'w World,
    /// Its lamps and coatings.
    pub optics: &'w PassOptics<C>,
    /// What it needs.
    pub needs: &'w Needs,
    /// How it is read.
    pub settings: Settings,
    /// Two-sided confidence of the intervals that may end the run.
    pub confidence: f64,
    /// How the cells' errors make the one that may end the run.
    pub error_over: ErrorOver,
}

impl<'w, const C: usize> Session<'w, C> {
    /// A run with photons of its own that is looked at between its passes, and perhaps gone on with. Its clock starts now.
    pub fn begin<'c>(&self, cells: &'c [Cell], schedule: &Schedule) -> Result<Ongoing<'c, C>, ReadError>
    where
        'w: 'c,
    {
        self.check_steady()?;
        Ok(Ongoing::new(*self, cells, *schedule, Source::Trace, Instant::now()))
    }
}

impl<const C: usize> Session<'_, C> {
    /// What the method asks of the schedule.
    pub fn demands(&self) -> Demands {
        let from_map = self.settings.method.is_direct_view();
        Demands {
            gather_rays: self.settings.rays_per_sample(),
            fewest_photons: if self.uses_maps() || self.settings.method == Method::Bins {
                self.optics.any().lamps.lamps.len().max(1) as u64
            } else {
                0
            },
            // A density estimate at one point is the same however often it is made in one pass.
            most_samples: if from_map { 1 << 8 } else { 1 << 13 },
            draws_wavelengths: self.needs.channels == Channels::Spectral,
        }
    }

    /// True if the method reads any map in this scene.
    pub(crate) fn uses_maps(&self) -> bool {
        match self.settings.method {
            Method::Path | Method::Bins => false,
            Method::FinalGather { .. } => self.needs.indirect || self.needs.caustic || self.needs.in_scattering,
            Method::Nearest { .. } | Method::Radius { .. } | Method::Adaptive => {
                self.settings.classes().direct || self.needs.indirect || self.needs.caustic
            }
        }
    }

    /// The light that photons are to find for the method's maps.
    pub(crate) fn sought(&self) -> Sought {
        let reads_direct = self.settings.method.is_direct_view() && self.settings.direct == Direct::Photons;
        if self.needs.indirect || self.needs.in_scattering || reads_direct { Sought::All } else { Sought::Caustics }
    }

    /// True if a ray from a diffuse point can bring light that neither lamp sampling nor the caustic map gives.
    pub(crate) fn looks_around(&self) -> bool {
        let by_paths = self.settings.method == Method::Path && self.needs.caustic;
        self.needs.indirect || by_paths || !self.optics.any().lamps.are_sampled_alone(self.world)
    }

    /// Reads all cells.
    pub fn run(
        &self,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
        observer: &dyn Observer,
    ) -> Result<Outcome<C>, ReadError> {
        runner().run(self, cells, schedule, source, observer)
    }

    pub(crate) fn run_here(
        &self,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
        observer: &dyn Observer,
    ) -> Result<Outcome<C>, ReadError> {
        let start = Instant::now();
        self.check_steady()?;
        let schedule = self.fit_into_time(cells, schedule, source, start)?;
        Ongoing::new(*self, cells, schedule, *source, start).go_on_here(observer)
    }

    /// Follows some photons where a medium loses no light: one without an end would hold a ray from an eye for ever, and only
    /// photons can say so.
    fn check_steady(&self) -> Result<(), ReadError> {
        if !self.world.scene.media.iter().any(|medium| medium.albedo.max() >= 1.0) {
            return Ok(());
        }
        let optics = self.optics.any();
        let photons = STEADY_PHOTONS.max(optics.lamps.lamps.len() as u64);
        trace_pass(self.world, optics, &self.settings, (Sought::AsEmitted, Classes::NONE), u32::MAX, photons).map(drop)
    }

    /// Divides the passes, after a pilot whose work is not used, so that enough of them end within the time limit.
    fn fit_into_time(
        &self,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
        start: Instant,
    ) -> Result<Schedule, ReadError> {
        let Some(limit) = schedule.ends.time_limit else {
            return Ok(*schedule);
        };
        let (pilot, longer) = schedule.pilot(PILOT);
        let mut run = Run::new(cells.len());
        let mut seconds_of_pass = || {
            let begun = Instant::now();
            self.pass(&mut run, cells, &pilot, source).map(|()| begun.elapsed().as_secs_f64() * longer)
        };
        // Only the first pass tunes, which takes time of its own.
        let first = seconds_of_pass()?;
        let alone = passes_at_hand(schedule, source) == Some(1);
        let pass = if alone { first } else { seconds_of_pass()?.min(first) };
        let left = (limit.as_secs_f64() - start.elapsed().as_secs_f64() - (first - pass)).max(1e-3);
        if schedule.ends.passes.is_some_and(|passes| pass * passes as f64 <= 0.5 * left) {
            return Ok(*schedule);
        }
        let by = (pass * PASSES_IN_TIME / left).ceil().clamp(1.0, 1e6);
        Ok(match source {
            Source::Trace => schedule.shortened(by as u64),
            // The passes of a saved map are what they are.
            Source::Map(_) => schedule.divided(by as u64),
        })
    }
}

/// The passes asked for, or as many as a saved map has; `None` if only a target or a clock ends the run.
pub(crate) fn passes_at_hand<const C: usize>(schedule: &Schedule, source: &Source<'_, C>) -> Option<u64> {
    match source {
        Source::Trace => schedule.ends.passes,
        Source::Map(file) => Some(schedule.ends.passes.unwrap_or(u64::MAX).min(file.passes.len() as u64)),
    }
}
