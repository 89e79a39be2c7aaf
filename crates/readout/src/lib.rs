//! Rays from eyes and receivers, direct light, and the strategies put together.
//!
//! A [`Session`] reads the cells of a scene's sensors in passes. Every pass has photons, maps and rays of its own, so the
//! spread of the passes' values is an honest standard error; the run ends when its error bars, the clock or the count
//! says so.
#![forbid(unsafe_code)]

mod adaptive;
mod bins;
mod cached;
mod caustic_cells;
mod cells;
mod checked_file;
mod compiled;
mod direct_view;
mod error_over;
mod identity;
mod lattice;
mod look;
mod map_file;
mod maps;
mod method;
mod near;
mod ongoing;
mod outcome;
mod outlook;
mod pass;
mod pilot;
mod precomputed;
mod probe;
mod run;
mod sample;
mod schedule;
mod seen;
mod session;
mod tuned;

pub use cells::{Cell, Target};
pub use checked_file::partial_name;
pub use error_over::ErrorOver;
pub use identity::scene_identity;
pub use map_file::{MapFile, MapFileError, MapHeader};
pub use maps::{PassPhotons, SHRINK, trace_pass};
pub use method::{Aids, Direct, Draws, Method, Settings};
pub use ongoing::{Ongoing, PASSES_BEFORE_STOPPING};
pub use outcome::{CellResult, Outcome};
pub use pass::USUAL_PASSES;
pub use schedule::{Demands, Ends, Schedule, Wanted};
pub use session::{Observer, ReadError, Session, Silent, Source};
