//! Surfaces, coatings, lamps and receivers; reading scene files; where a ray lands; what a scene needs.
//!
//! A file is read into a [`Scene`], a plain description in world units (metres); a [`World`] is the scene made ready for
//! rays; [`Needs`] says what must be modelled to read it.
#![forbid(unsafe_code)]

mod ball;
mod description;
mod needs;
mod parallelogram;
mod ray;
pub mod read;
mod world;

pub use ball::Ball;
pub use needs::{Need, Needs};
pub use parallelogram::Parallelogram;
pub use ray::Ray;
pub use world::{Hit, Primitive, Surface, SurfacePoint, World};

pub use description::{
    Bsdf, Camera, Emitter, Film, Geometry, Meter, Receiver, Rgb, Scene, Sensor, Shape, SpecularReflectance,
};
