//! Draws with their densities: emission, scattering, direct light, random streams, the emission plan.
//!
//! Every draw comes with the density it was drawn from, in the measure that its name states (`pdf_solid_angle`,
//! `pdf_area`), or is weighted so that the density has already been divided out; which of the two is said at each.
#![forbid(unsafe_code)]

mod aim;
mod compiled;
mod direct;
mod enclosure;
mod environment;
mod environment_table;
mod equiangular;
mod fresnel;
mod lamp;
mod lamps;
mod matte;
mod microfacet;
mod optics;
mod pass_optics;
mod pattern;
mod phase;
mod plan;
mod portal;
mod rough;
mod scatter;
mod sobol;
mod specular;
mod spherical_rectangle;
mod stream;
mod tabulated;
mod turn;
mod volume;
pub mod warp;
mod wavelength_plan;
mod window;

pub use direct::{DirectSample, LightDraw, balance_pdf, lamp_pdf_solid_angle, sample_direct};
pub use enclosure::leak;
pub use environment::Environment;
pub use equiangular::{AroundPoint, Equiangular};
pub use fresnel::{diffuse_fresnel, fresnel_conductor, fresnel_dielectric};
pub use lamp::{Emission, Lamp, LampKind};
pub use lamps::Lamps;
pub use matte::{Matte, Sight};
pub use microfacet::Facets;
pub use optics::Optics;
pub use pass_optics::{NothingCounts, PassOptics};
pub use phase::{phase_pdf_solid_angle, scatter};
pub use plan::{EmissionPlan, PlanError, Sought};
pub use portal::Portal;
pub use rough::{FacetMaterial, Rough, RoughDraw};
pub use scatter::{Dispersive, Followed, Interaction, Onward, goes_through};
pub use specular::Specular;
pub use stream::{Purpose, Stream, philox4x32};
pub use volume::{Flight, Volume};
pub use wavelength_plan::WavelengthPlan;
