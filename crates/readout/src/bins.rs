//! Which cells a photon counts in.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use photonlab_scene::{Film, Hit, World};
use photonlab_trace::Counter;

use crate::{Cell, Target};

/// The cells of all receivers, ready for counting.
pub(crate) struct Bins<'w> {
    world: &'w World,
    /// For each shape, the films of the meters on it.
    on_shapes: Vec<Vec<Slots>>,
    /// Goniometers.
    far: Vec<(DMat3, Slots)>,
    /// What flux is divided by in each cell: square metres, steradians, or one.
    pub(crate) measure: Vec<f64>,
}

impl<'w> Bins<'w> {
    /// Cells that look along rays count nothing.
    pub(crate) fn new(world: &'w World, cells: &[Cell]) -> Self {
        let mut bins = Self {
            world,
            on_shapes: vec![Vec::new(); world.scene.shapes.len()],
            far: Vec::new(),
            measure: cells.iter().map(|cell| measure(world, cell)).collect(),
        };
        let mut first = 0;
        for of_sensor in cells.chunk_by(|a, b| a.sensor == b.sensor) {
            match &of_sensor[0].target {
                Target::Patch { shape, film, .. } => bins.on_shapes[*shape].push(Slots::new(*film, of_sensor, first)),
                Target::Leaving { to_world, film } => {
                    bins.far.push((to_world.transpose(), Slots::new(*film, of_sensor, first)));
                }
                Target::Pixel { .. } | Target::Along(_) | Target::Distant { .. } => {}
            }
            first += of_sensor.len();
        }
        bins
    }
}

impl Counter for Bins<'_> {
    fn at_surface(&self, hit: &Hit, found: &mut dyn FnMut(usize)) {
        let shape = self.world.primitives[hit.point.primitive as usize].shape as usize;
        if hit.front && !self.on_shapes[shape].is_empty() {
            let uv = self.world.uv(&hit.point);
            self.on_shapes[shape].iter().filter_map(|slots| slots.at(uv.x, uv.y)).for_each(found);
        }
    }

    fn to_infinity(&self, direction: DVec3, found: &mut dyn FnMut(usize)) {
        for (to_local, slots) in &self.far {
            let local = *to_local * direction;
            let turn = local.y.atan2(local.x) / TAU;
            let gamma = (-local.z).clamp(-1.0, 1.0).acos() / PI;
            if let Some(cell) = slots.at(turn - turn.floor(), gamma) {
                found(cell);
            }
        }
    }
}

/// Which cells of a sensor's film are read, and where they stand among all.
#[derive(Clone)]
struct Slots {
    film: Film,
    /// Row by row.
    of_film: Vec<Option<u32>>,
}

impl Slots {
    /// Cells of one sensor, of which the first is number `first` of all.
    fn new(film: Film, cells: &[Cell], first: usize) -> Self {
        let mut of_film = vec![None; film.width as usize * film.height as usize];
        for (number, cell) in cells.iter().enumerate() {
            let [column, row] = cell.cell.map(|at| at as usize);
            of_film[row * film.width as usize + column] = Some((first + number) as u32);
        }
        Self { film, of_film }
    }

    /// The cell at (u, v) in [0, 1].
    fn at(&self, u: f64, v: f64) -> Option<usize> {
        let along = |x: f64, count: u32| ((x * f64::from(count)) as usize).min(count as usize - 1);
        let place = along(v, self.film.height) * self.film.width as usize + along(u, self.film.width);
        self.of_film[place].map(|cell| cell as usize)
    }
}

fn measure(world: &World, cell: &Cell) -> f64 {
    match &cell.target {
        Target::Patch { flux: true, .. } => 1.0,
        Target::Patch { shape, film, flux: false } => world.cell_area(*shape, cell.cell, [film.width, film.height]),
        Target::Leaving { film, .. } => {
            let gamma = |row: u32| PI * f64::from(row) / f64::from(film.height);
            TAU / f64::from(film.width) * (gamma(cell.cell[1]).cos() - gamma(cell.cell[1] + 1).cos())
        }
        Target::Pixel { .. } | Target::Along(_) | Target::Distant { .. } => 1.0,
    }
}
