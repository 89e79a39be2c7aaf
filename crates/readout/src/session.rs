//! Passes until the error, the clock or the count ends them.

use std::time::{Duration, Instant};

use photonlab_final_gather::Light;
use photonlab_gather::Scratch;
use photonlab_measure::Stopped;
use photonlab_photometry::{Channels, Colour};
use photonlab_sampling::{EmissionPlan, NothingCounts, Optics, PassOptics, PlanError, Purpose, Stream};
use photonlab_scene::{Needs, World};
use photonlab_trace::{Classes, Job, TraceError, count};
use rayon::prelude::*;

use crate::{
    Cell, Demands, Direct, ErrorOver, MapFile, Method, Outcome, Schedule, Settings,
    bins::Bins,
    compiled::runner,
    look::{Look, Sample},
    maps::PassMaps,
    probe::{probe, shares},
    run::Run,
    trace_pass,
};

/// Samples that one task takes of one cell.
const BLOCK: u64 = 256;
/// Passes before a run may end for its error: fewer would trust an error bar that is itself uncertain.
const PASSES_BEFORE_STOPPING: u64 = 16;
/// Passes before a target is given up as out of reach.
const PASSES_BEFORE_GIVING_UP: u64 = 64;
/// Growth of the number of passes between two looks at the error. Every look is a chance to stop on a lucky error bar.
const LOOK_GROWTH: f64 = 1.1;
/// A run that only its error could end stops here and says so.
const MOST_PASSES: u64 = 100_000;
/// Passes that a time limit should hold at least, and by how much the pilot that plans them is smaller than a usual pass.
const PASSES_IN_TIME: f64 = 20.0;
const PILOT: u64 = 64;
/// Photons that try whether light in a medium ends.
const STEADY_PHOTONS: u64 = 64;

/// Where a session's photons come from.
pub enum Source<'f, const C: usize> {
    /// Traced as the passes need them.
    Trace,
    /// A saved map, one pass for each of its replicates.
    Map(&'f MapFile<C>),
}

impl<const C: usize> Source<'_, C> {
    /// The seed by which the photons' wavelengths were drawn, or are to be.
    fn seed(&self, of_run: u64) -> u64 {
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

impl<const C: usize> Session<'_, C> {
    /// What the method asks of the schedule.
    pub fn demands(&self) -> Demands {
        let from_map = self.settings.method.is_direct_view();
        Demands {
            gather_rays: self.settings.gather_rays,
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
    fn uses_maps(&self) -> bool {
        match self.settings.method {
            Method::Path | Method::Bins => false,
            Method::FinalGather { .. } => self.needs.indirect || self.needs.caustic || self.needs.in_scattering,
            Method::Nearest { .. } | Method::Radius { .. } | Method::Adaptive => {
                self.settings.classes().direct || self.needs.indirect || self.needs.caustic
            }
        }
    }

    /// True if a ray from a diffuse point can bring light that neither lamp sampling nor the caustic map gives.
    fn looks_around(&self) -> bool {
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

    pub(crate) fn run_passes(
        &self,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
        observer: &dyn Observer,
    ) -> Result<Outcome<C>, ReadError> {
        let start = Instant::now();
        self.check_steady()?;
        let schedule = &self.fit_into_time(cells, schedule, source, start)?;
        let mut run = self.begin(cells, schedule, source)?;
        let passes = passes_at_hand(schedule, source).map(|passes| passes - run.pilots);
        let mut next_look = PASSES_BEFORE_STOPPING;
        let mut longest = Duration::ZERO;
        loop {
            let begun = Instant::now();
            self.pass(&mut run, cells, schedule, source)?;
            longest = longest.max(begun.elapsed());
            let done = run.passes;
            let looks = done >= next_look;
            let error = looks.then(|| self.error_over.of(&run.cells, self.optics.results(), self.confidence)).flatten();
            observer.pass_done(done, start.elapsed(), error);
            if looks {
                next_look = ((done as f64 * LOOK_GROWTH).ceil() as u64).max(done + 1);
            }
            let reached = schedule.ends.target_error.zip(error).is_some_and(|(target, error)| error <= target);
            let stopped = if reached {
                Some(Stopped::Target)
            } else if looks && self.target_is_out_of_reach(&run, schedule.ends.target_error) {
                run.out_of_reach = true;
                Some(Stopped::Count)
            } else if passes.unwrap_or(MOST_PASSES) <= done {
                Some(Stopped::Count)
            } else if schedule.ends.time_limit.is_some_and(|limit| start.elapsed() + longest > limit) {
                Some(Stopped::Time)
            } else {
                None
            };
            if let Some(stopped) = stopped {
                return Ok(run.finish(self, stopped));
            }
        }
    }

    /// An empty run; where cells find radii for themselves, after a pass that serves nothing else, because a mean is long in
    /// forgetting passes that were read with a wrong radius. Its photons are part of those asked for; one pass alone has none
    /// to spare.
    fn begin(&self, cells: &[Cell], schedule: &Schedule, source: &Source<'_, C>) -> Result<Run<C>, ReadError> {
        let run = Run::new(cells.len());
        let single = passes_at_hand(schedule, source).is_some_and(|passes| passes < 2);
        if self.settings.method != Method::Adaptive || single {
            return Ok(run);
        }
        let mut pilot = Run::new(cells.len());
        self.pass(&mut pilot, cells, schedule, source)?;
        let Run { of_cells, radii, photons, samples, .. } = pilot;
        Ok(Run { of_cells, radii, photons, samples, pilots: 1, ..run })
    }

    /// Follows some photons where a medium loses no light: one without an end would hold a ray from an eye for ever, and only
    /// photons can say so.
    fn check_steady(&self) -> Result<(), ReadError> {
        if !self.world.scene.media.iter().any(|medium| medium.albedo.max() >= 1.0) {
            return Ok(());
        }
        let optics = self.optics.any();
        let photons = STEADY_PHOTONS.max(optics.lamps.lamps.len() as u64);
        trace_pass(self.world, optics, &self.settings, Classes::NONE, u32::MAX, photons).map(drop)
    }

    /// True if more passes cannot bring the error down to the target: the bias of a radius that does not shrink, or light
    /// gathered across an edge, or nothing found at all, is beyond it already.
    fn target_is_out_of_reach(&self, run: &Run<C>, target: Option<f64>) -> bool {
        let Some(target) = target else { return false };
        let shrinks = match self.settings.method {
            Method::Radius { radius } | Method::FinalGather { radius } => radius.is_none(),
            Method::Nearest { .. } => false,
            Method::Adaptive | Method::Path | Method::Bins => true,
        };
        // What shrinks is given more passes before it is given up.
        let patience = if shrinks { 4 * PASSES_BEFORE_GIVING_UP } else { PASSES_BEFORE_GIVING_UP };
        run.passes >= patience
            && self
                .error_over
                .floor_of(&run.cells, self.optics.results(), self.confidence)
                .is_none_or(|floor| floor > target)
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
        self.pass(&mut Run::new(cells.len()), cells, &pilot, source)?;
        let pass = start.elapsed().as_secs_f64() * longer;
        let left = (limit.as_secs_f64() - start.elapsed().as_secs_f64()).max(1e-3);
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

    /// One pass: photons, maps, every cell.
    fn pass(
        &self,
        run: &mut Run<C>,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
    ) -> Result<(), ReadError> {
        let number = run.passes + run.pilots;
        if self.settings.method == Method::Bins {
            return self.count(run, cells, schedule);
        }
        let optics = &*self.optics.of_pass(self.world, source.seed(self.settings.seed), number as u32);
        let maps = self.maps(run, cells, optics, number, schedule, source)?;
        let samples = schedule.samples(number);
        let shares = shares(self.world, &optics.lamps, cells);
        let look = Look {
            world: self.world,
            optics,
            settings: &self.settings,
            maps: &maps,
            looks_around: self.looks_around(),
            pass: number as u32,
            samples,
            shares: &shares,
            caustics: &maps.in_cells,
        };
        let radii: Vec<f64> = run.of_cells.iter().map(|cell| cell.get(maps.surface_radius)).collect();
        let blocks = samples.div_ceil(BLOCK);
        let found: Vec<Sample<C>> = (0..cells.len() as u64 * blocks)
            .into_par_iter()
            .map_init(Scratch::default, |scratch, task| {
                let (number, block) = ((task / blocks) as usize, task % blocks);
                let shift = look.shift(number);
                let mut sum = Sample { light: Light::default(), dark: true };
                for sample in block * BLOCK..((block + 1) * BLOCK).min(samples) {
                    let one = look.sample(&cells[number], number, sample, &shift, radii[number], scratch);
                    sum.light.add(&one.light);
                    sum.dark &= one.dark;
                }
                sum
            })
            .collect();
        let brightest_glint = *run.brightest_glint.get_or_insert_with(|| self.brightest_glint());
        let probed = self.probes(cells, optics, number as u32, samples);
        for ((index, parts), probed) in found.chunks(blocks as usize).enumerate().zip(probed) {
            let mut light = Light::default();
            parts.iter().for_each(|part| light.add(&part.light));
            let mut mean = light.over(samples as f64);
            if self.settings.method == Method::Adaptive {
                run.of_cells[index].learn(&mean, radii[index], number + 1, self.largest_radius());
            }
            mean.irradiance += probed;
            if let Some((irradiance, photons)) = maps.in_cells.of(index) {
                mean.irradiance += irradiance;
                mean.reads += 1.0;
                light.photons += photons as f64;
            }
            let mean = mean.weighted(Colour::splat(cells[index].area_read(self.world)));
            let mean = mean.developed(&optics.palette);
            let cell = &mut run.cells[index];
            cell.push(&mean, light.photons, parts.iter().all(|part| part.dark));
            cell.glints += light.glints;
            cell.rays += (samples * u64::from(self.settings.gather_rays)) as f64;
            cell.brightest_glint =
                brightest_glint.and_then(|radiance| Some(radiance * cells[index].all_around(self.world)?));
        }
        run.passes += 1;
        run.samples += samples;
        Ok(())
    }

    /// One pass of photons counted where they arrive.
    fn count(&self, run: &mut Run<C>, cells: &[Cell], schedule: &Schedule) -> Result<(), ReadError> {
        let optics = &*self.optics.of_pass(self.world, self.settings.seed, run.passes as u32);
        let plan = EmissionPlan::new(&optics.lamps, schedule.photons(run.passes))?;
        let settings = &self.settings;
        let job =
            Job { seed: settings.seed, pass: run.passes as u32, limits: settings.limits, keep: settings.classes() };
        let bins = Bins::new(self.world, cells);
        let counted = count(self.world, optics, &plan, &job, cells.len(), &bins)?;
        for (index, cell) in run.cells.iter_mut().enumerate() {
            let irradiance = counted.flux[index] * (1.0 / bins.measure[index]);
            let light = Light { irradiance, reads: 1.0, ..Light::default() };
            cell.push(&light.developed(&optics.palette), counted.photons[index] as f64, false);
        }
        run.book(plan.photons(), &counted.ledger.map(|flux| optics.palette.develop(flux)));
        run.passes += 1;
        Ok(())
    }

    /// The largest radiance that a ray can find that meets a lamp behind specular surfaces by chance; `None` if none can be met so,
    /// or the method sends no such rays.
    pub(crate) fn brightest_glint(&self) -> Option<Colour<C>> {
        let sends = matches!(self.settings.method, Method::Path | Method::FinalGather { .. });
        if !sends || !self.needs.caustic {
            return None;
        }
        let optics = self.optics.any();
        Some(optics.palette.develop(optics.lamps.brightest()?))
    }

    /// No radius grows beyond this, metres: a quarter of the scene.
    fn largest_radius(&self) -> f64 {
        let (low, high) = self.world.bounds();
        0.25 * (high - low).max_element()
    }

    /// What rays from point lamps add to each cell, where direct light is sampled.
    fn probes(&self, cells: &[Cell], optics: &Optics<C>, pass: u32, points: u64) -> Vec<Colour<C>> {
        if self.settings.method.is_direct_view() && self.settings.direct == Direct::Photons {
            return vec![Colour::ZERO; cells.len()];
        }
        let of_sensors = cells.chunk_by(|a, b| a.sensor == b.sensor);
        of_sensors
            .flat_map(|of_sensor| {
                let number = of_sensor[0].sensor as u64;
                probe(self.world, optics, of_sensor, points, self.settings.limits.max_segments, |ray| {
                    Stream::new(self.settings.seed, Purpose::Probes, pass, number << 44 | ray)
                })
            })
            .collect()
    }

    fn maps(
        &self,
        run: &mut Run<C>,
        cells: &[Cell],
        optics: &Optics<C>,
        number: u64,
        schedule: &Schedule,
        source: &Source<'_, C>,
    ) -> Result<PassMaps<C>, ReadError> {
        if !self.uses_maps() {
            return Ok(PassMaps::none());
        }
        let photons = match source {
            Source::Map(file) => file.passes[number as usize].clone(),
            Source::Trace => {
                let count = schedule.photons(number);
                trace_pass(self.world, optics, &self.settings, self.settings.classes(), number as u32, count)?
            }
        };
        run.book(photons.emitted, &photons.ledger.map(|flux| optics.palette.develop(flux)));
        let maps =
            PassMaps::build(photons, (self.world, self.needs), cells, &self.settings, number as u32, &mut run.radii)?;
        run.radius += if maps.surface.is_some() { maps.surface_radius } else { maps.caustic_radius };
        Ok(maps)
    }
}

/// The passes asked for, or as many as a saved map has; `None` if only a target or a clock ends the run.
fn passes_at_hand<const C: usize>(schedule: &Schedule, source: &Source<'_, C>) -> Option<u64> {
    match source {
        Source::Trace => schedule.ends.passes,
        Source::Map(file) => Some(schedule.ends.passes.unwrap_or(u64::MAX).min(file.passes.len() as u64)),
    }
}
