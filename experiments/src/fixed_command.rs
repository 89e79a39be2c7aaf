//! The command that gives the same bits again.

use photonlab_gather::{AreaModel, Kernel};
use photonlab_readout::{Direct, Method, Outcome, Settings, USUAL_PASSES};

use crate::{
    chosen::usual_gather_rays,
    command::{Options, SceneArguments, UnitsName},
};

/// The command with the method and all counts spelled out, so that no clock and no `auto` decides. `None` where a clock has ended a run before
/// the passes for which its radius was tuned: one of so few passes would tune for fewer.
pub(crate) fn fixed_command<const C: usize>(
    verb: &str,
    scene: &SceneArguments,
    options: &Options,
    settings: &Settings,
    outcome: &Outcome<C>,
) -> Option<String> {
    let knew_its_passes = options.passes.is_some() || options.map.is_some() || outcome.passes >= USUAL_PASSES;
    if settings.method.is_tuned() && !knew_its_passes {
        return None;
    }
    let mut words = vec!["photonlab".to_string(), verb.into(), quoted(&scene.scene.display().to_string())];
    let mut option = |name: &str, value: String| words.extend([format!("--{name}"), value]);
    option("method", settings.method.name().into());
    match settings.method {
        Method::Nearest { k: Some(k) } => option("k", k.to_string()),
        Method::Radius { radius: Some(radius) } | Method::FinalGather { radius: Some(radius) } => {
            option("radius", radius.to_string());
        }
        Method::Nearest { k: None }
        | Method::Radius { radius: None }
        | Method::FinalGather { radius: None }
        | Method::Adaptive
        | Method::Path
        | Method::Bins => {}
    }
    if settings.direct == Direct::Photons {
        option("direct", "photons".into());
    }
    match settings.estimator.kernel {
        Kernel::Disc => {}
        Kernel::Cone => option("kernel", "cone".into()),
        Kernel::Epanechnikov => option("kernel", "epanechnikov".into()),
        Kernel::Biweight => option("kernel", "biweight".into()),
        Kernel::Gaussian => option("kernel", "gaussian".into()),
    }
    if matches!(settings.method, Method::Nearest { .. } | Method::Radius { .. } | Method::Adaptive) {
        let area = match settings.estimator.area {
            AreaModel::Disc => "disc",
            AreaModel::Sphere => "sphere",
            AreaModel::Clipped => "clipped",
            AreaModel::Linear => "linear",
            AreaModel::Flattened => "flattened",
            AreaModel::Visible => "visible",
        };
        option("area", area.into());
    }
    if settings.gather_rays != usual_gather_rays(settings.aids.cache) {
        option("gather-rays", settings.gather_rays.to_string());
    }
    if options.map.is_none() && settings.draws != settings.method.usual_draws() && settings.method != Method::Path {
        option("draws", "independent".into());
    }
    match &options.map {
        Some(map) => option("map", quoted(&map.display().to_string())),
        None if settings.method != Method::Path && outcome.photons > 0 => {
            option("photons", outcome.photons.to_string())
        }
        None => {}
    }
    option("passes", outcome.passes.to_string());
    if settings.method != Method::Bins {
        option("spp", outcome.samples.to_string());
    }
    if options.map.is_none() {
        if let Some(depth) = options.max_depth {
            option("max-depth", depth.to_string());
        }
        if let Some(specular) = options.max_specular {
            option("max-specular", specular.to_string());
        }
    }
    option("seed", settings.seed.to_string());
    option("confidence", options.confidence.to_string());
    if options.units == UnitsName::Photometric {
        option("units", "photometric".into());
    }
    if let Some(sensor) = &options.sensor {
        option("sensor", quoted(sensor));
    }
    if let Some([width, height]) = options.size {
        option("size", format!("{width}x{height}"));
    }
    for (option, given) in [("--cache", settings.aids.cache), ("--guided", settings.aids.guide)] {
        if given {
            words.push(option.into());
        }
    }
    for (name, value) in &scene.define {
        words.extend(["-D".into(), quoted(&format!("{name}={value}"))]);
    }
    Some(words.join(" "))
}

/// A word as a shell takes it.
pub(crate) fn quoted(word: &str) -> String {
    let plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./=,:+".contains(c));
    if plain && !word.is_empty() { word.into() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}
