//! Is a scene with portals closed but for them?
//!
//! Light that comes by other ways is counted, but so few photons are sent there that an error bar would not know of it. So
//! walks set out inwards from the portals, bounce off everything alike, black or white, and where a surface lets light
//! through go on to either side: one that leaves the scene through no portal has found another way in.

use photonlab_scene::{Bsdf, Emitter, Ray, World};

use crate::{Purpose, Stream, portal::way_out, warp};

/// Walks from each portal.
const WALKS: u64 = 8192;
/// Bounces of each.
const BOUNCES: u32 = 64;

/// The share of walks from the scene's portals that left it by another way; zero without portals. What less than one in
/// ten thousand of them finds may stay unknown.
pub fn leak(world: &World) -> f64 {
    let portals = world.scene.emitters.iter().find_map(|emitter| match emitter {
        Emitter::Environment { portals, .. } => Some(portals),
        _ => None,
    });
    let portals: Vec<u32> = portals.into_iter().flatten().flat_map(|&shape| world.primitives_of(shape)).collect();
    let leaks = |(number, &portal): (usize, &u32)| {
        let stream = |walk| Stream::new(number as u64, Purpose::Enclosure, 0, walk);
        (0..WALKS).filter(|&walk| walk_leaks(world, &portals, portal, &mut stream(walk))).count()
    };
    let found: usize = portals.iter().enumerate().map(leaks).sum();
    found as f64 / (WALKS * portals.len().max(1) as u64) as f64
}

fn walk_leaks(world: &World, portals: &[u32], start: u32, stream: &mut Stream) -> bool {
    let position = world.primitives[start as usize].surface.point_by_area(stream.next2());
    let point = world.point_on(start, position);
    let mut ray = Ray::new(position, warp::square_to_cosine_hemisphere(stream.next2(), point.normal));
    let mut from = Some(start);
    for _ in 0..BOUNCES {
        let Some(hit) = world.cast(&ray, from, f64::INFINITY) else {
            return !portals.iter().any(|&portal| way_out(world, portal, &ray).is_some());
        };
        // Through a portal is out, whatever stands beyond.
        if portals.iter().any(|&p| way_out(world, p, &ray).is_some_and(|at| (at - ray.origin).length() < hit.distance))
        {
            return false;
        }
        let bsdf = &world.shape_of(hit.point.primitive).bsdf;
        let through = bsdf.joins_its_sides() || matches!(bsdf, Bsdf::Mask { .. });
        let back = if hit.front { hit.point.normal } else { -hit.point.normal };
        let side = if through && stream.next() < 0.5 { -back } else { back };
        ray = Ray::new(hit.point.position, warp::square_to_cosine_hemisphere(stream.next2(), side));
        from = Some(hit.point.primitive);
    }
    false
}
