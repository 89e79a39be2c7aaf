//! Whether something stands on a surface and parts its light.

use std::f64::consts::TAU;

use glam::DVec2;
use photonlab_sampling::warp::Frame;
use photonlab_scene::{Ray, World};

use crate::{Spot, record::OFF_PLANE};

/// Circles around the place, and points on each, from which it is looked for.
const CIRCLES: u32 = 4;
const POINTS: u32 = 16;
/// Surfaces one over the other that are looked through.
const LAYERS: usize = 4;
/// Least cosine between the normals of a place and of another on its surface.
const ALIKE: f64 = 0.5;

/// True if some point of a spot's own surface, no farther than a radius in metres, is hidden from it. What seems narrower from the spot than a
/// sixteenth of a circle may be missed, and hides little.
pub(crate) fn is_parted<const C: usize>(world: &World, spot: &Spot<C>, radius: f64) -> bool {
    let (position, normal) = spot.place();
    let frame = Frame::around(normal);
    let hides = |circle: u32, point: u32| {
        let distance = radius * f64::from(circle) / f64::from(CIRCLES);
        let azimuth = TAU * (f64::from(point) + 0.5 * f64::from(circle % 2)) / f64::from(POINTS);
        let above = position + distance * (frame.world(DVec2::from_angle(azimuth).extend(0.0)) + 0.5 * normal);
        let (mut ray, mut from, mut reach) = (Ray::new(above, -normal), None, distance);
        for _ in 0..LAYERS {
            let Some(hit) = world.cast(&ray, from, reach) else { break };
            let (there, facing) = (hit.point.position, hit.facing_normal());
            let (offset, mean) = (there - position, normal + facing);
            let same =
                facing.dot(normal) > ALIKE && offset.dot(mean).abs() <= OFF_PLANE * offset.length() * mean.length();
            if same {
                return !world.see_each_other((position, normal), (there, facing));
            }
            (ray, from, reach) = (Ray::new(there, -normal), Some(hit.point.primitive), reach - hit.distance);
        }
        false
    };
    (1..=CIRCLES).any(|circle| (0..POINTS).any(|point| hides(circle, point)))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use photonlab_sampling::Sight;
    use photonlab_scene::{SurfacePoint, read::read_scene_str};

    use super::*;

    /// A floor, a wall across it, and a shelf that hangs over a part.
    #[test]
    fn a_wall_on_a_floor_parts_it_and_its_own_walls_and_what_hangs_over_it_do_not() {
        let plate =
            |place: &str| format!(r#"<shape type="rectangle"><transform name="to_world">{place}</transform></shape>"#);
        let floor = plate(r#"<scale value="5"/>"#);
        let wall = plate(r#"<rotate y="1" angle="90"/><translate x="1" z="1"/>"#);
        let end = plate(r#"<scale value="5"/><rotate y="1" angle="90"/><translate x="-5"/>"#);
        let shelf = plate(r#"<scale value="0.1"/><translate x="-2" z="0.6"/>"#);
        let text = format!(r#"<scene version="3.0.0">{floor}{wall}{end}{shelf}</scene>"#);
        let world = World::new(read_scene_str(&text, "floor", &[]).expect("a scene"));
        let parted = |x: f64, y: f64, radius: f64| {
            let position = DVec3::new(x, y, 0.0);
            let at = SurfacePoint { position, normal: DVec3::Z, shading: DVec3::Z, primitive: 0 };
            is_parted(&world, &Spot::<1> { at, sight: Sight::meter(DVec3::Z, None), used: 0 }, radius)
        };
        for (x, y, radius, expected) in [
            (0.9, 0.0, 0.5, true),
            (1.1, 0.3, 0.2, true),
            (0.9, 0.0, 0.09, false),
            (0.0, 0.0, 0.9, false),
            (0.0, 3.0, 1.5, false),
            (-4.9, 0.0, 2.0, false),
            (-2.0, 0.0, 0.5, false),
        ] {
            assert_eq!(parted(x, y, radius), expected, "{x} {y} {radius}");
        }
    }
}
