//! Light of the sky.

pub mod roof_opening;
pub mod sky;
