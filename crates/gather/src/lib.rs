//! Photons near a point in, illuminance with its error out; photons in a medium near a point or a ray in, the light that is
//! scattered there out.
//!
//! Stands on the tree and the photon record alone. What the estimate means near an edge or another surface is the
//! caller's to judge: it knows the geometry.
#![forbid(unsafe_code)]

mod bandwidth;
mod estimate;
mod map;
mod volume;

pub use bandwidth::{AreaModel, Bandwidth, Tests};
pub use estimate::Estimate;
pub use map::{CHECK, GatherPoint, PhotonMap, Scratch};
pub use volume::{Beam, Scattered, VolumeEstimate, VolumeMap};
