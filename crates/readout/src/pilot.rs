//! A pass whose photons tune and are not read.

use photonlab_sampling::Optics;

use crate::{
    Cell, Draws, Method, ReadError, Schedule, Session, Settings, Source,
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

/// The maps of two passes to tune by.
pub(crate) struct Pilots<const C: usize> {
    /// `None` if the run's first pass is the first.
    pub(crate) first: Option<PassMaps<C>>,
    pub(crate) second: PassMaps<C>,
}

impl<const C: usize> Session<'_, C> {
    /// The photons of two independent passes, to tune by. For few cells, and where each cell has a radius of its own, no pass reads them
    /// and they are the same whatever the run's seed: by its own photons each run would choose another radius, and so another bias, which
    /// the spread of its passes does not show. The radius of many cells hardly varies, and the first of the two is the first pass.
    pub(crate) fn pilots(
        &self,
        cells: &[Cell],
        optics: &Optics<C>,
        schedule: &Schedule,
        source: &Source<'_, C>,
    ) -> Result<Pilots<C>, ReadError> {
        let few = cells.len() < FEWEST_CELLS || self.settings.method == Method::Adaptive;
        let draws = match source {
            Source::Trace => self.settings.draws,
            Source::Map(_) => Draws::Independent,
        };
        let settings = Settings { seed: PILOT_SEED, draws, ..self.settings };
        let pilot = |pass: u32| {
            let light = (self.sought(), settings.classes());
            let count = match source {
                Source::Map(file) => file.passes[0].emitted,
                Source::Trace => schedule.photons(0),
            };
            let photons = trace_pass(self.world, optics, &settings, light, pass, count)?;
            let of = (self.world, self.needs);
            PassMaps::build(photons, of, cells, &settings, 0, &mut Radii::default())
        };
        Ok(Pilots { first: if few { Some(pilot(PILOT_PASS - 1)?) } else { None }, second: pilot(PILOT_PASS)? })
    }

    /// Lets each cell choose its first radius by the photons of two passes that are not read.
    pub(crate) fn learn_from_pilots(
        &self,
        run: &mut Run<C>,
        look: &Look<'_, C>,
        cells: &[Cell],
        (passes, first): (u64, f64),
        pilots: &Pilots<C>,
    ) {
        for maps in [&pilots.second].into_iter().chain(&pilots.first) {
            let look = Look { maps, ..*look };
            let radii: Vec<f64> = run.of_cells.iter().map(|cell| cell.get(first)).collect();
            for (index, found) in read(&look, cells, &radii).iter().enumerate() {
                let mean = found.estimate.over(look.samples as f64);
                run.of_cells[index].learn(&mean, radii[index], passes, &run.common, self.largest_radius());
            }
        }
    }
}
