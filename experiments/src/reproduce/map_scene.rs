//! Surfaces whose illuminance is mapped, and their true maps.

use std::cmp::Reverse;

use photonlab_readout::{Cell, Outcome, Wanted};
use photonlab_scene::Film;

use super::{cube_field::CubeField, lab::Lab, strategy::Strategy};
use crate::isolux::Grid;

const CUBE: &str = include_str!("../../scenes/maps/cube-face.xml");
const OFFICE: &str = include_str!("../../scenes/maps/office.xml");
/// Points along each side of a cell over which CUBE's truth is averaged.
const POINTS: u32 = 8;

/// A scene with a meter on one of its surfaces.
pub(super) struct MapScene {
    /// Its name in rows and files.
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    /// What a caption says of the surface.
    pub(super) surface: &'static str,
    pub(super) lab: Lab,
    /// Row by row as in a plan: x to the right and y up.
    pub(super) cells: Vec<Cell>,
    film: Film,
    /// lx.
    pub(super) truth: Grid,
}

impl MapScene {
    /// One face of CUBE in `cells` x `cells`, against the radiosity solution.
    pub(super) fn cube(cells: u32) -> anyhow::Result<Self> {
        let field = CubeField::new();
        let along = |cell: u32, point: u32| {
            2.0 * (f64::from(cell) + (f64::from(point) + 0.5) / f64::from(POINTS)) / f64::from(cells) - 1.0
        };
        let mean = |&Cell { cell: [column, row], .. }: &Cell| {
            let points = (0..POINTS * POINTS).map(|n| (along(column, n % POINTS), along(row, n / POINTS)));
            points.map(|(u, v)| field.illuminance(u, v)).sum::<f64>() / f64::from(POINTS * POINTS)
        };
        let (lab, plan, film) = metered("cube-face.xml", CUBE, Film { width: cells, height: cells })?;
        let truth = grid(film, plan.iter().map(mean).collect());
        Ok(Self {
            id: "cube",
            title: "One face of CUBE",
            surface: "10 m by 10 m, the lamp 5 m above its middle",
            lab,
            cells: plan,
            film,
            truth,
        })
    }

    /// The floor of a small office in `rows` x 3/2 `rows` cells, against path tracing of so many paths for each cell.
    pub(super) fn office(rows: u32, seed: u64, paths: u64) -> anyhow::Result<Self> {
        let (lab, cells, film) = metered("office.xml", OFFICE, Film { width: rows * 3 / 2, height: rows })?;
        let wanted = Wanted { samples: Some(paths), ..Wanted::default() };
        let control = lab.read::<1>(&cells, Strategy::PATH.settings(seed), &wanted, 0.95)?;
        let truth = grid(film, means(&control));
        Ok(Self {
            id: "office",
            title: "Floor of an office",
            surface: "6 m by 4 m in plan, two luminaires, the dark patch under a desk",
            lab,
            cells,
            film,
            truth,
        })
    }

    /// Values of its cells as a grid.
    pub(super) fn grid(&self, values: Vec<f64>) -> Grid {
        grid(self.film, values)
    }
}

/// A scene, the cells of its meter and their film.
fn metered(name: &str, xml: &str, film: Film) -> anyhow::Result<(Lab, Vec<Cell>, Film)> {
    let mut lab = Lab::new(name, xml, &[])?;
    lab.world.scene.sensors[0].film = film;
    let mut cells = Cell::of_sensor(&lab.world.scene, 0);
    // A meter's rows go up with v, a picture's go down.
    cells.sort_by_key(|cell| (Reverse(cell.cell[1]), cell.cell[0]));
    Ok((lab, cells, film))
}

fn grid(film: Film, values: Vec<f64>) -> Grid {
    Grid { width: film.width as usize, height: film.height as usize, values }
}

/// The cells' values, lx where lamps are given in cd and cd/m^2.
pub(super) fn means(outcome: &Outcome<1>) -> Vec<f64> {
    outcome.cells.iter().map(|cell| cell.value[0].mean().unwrap_or(0.0)).collect()
}
