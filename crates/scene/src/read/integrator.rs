//! What this program chooses by itself: integrators and samplers are superseded, except for the depth and the hidden lamps that they ask for.

use super::element::Element;
use super::error::SceneError;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;

/// Reads the integrator: `max_depth` and `hide_emitters` go into the scene, the rest into a note.
pub(super) fn integrator<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<(), SceneError> {
    if let Some(first) = builder.integrator.replace(element) {
        let what = format!("a second integrator, the first is at {}", first.place);
        return Err(element.error(what, "keep one of them"));
    }
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let depth = object.integer("max_depth")?;
    builder.scene.max_depth = depth.map(|depth| max_depth(element, depth)).transpose()?.flatten();

    let mut unused = Vec::new();
    for name in ["rr_depth", "samples_per_pass", "shading_samples", "emitter_samples", "bsdf_samples"] {
        if object.integer(name)?.is_some() {
            unused.push(name);
        }
    }
    builder.scene.hides_lamps = object.boolean("hide_emitters")?.unwrap_or(false);
    let plugin = object.plugin;
    object.close(&["integrator", "samples", "block_size", "timeout"])?;
    let obeyed = match (depth.is_some(), builder.scene.hides_lamps) {
        (true, true) => "; its max_depth is obeyed, and hide_emitters by cameras",
        (true, false) => "; its max_depth is obeyed",
        (false, true) => "; its hide_emitters is obeyed by cameras",
        (false, false) => "",
    };
    let without = if unused.is_empty() { String::new() } else { format!("; not used: {}", unused.join(", ")) };
    builder.note(&format!("integrator {plugin} is superseded by --method{obeyed}{without}"));
    Ok(())
}

fn max_depth(element: &Element, depth: i64) -> Result<Option<u32>, SceneError> {
    if depth == -1 {
        return Ok(None);
    }
    match u32::try_from(depth) {
        Ok(segments @ 1..) => Ok(Some(segments)),
        _ => {
            let what = format!("max_depth {depth} leaves no light path or is no depth");
            Err(element.error(what, "use -1 for unlimited, or 1 to 4294967295"))
        }
    }
}

/// Reads a sampler, which is superseded.
pub(super) fn sampler(element: &Element, builder: &mut Builder) -> Result<(), SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    object.integer("sample_count")?;
    object.integer("seed")?;
    object.boolean("jitter")?;
    object.integer("strength")?;
    object.integer("base")?;
    object.float("dimension", Range::ANY)?;
    object.close(&[])?;
    builder.note("sample counts and samplers in the file are superseded by --spp and --seed");
    Ok(())
}
