//! Tracing, compiled here for every number of channels.

use photonlab_photometry::{WAVELENGTHS, compiled};
use photonlab_sampling::{EmissionPlan, Optics};
use photonlab_scene::World;

use crate::{Counted, Counter, Job, TraceError, Traced, counter, follow_all};

/// The photons of one pass and where they fly.
#[derive(Clone, Copy)]
pub(crate) struct Flight<'f, const C: usize> {
    pub(crate) world: &'f World,
    pub(crate) optics: &'f Optics<C>,
    pub(crate) plan: &'f EmissionPlan<C>,
    pub(crate) job: &'f Job,
}

/// [`crate::trace`] and [`crate::count`] in `C` channels.
pub(crate) trait Tracer<const C: usize>: Sync {
    fn trace(&self, flight: Flight<'_, C>) -> Result<Traced<C>, TraceError>;
    fn count(&self, flight: Flight<'_, C>, cells: usize, counter: &dyn Counter) -> Result<Counted<C>, TraceError>;
}

struct Compiled;

macro_rules! compile {
    ($($c:expr),*) => {$(
        impl Tracer<{ $c }> for Compiled {
            fn trace(&self, flight: Flight<'_, { $c }>) -> Result<Traced<{ $c }>, TraceError> {
                follow_all(flight)
            }

            fn count(
                &self,
                flight: Flight<'_, { $c }>,
                cells: usize,
                counter: &dyn Counter,
            ) -> Result<Counted<{ $c }>, TraceError> {
                counter::count_all(flight, cells, counter)
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
