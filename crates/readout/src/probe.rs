//! Direct light of point lamps on a meter's cells, sampled from the lamps' side.
//!
//! A point of a cell drawn by area sees a near point lamp as intensity over distance squared, which has next to no bound. A
//! ray drawn from the lamp carries bounded flux, but rarely meets a small or distant cell. Each does what it does well: on a cell of
//! area A a lamp at distance d and cosine c is left to the points with weight 1 / (1 + A c / (4 pi d^2)). That is the balance
//! heuristic (Veach and Guibas 1995) of as many rays as points. The many rays that other cells of a map need do not count in it:
//! points that see a lamp far away over their cell's size hardly differ, which the heuristic does not know.

use std::f64::consts::PI;

use photonlab_photometry::Colour;
use photonlab_sampling::{Emission, LampKind, Lamps, Optics, Stream};
use photonlab_scene::{Hit, Ray, World};
use rayon::prelude::*;

use crate::{Cell, Target};

/// Rays are sent if the odds of the two ways can reach this.
const TRIFLE: f64 = 0.02;

/// Rays that one task follows.
const BLOCK: u64 = 1024;

/// What the weight of a point on each of the cells needs: A / (4 pi), zero where no rays are sent. Cells of one sensor
/// stand together and share one look at the whole film, so the work grows with the cells and not with their square.
pub(crate) fn shares<const C: usize>(world: &World, lamps: &Lamps<C>, cells: &[Cell]) -> Vec<f64> {
    let of_sensor = |cells: &[Cell]| -> Vec<f64> {
        let Some(Target::Patch { shape, film, .. }) = cells.first().map(|cell| &cell.target) else {
            return vec![0.0; cells.len()];
        };
        let size = [film.width, film.height];
        let is_near = is_near_a_lamp(world, lamps, *shape, size);
        cells.iter().map(|cell| if is_near { share_of(world, *shape, cell.cell, size) } else { 0.0 }).collect()
    };
    cells.chunk_by(|a, b| a.sensor == b.sensor).flat_map(of_sensor).collect()
}

fn share_of(world: &World, shape: usize, cell: [u32; 2], size: [u32; 2]) -> f64 {
    world.cell_area(shape, cell, size) / (4.0 * PI)
}

/// True if a point lamp is so near that rays from it could carry more than a trifle of what a cell of the shape gets by its
/// own points. Farther away the points alone are good, and the rare rays that met a cell would only add rare jumps.
fn is_near_a_lamp<const C: usize>(world: &World, lamps: &Lamps<C>, shape: usize, size: [u32; 2]) -> bool {
    let has_points = lamps.lamps.iter().any(|lamp| matches!(lamp.kind, LampKind::Point { .. }));
    // Such rays know nothing of media; and without a point lamp the cells need not be looked at.
    if !world.scene.media.is_empty() || !has_points {
        return false;
    }
    let cells = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| [column, row]));
    let share = cells.map(|cell| share_of(world, shape, cell, size)).fold(0.0, f64::max);
    lamps.lamps.iter().any(|lamp| match &lamp.kind {
        LampKind::Point { position, .. } => {
            let near = world.distance_to_shape(shape, *position);
            share * lamp.brightest_point_emission() >= TRIFLE * near * near
        }
        _ => false,
    })
}

/// What rays from point lamps bring each cell of one sensor: irradiance, weighted against the cells' own points.
/// `points` is the number of points per cell.
pub(crate) fn probe<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    cells: &[Cell],
    points: u64,
    max_segments: Option<u32>,
    stream: impl Fn(u64) -> Stream + Sync,
) -> Vec<Colour<C>> {
    let mut found = vec![Colour::ZERO; cells.len()];
    let Some(Target::Patch { shape, film, .. }) = cells.first().map(|cell| &cell.target) else { return found };
    let size = [film.width, film.height];
    if !is_near_a_lamp(world, &optics.lamps, *shape, size) {
        return found;
    }
    // As many rays are sent for each cell of a sensor as it has points, and any cell may catch them.
    let rays = points * cells.len() as u64;
    let arrivals: Vec<Vec<(usize, Colour<C>)>> = (0..rays.div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            let each = block * BLOCK..((block + 1) * BLOCK).min(rays);
            each.filter_map(|ray| arrival(world, optics, (*shape, size), max_segments, &mut stream(ray))).collect()
        })
        .collect();
    for (cell, irradiance) in arrivals.into_iter().flatten() {
        found[cell] += irradiance * (1.0 / rays as f64);
    }
    found
}

/// Where one ray from a lamp lands on the shape: the cell and its weighted contribution.
fn arrival<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    (shape, size): (usize, [u32; 2]),
    limits: Option<u32>,
    stream: &mut Stream,
) -> Option<(usize, Colour<C>)> {
    let lamps = &optics.lamps;
    let chosen = lamps.choose(stream.next());
    let lamp = &lamps.lamps[chosen];
    if !matches!(lamp.kind, LampKind::Point { .. }) {
        return None;
    }
    let emission = lamp.emit(world, stream);
    let (hit, arrives, distance) = straight_to(world, optics, shape, &emission, limits)?;
    let uv = world.uv(&hit.point);
    let place = |x: f64, count: u32| ((x * f64::from(count)) as u32).min(count - 1);
    let [column, row] = [place(uv.x, size[0]), place(uv.y, size[1])];
    let area = world.cell_area(shape, [column, row], size);
    let cosine = -emission.ray.direction.dot(hit.point.normal);
    let towards = lamp.point_emission(emission.ray.direction);
    let odds = area * cosine * towards / (4.0 * PI * distance * distance);
    let weight = odds / (1.0 + odds);
    let irradiance = lamp.flux * arrives * (weight / (lamps.probability[chosen] * area));
    Some(((row * size[0] + column) as usize, irradiance))
}

/// Where a lamp's ray meets the front of a shape, through what masks and panes leave of it, if nothing else is between; and how far
/// it flew.
fn straight_to<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    shape: usize,
    emission: &Emission<C>,
    max_segments: Option<u32>,
) -> Option<(Hit, Colour<C>, f64)> {
    let (mut ray, mut from, mut share, mut flown) = (emission.ray, emission.from, Colour::ONE, 0.0);
    let mut segments = 1;
    while !share.is_zero() && max_segments.is_none_or(|most| segments <= most) {
        let hit = world.cast(&ray, from, f64::INFINITY)?;
        flown += hit.distance;
        if hit.front && world.primitives[hit.point.primitive as usize].shape as usize == shape {
            return Some((hit, share, flown));
        }
        let (straight, ended) = optics.straight(world, &ray, &hit);
        share = share * straight;
        segments += ended;
        (ray, from) = (Ray::new(hit.point.position, ray.direction), Some(hit.point.primitive));
    }
    None
}
