//! What of a scene is read where a plan or a chart is for all of it.

use std::path::Path;

use photonlab_readout::{Cell, ErrorOver, Target};
use photonlab_scene::{Film, Receiver};

use crate::{Failure, loaded::Loaded};

/// All meters but goniometers, or the first camera where there is none.
pub(crate) struct Reads {
    pub(crate) cells: Vec<Cell>,
    pub(crate) error_over: ErrorOver,
    /// Columns and rows of the image, if it is one.
    pub(crate) film: Option<Film>,
    /// How many times as many pixels the image of the command has.
    pub(crate) smaller_by: f64,
    /// True if goniometers are left out.
    without_goniometers: bool,
}

impl Reads {
    /// An image has at most so many pixels across and down.
    pub(crate) fn of(loaded: &mut Loaded, file: &Path, most_pixels: u32) -> Result<Self, Failure> {
        let scene = &mut loaded.world.scene;
        let mut cells = Cell::of_meters(scene);
        let all = cells.len();
        cells.retain(|cell| !matches!(cell.target, Target::Leaving { .. }));
        let without_goniometers = cells.len() < all;
        if !cells.is_empty() {
            return Ok(Self { cells, error_over: ErrorOver::Worst, film: None, smaller_by: 1.0, without_goniometers });
        }
        let is_camera = |index: &usize| matches!(scene.sensors[*index].receiver, Receiver::Camera(_));
        let camera = (0..scene.sensors.len()).find(is_camera).ok_or_else(|| {
            let why = match scene.sensors.is_empty() {
                true => "no sensor; add a meter or a camera",
                false => "goniometers alone, which only --method bins reads; add a meter or a camera",
            };
            Failure::usage(format!("{}:1: scene: {why}", file.display()))
        })?;
        let asked = scene.sensors[camera].film;
        let by = (f64::from(most_pixels) / f64::from(asked.width.max(asked.height))).min(1.0);
        let smaller = |pixels: u32| ((f64::from(pixels) * by).round() as u32).max(1);
        crate::render::resize(loaded, camera, [smaller(asked.width), smaller(asked.height)]);
        let scene = &loaded.world.scene;
        let film = Some(scene.sensors[camera].film);
        let cells = Cell::of_sensor(scene, camera);
        let smaller_by = f64::from(asked.width) * f64::from(asked.height) / cells.len() as f64;
        Ok(Self { cells, error_over: ErrorOver::Image, film, smaller_by, without_goniometers })
    }

    /// The command that reads it.
    pub(crate) fn verb(&self) -> &'static str {
        if self.film.is_some() { "render" } else { "measure" }
    }

    /// The option that it cannot do without.
    pub(crate) fn output(&self) -> &'static str {
        if self.film.is_some() { " -o IMAGE.exr" } else { "" }
    }

    /// What is read.
    pub(crate) fn words(&self) -> String {
        match self.film {
            Some(Film { width, height }) if self.smaller_by > 1.0 => {
                format!("the first camera's image, read at {width} x {height} pixels")
            }
            Some(Film { width, height }) => format!("the first camera's image, {width} x {height} pixels"),
            None if self.without_goniometers => {
                format!("{} cells of all meters but goniometers (--sensor ID reads one by itself)", self.cells.len())
            }
            None => format!("{} cells of all meters", self.cells.len()),
        }
    }

    /// How one number is made of all errors, or half-widths.
    pub(crate) fn over(&self) -> &'static str {
        if self.film.is_some() { "root mean square over the image, over its mean" } else { "the worst of all readings" }
    }
}
