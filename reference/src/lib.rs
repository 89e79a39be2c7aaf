//! Scenes whose answer is known, each derived here and checked by an independent computation.
#![forbid(unsafe_code)]

pub mod ball_lens;
pub mod cube;
pub mod edge_laws;
pub mod fixed_radius_law;
pub mod furnace;
pub mod integrating_sphere;
mod mitsuba;
pub mod nearest_law;
mod out_of_range;
mod quadrature;
#[cfg(test)]
mod random;
pub mod rendering_equation;
pub mod square_lamp;

pub use out_of_range::OutOfRange;
