//! Draws with their densities: emission, scattering, direct light, random streams, the emission plan.
//!
//! Every draw comes with the density it was drawn from, in the measure that its name states (`pdf_solid_angle`,
//! `pdf_area`), or is weighted so that the density has already been divided out; which of the two is said at each.
#![forbid(unsafe_code)]

mod direct;
mod lamp;
mod plan;
mod scatter;
mod spherical_rectangle;
mod stream;
pub mod warp;

pub use direct::{DirectSample, lamp_pdf_solid_angle, sample_direct};
pub use lamp::{Emission, Lamp, LampKind, Lamps};
pub use plan::{EmissionPlan, PlanError};
pub use scatter::{Interaction, Specular, fresnel_dielectric, interaction};
pub use stream::{Purpose, Stream, philox4x32};
