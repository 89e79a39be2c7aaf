//! Surfaces, coatings, lamps and receivers; reading scene files; where a ray lands; what a scene needs.
//!
//! A file is read into a [`Scene`], a plain description in world units (metres); a [`World`] is the scene made ready for
//! rays; [`Needs`] says what must be modelled to read it.
#![forbid(unsafe_code)]

mod absent;
mod accelerator;
mod ball;
mod bsdf;
mod cell;
mod description;
mod dish;
mod disk;
mod emitter;
mod frame;
mod hidden;
mod index;
mod inside;
pub mod luminaire;
mod medium;
mod mesh;
mod needs;
mod normals;
mod parallelogram;
mod primitive;
mod ray;
pub mod read;
mod reasons;
mod seen;
mod sensor;
mod sky;
mod triangle;
mod tube;
mod world;

pub use ball::Ball;
pub use bsdf::{Bsdf, Conductor, Dielectric, Microfacets, Roughness};
pub use description::{Geometry, LensBody, Scene, Shape};
pub use dish::{Dish, Section};
pub use disk::Disk;
pub use emitter::{Emitter, EnvironmentLight, Pattern, SkyMap};
pub use frame::Frame;
pub use index::Index;
pub use inside::{Inside, Neighbourhood, RadialWeight};
pub use medium::{Boundary, Medium, Phase};
pub use mesh::{Mesh, Smooth};
pub use needs::{Need, Needs};
pub use normals::Normals;
pub use parallelogram::Parallelogram;
pub use primitive::{Hit, Primitive, Surface, SurfacePoint};
pub use ray::Ray;
pub use sensor::{Camera, DistantTarget, Film, Lens, Meter, Receiver, Sensor};
pub use sky::{Sky, SkyLaw};
pub use triangle::Triangle;
pub use tube::Tube;
pub use world::World;
