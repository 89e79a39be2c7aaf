//! Photons near a point in, illuminance with its error out; photons in a medium near a point or a ray in, the light that is
//! scattered there out.
//!
//! Stands on the tree and the photon record alone. What the estimate means near an edge or another surface is the
//! caller's to judge: it knows the geometry.
#![forbid(unsafe_code)]

mod accepted;
mod ball_sum;
mod bandwidth;
mod boundary;
mod estimate;
mod facing;
mod kernel;
mod map;
mod precomputed;
mod volume;

pub use bandwidth::{AreaModel, Bandwidth, Estimator, Tests};
pub use boundary::{Inside, OpenPlane, Surroundings};
pub use estimate::Estimate;
pub use kernel::Kernel;
pub use map::{CHECK, GatherPoint, PhotonMap, SAME_SURFACE, Scratch};
pub use precomputed::{NEAR, Precomputed};
pub use volume::{Beam, Scattered, VolumeEstimate, VolumeMap};
