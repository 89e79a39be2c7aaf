//! A scene loaded and made ready, and everything that is said of it on the way.

use photonlab_photometry::{Channels, Response, Spectrum};
use photonlab_readout::{Aids, MapFile, MapHeader, ReadError, Schedule, Session, Settings, Wanted, scene_identity};
use photonlab_sampling::{PassOptics, leak};
use photonlab_scene::{Emitter, Needs, Receiver, Scene, World, read::read_scene};

use crate::{
    Failure,
    command::{Options, SceneArguments},
};

/// A scene ready to be read.
pub(crate) struct Loaded {
    pub(crate) world: World,
    pub(crate) needs: Needs,
    pub(crate) identity: u128,
    /// Share of walks from the scene's portals that find another way out.
    pub(crate) leak: f64,
}

/// Leak above which portals are refused; below it readings are made but not certified.
const MOST_LEAK: f64 = 0.01;

impl Loaded {
    /// Reads a scene file; what it supersedes is said on standard error.
    pub(crate) fn new(arguments: &SceneArguments) -> Result<Self, Failure> {
        let scene = read_scene(&arguments.scene, &arguments.define).map_err(|e| Failure::usage(e.to_string()))?;
        for note in &scene.notes {
            say!("{}: note: {note}", arguments.scene.display());
        }
        let (needs, identity, world) = (Needs::of(&scene), scene_identity(&scene), World::new(scene));
        Ok(Self { needs, identity, leak: leak(&world), world })
    }

    /// Refuses a scene without light, and one whose portals are not the only ways in.
    pub(crate) fn needs_light(&self, file: &std::path::Path) -> Result<(), Failure> {
        if !self.world.scene.has_light() {
            return Err(Failure::usage(format!("{}:1: scene: no lamp; add an <emitter>", file.display())));
        }
        if self.leak > MOST_LEAK {
            return Err(Failure::usage(format!(
                "{}:1: scene: its portals are not the only ways in: {:.1} % of walks from them leave by another; turn them \
                 inwards, put one into every opening, a little larger than that, or take them out",
                file.display(),
                100.0 * self.leak
            )));
        }
        Ok(())
    }
}

/// Opens the map that the options name, if they name one, and refuses one that does not fit.
pub(crate) fn open_map<const C: usize>(
    options: &Options,
    loaded: &Loaded,
    settings: &mut Settings,
) -> Result<Option<MapFile<C>>, Failure> {
    let Some(path) = &options.map else {
        return Ok(None);
    };
    refuse_spectral_map(loaded)?;
    for (option, given) in [
        ("photons", options.photons.is_some()),
        ("draws", options.draws.is_some()),
        ("max-depth", options.max_depth.is_some()),
        ("max-specular", options.max_specular.is_some()),
    ] {
        if given {
            return Err(Failure::usage(format!(
                "--{option} was decided when the map was built; leave it out beside --map"
            )));
        }
    }
    let wrong = |what: String| Failure::usage(format!("{}: {what}", path.display()));
    let header = MapHeader::read(path).map_err(|e| Failure::usage(e.to_string()))?;
    if header.identity != loaded.identity {
        return Err(wrong(
            "this map is of another scene; build it again from this one with `photonlab map build`".into(),
        ));
    }
    if !header.classes.contains(settings.classes()) {
        return Err(wrong(format!(
            "this map has no direct photons, which the method {} needs; build it without --direct sampled",
            settings.method.name()
        )));
    }
    settings.limits = header.limits;
    Ok(Some(MapFile::load(path).map_err(|e| Failure::usage(e.to_string()))?))
}

/// Maps of scenes with wavelengths would have to carry these and what light counts for.
pub(crate) fn refuse_spectral_map(loaded: &Loaded) -> Result<(), Failure> {
    if loaded.needs.channels != Channels::Spectral {
        return Ok(());
    }
    Err(Failure::usage("saved maps of scenes with wavelengths are not built yet; measure or render without --map"))
}

/// What was asked for, with the passes that a saved map has; more than it has are refused.
pub(crate) fn wanted<const C: usize>(options: &Options, map: Option<&MapFile<C>>) -> Result<Wanted, Failure> {
    let wanted = options.wanted();
    let Some(map) = map else { return Ok(wanted) };
    let has = map.passes.len() as u64;
    match wanted.passes {
        Some(asked) if asked > has => {
            Err(Failure::usage(format!("--passes {asked}: the map has {has}; ask for fewer or build a larger map")))
        }
        asked => Ok(Wanted { passes: Some(asked.unwrap_or(has)), ..wanted }),
    }
}

/// The schedule of a session, with its default count named on standard error.
pub(crate) fn schedule<const C: usize>(session: &Session<'_, C>, wanted: &Wanted, cells: usize) -> Schedule {
    let schedule = Schedule::new(wanted, cells, &session.demands());
    warn_of_idle_aids(session);
    let nothing_given = wanted.photons.is_none()
        && wanted.passes.is_none()
        && wanted.samples.is_none()
        && wanted.target_error.is_none()
        && wanted.time_limit.is_none();
    if let (true, Some(passes)) = (nothing_given, schedule.ends.passes) {
        let photons: u64 = (0..passes).map(|p| schedule.photons(p)).sum();
        let samples: u64 = (0..passes).map(|p| schedule.samples(p)).sum();
        say!(
            "note: {passes} passes, {photons} photons and {samples} points per cell in all by default; ask for more with --target-error, --time-limit or counts"
        );
    }
    schedule
}

/// Says what was asked for and changes nothing.
pub(crate) fn warn_of_idle_aids<const C: usize>(session: &Session<'_, C>) {
    let Aids { cache, guide, .. } = session.settings.aids;
    if cache && !session.reads_reflected() || guide && !session.needs.indirect {
        say!("note: nothing is reflected here; --cache, --guided and --gather-rays change nothing");
    }
}

/// The lamps and coatings of a world in its channels; refuses what emits nothing.
pub(crate) fn optics<const C: usize>(
    loaded: &Loaded,
    file: &std::path::Path,
    response: Response,
) -> Result<PassOptics<C>, Failure> {
    if loaded.world.scene.emitters.iter().all(Emitter::is_black)
        && loaded.world.scene.shapes.iter().all(|shape| shape.radiance.as_ref().is_none_or(Spectrum::is_black))
    {
        return Err(Failure::usage(format!(
            "{}:1: scene: every lamp is black; give one a radiance above 0",
            file.display()
        )));
    }
    PassOptics::new(&loaded.world, response)
        .map_err(|error| Failure::usage(format!("{}:1: scene: {error}", file.display())))
}

/// Wrong counts are the user's to mend, the rest is not.
pub(crate) fn read_failure(error: ReadError) -> Failure {
    match error {
        ReadError::Plan(plan) => Failure::usage(plan.to_string()),
        other => Failure::Running(other.into()),
    }
}

/// The sensors of a scene that a verb reads: the named one, or what `choose` takes.
pub(crate) fn sensors(
    scene: &Scene,
    file: &std::path::Path,
    wanted: Option<&str>,
    kind: &str,
    is_kind: impl Fn(&Receiver) -> bool,
) -> Result<Vec<usize>, Failure> {
    let of_kind: Vec<usize> = (0..scene.sensors.len()).filter(|&i| is_kind(&scene.sensors[i].receiver)).collect();
    if of_kind.is_empty() {
        return Err(Failure::usage(format!("{}:1: scene: no {kind}; add a <sensor>", file.display())));
    }
    let Some(id) = wanted else { return Ok(of_kind) };
    match of_kind.iter().find(|&&i| scene.sensors[i].id == id) {
        Some(&index) => Ok(vec![index]),
        None => {
            let ids: Vec<_> = of_kind.iter().map(|&i| format!("`{}`", scene.sensors[i].id)).collect();
            Err(Failure::usage(format!("--sensor {id}: the scene has no such {kind}; it has {}", ids.join(", "))))
        }
    }
}

/// Runs `grey` or `rgb` by the scene's channels.
#[macro_export]
#[doc(hidden)]
macro_rules! by_channels {
    ($channels:expr, $function:ident ( $($argument:expr),* )) => {
        match $channels {
            photonlab_photometry::Channels::Grey => $function::<1>($($argument),*),
            photonlab_photometry::Channels::Rgb => $function::<3>($($argument),*),
            photonlab_photometry::Channels::Spectral => {
                $function::<{ photonlab_photometry::WAVELENGTHS }>($($argument),*)
            }
        }
    };
}

/// The number of channels, for messages.
pub(crate) fn channel_names(channels: Channels) -> Vec<String> {
    channels.names().iter().map(|name| name.to_string()).collect()
}
