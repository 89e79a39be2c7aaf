//! Direct light at a point by sampling lamps.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Ball, Ray, Surface, SurfacePoint, World};

use crate::{LampKind, Lamps, lamp::point_on_surface, warp};

/// One draw of direct light that was found unblocked.
#[derive(Clone, Copy, Debug)]
pub struct DirectSample<const C: usize> {
    /// Towards the lamp, unit.
    pub direction: DVec3,
    /// Irradiance on the point's side, all densities divided out: its mean is the direct irradiance.
    pub irradiance: Colour<C>,
    /// Density per solid angle of the draw, the choice of the lamp included; zero for lamps without extent.
    pub pdf_solid_angle: f64,
}

/// Draws one lamp and one point of it, from three numbers, as seen from a point on the side of `normal`.
/// `None` if what was drawn does not light that side or is hidden.
pub fn sample_direct<const C: usize>(
    world: &World,
    lamps: &Lamps<C>,
    point: &SurfacePoint,
    normal: DVec3,
    xi: [f64; 3],
) -> Option<DirectSample<C>> {
    if lamps.lamps.is_empty() {
        return None;
    }
    let index = lamps.choose(xi[0]);
    let chosen = lamps.probability[index];
    let visible = |direction: DVec3, distance: f64, to: Option<u32>| {
        world.sees(&Ray::new(point.position, direction), Some(point.primitive), distance, to)
    };
    match &lamps.lamps[index].kind {
        LampKind::Point { position, intensity } => {
            let offset = *position - point.position;
            let distance = offset.length();
            let direction = offset / distance;
            let cosine = direction.dot(normal);
            let lit = cosine > 0.0 && visible(direction, distance, None);
            let irradiance = *intensity * (cosine / (distance * distance) / chosen);
            lit.then_some(DirectSample { direction, irradiance, pdf_solid_angle: 0.0 })
        }
        LampKind::Directional { direction, irradiance, .. } => {
            let cosine = -direction.dot(normal);
            let lit = cosine > 0.0 && visible(-*direction, f64::INFINITY, None);
            let irradiance = *irradiance * (cosine / chosen);
            lit.then_some(DirectSample { direction: -*direction, irradiance, pdf_solid_angle: 0.0 })
        }
        LampKind::Area { primitive, radiance, .. } => {
            let position = point_towards(world, *primitive, point.position, [xi[1], xi[2]])?;
            let offset = position - point.position;
            let distance = offset.length();
            let direction = offset / distance;
            let cosine = direction.dot(normal);
            let pdf = chosen * primitive_pdf_solid_angle(world, *primitive, point.position, position);
            let lit = cosine > 0.0 && pdf > 0.0 && visible(direction, distance, Some(*primitive));
            let irradiance = *radiance * (cosine / pdf);
            lit.then_some(DirectSample { direction, irradiance, pdf_solid_angle: pdf })
        }
    }
}

/// Density per solid angle with which [`sample_direct`] draws the point `position` of an emitting primitive, seen from
/// `from`; the choice of the lamp included.
pub fn lamp_pdf_solid_angle<const C: usize>(
    world: &World,
    lamps: &Lamps<C>,
    primitive: u32,
    from: DVec3,
    position: DVec3,
) -> f64 {
    lamps.of_primitive(primitive).map_or(0.0, |lamp| {
        lamps.probability[lamp as usize] * primitive_pdf_solid_angle(world, primitive, from, position)
    })
}

/// A point of a primitive: by solid angle on spheres seen from outside, by area elsewhere.
fn point_towards(world: &World, primitive: u32, from: DVec3, xi: [f64; 2]) -> Option<DVec3> {
    let surface = &world.primitives[primitive as usize].surface;
    if let Surface::Ball(ball) = surface
        && let Some(cone) = cone_of(ball, from)
    {
        let axis = (ball.centre - from).normalize();
        let ray = Ray::new(from, warp::square_to_uniform_cone(xi, axis, cone));
        let near = ball.intersect(&ray, 0.0, false);
        // A draw on the very rim may miss by rounding; the rim's nearest point stands for it.
        let distance = near.unwrap_or_else(|| (ball.centre - from).dot(ray.direction));
        return Some(ball.project(ray.at(distance)));
    }
    Some(point_on_surface(surface, xi))
}

fn primitive_pdf_solid_angle(world: &World, primitive: u32, from: DVec3, position: DVec3) -> f64 {
    let surface = &world.primitives[primitive as usize].surface;
    let offset = position - from;
    let normal = world.point_on(primitive, position).normal;
    let cosine = -offset.dot(normal);
    if cosine <= 0.0 {
        return 0.0;
    }
    if let Surface::Ball(ball) = surface
        && let Some(cone) = cone_of(ball, from)
    {
        return warp::uniform_cone_pdf_solid_angle(cone);
    }
    offset.length_squared() * offset.length() / (cosine * surface.area())
}

/// 1 - cos of the half-angle under which an outward-shining sphere is seen from outside.
fn cone_of(ball: &Ball, from: DVec3) -> Option<f64> {
    let distance2 = (ball.centre - from).length_squared();
    let sine2 = ball.radius * ball.radius / distance2;
    (!ball.inwards && sine2 < 1.0).then(|| sine2 / (1.0 + (1.0 - sine2).sqrt()))
}
