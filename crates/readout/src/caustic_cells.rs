//! Caustic light on meters, counted in their cells.
//!
//! A density estimate blurs what it reads and darkens at edges. A cell of a meter that is no smaller than the ball would be holds
//! as many photons itself, and their flux over its area is its irradiance without either. On a meter that is hardly larger than
//! the ball there is nothing else to read.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_photometry::{Colour, PathClass, Photon};
use photonlab_scene::{Hit, Ray, World};
use photonlab_trace::Counter;
use rayon::prelude::*;

use crate::{Cell, PassPhotons, Target, bins::Bins};

/// Photons looked at by one task.
const CHUNK: usize = 4096;
/// A shape below this many discs' area is mostly edge: its cells are counted however small they are.
const DISCS: f64 = 16.0;
/// Distance from which a photon's surface is sought again, over the size of the scene: beyond the rounding of positions in single
/// precision, and below what parts two surfaces.
const ROUNDING: f64 = 1e-6;

/// What one pass's photons brought to the cells in which they are counted.
pub(crate) struct CausticCells<const C: usize> {
    /// Irradiance in W/m^2 and photons; `None` for a cell that reads the map. Empty if all do.
    counted: Vec<Option<(Colour<C>, u64)>>,
}

impl<const C: usize> CausticCells<C> {
    /// No cell is counted.
    pub(crate) fn none() -> Self {
        Self { counted: Vec::new() }
    }

    /// Counts in the cells that are no smaller than the disc of a radius, or stand on little more, photons of at most so many
    /// segments.
    pub(crate) fn count(
        world: &World,
        cells: &[Cell],
        photons: &PassPhotons<C>,
        radius: f64,
        max_segments: Option<u32>,
    ) -> Self {
        let is_counted: Vec<bool> = cells.iter().map(|cell| is_counted(world, cell, radius)).collect();
        if !is_counted.contains(&true) {
            return Self::none();
        }
        let search = Search::new(world, cells, &is_counted);
        let chunks = photons.positions.par_chunks(CHUNK).zip(photons.photons.par_chunks(CHUNK));
        let arrivals: Vec<Vec<(usize, Colour<C>)>> = chunks
            .map(|(positions, photons)| {
                let mut found = Vec::new();
                let counts = |photon: &Photon<C>| {
                    photon.class == PathClass::Caustic
                        && max_segments.is_none_or(|most| u32::from(photon.segments) <= most)
                };
                for (position, photon) in positions.iter().zip(photons).filter(|(_, photon)| counts(photon)) {
                    search.cells_at(*position, photon, |cell| found.push((cell, photon.flux())));
                }
                found
            })
            .collect();
        let mut flux = vec![(Colour::ZERO, 0); cells.len()];
        for (cell, arrived) in arrivals.into_iter().flatten() {
            flux[cell].0 += arrived;
            flux[cell].1 += 1;
        }
        let over_area =
            |(cell, (flux, photons)): (&Cell, (Colour<C>, u64))| (flux * (1.0 / area(world, cell)), photons);
        let counted = cells.iter().zip(flux).zip(is_counted).map(|(one, counted)| counted.then(|| over_area(one)));
        Self { counted: counted.collect() }
    }

    /// What was counted in a cell; `None` if it reads the map.
    pub(crate) fn of(&self, cell: usize) -> Option<(Colour<C>, u64)> {
        self.counted.get(cell).copied().flatten()
    }
}

/// Finds the cells of meters that photons are in.
struct Search<'w> {
    world: &'w World,
    bins: Bins<'w>,
    /// The boxes around shapes with counted cells.
    boxes: Vec<(DVec3, DVec3)>,
    is_counted: &'w [bool],
    /// Metres.
    rounding: f64,
}

impl<'w> Search<'w> {
    fn new(world: &'w World, cells: &[Cell], is_counted: &'w [bool]) -> Self {
        let (low, high) = world.bounds();
        let rounding = ROUNDING * (high - low).max_element();
        let mut shapes: Vec<usize> =
            cells.iter().zip(is_counted).filter(|(_, counted)| **counted).filter_map(|(cell, _)| shape(cell)).collect();
        shapes.dedup();
        let boxes = shapes.into_iter().map(|shape| {
            let (low, high) = world.bounds_of(shape);
            (low - rounding, high + rounding)
        });
        Self { world, bins: Bins::new(world, cells), boxes: boxes.collect(), is_counted, rounding }
    }

    /// Calls `found` with every counted cell that a photon is in. It was stored in single precision, so its surface is met again
    /// by a short ray from a little above.
    fn cells_at<const C: usize>(&self, position: [f32; 3], photon: &Photon<C>, mut found: impl FnMut(usize)) {
        let at = self.world.middle() + DVec3::from(position.map(f64::from));
        if !self.boxes.iter().any(|(low, high)| at.cmpge(*low).all() && at.cmple(*high).all()) {
            return;
        }
        let normal = DVec3::from(photon.normal.unpack().map(f64::from));
        let ray = Ray::new(at + self.rounding * normal, -normal);
        let hit: Option<Hit> = self.world.cast(&ray, None, 2.0 * self.rounding);
        if let Some(hit) = hit {
            self.bins.at_surface(&hit, &mut |cell| {
                if self.is_counted[cell] {
                    found(cell);
                }
            });
        }
    }
}

fn shape(cell: &Cell) -> Option<usize> {
    match cell.target {
        Target::Patch { shape, .. } => Some(shape),
        _ => None,
    }
}

fn is_counted(world: &World, cell: &Cell, radius: f64) -> bool {
    let disc = PI * radius * radius;
    shape(cell).is_some_and(|shape| area(world, cell) >= disc || world.area_of(shape) < DISCS * disc)
}

/// Square metres.
fn area(world: &World, cell: &Cell) -> f64 {
    match cell.target {
        Target::Patch { shape, film, .. } => world.cell_area(shape, cell.cell, [film.width, film.height]),
        _ => 0.0,
    }
}
