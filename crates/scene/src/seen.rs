//! How much surface in a ball its centre sees, by rays: for meshes, and where walls part what the ball holds.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use crate::{Inside, Neighbourhood, RadialWeight, Ray, World};

/// Points that are tried.
const POINTS: u32 = 256;
/// The golden angle, 2 pi times the square of the golden ratio's inverse: points turned by it cover a disc evenly (Vogel 1979).
const GOLDEN: f64 = TAU * 0.381_966_011_250_105_1;
/// Two points see each other if what is over either by this share of their distance does: between points of a sphere its own
/// surface rises by an eighth at most.
const OVER: f64 = 0.2;
/// Surfaces one over the other that are looked through.
const LAYERS: usize = 8;

impl World {
    /// True if nothing stands between two points of surfaces, each seen from its side's unit normal: between what is over them.
    pub fn see_each_other(&self, from: (DVec3, DVec3), to: (DVec3, DVec3)) -> bool {
        let over = OVER * (to.0 - from.0).length();
        let (start, end) = (from.0 + over * from.1, to.0 + over * to.1);
        let way = end - start;
        let distance = way.length();
        distance == 0.0 || self.unblocked(&Ray::new(start, way / distance), None, distance, None) > 0.5
    }

    /// Integrals of a weight over the surface inside a ball that its centre sees, of which a side passes the test of normals and
    /// `counts`, as it does for a primitive's number and whether its front side is meant. Every kind of surface counts; points are tried on
    /// rays across the centre's tangent plane, so that the area is known to some 2 %.
    pub fn surface_seen(
        &self,
        around: &Neighbourhood,
        weight: &impl RadialWeight,
        counts: impl Fn(u32, bool) -> bool,
    ) -> Inside {
        let Neighbourhood { position, normal, radius, least_cosine, .. } = *around;
        let (a, b) = normal.any_orthonormal_pair();
        let mut sum = Inside { area: 0.0, first: DVec3::ZERO, second: DMat3::ZERO, open: true };
        let turn = turn_of(position);
        for i in 0..POINTS {
            let share = (f64::from(i) + 0.5) / f64::from(POINTS);
            let (sin, cos) = (turn + GOLDEN * f64::from(i)).sin_cos();
            let across = radius * share.sqrt() * (cos * a + sin * b);
            let mut ray = Ray::new(position + across + radius * normal, -normal);
            let (mut from, mut reach) = (None, 2.0 * radius);
            for _ in 0..LAYERS {
                let Some(hit) = self.cast(&ray, from, reach) else { break };
                let (at, facing) = (hit.point.position, hit.facing_normal());
                let x = (at - position) / radius;
                let cosine = facing.dot(normal);
                let here = x.length_squared() <= 1.0
                    && cosine >= least_cosine
                    && counts(hit.point.primitive, hit.front)
                    && self.see_each_other((position, normal), (at, facing));
                if here {
                    let one = weight.weight(x.length_squared()) / (f64::from(POINTS) * cosine);
                    sum.area += one;
                    sum.first += one * x;
                    sum.second += DMat3::from_cols(x * x.x, x * x.y, x * x.z) * one;
                }
                ray = Ray::new(at, ray.direction);
                (from, reach) = (Some(hit.point.primitive), reach - hit.distance);
            }
        }
        sum
    }
}

/// An angle that goes with a place as if drawn, so that places differ in what of their discs is tried.
fn turn_of(position: DVec3) -> f64 {
    // FNV-1a.
    let words = position.to_array().map(f64::to_bits);
    let hash = words.iter().fold(0xcbf2_9ce4_8422_2325u64, |hash, word| {
        let mixed = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        mixed ^ mixed >> 29
    });
    TAU * (hash >> 11) as f64 / (1u64 << 53) as f64
}
