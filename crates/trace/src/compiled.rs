//! Tracing, compiled here for every number of channels.

use photonlab_photometry::{WAVELENGTHS, compiled};
use photonlab_sampling::{EmissionPlan, Optics};
use photonlab_scene::World;

use crate::{Counted, Counter, Job, TraceError, Traced, counter, follow_all};

/// [`crate::trace`] and [`crate::count`] in `C` channels.
pub(crate) trait Tracer<const C: usize>: Sync {
    fn trace(
        &self,
        world: &World,
        optics: &Optics<C>,
        plan: &EmissionPlan<C>,
        job: &Job,
    ) -> Result<Traced<C>, TraceError>;

    fn count(
        &self,
        world: &World,
        optics: &Optics<C>,
        plan: &EmissionPlan<C>,
        job: &Job,
        cells: usize,
        counter: &dyn Counter,
    ) -> Result<Counted<C>, TraceError>;
}

struct Compiled;

macro_rules! compile {
    ($($channels:expr),*) => {$(
        impl Tracer<{ $channels }> for Compiled {
            fn trace(
                &self,
                world: &World,
                optics: &Optics<{ $channels }>,
                plan: &EmissionPlan<{ $channels }>,
                job: &Job,
            ) -> Result<Traced<{ $channels }>, TraceError> {
                follow_all(world, optics, plan, job)
            }

            fn count(
                &self,
                world: &World,
                optics: &Optics<{ $channels }>,
                plan: &EmissionPlan<{ $channels }>,
                job: &Job,
                cells: usize,
                counter: &dyn Counter,
            ) -> Result<Counted<{ $channels }>, TraceError> {
                counter::count_all(world, optics, plan, job, cells, counter)
            }
        }
    )*};
}

compile!(1, 3, WAVELENGTHS);

/// The one for `C` channels.
pub(crate) fn tracer<const C: usize>() -> &'static dyn Tracer<C> {
    static GREY: &dyn Tracer<1> = &Compiled;
    static RGB: &dyn Tracer<3> = &Compiled;
    static SPECTRAL: &dyn Tracer<WAVELENGTHS> = &Compiled;
    compiled(&[&GREY, &RGB, &SPECTRAL])
}
