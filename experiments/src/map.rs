//! `photonlab map`: save and describe photon maps.

use std::{fmt::Write as _, io::Write as _, path::Path};

use photonlab_photometry::{PathClass, Response};
use photonlab_readout::{Demands, Draws, MapFile, MapHeader, Schedule, Settings, Wanted, trace_pass};
use photonlab_sampling::Sought;
use photonlab_trace::Classes;

use crate::{
    Failure, by_channels,
    command::{self, DirectName, MapVerb},
    interrupt,
    loaded::{Loaded, optics, read_failure, refuse_spectral_map},
    system,
};

/// Builds or describes a map.
pub(crate) fn map(arguments: &command::Map) -> Result<(), Failure> {
    match &arguments.verb {
        MapVerb::Build(build) => {
            system::start_threads(build.options.threads)?;
            let loaded = Loaded::new(&build.scene)?;
            loaded.needs_light(&build.scene.scene)?;
            crate::image::is_writable(&build.output)?;
            by_channels!(loaded.needs.channels, save(build, &loaded))
        }
        MapVerb::Info { file } => info(file),
    }
}

fn save<const C: usize>(arguments: &command::MapBuild, loaded: &Loaded) -> Result<(), Failure> {
    let options = &arguments.options;
    for (option, given) in [
        ("k", options.k.is_some()),
        ("radius", options.radius.is_some()),
        ("kernel", options.kernel.is_some()),
        ("area", options.area.is_some()),
        ("gather-rays", options.gather_rays.is_some()),
        ("cache", options.cache),
        ("guided", options.guided),
        ("map", options.map.is_some()),
        ("size", options.size.is_some()),
        ("spp", options.spp.is_some()),
        ("sensor", options.sensor.is_some()),
        ("target-error", options.target_error.is_some()),
        ("time-limit", options.time_limit.is_some()),
    ] {
        if given {
            return Err(Failure::usage(format!(
                "--{option} is not used when a map is built; give it when the map is read"
            )));
        }
    }
    if options.draws.is_some() {
        return Err(Failure::usage(
            "the photons of a saved map are independent, so that every method can read it; leave --draws out",
        ));
    }
    refuse_spectral_map(loaded)?;
    let optics = optics::<C>(loaded, &arguments.scene.scene, Response::Radiometric)?;
    // The direct view's settings keep every class; which of them are stored is said by --direct.
    let mut reading = options.clone();
    reading.direct = None;
    let settings = Settings { draws: Draws::Independent, ..reading.settings(&loaded.world.scene)? };
    let classes = match options.direct {
        Some(DirectName::Sampled) => Classes { direct: false, ..Classes::ALL },
        Some(DirectName::Photons) | None => Classes::ALL,
    };
    let wanted = Wanted { photons: options.photons, passes: options.passes, ..Wanted::default() };
    let schedule = Schedule::new(
        &wanted,
        1,
        &Demands {
            gather_rays: 1,
            fewest_photons: optics.any().lamps.lamps.len() as u64,
            most_samples: 1,
            draws_wavelengths: false,
        },
    );
    let passes = schedule.ends.passes.unwrap_or(1);
    let light = (Sought::All, classes);
    let traced = (0..passes)
        .map(|pass| trace_pass(&loaded.world, optics.any(), &settings, light, pass as u32, schedule.photons(pass)));
    let header = MapHeader {
        channels: C as u32,
        identity: loaded.identity,
        seed: settings.seed,
        classes,
        limits: settings.limits,
    };
    let file = MapFile::<C> { header, passes: traced.collect::<Result<_, _>>().map_err(read_failure)? };
    let _guard = interrupt::writing();
    file.save(&arguments.output)?;
    Ok(())
}

fn info(path: &Path) -> Result<(), Failure> {
    let header = MapHeader::read(path).map_err(|e| Failure::usage(e.to_string()))?;
    let text = match header.channels {
        1 => describe(&MapFile::<1>::load(path)?),
        _ => describe(&MapFile::<3>::load(path)?),
    };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

fn describe<const C: usize>(file: &MapFile<C>) -> String {
    let header = &file.header;
    let mut text = format!("photon map of scene {:032x}\n", header.identity);
    let classes: Vec<_> =
        PathClass::ALL.into_iter().filter(|&class| header.classes.has(class)).map(PathClass::name).collect();
    let emitted: u64 = file.passes.iter().map(|pass| pass.emitted).sum();
    let stored: usize = file.passes.iter().map(|pass| pass.photons.len()).sum();
    let depth = header.limits.max_segments.map_or("unlimited".to_string(), |n| n.to_string());
    let _ = writeln!(text, "channels        {}", if C == 1 { "Y" } else { "R G B" });
    let _ = writeln!(text, "classes         {}", classes.join(" "));
    let _ = writeln!(text, "seed            {}", header.seed);
    let _ = writeln!(text, "longest path    {depth}");
    let _ = writeln!(text, "passes          {}", file.passes.len());
    let _ = writeln!(text, "emitted paths   {emitted}");
    let _ = writeln!(text, "stored photons  {stored}");
    let in_media: usize = file.passes.iter().map(|pass| pass.volume.photons.len()).sum();
    if in_media > 0 {
        let _ = writeln!(text, "in media        {in_media}");
    }
    let mean = |of: &dyn Fn(&photonlab_trace::Ledger<C>) -> f64| {
        file.passes.iter().map(|pass| of(&pass.ledger)).sum::<f64>() / file.passes.len().max(1) as f64
    };
    for (channel, name) in (0..C).zip(if C == 1 { &["Y"][..] } else { &["R", "G", "B"][..] }) {
        let _ = writeln!(
            text,
            "flux {name}          emitted {:.6}, absorbed {:.6}, escaped {:.6}, cut off {:.6}, roulette {:.6}",
            mean(&|ledger| ledger.emitted[channel]),
            mean(&|ledger| ledger.total().absorbed[channel]),
            mean(&|ledger| ledger.total().escaped[channel]),
            mean(&|ledger| ledger.total().cut_off[channel]),
            mean(&|ledger| ledger.total().roulette()[channel]),
        );
    }
    text
}
