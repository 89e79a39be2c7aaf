//! Quantities, units, spectra, channels and the photon record.
//!
//! This crate stands at the bottom of the house: everything that crosses a door between two crates and says
//! something about light is defined here.
#![forbid(unsafe_code)]

mod colour;
mod compiled;
mod curve;
mod direction;
mod observer;
mod palette;
mod photon;
mod quantity;
mod rgb_spectrum;
mod spectrum;

pub use colour::{Channels, Colour, WAVELENGTHS};
pub use compiled::compiled;
pub use curve::{Curve, CurveError};
pub use direction::PackedDirection;
pub use observer::{PEAK_EFFICACY, SRGB_OF_XYZ, VISIBLE, daylight, matching, sensitivity};
pub use palette::{Palette, Response, Wavelengths};
pub use photon::{PathClass, Photon, VolumePhoton};
pub use quantity::{Quantity, Unit, UnitSystem};
pub use spectrum::Spectrum;
