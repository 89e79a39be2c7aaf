//! A pass whose photons tune and are not read.

use photonlab_sampling::Optics;

use crate::{
    Cell, Method, ReadError, Schedule, Session, Settings, Source,
    look::Look,
    maps::{PassMaps, Radii},
    pass::read,
    run::Run,
    trace_pass,
    tuned::FEWEST_CELLS,
};

/// Whose photons tune: a pass that no run reads.
const PILOT_SEED: u64 = 0;
const PILOT_PASS: u32 = u32::MAX - 1;

/// Times that the cells read a pilot's photons, each with the radius that they chose by the last.
const PILOT_ROUNDS: u32 = 2;

impl<const C: usize> Session<'_, C> {
    /// Maps of photons of which no pass reads any, the same whatever the run's seed, to tune few cells' radius by: by its own photons each
    /// run would choose another, and so another bias, which the spread of its passes does not show. `None` for many cells, whose radius
    /// hardly varies.
    pub(crate) fn pilot(
        &self,
        cells: &[Cell],
        optics: &Optics<C>,
        schedule: &Schedule,
        source: &Source<'_, C>,
    ) -> Result<Option<PassMaps<C>>, ReadError> {
        if cells.len() >= FEWEST_CELLS && self.settings.method != Method::Adaptive {
            return Ok(None);
        }
        let count = match source {
            Source::Trace => schedule.photons(0),
            Source::Map(file) => file.passes[0].emitted,
        };
        let settings = Settings { seed: PILOT_SEED, ..self.settings };
        let light = (self.sought(), settings.classes());
        let photons = trace_pass(self.world, optics, &settings, light, PILOT_PASS, count)?;
        let of = (self.world, self.needs);
        PassMaps::build(photons, of, cells, &settings, 0, &mut Radii::default())
            .map(|maps| maps.surface.is_some().then_some(maps))
    }

    /// Lets each cell choose its first radius by the photons of a pass that is not read.
    pub(crate) fn learn_from_pilot(
        &self,
        run: &mut Run<C>,
        look: &Look<'_, C>,
        cells: &[Cell],
        (passes, first): (u64, f64),
        pilot: Option<&PassMaps<C>>,
    ) {
        let Some(maps) = pilot else { return };
        let look = Look { maps, ..*look };
        for _ in 0..PILOT_ROUNDS {
            let radii: Vec<f64> = run.of_cells.iter().map(|cell| cell.get(first)).collect();
            for (index, found) in read(&look, cells, &radii).iter().enumerate() {
                let mean = found.light.over(look.samples as f64);
                run.of_cells[index].learn(&mean, radii[index], passes, &run.common, self.largest_radius());
            }
        }
    }
}
