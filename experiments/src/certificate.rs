//! Which readings are certified, and why others are not.

use photonlab_gather::AreaModel;
use photonlab_readout::{CellResult, Method, Settings};
use photonlab_scene::{Emitter, Needs, World};

/// A reading from a map that rests on fewer photons is not certified: none found is not dark, and few tell no error.
const FEWEST_PHOTONS: f64 = 30.0;

/// A reading of which more than this share was gathered across an edge is not certified.
const RESOLVED: f64 = 1e-3;

/// A reading of which light that rays meet too seldom to show may be more than this share is not certified.
const RARE: f64 = 0.05;

/// A reading of which more than this share of the balls reached over an edge is not certified, however little they read there.
const ASTRAY: f64 = 0.01;

/// A reading whose kernel bias is surely more than this share of it is not certified. The bound is the bias's leading order: on a
/// round peak (a Gaussian) of this bias it falls short by one per cent of the reading, on sharper ones by many times itself.
const STRAIGHT: f64 = 0.05;

/// Why there is no value at all, if so: no light was found that might be there.
pub(crate) fn nothing<const C: usize>(result: &CellResult<C>, channel: usize, emits: bool) -> Option<&'static str> {
    if result.found_nothing() {
        return Some(
            "no light was found: no photon and no lamp sample reached it, which does not show that it is dark",
        );
    }
    let none_of_it = result.value[channel].mean().unwrap_or(0.0) == 0.0 && !result.dark && emits;
    none_of_it
        .then_some("no light of this channel was found, though a lamp emits it, which does not show that it is dark")
}

/// What speaks against the error bar of a channel; `t` is the interval's quantile of Student's t.
pub(crate) fn objections<const C: usize>(result: &CellResult<C>, channel: usize, t: f64) -> Vec<String> {
    let mut objections = Vec::new();
    let unresolved = result.unresolved_share(channel);
    if unresolved > RESOLVED {
        objections.push(format!(
            "{:.2} % of the value was gathered with a ball that reaches over an edge or onto another surface, where the bias has no \
             bound",
            100.0 * unresolved
        ));
    }
    let astray = result.astray.mean().unwrap_or(0.0);
    if unresolved <= RESOLVED && astray > ASTRAY {
        objections.push(format!(
            "{:.0} % of the balls with which the map was read reach over an edge or onto another surface, and what they lack has no bound",
            100.0 * astray
        ));
    }
    let bend = result.bend(channel, t);
    if bend > STRAIGHT {
        objections.push(format!(
            "light changes within the ball that it was gathered with: by {:.0} % of the value at least, where the bias has no sure \
             bound; more photons make a smaller ball",
            100.0 * bend
        ));
    }
    if result.asked_photons && result.photons < FEWEST_PHOTONS && result.brightest_glint.is_none() {
        objections.push(format!(
            "only {} photons were found near what it looks at: too few to tell what light they stand for",
            result.photons
        ));
    }
    let (rare, value) = (result.rare_bound(channel), result.value[channel].mean().unwrap_or(0.0).abs());
    if rare > RARE * value {
        objections.push(format!(
            "{} of {} paths met a lamp behind specular surfaces, and what more of them would find may add {:.0} % of the value",
            result.glints,
            result.rays,
            100.0 * rare / value
        ));
    }
    objections
}

/// True if a cell's error bar can be signed as far as edges go: what few photons or few glints say against it more of them may mend.
pub(crate) fn is_clear_of_edges<const C: usize>(result: &CellResult<C>) -> bool {
    let resolved = (0..C).all(|channel| result.unresolved_share(channel) <= RESOLVED);
    resolved && result.astray.mean().unwrap_or(0.0) <= ASTRAY
}

/// True if a method cannot find some of the scene's light.
pub(crate) fn is_blind(world: &World, needs: &Needs, settings: &Settings) -> bool {
    let has_delta_lamp = world.scene.emitters.iter().any(|e| !matches!(e, Emitter::Environment { .. }));
    settings.method == Method::Path && needs.caustic && has_delta_lamp
}

/// Why no reading of this method can be certified in this scene, if so.
/// `leak` is the share of walks from the scene's portals that find another way out.
pub(crate) fn doubt(world: &World, needs: &Needs, leak: f64, settings: &Settings) -> Option<String> {
    if is_blind(world, needs, settings) {
        return Some(
            "paths from the eye cannot find a point or directional lamp by way of specular surfaces; every other method can"
                .into(),
        );
    }
    if leak > 0.0 {
        return Some(format!(
            "{:.3} % of walks from the portals leave the scene by another way, and what light comes in there few photons tell",
            100.0 * leak
        ));
    }
    if settings.estimator.area == AreaModel::Sphere {
        return Some(
            "the sphere's whole area is the paper's wording, four times the area that a flat surface has in it".into(),
        );
    }
    None
}
