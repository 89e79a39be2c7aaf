//! A table from what a goniometer counts.
//!
//! A goniometer knows the flux in each of its cells; a table states intensities at angles, and is bilinear between them. The
//! two agree if the table's own flux in every cell is the counted one. So the table's angles are the cells' middles (with
//! the poles, where the outermost rows go on evenly), and its values are found by the iteration of Richardson (1972) and
//! Lucy (1974): it keeps values from falling below zero and the total flux at the counted one in every step, and tends to
//! the table under which the counts are the likeliest. That has the counted flux in every cell, unless the light ends so
//! sharply inside a cell that no table of these angles without negative values does: then a few per cent of the flux around
//! the end may lie in the wrong one of two neighbouring cells, as with any table of such angles.

use super::{Cell, IntensityTable, LuminaireError, Symmetry};

/// Steps at most; by then the mode that is slowest to come, from cell to cell up and down both ways, is there to 1e-14.
const STEPS: usize = 500;
/// Share of the total flux by which all cells together may be off before that.
const CLOSE: f64 = 1e-9;

/// What an even step in C gives the cell of a value, and each of both neighbours: a hat of two cells' width.
const OWN: f64 = 0.75;
const BESIDE: f64 = 0.125;

impl IntensityTable {
    /// From flux in lm counted in cells of equal angles, row by row: columns along C from 0 to 360, rows along gamma from 0
    /// to 180 degrees. The table has the same flux in all, and in every cell if that is possible.
    pub fn from_cells(columns: usize, rows: usize, flux: &[f64]) -> Result<Self, LuminaireError> {
        assert_eq!(columns * rows, flux.len(), "one flux for each cell");
        let hats: Vec<Hat> = (0..rows).map(|row| Hat::new(row, rows)).collect();
        let of_values = likeliest(columns, &hats, flux);
        let candela =
            |column: usize, row: usize| of_values[row * columns + column] / (hats[row].whole() / columns as f64);
        let step = 180.0 / rows as f64;
        let middles = (0..rows).map(|row| (row as f64 + 0.5) * step);
        let gamma: Vec<f64> = [0.0].into_iter().chain(middles).chain([180.0]).collect();
        let plane = |column| (0..rows + 2).map(move |i| candela(column, i.clamp(1, rows) - 1));
        let intensity: Vec<f64> = (0..columns).flat_map(plane).collect();
        if columns == 1 {
            return Self::new(Symmetry::Rotational, &[0.0], &gamma, &intensity);
        }
        let c: Vec<f64> = (0..columns).map(|column| (column as f64 + 0.5) * 360.0 / columns as f64).collect();
        Self::new(Symmetry::None, &c, &gamma, &intensity)
    }
}

/// The flux that a value of 1 cd in a row, all around, puts into its own row of cells and the ones before and after, lm.
#[derive(Clone, Copy, Debug)]
struct Hat {
    before: f64,
    own: f64,
    after: f64,
}

impl Hat {
    fn new(row: usize, rows: usize) -> Self {
        // In half cells; the value falls to zero at the neighbours' middles, and stays the same up to a pole.
        let part = |half: usize, ends: [f64; 2]| {
            let gamma = [half, half + 1].map(|i| 90.0 * i as f64 / rows as f64);
            Cell { c: [0.0, 360.0], gamma, corners: [ends; 2] }.flux()
        };
        let (first, last) = (row == 0, row + 1 == rows);
        let half = 2 * row;
        Self {
            before: if first { 0.0 } else { part(half - 1, [0.0, 0.5]) },
            own: part(half, [if first { 1.0 } else { 0.5 }, 1.0]) + part(half + 1, [1.0, if last { 1.0 } else { 0.5 }]),
            after: if last { 0.0 } else { part(half + 2, [0.5, 0.0]) },
        }
    }

    fn whole(&self) -> f64 {
        self.before + self.own + self.after
    }
}

/// The flux of each value's hat under which the flux in the cells is the likeliest.
fn likeliest(columns: usize, hats: &[Hat], flux: &[f64]) -> Vec<f64> {
    let total: f64 = flux.iter().sum();
    let sphere: f64 = hats.iter().map(Hat::whole).sum();
    let even = |hat: &Hat| total * hat.whole() / sphere / columns as f64;
    let mut found: Vec<f64> = hats.iter().flat_map(|hat| std::iter::repeat_n(even(hat), columns)).collect();
    for _ in 0..STEPS {
        let there = spread(columns, hats, &found);
        let off: f64 = there.iter().zip(flux).map(|(there, flux)| (there - flux).abs()).sum();
        if off <= CLOSE * total {
            break;
        }
        let ratios: Vec<f64> =
            there.iter().zip(flux).map(|(there, flux)| if *there > 0.0 { flux / there } else { 0.0 }).collect();
        found.iter_mut().zip(collect(columns, hats, &ratios)).for_each(|(value, ratio)| *value *= ratio);
    }
    found
}

/// The flux in each cell from the flux of the hats.
fn spread(columns: usize, hats: &[Hat], of_hats: &[f64]) -> Vec<f64> {
    let around = around(columns, of_hats);
    let share = |row: usize, part: fn(&Hat) -> f64| part(&hats[row]) / hats[row].whole();
    along(columns, hats.len(), &around, |from, to| match from.cmp(&to) {
        std::cmp::Ordering::Less => share(from, |hat| hat.after),
        std::cmp::Ordering::Equal => share(from, |hat| hat.own),
        std::cmp::Ordering::Greater => share(from, |hat| hat.before),
    })
}

/// The mean over each hat of what stands in the cells.
fn collect(columns: usize, hats: &[Hat], of_cells: &[f64]) -> Vec<f64> {
    let around = around(columns, of_cells);
    along(columns, hats.len(), &around, |from, to| {
        let hat = &hats[to];
        let part = match from.cmp(&to) {
            std::cmp::Ordering::Less => hat.before,
            std::cmp::Ordering::Equal => hat.own,
            std::cmp::Ordering::Greater => hat.after,
        };
        part / hat.whole()
    })
}

/// Sums over the row itself and its neighbours, with a weight from row to row.
fn along(columns: usize, rows: usize, values: &[f64], weight: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let mut sums = vec![0.0; values.len()];
    for to in 0..rows {
        for from in to.saturating_sub(1)..(to + 2).min(rows) {
            let weight = weight(from, to);
            for column in 0..columns {
                sums[to * columns + column] += weight * values[from * columns + column];
            }
        }
    }
    sums
}

/// The same around a row, which is a ring.
fn around(columns: usize, values: &[f64]) -> Vec<f64> {
    let mut sums = Vec::with_capacity(values.len());
    for row in values.chunks(columns) {
        let beside = |i: usize| row[(i + 1) % columns] + row[(i + columns - 1) % columns];
        sums.extend((0..columns).map(|i| OWN * row[i] + BESIDE * beside(i)));
    }
    sums
}
