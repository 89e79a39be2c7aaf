//! `photonlab plan`: what a scene needs and why.

use std::{fmt::Write as _, io::Write as _};

use crate::{Failure, command, loaded::Loaded};

/// Explains a scene's needs on standard output.
pub(crate) fn plan(arguments: &command::Plan) -> Result<(), Failure> {
    if arguments.target_error.is_some() {
        return Err(Failure::usage("plan --target-error is not built yet: it tells needs alone; leave it out"));
    }
    let loaded = Loaded::new(&arguments.scene)?;
    let scene = &loaded.world.scene;
    let mut text = format!(
        "{}: {} shapes, {} lamps, {} sensors\n\nneeded:\n",
        arguments.scene.scene.display(),
        scene.shapes.len(),
        scene.emitters.len() + scene.shapes.iter().filter(|s| s.radiance.is_some()).count(),
        scene.sensors.len()
    );
    for need in &loaded.needs.list {
        let _ = writeln!(text, "  {:<16} {}", need.need, need.reason);
    }
    text.push_str("\nleft out:\n");
    for need in &loaded.needs.left_out {
        let _ = writeln!(text, "  {:<16} {}", need.need, need.reason);
    }
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}
