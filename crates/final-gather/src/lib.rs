//! Looks around once before gathering.
//!
//! [`Gatherer::irradiance`] estimates all light at a diffuse point: direct light by lamp sampling, caustic light straight
//! from the caustic map, and the rest by a ray over the hemisphere that gathers where it lands. Without maps the
//! same walk is a path tracer, the control that photon maps are held against. In media [`InScattering`] says how.
//! An irradiance cache ([`Sites`], [`Record`]) looks around at few places and tells what lies between.
#![forbid(unsafe_code)]

mod cache;
mod collision;
mod gatherer;
mod guide;
mod hemisphere;
mod in_scattering;
mod light;
mod look;
mod parting;
mod place;
mod record;
mod segment;
mod stretches;
mod zones;

pub use cache::{ACCURACY, Sites};
pub use gatherer::{GatherMaps, Gatherer, MapWithRadius};
pub use guide::{Guide, UNGUIDED};
pub use in_scattering::{InScattering, VolumeMaps};
pub use light::Light;
pub use place::{Place, surface_inside, surface_seen};
pub use record::{Record, Site, Spot};
pub use segment::{EyeLimits, Landing, Start, follow};
