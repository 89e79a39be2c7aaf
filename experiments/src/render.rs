//! `photonlab render`: an image with its error layers.

use photonlab_measure::student_t_quantile;
use photonlab_photometry::{Channels, Response, UnitSystem};
use photonlab_readout::{Cell, ErrorOver, Outcome, Session};
use photonlab_scene::{Film, Receiver};

use crate::{
    Failure, by_channels,
    certificate::doubt,
    command,
    fixed_command::fixed_command,
    image::{Image, Layers},
    loaded::{Loaded, open_map, optics, sensors},
    measure::{is_readable, warn, warn_of_unsent},
    planned::read,
    system,
};

/// Renders and writes the image.
pub(crate) fn render(arguments: &command::Render) -> Result<(), Failure> {
    system::start_threads(arguments.options.threads)?;
    let extension = arguments.output.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    if !matches!(extension.as_str(), "exr" | "png") {
        return Err(Failure::usage(format!(
            "-o {}: the image's name must end in .exr or .png",
            arguments.output.display()
        )));
    }
    if arguments.false_colour && extension != "png" {
        return Err(Failure::usage("--false-colour makes an image for looking at; give -o a name that ends in .png"));
    }
    crate::image::is_writable(&arguments.output)?;
    let mut loaded = Loaded::new(&arguments.scene)?;
    let file = &arguments.scene.scene;
    loaded.needs_light(file)?;
    let is_camera = |receiver: &Receiver| matches!(receiver, Receiver::Camera(_));
    let chosen = sensors(&loaded.world.scene, file, arguments.options.sensor.as_deref(), "camera", is_camera)?[0];
    if let Some(size) = arguments.options.size {
        resize(&mut loaded, chosen, size);
    }
    let layers = by_channels!(loaded.needs.channels, run(arguments, &loaded, chosen))?;
    let bytes = match extension.as_str() {
        "exr" => layers.to_exr()?,
        _ if arguments.false_colour => layers.to_false_colour_png()?,
        _ => layers.to_png()?,
    };
    crate::interrupt::write_whole(&arguments.output, &bytes)?;
    Ok(())
}

/// Gives a camera another film; the field of view along the width stays.
pub(crate) fn resize(loaded: &mut Loaded, sensor: usize, [width, height]: [u32; 2]) {
    let sensor = &mut loaded.world.scene.sensors[sensor];
    sensor.film = Film { width, height };
    if let Receiver::Camera(camera) = &mut sensor.receiver {
        camera.tan_half_height = camera.tan_half_width * f64::from(height) / f64::from(width);
    }
}

fn run<const C: usize>(arguments: &command::Render, loaded: &Loaded, sensor: usize) -> Result<Layers, Failure> {
    let options = &arguments.options;
    let response = match options.unit_system() {
        UnitSystem::Radiometric => Response::Radiometric,
        UnitSystem::Photometric => Response::Image,
    };
    if loaded.needs.channels == Channels::Spectral && response == Response::Radiometric {
        say!("note: radiance of all wavelengths together makes a grey image; --units photometric gives colours");
    }
    let optics = optics::<C>(loaded, &arguments.scene.scene, response)?;
    let mut settings = options.settings(&loaded.world.scene)?;
    let map = open_map::<C>(options, loaded, &mut settings)?;
    let (world, needs, confidence) = (&loaded.world, &loaded.needs, options.confidence);
    let cells = Cell::of_sensor(&world.scene, sensor);
    is_readable(&world.scene, &cells, &settings)?;
    let session = Session { world, optics: &optics, needs, settings, confidence, error_over: ErrorOver::Image };
    let (settings, outcome) = read(options, &session, &cells, map.as_ref())?;
    warn(&outcome);
    warn_of_unsent(&outcome, options.photons);
    if let Some(doubt) = doubt(&loaded.world, &loaded.needs, loaded.leak, &settings) {
        say!("warning: this image is not certified: {doubt}");
    }
    let unit = cells[0].quantity().in_system(options.unit_system()).unit();
    let film = world.scene.sensors[sensor].film;
    let command = fixed_command("render", &arguments.scene, options, &settings, &outcome);
    let mut attributes = vec![
        ("scene".to_string(), arguments.scene.scene.display().to_string()),
        ("seed".to_string(), settings.seed.to_string()),
        ("units".to_string(), unit.symbol().to_string()),
        ("confidence".to_string(), confidence.to_string()),
    ];
    attributes.extend(command.map(|command| ("command".to_string(), command)));
    Ok(layers(&outcome, film, confidence, unit.symbol(), attributes))
}

fn layers<const C: usize>(
    outcome: &Outcome<C>,
    film: Film,
    confidence: f64,
    unit: &str,
    attributes: Vec<(String, String)>,
) -> Layers {
    let degrees = outcome.cells.first().map_or(0.0, |cell| cell.value[0].degrees_of_freedom());
    let quantile = (degrees > 0.0).then(|| student_t_quantile(confidence, degrees));
    let image = |of: &dyn Fn(usize, usize) -> f64| {
        let pixel = |cell: usize| std::array::from_fn(|c| of(cell, if outcome.results == 1 { 0 } else { c }) as f32);
        Image {
            width: film.width as usize,
            height: film.height as usize,
            pixels: (0..outcome.cells.len()).map(pixel).collect(),
        }
    };
    Layers {
        value: image(&|cell, c| outcome.cells[cell].value[c].mean().unwrap_or(0.0)),
        std_error: image(&|cell, c| outcome.cells[cell].value[c].std_error().unwrap_or(f64::NAN)),
        bias_bound: image(&|cell, c| match quantile {
            // Nothing found is not dark: no bound is known there.
            Some(_) if outcome.cells[cell].found_nothing() => f64::INFINITY,
            Some(quantile) => outcome.cells[cell].bias_bound_within(c, quantile),
            None => f64::NAN,
        }),
        photons_used: outcome.cells.iter().map(|cell| cell.photons as f32).collect(),
        unit: unit.into(),
        attributes,
    }
}
