//! One pass of a session.

use std::ops::Range;

use photonlab_final_gather::{Guide, Light, Sites, UNGUIDED};
use photonlab_gather::Scratch;
use photonlab_photometry::Colour;
use photonlab_sampling::{Optics, Purpose, Sought, Stream};
use photonlab_trace::{Job, count};
use rayon::prelude::*;

use crate::{
    Cell, Direct, Draws, ErrorOver, Method, ReadError, Schedule, Session, Source,
    adaptive::CellRadius,
    bins::Bins,
    cached::Cache,
    look::Look,
    maps::{DIRECT_VIEW_COUNT, PassMaps, SHRINK},
    pilot::Pilots,
    probe::{probe, shares},
    run::Run,
    sample::Sample,
    session::passes_at_hand,
    trace_pass,
};

/// Passes for which a radius is tuned where nobody says how many there will be, or more: a run that its error ends has no fewer, so the
/// command that spells its passes out gives its bits.
pub const USUAL_PASSES: u64 = 16;

/// Of so many samples of a pixel in one pass one tells the bias of its density estimate: it costs more than the estimate, and its
/// noise is the smaller part of the error bar.
const TOLD_OF: u64 = 4;

/// Photons of a nearest-photon estimate at least.
const FEWEST_NEAREST: f64 = 8.0;

/// Samples that one task takes of one cell.
const BLOCK: u64 = 256;
/// Tasks of all cells together, whose findings are added up before the next begin.
const BLOCKS: u64 = 1 << 12;

impl<const C: usize> Session<'_, C> {
    /// One pass: photons, maps, every cell.
    pub(crate) fn pass(
        &self,
        run: &mut Run<C>,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
    ) -> Result<(), ReadError> {
        let number = run.passes;
        if self.settings.method == Method::Bins {
            return self.count(run, cells, schedule);
        }
        let optics = &*self.optics.of_pass(self.world, source.seed(self.settings.seed), number as u32);
        let maps = self.maps(run, cells, optics, number, schedule, source)?;
        let samples = schedule.samples(number);
        let shares = shares(self.world, &optics.lamps, cells);
        let mut look = Look {
            world: self.world,
            optics,
            settings: &self.settings,
            maps: &maps,
            looks_around: self.looks_around(),
            pass: number as u32,
            samples,
            k: DIRECT_VIEW_COUNT,
            told_of: self.told_of(),
            shares: &shares,
            caustics: &maps.in_cells,
            guides: &[],
            cache: None,
        };
        let passes = passes_at_hand(schedule, source).map_or(USUAL_PASSES, |passes| passes.min(USUAL_PASSES));
        let tunes = number == 0 && maps.surface.is_some() && self.settings.method.is_tuned();
        let pilots = if tunes { Some(self.pilots(cells, optics, schedule, source)?) } else { None };
        let surface_radius = match &pilots {
            Some(Pilots { first, second }) => {
                let looks = [first.as_ref().unwrap_or(&maps), second].map(|maps| Look { maps, ..look });
                run.common = self.tuned_radius(&looks, cells, passes);
                run.k = Some(run.common.photons);
                run.radius += run.common.radius - maps.surface_radius;
                *run.radii.surface.insert(run.common.radius)
            }
            _ => maps.surface_radius,
        };
        if let Method::Nearest { k } = self.settings.method {
            look.k = k.unwrap_or_else(|| shrunken(run.k, number));
        }
        if let (Method::Adaptive, Some(pilots)) = (self.settings.method, &pilots) {
            self.learn_from_pilots(run, &look, cells, (passes, surface_radius), pilots);
        }
        let radii: Vec<f64> = run.of_cells.iter().map(|cell| self.radius_of(cell, surface_radius)).collect();
        let caches = self.caches();
        let sites: &Sites<C> =
            run.sites.get_or_insert_with(|| if caches { self.sites(&look, cells) } else { Sites::default() });
        let records = self.records(&look, sites);
        if caches {
            look.cache = Some(Cache { sites, records: &records });
        }
        // The photons of the first pass guide the rays of all: no later pass knows them, and asking them costs more than rays do.
        let guide = self.settings.aids.guide;
        look.guides = run.guides.get_or_insert_with(|| if guide { guides(&look, cells) } else { Vec::new() });
        let found = read(&look, cells, &radii);
        let counts_spread = self.settings.draws == Draws::Spread && matches!(source, Source::Trace);
        let brightest_glint = *run.brightest_glint.get_or_insert_with(|| self.brightest_glint());
        let probed = self.probes(cells, optics, number as u32, samples);
        for ((index, Sample { mut light, estimate, dark }), probed) in found.into_iter().enumerate().zip(probed) {
            let mut mean = light.over(samples as f64);
            if self.takes_off_bias() {
                let (passes, estimate) = (passes.max(number + 1), estimate.over(samples as f64));
                // At an edge what is told bounds the bias, or means nothing.
                let is_told = estimate.astray == 0.0 && estimate.remedied == 0.0;
                let share = run.of_cells[index].correction(radii[index], passes, &run.common);
                mean.irradiance = mean.irradiance - estimate.bias * if is_told { share } else { 0.0 };
                run.of_cells[index].learn(&estimate, radii[index], passes, &run.common, self.largest_radius());
            }
            mean.irradiance += probed;
            if let Some((irradiance, photons)) = maps.in_cells.of(index) {
                mean.irradiance += irradiance;
                mean.reads += 1.0;
                light.photons += photons as f64;
                if photons > 0 && counts_spread {
                    let one = irradiance * (cells[index].area_read(self.world) / photons as f64);
                    run.cells[index].add_grain(optics.palette.develop(one));
                }
            }
            let mean = mean.weighted(Colour::splat(cells[index].area_read(self.world)));
            let mean = mean.developed(&optics.palette);
            let cell = &mut run.cells[index];
            cell.push(&mean, light.photons, dark);
            // Samples that a cache answers share its rays. Guided ones look as thinly as the unguided of them in places.
            let guided = if look.guides.get(index).is_some_and(Option::is_some) { UNGUIDED } else { 1.0 };
            let of_own =
                guided * if caches { (f64::from(self.settings.gather_rays) / samples as f64).min(1.0) } else { 1.0 };
            cell.glints += of_own * light.glints;
            cell.rays += of_own * (samples * u64::from(self.settings.rays_per_sample())) as f64;
            cell.brightest_glint =
                brightest_glint.and_then(|radiance| Some(radiance * cells[index].all_around(self.world)?));
        }
        run.passes += 1;
        run.samples += samples;
        Ok(())
    }

    /// The radius with which a cell is read, metres: its own where each has one, else that which all share.
    pub(crate) fn radius_of(&self, cell: &CellRadius, shared: f64) -> f64 {
        if self.settings.method == Method::Adaptive { cell.get(shared) } else { shared }
    }

    /// True if each cell learns of its bias, and what it has learnt is taken off: where radii are the program's own.
    fn takes_off_bias(&self) -> bool {
        matches!(self.settings.method, Method::Adaptive | Method::Radius { radius: None })
    }

    /// Of so many samples in one pass one tells its bias: all do where every reading has an error bar to be signed.
    fn told_of(&self) -> u64 {
        if self.error_over == ErrorOver::Worst { 1 } else { TOLD_OF }
    }

    /// One pass of photons counted where they arrive.
    fn count(&self, run: &mut Run<C>, cells: &[Cell], schedule: &Schedule) -> Result<(), ReadError> {
        let optics = &*self.optics.of_pass(self.world, self.settings.seed, run.passes as u32);
        let settings = &self.settings;
        let plan = settings.plan(&optics.lamps, schedule.photons(run.passes), Sought::All, run.passes as u32)?;
        let job =
            Job { seed: settings.seed, pass: run.passes as u32, limits: settings.limits, keep: settings.classes() };
        let bins = Bins::new(self.world, cells);
        let counted = count(self.world, optics, &plan, &job, cells.len(), &bins)?;
        for (index, cell) in run.cells.iter_mut().enumerate() {
            let irradiance = counted.flux[index] * (1.0 / bins.measure[index]);
            let light = Light { irradiance, reads: 1.0, ..Light::default() };
            let developed = light.developed(&optics.palette);
            let photons = counted.photons[index] as f64;
            cell.push(&developed, photons, false);
            if settings.draws == Draws::Spread && photons > 0.0 {
                cell.add_grain(developed.irradiance * (1.0 / photons));
            }
        }
        run.book(plan.photons(), &counted.ledger.map(|flux| optics.palette.develop(flux)));
        run.passes += 1;
        Ok(())
    }

    /// The largest radiance that a ray can find that meets a lamp behind specular surfaces by chance; `None` if none can be met so,
    /// or the method sends no such rays.
    fn brightest_glint(&self) -> Option<Colour<C>> {
        let sends = matches!(self.settings.method, Method::Path | Method::FinalGather { .. });
        if !sends || !self.needs.caustic {
            return None;
        }
        let optics = self.optics.any();
        Some(optics.palette.develop(optics.lamps.brightest()?))
    }

    /// No radius grows beyond this, metres: a quarter of the scene.
    pub(crate) fn largest_radius(&self) -> f64 {
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
        let mut photons = match source {
            Source::Map(file) => file.passes[number as usize].clone(),
            Source::Trace => {
                let count = schedule.photons(number);
                let light = (self.sought(), self.settings.classes());
                trace_pass(self.world, optics, &self.settings, light, number as u32, count)?
            }
        };
        run.book(photons.emitted, &photons.ledger.map(|flux| optics.palette.develop(flux)));
        if let Some(near) = self.near(run, cells, optics, number, schedule) {
            near.sift(&mut photons);
        }
        let (emitted, of) = (photons.emitted, (self.world, self.needs));
        let mut maps = PassMaps::build(photons, of, cells, &self.settings, number as u32, &mut run.radii)?;
        if self.precomputes() {
            maps.precomputed = Some(self.precomputed(run, optics, &maps, emitted)?);
        }
        run.radius += if maps.surface.is_some() { maps.surface_radius } else { maps.caustic_radius };
        Ok(maps)
    }
}

/// What guides the rays of each cell.
fn guides<const C: usize>(look: &Look<'_, C>, cells: &[Cell]) -> Vec<Option<Guide>> {
    let numbered = cells.par_iter().enumerate();
    numbered.map_init(Scratch::default, |scratch, (number, cell)| look.guide(cell, number, scratch)).collect()
}

/// What the samples of each cell found together. So many samples of all cells are taken at a time that what they found needs little memory.
pub(crate) fn read<const C: usize>(look: &Look<'_, C>, cells: &[Cell], radii: &[f64]) -> Vec<Sample<C>> {
    let blocks = look.samples.div_ceil(BLOCK);
    let at_a_time = (BLOCKS / cells.len().max(1) as u64).max(1);
    let mut found = vec![Sample::default(); cells.len()];
    for first in (0..blocks).step_by(at_a_time as usize) {
        let together = first..(first + at_a_time).min(blocks);
        let parts = read_blocks(look, cells, radii, together.clone());
        let of_cells = parts.chunks((together.end - together.start) as usize);
        found.iter_mut().zip(of_cells).for_each(|(sum, parts)| parts.iter().for_each(|part| sum.add(part)));
    }
    found
}

/// What some blocks of each cell's samples found, cell by cell.
fn read_blocks<const C: usize>(
    look: &Look<'_, C>,
    cells: &[Cell],
    radii: &[f64],
    blocks: Range<u64>,
) -> Vec<Sample<C>> {
    let of_cell = blocks.end - blocks.start;
    (0..cells.len() as u64 * of_cell)
        .into_par_iter()
        .map_init(Scratch::default, |scratch, task| {
            let (number, block) = ((task / of_cell) as usize, blocks.start + task % of_cell);
            let shift = look.shift(number);
            let mut sum = Sample::default();
            for sample in block * BLOCK..((block + 1) * BLOCK).min(look.samples) {
                sum.add(&look.sample(&cells[number], number, sample, &shift, radii[number], scratch));
            }
            sum
        })
        .collect()
}

/// Photons of a nearest-photon estimate, as many as were chosen in the first pass or fewer in later ones: the squared radius shrinks as
/// that of a fixed radius does.
fn shrunken(first: Option<f64>, number: u64) -> usize {
    let first = first.unwrap_or(DIRECT_VIEW_COUNT as f64);
    let now = first * ((number + 1) as f64).powf(-2.0 * SHRINK);
    now.max(FEWEST_NEAREST.min(first)).round().max(2.0) as usize
}
