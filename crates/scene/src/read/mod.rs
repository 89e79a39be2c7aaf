//! Reading Mitsuba 3 XML into a [`Scene`].
//!
//! Two walks: `load` turns the file and what it includes into a tree of checked `element`s with every `$name`
//! replaced; `scene` asks those elements for what it knows and refuses what is left over, so nothing of a file is
//! ignored in silence. Conventions are Mitsuba's own, as version 3.9 shows them.

mod bsdf;
mod camera;
mod colour;
mod cylinder;
mod defaults;
mod dielectric;
mod element;
mod emitter;
mod environment;
mod error;
mod film;
mod index;
mod integrator;
mod lens;
mod load;
mod lumens;
mod luminaire;
mod medium;
mod mesh;
mod metal;
mod names;
mod number;
mod obj;
mod object;
mod picture;
mod plugins;
mod ply;
mod scan;
mod scene;
mod sensor;
mod shape;
mod source;
mod sphere;
mod syntax;
mod tag;
mod transform;
mod version;
mod walk;

use std::path::Path;

pub use error::SceneError;
pub(crate) use names::quote;

use crate::Scene;
use load::Loader;

/// Reads the scene at `path`; each of `defines` (name, value) replaces the value of a `<default>` of that name.
pub fn read_scene(path: &Path, defines: &[(String, String)]) -> Result<Scene, SceneError> {
    scene::build(Loader::new(&path.display().to_string(), defines)?.load_file(path)?)
}

/// Reads a scene from `text`, called `name` in errors; it can include no files.
pub fn read_scene_str(text: &str, name: &str, defines: &[(String, String)]) -> Result<Scene, SceneError> {
    scene::build(Loader::new(name, defines)?.load_text(text, name)?)
}
