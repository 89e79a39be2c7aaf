//! `photonlab plan`: what a scene needs and why, and which method reaches an error soonest.

use std::{fmt::Write as _, io::Write as _, time::Duration};

use photonlab_photometry::Response;
use photonlab_planner::{Entrant, Plan};
use photonlab_readout::{Cell, ErrorOver, Session, Target};
use photonlab_scene::Receiver;

use crate::{
    Failure, by_channels,
    command::{self, Options},
    loaded::{Loaded, optics},
    planned::{interval, race},
    system,
};

/// Pilots take no longer than this.
const PATIENCE: Duration = Duration::from_secs(3);

/// Explains a scene's needs on standard output, and a race's end if an error is wanted.
pub(crate) fn plan(arguments: &command::Plan) -> Result<(), Failure> {
    system::start_threads(None)?;
    let loaded = Loaded::new(&arguments.scene)?;
    let mut text = needs(&loaded, &arguments.scene.scene.display().to_string());
    if let Some(target) = arguments.target_error {
        loaded.needs_light(&arguments.scene.scene)?;
        let options = &Options { target_error: Some(target), ..Options::usual() };
        text += &by_channels!(loaded.needs.channels, forecasts(arguments, &loaded, options, target))?;
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

/// What is foretold of each method: for all meters that no goniometer is, or for the first camera where there is none.
fn forecasts<const C: usize>(
    arguments: &command::Plan,
    loaded: &Loaded,
    options: &Options,
    target: f64,
) -> Result<String, Failure> {
    let scene = &loaded.world.scene;
    let of = |index: usize| Cell::of_sensor(scene, index);
    let is_meter = |index: &usize| matches!(scene.sensors[*index].receiver, Receiver::Meter(_));
    let mut cells: Vec<Cell> = (0..scene.sensors.len()).filter(is_meter).flat_map(of).collect();
    cells.retain(|cell| !matches!(cell.target, Target::Leaving { .. }));
    let (mut verb, mut error_over, mut what) = ("measure", ErrorOver::Worst, "the worst interval of all meters");
    if cells.is_empty() {
        let camera = (0..scene.sensors.len()).find(|index| !is_meter(index));
        let none = || {
            Failure::usage(format!(
                "{}:1: scene: nothing that a plan is for; add a meter or a camera",
                arguments.scene.scene.display()
            ))
        };
        cells = of(camera.ok_or_else(none)?);
        (verb, error_over, what) = ("render", ErrorOver::Image, "RMS of the intervals over the image, over its mean");
    }
    let optics = optics::<C>(loaded, &arguments.scene.scene, Response::of(options.unit_system()))?;
    let session = Session {
        world: &loaded.world,
        optics: &optics,
        needs: &loaded.needs,
        settings: options.settings(scene)?,
        confidence: options.confidence,
        error_over,
    };
    let plan = race(options, &session, &cells, (target, Some(PATIENCE)))?;
    let mut text = format!(
        "\nto {} % ({what}, half their width; {} cells), on {} threads:\n",
        100.0 * target,
        cells.len(),
        system::threads()
    );
    text += &table(&plan);
    let command = format!("photonlab {verb} {} --target-error {}%", arguments.scene.scene.display(), 100.0 * target);
    let _ = writeln!(text, "\nrun: {command}{}", if verb == "render" { " -o IMAGE.exr" } else { "" });
    Ok(text)
}

/// Candidates, the soonest first, and the choice.
fn table<const C: usize>(plan: &Plan<'_, C>) -> String {
    let mut text = String::new();
    let mut order: Vec<usize> = (0..plan.entrants.len()).collect();
    let seconds = |index: usize| plan.entrants[index].forecast.map_or(f64::INFINITY, |forecast| forecast.seconds);
    order.sort_by(|&a, &b| (a != plan.chosen).cmp(&(b != plan.chosen)).then(seconds(a).total_cmp(&seconds(b))));
    for index in order {
        let Entrant { candidate, forecast } = &plan.entrants[index];
        let time = forecast.as_ref().map_or("not foretold: too little found, or out of reach".into(), interval);
        let mark = if index == plan.chosen { '*' } else { ' ' };
        let _ = writeln!(text, "{mark} {:<28} {time}", candidate.title());
    }
    let _ = write!(text, "* is chosen, by {:.1} s of pilots", plan.pilots.as_secs_f64());
    if plan.entrants.len() == 1 {
        text += ": it is all that the scene needs";
    }
    text + "; intervals at 90 %\n"
}
