//! Surfaces, coatings, lamps and receivers; reading scene files; where a ray lands; what a scene needs.
//!
//! A file is read into a [`Scene`], a plain description in world units (metres); a [`World`] is the scene made ready for
//! rays; [`Needs`] says what must be modelled to read it.
#![forbid(unsafe_code)]

mod accelerator;
mod ball;
mod cell;
mod description;
pub mod luminaire;
mod needs;
mod parallelogram;
mod primitive;
mod ray;
pub mod read;
mod sky;
mod world;

pub use ball::Ball;
pub use needs::{Need, Needs};
pub use parallelogram::Parallelogram;
pub use primitive::{Hit, Primitive, Surface, SurfacePoint};
pub use ray::Ray;
pub use sky::{Sky, SkyLaw};
pub use world::World;

pub use description::{
    Bsdf, Camera, Conductor, Dielectric, Emitter, EnvironmentLight, Film, Geometry, Meter, Microfacets, Pattern,
    Receiver, Rgb, Roughness, Scene, Sensor, Shape, SkyMap, SpecularReflectance,
};
