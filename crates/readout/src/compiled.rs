//! Whole runs, compiled here for every number of channels.

use std::time::Duration;

use photonlab_photometry::{WAVELENGTHS, compiled};

use crate::{Cell, Observer, Ongoing, Outcome, ReadError, Schedule, Session, Source};

/// [`Session::run`] in `C` channels, and the passes of an [`Ongoing`] run.
pub(crate) trait Runner<const C: usize>: Sync {
    fn run(
        &self,
        session: &Session<'_, C>,
        cells: &[Cell],
        schedule: &Schedule,
        source: &Source<'_, C>,
        observer: &dyn Observer,
    ) -> Result<Outcome<C>, ReadError>;

    fn pass(&self, ongoing: &mut Ongoing<'_, C>) -> Result<Duration, ReadError>;

    fn go_on(&self, ongoing: Ongoing<'_, C>, observer: &dyn Observer) -> Result<Outcome<C>, ReadError>;
}

struct Compiled;

macro_rules! compile {
    ($($channels:expr),*) => {$(
        impl Runner<{ $channels }> for Compiled {
            fn run(
                &self,
                session: &Session<'_, { $channels }>,
                cells: &[Cell],
                schedule: &Schedule,
                source: &Source<'_, { $channels }>,
                observer: &dyn Observer,
            ) -> Result<Outcome<{ $channels }>, ReadError> {
                session.run_here(cells, schedule, source, observer)
            }

            fn pass(&self, ongoing: &mut Ongoing<'_, { $channels }>) -> Result<Duration, ReadError> {
                ongoing.one_pass()
            }

            fn go_on(
                &self,
                ongoing: Ongoing<'_, { $channels }>,
                observer: &dyn Observer,
            ) -> Result<Outcome<{ $channels }>, ReadError> {
                ongoing.go_on_here(observer)
            }
        }
    )*};
}

compile!(1, 3, WAVELENGTHS);

/// The one for `C` channels.
pub(crate) fn runner<const C: usize>() -> &'static dyn Runner<C> {
    static GREY: &dyn Runner<1> = &Compiled;
    static RGB: &dyn Runner<3> = &Compiled;
    static SPECTRAL: &dyn Runner<WAVELENGTHS> = &Compiled;
    compiled(&[&GREY, &RGB, &SPECTRAL])
}
