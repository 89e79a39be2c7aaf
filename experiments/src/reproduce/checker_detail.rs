//! A checker of shadow and light, read from the map and by sampling the light.

use std::{f64::consts::PI, ops::Range};

use photonlab_measure::{Axis, Expected, FigureData, Interval, Point, Replicates, Series, SeriesKind};
use photonlab_readout::{Cell, Outcome, Wanted};
use photonlab_reference::checker::{Checker, Shower};

use super::{
    context::Findings,
    cpu_clock::{CpuClock, microseconds},
    field::stream,
    lab::Lab,
    strategy::Strategy,
    table::{Table, row},
};

/// Search radius (m), and the height of the plates, out of its reach.
const RADIUS: f64 = 1.0;
const PLATES: f64 = 4.0;
/// How far the floor reaches beyond the squares that are read, in radii.
const AROUND: f64 = 1.1;
/// Cells along a radius, and fewest along a square: the readings are those of points.
const FINE: f64 = 8.0;
const FEWEST: f64 = 4.0;
/// What sampled light may be off by.
const ROUNDING: f64 = 1e-6;

/// The ways to read, of which the first two read the map.
const WAYS: [(&str, Strategy); 3] = [
    ("map, fixed radius", Strategy::RADIUS_DIRECT_VIEW),
    ("map, 50 nearest", Strategy::NEAREST_DIRECT_VIEW),
    ("light sampled", Strategy::PATH),
];

/// Squares of one size.
pub(super) struct Squares {
    /// Side in radii.
    pub(super) side: f64,
    law: f64,
    /// For each way the squared error over the mean irradiance squared, mean over the cells.
    pub(super) errors: [Replicates; 3],
    /// CPU seconds for all cells.
    pub(super) seconds: [Replicates; 3],
}

impl Squares {
    /// How many comparisons [`Squares::judge`] makes.
    pub(super) const COMPARISONS: usize = 2;

    /// Reads random cells; `photons` is how many a disc in full light holds.
    pub(super) fn read(
        side: f64,
        photons: f64,
        cells: usize,
        seeds: &Range<u64>,
        found: &mut Findings,
    ) -> anyhow::Result<Self> {
        let tiles = 2.0 * ((side + AROUND * RADIUS) / side).ceil();
        let along = (FINE * side / RADIUS).ceil().max(FEWEST);
        let (checker, width) = (Checker::new(side, tiles as u32)?, tiles * along);
        let lab = Lab::new("checker", &checker.xml(PLATES, width as usize), &[])?;
        let all = Cell::of_meters(&lab.world.scene);
        let middle = |cell: &Cell| cell.cell.map(|i| (f64::from(i) + 0.5 - 0.5 * width) * side / along);
        let inside: Vec<Cell> = all.into_iter().filter(|cell| middle(cell).iter().all(|x| x.abs() < side)).collect();
        let shower = shower(&lab, &inside[..1], photons)?;
        let mut squares = Self {
            side: side / RADIUS,
            law: checker.squared_error(RADIUS, shower),
            errors: Default::default(),
            seconds: Default::default(),
        };
        for seed in seeds.clone() {
            let mut stream = stream(seed, 0);
            let chosen: Vec<Cell> =
                (0..cells).map(|_| inside[(stream.next() * inside.len() as f64) as usize].clone()).collect();
            for (way, (name, strategy)) in WAYS.into_iter().enumerate() {
                let photons = (strategy != Strategy::PATH).then_some(shower.photons as u64);
                let wanted = Wanted { photons, passes: Some(1), samples: Some(1), ..Wanted::default() };
                let clock = CpuClock::start();
                let outcome = lab.read::<1>(&chosen, strategy.within(RADIUS).settings(seed), &wanted, 0.99)?;
                let seconds = clock.seconds();
                let truth = |cell: &Cell| {
                    let [x, y] = middle(cell);
                    checker.irradiance(x, y)
                };
                let error = squared_error(&chosen, &outcome, truth);
                squares.errors[way].push(error);
                squares.seconds[way].push(seconds);
                found.rows.push(row([
                    ("scene", "checker".into()),
                    ("side", squares.side.into()),
                    ("way", name.into()),
                    ("seed", seed.into()),
                    ("squared_error", error.into()),
                    ("cpu_seconds", microseconds(seconds).into()),
                ]));
            }
        }
        Ok(squares)
    }

    /// The fixed radius against its law, and sampled light against none.
    pub(super) fn judge(&self, table: &mut Table, precision: f64) {
        let label = |way: usize| format!("{}, squares of {} radii: squared error", WAYS[way].0, self.side);
        let law = Expected::within(self.law, 1e-4, "checker blurred by a disc, and the photons' noise");
        table.judge(label(0), law, self.errors[0].interval(table.confidence), precision);
        let exact = Expected::within(0.0, ROUNDING, "a shadow ray sees the lamp or does not");
        table.judge(label(2), exact, self.errors[2].interval(table.confidence), precision);
    }

    /// RMS error against the size of the squares.
    pub(super) fn figure(all: &[Squares], replicates: u64, table: &Table) -> FigureData {
        let root = |x: f64| x.max(0.0).sqrt();
        let rooted = |i: Interval| Interval { value: root(i.value), low: root(i.low), high: root(i.high), ..i };
        let mut series = Vec::new();
        for (way, (name, _)) in WAYS.into_iter().enumerate() {
            let points = all.iter().filter_map(|squares| {
                Some(Point::measured(squares.side, rooted(squares.errors[way].interval(table.confidence)?)))
            });
            series.push(Series { label: name.into(), kind: SeriesKind::Measured, points: points.collect() });
        }
        let law = all.iter().map(|squares| Point::new(squares.side, root(squares.law)));
        let label = "law of the fixed radius".into();
        series.push(Series { label, kind: SeriesKind::Predicted, points: law.collect() });
        FigureData {
            id: "checker".into(),
            title: "A checker of shadow and light".into(),
            caption: format!(
                "Parallel light through a checker of plates. The map's disc and the k nearest blur squares smaller than themselves away; a shadow ray \
                 does not. {replicates} seeds; {}.",
                table.intervals()
            ),
            x: Axis::log("side of a square over the search radius"),
            y: Axis::linear("RMS error over the mean irradiance"),
            series,
        }
    }
}

/// As many photons as hold the wanted number in a full disc, and the area that the lamp sends them to: with irradiance 1 its flux.
fn shower(lab: &Lab, cells: &[Cell], in_disc: f64) -> anyhow::Result<Shower> {
    let wanted = Wanted { photons: Some(1000), passes: Some(1), samples: Some(1), ..Wanted::default() };
    let outcome = lab.read::<1>(cells, Strategy::RADIUS_DIRECT_VIEW.within(RADIUS).settings(0), &wanted, 0.99)?;
    let ledger = outcome.ledger.ok_or_else(|| anyhow::anyhow!("no photon was traced"))?;
    let area = ledger.emitted[0];
    Ok(Shower { photons: (in_disc * area / (PI * RADIUS * RADIUS)).round(), area })
}

fn squared_error(cells: &[Cell], outcome: &Outcome<1>, truth: impl Fn(&Cell) -> f64) -> f64 {
    let off = cells.iter().zip(&outcome.cells).map(|(cell, read)| {
        // Relative to the mean irradiance, a half.
        2.0 * (read.value[0].mean().unwrap_or(0.0) - truth(cell))
    });
    off.map(|x| x * x).sum::<f64>() / cells.len() as f64
}
