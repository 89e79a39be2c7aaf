//! The plugins that are built, those that are promised, and those of Mitsuba that are not planned.

use super::error::SceneError;
use super::names::{nearest_first, quote};
use super::object::Object;

struct Plugins {
    built: &'static [&'static str],
    /// Promised by the design, not built yet.
    later: &'static [&'static str],
    /// Mitsuba's, not planned.
    foreign: &'static [&'static str],
}

const NONE: Plugins = Plugins { built: &[], later: &[], foreign: &[] };

const SHAPES: Plugins = Plugins {
    built: &["rectangle", "sphere", "cube", "disk", "cylinder", "obj", "ply", "paraboloid", "lens"],
    later: &[],
    foreign: &[
        "blender",
        "bsplinecurve",
        "ellipsoids",
        "ellipsoidsmesh",
        "instance",
        "linearcurve",
        "merge",
        "sdfgrid",
        "serialized",
        "shapegroup",
    ],
};

const BSDFS: Plugins = Plugins {
    built: &[
        "diffuse",
        "dielectric",
        "thindielectric",
        "roughdielectric",
        "conductor",
        "roughconductor",
        "plastic",
        "diffusetransmitter",
        "twosided",
        "mask",
        "null",
    ],
    later: &[],
    foreign: &[
        "blendbsdf",
        "bumpmap",
        "circular",
        "hair",
        "measured",
        "measured_polarized",
        "normalmap",
        "polarizer",
        "pplastic",
        "principled",
        "principledthin",
        "retarder",
        "roughplastic",
    ],
};

const EMITTERS: Plugins = Plugins {
    built: &["area", "point", "spot", "directional", "constant", "envmap", "sky", "ies", "portal"],
    later: &[],
    foreign: &["directionalarea", "projector", "sunsky", "timed_sunsky", "volumelight"],
};

const SENSORS: Plugins = Plugins {
    built: &["perspective", "thinlens", "radiancemeter", "distant", "irradiancemeter", "fluxmeter", "intensitymeter"],
    later: &[],
    foreign: &["batch", "orthographic"],
};

const MEDIA: Plugins = Plugins { built: &["homogeneous"], later: &[], foreign: &["heterogeneous"] };

const PHASES: Plugins =
    Plugins { built: &["isotropic", "hg"], later: &[], foreign: &["blendphase", "rayleigh", "sggx", "tabphase"] };

const FILMS: Plugins = Plugins { built: &["hdrfilm"], later: &[], foreign: &["specfilm"] };

const FILTERS: Plugins =
    Plugins { built: &["box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"], later: &[], foreign: &[] };

const SAMPLERS: Plugins = Plugins {
    built: &["independent", "stratified", "multijitter", "orthogonal", "ldsampler"],
    later: &[],
    foreign: &[],
};

const INTEGRATORS: Plugins = Plugins {
    built: &[
        "path",
        "direct",
        "volpath",
        "volpathmis",
        "ptracer",
        "photonmapper",
        "progressivephotonmapper",
        "sppm",
        "bdpt",
        "prb",
        "prb_basic",
        "prbvolpath",
    ],
    later: &[],
    foreign: &["aov", "depth", "moment", "stokes"],
};

fn of(tag: &str) -> &'static Plugins {
    match tag {
        "shape" => &SHAPES,
        "bsdf" => &BSDFS,
        "emitter" => &EMITTERS,
        "sensor" => &SENSORS,
        "medium" => &MEDIA,
        "phase" => &PHASES,
        "film" => &FILMS,
        "rfilter" => &FILTERS,
        "sampler" => &SAMPLERS,
        "integrator" => &INTEGRATORS,
        _ => &NONE,
    }
}

/// Checks that the object's plugin is built.
pub(super) fn check(object: &Object) -> Result<(), SceneError> {
    if of(object.element.tag.name).built.contains(&object.plugin) { Ok(()) } else { Err(refuse(object)) }
}

/// Why the object's plugin cannot be read: known but not built yet, not planned, or unknown.
pub(super) fn refuse(object: &Object) -> SceneError {
    let (tag, plugin) = (object.element.tag.name, object.plugin);
    let plugins = of(tag);
    let known = nearest_first(plugin, plugins.built.iter().copied());
    let what = if plugins.later.contains(&plugin) {
        format!("{tag} {} is known but not built yet", quote(plugin))
    } else if plugins.foreign.contains(&plugin) {
        format!("{tag} {} is Mitsuba's and not part of this program", quote(plugin))
    } else {
        format!("unknown {tag} {}", quote(plugin))
    };
    object.element.error(what, format!("use one of {known}"))
}
