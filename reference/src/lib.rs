//! Scenes whose answer is known, each derived here and checked by an independent computation.
//!
//! Two kinds of answer: scenes, which say what the light is and write themselves as Mitsuba 3 XML from the same parameters;
//! and laws, which say what an estimator reads on photons that are right ([`fixed_radius_law`], [`nearest_law`],
//! [`kernel_law`], [`edge_laws`], [`convergence`], [`atlas`]) or how a surface scatters ([`scattering`]). Scenes: direct light ([`lamps`], [`square_lamp`]),
//! interreflection ([`cube`], [`emitting_cube`], [`closed_room`], [`integrating_sphere`], [`furnace`], [`groove`]),
//! shadows ([`checker`]), specular paths ([`pane`], [`ball_lens`], [`paraboloid`], [`mirror_arc`], [`prism`], [`optics`]), participating media ([`medium`]),
//! daylight ([`daylight`]); [`rendering_equation`] and [`eye`] stand by themselves. [`catalogue::ALL`] lists the scenes with what
//! their meters must read. Metres, watts or lumens, double precision. The crate sees no other code of the project but its
//! words for quantities, so that it can judge the rest.
//!
//! ```
//! use photonlab_reference::{cube::Cube, edge_laws, nearest_law::{self, Counted}};
//!
//! let solution = Cube::BENCHMARK.solve();
//! assert!((solution.luminance(0.0, 0.0) - 892.8).abs() < 0.05);
//! assert!(solution.error_bound() < 1e-5);
//!
//! // A gather at a free edge reads one half; twenty nearest photons, all counted, read 20/19 in the open.
//! assert_eq!(edge_laws::half_plane(0.0), 0.5);
//! assert!((nearest_law::uniform(20, Counted::All).mean - 20.0 / 19.0).abs() < 1e-12);
//! ```
#![forbid(unsafe_code)]

pub mod atlas;
pub mod ball_lens;
pub mod catalogue;
pub mod checker;
pub mod closed_room;
pub mod convergence;
pub mod cube;
pub mod daylight;
mod disc_response;
pub mod edge_laws;
pub mod emitting_cube;
pub mod eye;
pub mod fixed_radius_law;
pub mod furnace;
pub mod groove;
pub mod integrating_sphere;
pub mod kernel_law;
pub mod lamps;
pub mod medium;
pub mod mirror_arc;
mod mitsuba;
pub mod nearest_law;
pub mod optics;
mod out_of_range;
pub mod pane;
pub mod paraboloid;
pub mod prism;
mod quadrature;
#[cfg(test)]
mod random;
pub mod rendering_equation;
pub mod scattering;
pub mod square_lamp;
mod vector;

pub use out_of_range::OutOfRange;
