//! Scattering laws as functions, to be compared with an implementation's draws and densities.

pub mod fresnel;
