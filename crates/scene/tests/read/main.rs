//! Reading scenes: every sample, every feature, every way to be wrong.

mod broken;
mod features;
mod files;
mod hostile;
mod meshes;
mod optics;
mod round;
mod samples;

use photonlab_scene::Scene;
use photonlab_scene::read::{SceneError, read_scene_str};

/// The scene with `body` on line 2 and after.
fn read_body(body: &str, defines: &[(&str, &str)]) -> Result<Scene, SceneError> {
    let defines: Vec<(String, String)> =
        defines.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    read_scene_str(&format!("<scene version=\"3.0.0\">\n{body}\n</scene>"), "test.xml", &defines)
}

/// The scene, which must be right.
fn scene(body: &str) -> Scene {
    read_body(body, &[]).unwrap_or_else(|error| panic!("{error}\nin {body}"))
}
