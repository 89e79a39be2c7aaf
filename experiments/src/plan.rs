//! `photonlab plan`: what a scene needs and why, and which method reaches an error soonest.

use std::{fmt::Write as _, io::Write as _, time::Duration};

use photonlab_photometry::Response;
use photonlab_planner::{Entrant, Plan, Standing, Why};
use photonlab_readout::Session;

use crate::{
    Failure, by_channels,
    command::{self, Options},
    fixed_command::quoted,
    loaded::{Loaded, optics},
    planned::{interval, percent, race},
    reads::Reads,
    system,
};

/// Pixels across and down of an image that a plan reads at most; times are told for all of it.
const MOST_PIXELS: u32 = 128;
/// No pilot starts later than this.
const PATIENCE: Duration = Duration::from_secs(3);

/// Explains a scene's needs on standard output, and a race's end if an error is wanted.
pub(crate) fn plan(arguments: &command::Plan) -> Result<(), Failure> {
    system::start_threads(None)?;
    let mut loaded = Loaded::new(&arguments.scene)?;
    let mut text = needs(&loaded, &arguments.scene.scene.display().to_string());
    if let Some(target) = arguments.target_error {
        loaded.needs_light(&arguments.scene.scene)?;
        let reads = Reads::of(&mut loaded, &arguments.scene.scene, MOST_PIXELS)?;
        let options = &Options { target_error: Some(target), ..Options::usual() };
        text += &by_channels!(loaded.needs.channels, forecasts(arguments, &loaded, options, (target, &reads)))?;
    }
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

fn needs(loaded: &Loaded, file: &str) -> String {
    let scene = &loaded.world.scene;
    let mut text = format!(
        "{file}: {} shapes, {} lamps, {} sensors\n\nneeded:\n",
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
    text
}

/// What is foretold of each method.
fn forecasts<const C: usize>(
    arguments: &command::Plan,
    loaded: &Loaded,
    options: &Options,
    (target, reads): (f64, &Reads),
) -> Result<String, Failure> {
    let scene = &loaded.world.scene;
    let optics = optics::<C>(loaded, &arguments.scene.scene, Response::of(options.unit_system()))?;
    let session = Session {
        world: &loaded.world,
        optics: &optics,
        needs: &loaded.needs,
        settings: options.settings(scene)?,
        confidence: options.confidence,
        error_over: reads.error_over,
    };
    let plan = race(options, &session, &reads.cells, (target, Some(PATIENCE)))?;
    let mut text = format!(
        "\n{}, to a half-width of {} ({}), on {} threads:\n",
        reads.words(),
        percent(target),
        reads.over(),
        system::threads()
    );
    text += &table(&plan, reads.smaller_by);
    let defines =
        arguments.scene.define.iter().map(|(name, value)| format!(" -D {}", quoted(&format!("{name}={value}"))));
    let scene = quoted(&arguments.scene.scene.display().to_string()) + &defines.collect::<String>();
    let _ = writeln!(
        text,
        "\nrun: photonlab {} {scene} --target-error {}{}",
        reads.verb(),
        percent(target),
        reads.output()
    );
    Ok(text)
}

/// Candidates, the soonest first, and the choice.
fn table<const C: usize>(plan: &Plan<'_, C>, smaller_by: f64) -> String {
    let mut text = String::new();
    let mut order: Vec<usize> = (0..plan.entrants.len()).collect();
    let seconds =
        |index: usize| plan.entrants[index].standing.forecast().map_or(f64::INFINITY, |forecast| forecast.seconds);
    order.sort_by(|&a, &b| (a != plan.chosen).cmp(&(b != plan.chosen)).then(seconds(a).total_cmp(&seconds(b))));
    for index in order {
        let Entrant { candidate, standing } = &plan.entrants[index];
        // The run that would go on has told more of itself than its pilots did.
        let told = plan.forecast.filter(|_| index == plan.chosen);
        let time = told.map_or_else(|| words(standing, smaller_by), |told| interval(&told.times(smaller_by)));
        let mark = if index == plan.chosen { '*' } else { ' ' };
        let _ = writeln!(text, "{mark} {:<28} {time}", candidate.title());
    }
    let _ = write!(text, "* is chosen, by {:.1} s of pilots", plan.pilots.as_secs_f64());
    if plan.entrants.len() == 1 {
        text += ": no map is needed, for rays to lamps find all light";
    }
    text + "; intervals at 90 %\n"
}

/// How a candidate stands, where the image that was read is smaller than that of the command.
fn words(standing: &Standing, smaller_by: f64) -> String {
    match standing {
        Standing::Foretold(forecast) => interval(&forecast.times(smaller_by)),
        Standing::OutOfReach => "not foretold: too little found, or out of reach".into(),
        Standing::NotRaced(Why::DoneSoon) => "not raced: its pilots would take long beside the best".into(),
        Standing::NotRaced(Why::KinIsBehind) => "not raced: progressive, its kin, is far behind".into(),
        Standing::NotRaced(Why::StartsSlowly) => {
            "not raced: to choose its places would take as long as the best".into()
        }
        Standing::NotRaced(Why::NoTimeLeft) => "not raced: the pilots' time was over".into(),
        Standing::NotRaced(Why::Failed) => "failed".into(),
    }
}
