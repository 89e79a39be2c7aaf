//! Quantities, units, channels and the photon record.
//!
//! This crate stands at the bottom of the house: everything that crosses a door between two crates and says
//! something about light is defined here.
#![forbid(unsafe_code)]

mod colour;
mod direction;
mod photon;
mod quantity;

pub use colour::{Channels, Colour};
pub use direction::PackedDirection;
pub use photon::{PathClass, Photon};
pub use quantity::{Quantity, Unit, UnitSystem};
