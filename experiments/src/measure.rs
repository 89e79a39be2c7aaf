//! `photonlab measure`: every meter of a scene, with error bars.

use std::{io::Write, time::Instant};

use photonlab_measure::{FluxBook, FluxLedger, Measurement, Need, Place, Reading, Stopped, student_t_quantile};
use photonlab_photometry::{Colour, PathClass, Response};
use photonlab_readout::{Cell, ErrorOver, Method, Outcome, Session, Settings, Target};
use photonlab_scene::{Receiver, Scene};
use photonlab_trace::{Book, Ledger};

use crate::{
    Failure, by_channels,
    certificate::{doubt, nothing, objections},
    command::{self, MethodName, Options},
    fixed_command::fixed_command,
    goniometer::LuminaireFile,
    loaded::{Loaded, channel_names, open_map, optics, sensors},
    planned::read,
    system,
};

/// Measures and writes the result to standard output.
pub(crate) fn measure(arguments: &command::Measure) -> Result<(), Failure> {
    let start = Instant::now();
    system::start_threads(arguments.options.threads)?;
    let loaded = Loaded::new(&arguments.scene)?;
    let file = &arguments.scene.scene;
    if arguments.options.size.is_some() {
        return Err(Failure::usage("--size is for images; a meter's cells are its film's"));
    }
    loaded.needs_light(file)?;
    let is_meter = |receiver: &Receiver| matches!(receiver, Receiver::Meter(_));
    let chosen = sensors(&loaded.world.scene, file, arguments.options.sensor.as_deref(), "meter", is_meter)?;
    let cells: Vec<Cell> = chosen.iter().flat_map(|&index| Cell::of_sensor(&loaded.world.scene, index)).collect();
    let file_of = arguments.ies.as_deref().map(|path| LuminaireFile::new(path, &loaded, &chosen, &arguments.options));
    let luminaire_file = file_of.transpose()?;
    let measurement = by_channels!(loaded.needs.channels, run(arguments, &loaded, &cells, start))?;
    if let Some(file) = luminaire_file {
        file.write(&measurement)?;
    }
    let text = if arguments.json { measurement.to_json()? } else { table(&measurement, arguments.options.confidence) };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

fn run<const C: usize>(
    arguments: &command::Measure,
    loaded: &Loaded,
    cells: &[Cell],
    start: Instant,
) -> Result<Measurement, Failure> {
    let options = &Options { method: method_for(cells, arguments.options.method), ..arguments.options.clone() };
    let optics = optics::<C>(loaded, &arguments.scene.scene, Response::of(options.unit_system()))?;
    let mut settings = options.settings(&loaded.world.scene)?;
    is_readable(&loaded.world.scene, cells, &settings)?;
    let map = open_map::<C>(options, loaded, &mut settings)?;
    let (world, needs, confidence) = (&loaded.world, &loaded.needs, options.confidence);
    let session = Session { world, optics: &optics, needs, settings, confidence, error_over: ErrorOver::Worst };
    let (settings, outcome) = read(options, &session, cells, map.as_ref())?;
    warn(&outcome);
    warn_of_unsent(&outcome, options.photons);
    Ok(Measurement {
        scene: arguments.scene.scene.display().to_string(),
        method: settings.method.name().into(),
        command: fixed_command("measure --json", &arguments.scene, options, &settings, &outcome),
        seed: settings.seed,
        threads: system::threads(),
        photons: outcome.photons,
        seconds: start.elapsed().as_secs_f64(),
        peak_bytes: system::peak_bytes(),
        stopped: outcome.stopped,
        channels: channel_names(outcome.channels),
        needs: loaded.needs.list.iter().map(|n| Need { need: n.need.clone(), reason: n.reason.clone() }).collect(),
        ledger: flux_ledger(outcome.ledger.as_ref(), outcome.results),
        readings: readings(loaded, cells, &outcome, options, &settings)?,
    })
}

/// Says what the readings alone do not: light given up because nothing absorbs it, a target that cannot be reached.
pub(crate) fn warn<const C: usize>(outcome: &Outcome<C>) {
    if outcome.out_of_reach {
        say!(
            "warning: stopped after {} passes: more of them cannot reach the wanted error, because light was gathered across \
             edges, or with a radius that is too wide, or none was found; see the readings, and try --method final-gather",
            outcome.passes
        );
    }
    if let Some(ledger) = outcome.ledger.as_ref().filter(|ledger| ledger.trapped_paths > 0) {
        let share = 100.0 * ledger.total().cut_off.max() / ledger.emitted.max();
        say!(
            "warning: {} light paths did not leave lossless specular surfaces and are booked under cut_off with all others \
             that were ended early ({share:.3} % of the emitted flux)",
            ledger.trapped_paths
        );
    }
}

/// Says that another end came first, where photons were asked for.
pub(crate) fn warn_of_unsent<const C: usize>(outcome: &Outcome<C>, asked: Option<u64>) {
    if let Some(asked) = asked.filter(|&asked| outcome.photons < asked) {
        let why = match outcome.stopped {
            Stopped::Target => "the wanted error",
            Stopped::Time => "the time limit",
            Stopped::Count if outcome.photons == 0 => {
                "nothing that the method reads here rests on photons, and the end"
            }
            Stopped::Count => "another count (--spp or --passes)",
        };
        say!("note: {} of {asked} photons were sent: {why} came first", outcome.photons);
    }
}

/// `auto` counts photons where a goniometer is read, which nothing else can do.
fn method_for(cells: &[Cell], asked: MethodName) -> MethodName {
    let far = cells.iter().any(|cell| matches!(cell.target, Target::Leaving { .. }));
    if far && asked == MethodName::Auto { MethodName::Bins } else { asked }
}

/// Refuses a method that cannot read one of the meters.
pub(crate) fn is_readable(scene: &Scene, cells: &[Cell], settings: &Settings) -> Result<(), Failure> {
    let Some((cell, why)) = unreadable(cells, settings) else { return Ok(()) };
    let id = &scene.sensors[cell.sensor].id;
    let others =
        if matches!(cell.target, Target::Pixel { .. }) { "" } else { "; --sensor ID reads one sensor by itself" };
    Err(Failure::usage(format!("sensor `{id}`: {why}{others}")))
}

/// A cell that a method cannot read, and why.
pub(crate) fn unreadable<'c>(cells: &'c [Cell], settings: &Settings) -> Option<(&'c Cell, &'static str)> {
    let counts = settings.method == Method::Bins;
    cells.iter().find_map(|cell| match cell.target {
        Target::Leaving { .. } if !counts => Some((cell, "an intensitymeter is read by --method bins alone")),
        Target::Along(_) | Target::Distant { .. } | Target::Pixel { .. } if counts => {
            Some((cell, "photons cannot be counted along a ray; leave out --method bins"))
        }
        _ => None,
    })
}

fn readings<const C: usize>(
    loaded: &Loaded,
    cells: &[Cell],
    outcome: &Outcome<C>,
    options: &Options,
    settings: &Settings,
) -> Result<Vec<Reading>, Failure> {
    let degrees = outcome.cells.first().map_or(0.0, |cell| cell.value[0].degrees_of_freedom());
    let t = if degrees > 0.0 { student_t_quantile(options.confidence, degrees) } else { 0.0 };
    let scene = &loaded.world.scene;
    let doubt = doubt(&loaded.world, &loaded.needs, loaded.leak, settings);
    let emits: Vec<bool> = (0..outcome.results).map(|channel| outcome.lamp_flux[channel] > 0.0).collect();
    let mut readings = Vec::new();
    for (cell, result) in cells.iter().zip(&outcome.cells) {
        for channel in 0..outcome.results {
            let place = Place {
                sensor: scene.sensors[cell.sensor].id.clone(),
                quantity: cell.quantity().in_system(options.unit_system()),
                cell: cell.cell,
                channel: outcome.channels.names()[channel].into(),
            };
            if let Some(why) = nothing(result, channel, emits[channel]) {
                readings.push(Reading::nothing(place, why).with_support(result.photons, outcome.radius)?);
                continue;
            }
            let value = result.value[channel].mean().unwrap_or(0.0);
            let bias_bound = result.bias_bound(channel, options.confidence);
            let error = result.value[channel].std_error();
            let mut reading =
                Reading::new(place, value, error, t, Some(bias_bound))?.with_support(result.photons, outcome.radius)?;
            for objection in objections(result, channel, t).iter().chain(&doubt) {
                reading = reading.not_certified(objection);
            }
            readings.push(reading);
        }
    }
    Ok(readings)
}

fn flux_ledger<const C: usize>(ledger: Option<&Ledger<C>>, results: usize) -> FluxLedger {
    let Some(ledger) = ledger else {
        let none = vec![0.0; results];
        let total = FluxBook {
            emitted: none.clone(),
            absorbed: none.clone(),
            escaped: none.clone(),
            cut_off: none.clone(),
            roulette: none,
        };
        return FluxLedger { total, ..FluxLedger::default() };
    };
    let list = |flux: Colour<C>| flux.0[..results].to_vec();
    let book = |emitted: Colour<C>, book: &Book<C>| FluxBook {
        emitted: list(emitted),
        absorbed: list(book.absorbed),
        escaped: list(book.escaped),
        cut_off: list(book.cut_off),
        roulette: list(book.roulette()),
    };
    let class = |class: PathClass| {
        let of_class = &ledger.classes[class as usize];
        (class.name().to_string(), book(of_class.accounted(), of_class))
    };
    FluxLedger {
        total: book(ledger.emitted, &ledger.total()),
        classes: PathClass::ALL.into_iter().map(class).collect(),
    }
}

/// Readings for people: one line each, the half-width beside the value.
fn table(measurement: &Measurement, confidence: f64) -> String {
    use std::fmt::Write;
    let mut text = format!(
        "{}: {} with {} photons, {:.2} s, ended by {}; intervals at {} %\n",
        measurement.scene,
        measurement.method,
        measurement.photons,
        measurement.seconds,
        match measurement.stopped {
            Stopped::Target => "the wanted error",
            Stopped::Time => "the time limit",
            Stopped::Count => "its counts",
        },
        100.0 * confidence
    );
    for r in &measurement.readings {
        let name = format!("{} [{}, {}] {}", r.sensor, r.cell[0], r.cell[1], r.channel);
        let value = match (r.value, r.half_width()) {
            (Some(value), Some(half)) => format!("{} ± {:<12} {}", number(value), number(half).trim_start(), r.unit),
            (Some(value), None) => format!("{} ± unknown      {}", number(value), r.unit),
            (None, _) => "       nothing found".to_string(),
        };
        let why = r.why.as_ref().map_or(String::new(), |why| format!("  (not certified: {why})"));
        let _ = writeln!(text, "{name:<32} {value}{why}");
    }
    text
}

/// Six decimals where they say something, else an exponent.
fn number(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e7).contains(&value.abs()) {
        format!("{value:>14.5e}")
    } else {
        format!("{value:>14.6}")
    }
}
