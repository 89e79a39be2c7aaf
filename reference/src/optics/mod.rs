//! Optical devices and what comes out of them: the answers of the scenes in `experiments/scenes/optics/`.
//!
//! Each device is described by a constant that has the numbers of its scene file; a test loads the file and compares.

pub mod condenser;
pub mod light_guide;
pub mod port_sphere;
pub mod reflector;
pub mod spectrograph;
