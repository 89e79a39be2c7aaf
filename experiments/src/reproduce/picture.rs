//! A scene seen from one place, read at points of the picture.

use glam::DVec3;
use photonlab_readout::{Cell, Target};
use photonlab_sampling::Stream;
use photonlab_scene::{Ray, Receiver, World};

use super::{face_edges::FaceEdges, field::stream, lab::Lab};

const CUBE: &str = include_str!("../../scenes/cube.xml");
const CORNELL_BOX: &str = include_str!("../../scenes/cornell-box.xml");
/// Points are chosen from one random ray in each of so many columns and rows.
const STRATA: usize = 256;
/// Points nearer to an edge are chosen as if they were so far away (m).
const HAIR: f64 = 1e-6;

/// Which part of a picture is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Region {
    /// All that shows no lamp.
    Whole,
    /// Of that, what is farther than this from every edge, in metres.
    FromEdges(f64),
}

impl Region {
    pub(super) fn title(&self) -> &'static str {
        match self {
            Region::Whole => "whole picture",
            Region::FromEdges(_) => "far from edges",
        }
    }
}

/// A scene and the rays of its picture.
pub(super) struct Picture {
    /// Its name in rows and ids.
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    pub(super) lab: Lab,
    edges: FaceEdges,
    /// The ray through a place of the unit square.
    ray: fn(&World, [f64; 2]) -> Ray,
}

/// A point of a picture.
pub(super) struct Spot {
    /// Reads the radiance along its ray.
    pub(super) cell: Cell,
    /// Where the ray lands, metres.
    pub(super) position: DVec3,
    /// The picture's area that it stands for, up to a factor that all have in common.
    pub(super) weight: f64,
}

impl Picture {
    /// A whole face of CUBE, seen from the lamp's place. A picture shows a face evenly there.
    pub(super) fn cube() -> anyhow::Result<Self> {
        Self::new("cube", "CUBE", Lab::new("cube.xml", CUBE, &[])?, |world, place| {
            let half = world.bounds().1.x;
            let [y, z] = place.map(|x| (2.0 * x - 1.0) * half);
            Ray::towards(DVec3::ZERO, DVec3::new(half, y, z))
        })
    }

    /// The Cornell box as its camera sees it.
    pub(super) fn cornell_box() -> anyhow::Result<Self> {
        Self::new("cornell-box", "Cornell box", Lab::new("cornell-box.xml", CORNELL_BOX, &[])?, |world, [x, y]| {
            let Receiver::Camera(camera) = &world.scene.sensors[0].receiver else {
                unreachable!("the scene's only sensor is its camera");
            };
            let [left, up] = [(1.0 - 2.0 * x) * camera.tan_half_width, (1.0 - 2.0 * y) * camera.tan_half_height];
            let along = camera.to_world.transform_vector3(DVec3::new(left, up, 1.0));
            Ray::new(camera.to_world.translation, along.normalize())
        })
    }

    fn new(id: &'static str, title: &'static str, lab: Lab, ray: fn(&World, [f64; 2]) -> Ray) -> anyhow::Result<Self> {
        Ok(Self { id, title, edges: FaceEdges::of(&lab.world), lab, ray })
    }

    /// Random points of a region. Over a whole picture they crowd towards the edges, evenly in the cube root of the distance, and weigh less
    /// there: whatever the radius, as many of them lie within it.
    pub(super) fn spots(&self, region: Region, count: usize, seed: u64) -> Vec<Spot> {
        let mut random = stream(seed, 0);
        let mut seen = self.candidates(&mut random);
        let density = |&(away, ..): &(f64, Ray, DVec3)| match region {
            Region::Whole => away.max(HAIR).powf(-2.0 / 3.0),
            Region::FromEdges(least) => f64::from(u8::from(away > least)),
        };
        if region == Region::Whole {
            seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let step = seen.iter().map(density).sum::<f64>() / count as f64;
        let (mut passed, mut next, mut spots) = (0.0, random.next() * step, Vec::new());
        for candidate in &seen {
            passed += density(candidate);
            // As often as its share has room: a weight that falls as the density grows keeps means right.
            while next < passed {
                let &(_, ray, position) = candidate;
                let cell = Cell { sensor: 0, cell: [spots.len() as u32, 0], target: Target::Along(ray) };
                spots.push(Spot { cell, position, weight: density(candidate).recip() });
                next += step;
            }
        }
        spots
    }

    /// Distance from the nearest edge, ray and landing point of one ray in each stratum that meets no lamp.
    fn candidates(&self, random: &mut Stream) -> Vec<(f64, Ray, DVec3)> {
        let world = &self.lab.world;
        let candidate = |stratum: usize| {
            let [x, y] = random.next2();
            let place = [(stratum % STRATA) as f64 + x, (stratum / STRATA) as f64 + y].map(|x| x / STRATA as f64);
            let ray = (self.ray)(world, place);
            let hit = world.cast(&ray, None, f64::INFINITY)?;
            let is_lit = hit.front && world.shape_of(hit.point.primitive).radiance.is_none();
            is_lit.then(|| (self.edges.distance(hit.point.position), ray, hit.point.position))
        };
        (0..STRATA * STRATA).filter_map(candidate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shares of a square face by area: within 1 m of the edges 1 - 0.8^2, within 1 cm 1 - 0.998^2.
    #[test]
    fn weights_make_up_for_crowding() {
        let picture = Picture::cube().unwrap();
        let spots = picture.spots(Region::Whole, 2000, 1);
        let all: f64 = spots.iter().map(|spot| spot.weight).sum();
        let within = |distance: f64| {
            let near = spots.iter().filter(|spot| picture.edges.distance(spot.position) < distance);
            near.map(|spot| spot.weight).sum::<f64>() / all
        };
        assert!((within(1.0) / 0.36 - 1.0).abs() < 0.05, "{}", within(1.0));
        assert!((within(0.01) / 0.003996 - 1.0).abs() < 0.2, "{}", within(0.01));
        let inner = picture.spots(Region::FromEdges(1.0), 300, 1);
        assert!(inner.iter().all(|spot| picture.edges.distance(spot.position) > 1.0));
        assert!((inner.len() as i64 - 300).abs() <= 1);
    }
}
