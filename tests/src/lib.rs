//! What the integration tests share: one budget of false alarms, synthetic photons, scenes, the program, the mutants.
//!
//! Every random test runs on fixed seeds. `PHOTONLAB_TEST_SEED=n` moves all of them to a fresh set, which is how the mutant
//! runner sees that a test's verdict does not hang on one lucky seed.
#![forbid(unsafe_code)]

mod family;
mod field;
mod icosphere;
mod image;
mod lab;
mod mutant;
mod openimageio;
mod program;
mod schema;
mod seed;

pub use family::{FALSE_ALARM, Family, SUITE};
pub use field::{Field, column, replicates};
pub use icosphere::icosphere;
pub use image::{Exr, ImageError};
pub use lab::{LAMP_OVER_FLOOR, Lab, scene_file, scene_text, settings};
pub use mutant::{Mutant, MutantError};
pub use openimageio::{OpenImageIo, Said};
pub use program::{Answer, Program};
pub use schema::violation;
pub use seed::seed;
