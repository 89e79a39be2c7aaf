//! Lamps and coatings made ready, compiled here for every number of channels.

use photonlab_photometry::{Palette, WAVELENGTHS, compiled};
use photonlab_scene::World;

use crate::Optics;

/// [`Optics::new`] in `C` channels.
pub(crate) trait Maker<const C: usize>: Sync {
    fn optics(&self, world: &World, palette: Palette<C>) -> Optics<C>;
}

struct Compiled;

macro_rules! compile {
    ($($channels:expr),*) => {$(
        impl Maker<{ $channels }> for Compiled {
            fn optics(&self, world: &World, palette: Palette<{ $channels }>) -> Optics<{ $channels }> {
                Optics::make(world, palette)
            }
        }
    )*};
}

compile!(1, 3, WAVELENGTHS);

/// The one for `C` channels.
pub(crate) fn maker<const C: usize>() -> &'static dyn Maker<C> {
    static GREY: &dyn Maker<1> = &Compiled;
    static RGB: &dyn Maker<3> = &Compiled;
    static SPECTRAL: &dyn Maker<WAVELENGTHS> = &Compiled;
    compiled(&[&GREY, &RGB, &SPECTRAL])
}
