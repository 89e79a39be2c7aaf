//! Participating media: homogeneous, in optical units (mean free paths) where nothing else is said.

pub mod attenuation;
pub mod half_space;
pub mod infinite;
pub mod once_scattered;
pub mod phase;
pub mod slab;
