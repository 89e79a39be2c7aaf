//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use photonlab_measure::Budget;

use crate::number;

/// Photon-map illuminance with error bars that hold.
#[derive(Parser)]
#[command(name = "photonlab", version, about, subcommand_required = true, arg_required_else_help = true)]
pub(crate) struct Photonlab {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// The main job: the paper's claims to records, figures and a report.
    Reproduce(Reproduce),
    /// Every meter of a scene, with error bars.
    Measure(Measure),
    /// An image with its error layers.
    Render(Render),
    /// What a scene needs and why; with a wanted error, which method reaches it soonest.
    Plan(Plan),
    /// Speed against accuracy of every method on a scene: two figures and their numbers.
    Chart(Chart),
    /// Save and describe photon maps.
    Map(Map),
}

/// The scene and what it defines.
#[derive(Args, Clone)]
pub(crate) struct SceneArguments {
    /// A scene file (Mitsuba 3 XML).
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    /// Sets a `<default>` of the scene.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = number::definition)]
    pub(crate) define: Vec<(String, String)>,
}

/// How light is found, shared by `measure`, `render` and `map build`.
#[derive(Args, Clone)]
pub(crate) struct Options {
    /// How light at a point is found. auto with --target-error, and neither counts nor a map, lets methods race by short passes and goes on
    /// with the soonest; else it is final-gather, or the first that uses every option given. progressive is radius without --radius: tuned, shrinking from pass to pass, and with the bias taken off
    /// that wider balls tell (a radius of your own is read plainly).
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) method: MethodName,
    /// Where direct light comes from when the map is read at the point itself [default: sampled].
    #[arg(long, value_enum)]
    pub(crate) direct: Option<DirectName>,
    /// Emitted paths in all, over lamps and passes.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number::positive_count)]
    pub(crate) photons: Option<u64>,
    /// Photons of a nearest-photon estimate [default: from scene and photons, by a look at two passes].
    #[arg(long, value_name = "K", allow_negative_numbers = true, value_parser = number::positive_count)]
    pub(crate) k: Option<u64>,
    /// Gather radius in metres [default: from scene and photons, by a look at two passes].
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number::positive)]
    pub(crate) radius: Option<f64>,
    /// Weight of a photon by its distance [default: disc].
    #[arg(long, value_enum)]
    pub(crate) kernel: Option<KernelName>,
    /// What gathered flux is divided by: the disc, the paper's sphere, the surface in the ball (clipped; linear takes a slope out too), the
    /// disc with photons near the plane alone (flattened), or the surface that the point sees (visible; slow) [default: clipped].
    #[arg(long, value_enum)]
    pub(crate) area: Option<AreaName>,
    /// Final-gather rays per point [default: 1]; with --cache, per cached place and pass [default: 64], and 1 per point
    /// that no cached place stands for, as on coats.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number::small_count)]
    pub(crate) gather_rays: Option<u32>,
    /// Final gather looks around at few places and tells of all between (irradiance cache).
    #[arg(long)]
    pub(crate) cache: bool,
    /// Photons near a point guide final gather's rays to where the light comes from: less noise where it comes through a gap.
    #[arg(long)]
    pub(crate) guided: bool,
    /// How photons leave their lamps: spread evenly over directions and places, or each by itself; [default: spread; independent for
    /// nearest and for saved maps, which know no other].
    #[arg(long, value_enum)]
    pub(crate) draws: Option<DrawsName>,
    /// Passes, each with photons and rays of its own.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number::positive_count)]
    pub(crate) passes: Option<u64>,
    /// Longest light path in segments, as Mitsuba's volpath counts them: passing through a mask is none.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number::small_count)]
    pub(crate) max_depth: Option<u32>,
    /// Longest run of lossless specular events [default: 1000].
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number::small_count)]
    pub(crate) max_specular: Option<u32>,
    /// Photons from a saved map.
    #[arg(long, value_name = "FILE")]
    pub(crate) map: Option<PathBuf>,
    /// Size of the image.
    #[arg(long, value_name = "WxH", value_parser = number::size)]
    pub(crate) size: Option<[u32; 2]>,
    /// Points per pixel or cell in all.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number::positive_count)]
    pub(crate) spp: Option<u64>,
    /// The sensor to read [default: render: the first camera; measure: every meter].
    #[arg(long, value_name = "ID")]
    pub(crate) sensor: Option<String>,
    /// Seed of all random numbers.
    #[arg(long, value_name = "S", allow_hyphen_values = true, default_value_t = 0)]
    pub(crate) seed: u64,
    /// Threads [default: all cores]. No result depends on it, but by the clock: of a race, or of --time-limit; the command that a result
    /// names gives its bits whatever the clock.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = number::threads)]
    pub(crate) threads: Option<u32>,
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceName,
    /// Stop when the interval's half-width is this share of the value (1% or 0.01).
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = number::share)]
    pub(crate) target_error: Option<f64>,
    /// Confidence of the intervals.
    #[arg(long, value_name = "P", allow_negative_numbers = true, value_parser = number::probability, default_value = "0.95")]
    pub(crate) confidence: f64,
    /// Stop after this wall time.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = number::positive)]
    pub(crate) time_limit: Option<f64>,
    /// Units of results.
    #[arg(long, value_enum, default_value = "radiometric")]
    pub(crate) units: UnitsName,
}

impl Options {
    /// What holds where nothing is given.
    pub(crate) fn usual() -> Self {
        #[derive(Parser)]
        struct Alone {
            #[command(flatten)]
            options: Options,
        }
        Alone::parse_from([""]).options
    }
}

#[derive(Args)]
pub(crate) struct Reproduce {
    /// Claims by name; none means all.
    #[arg(value_name = "CLAIM")]
    pub(crate) claims: Vec<String>,
    /// Entries of the catalogue to read, such as E1,E4 (claim catalogue alone) [default: all].
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    pub(crate) entries: Vec<String>,
    /// How long it may take: three minutes, two hours, twelve hours.
    #[arg(long, value_enum, default_value = "quick")]
    pub(crate) budget: BudgetName,
    /// Where records, figures and the report go [default: target/reproduce/BUDGET].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceName,
    /// Threads [default: all cores]. No result depends on it.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = number::threads)]
    pub(crate) threads: Option<u32>,
}

#[derive(Args)]
pub(crate) struct Measure {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Write one JSON object.
    #[arg(long, overrides_with = "json")]
    pub(crate) json: bool,
    /// Write what a goniometer reads as a luminaire file (LM-63) too; needs --units photometric.
    #[arg(long, value_name = "FILE")]
    pub(crate) ies: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) options: Options,
}

#[derive(Args)]
pub(crate) struct Render {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// The image: .exr with error layers, or .png for looking at.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Colours with a legend in the image's unit (.png).
    #[arg(long)]
    pub(crate) false_colour: bool,
    #[command(flatten)]
    pub(crate) options: Options,
}

#[derive(Args)]
pub(crate) struct Plan {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Lets methods race, for a few seconds at most, to intervals of this half-width over the value (1% or 0.01), and foretells their time.
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = number::share)]
    pub(crate) target_error: Option<f64>,
}

#[derive(Args)]
pub(crate) struct Chart {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// The folder for error.svg, certainty.svg and chart.json [default: the scene's name and -chart].
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct Map {
    #[command(subcommand)]
    pub(crate) verb: MapVerb,
}

#[derive(Subcommand)]
pub(crate) enum MapVerb {
    /// Traces a scene's photons and saves them.
    Build(Box<MapBuild>),
    /// Describes a saved map.
    Info {
        /// The map.
        file: PathBuf,
    },
}

#[derive(Args)]
pub(crate) struct MapBuild {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// The map's file.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) options: Options,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodName {
    Auto,
    Nearest,
    Radius,
    Adaptive,
    FinalGather,
    Progressive,
    Bins,
    Path,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DrawsName {
    Spread,
    Independent,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DirectName {
    Sampled,
    Photons,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum KernelName {
    Disc,
    Cone,
    Epanechnikov,
    Biweight,
    Gaussian,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum AreaName {
    Disc,
    Sphere,
    Clipped,
    Linear,
    Flattened,
    Visible,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DeviceName {
    Auto,
    Cpu,
    Gpu,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum BudgetName {
    Quick,
    Paper,
    Archive,
}

impl BudgetName {
    pub(crate) fn budget(self) -> Budget {
        match self {
            BudgetName::Quick => Budget::Quick,
            BudgetName::Paper => Budget::Paper,
            BudgetName::Archive => Budget::Archive,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnitsName {
    Radiometric,
    Photometric,
}
