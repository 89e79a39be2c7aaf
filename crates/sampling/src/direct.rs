//! Direct light at a point by sampling lamps.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Ball, Primitive, Ray, Surface, SurfacePoint, World};

use crate::{LampKind, Lamps, Optics, Sight, pattern, spherical_rectangle::SphericalRectangle, warp};

/// One point of a lamp, drawn; whether it is seen is not known yet.
#[derive(Clone, Copy, Debug)]
pub struct LightDraw<const C: usize> {
    /// Towards the lamp, unit.
    pub direction: DVec3,
    /// Distance to it in metres; infinite for parallel light.
    pub distance: f64,
    /// The primitive it lies on, if any.
    pub on: Option<u32>,
    /// Radiance over its density per solid angle, the choice of the lamp included: times the cosine, its mean is the
    /// irradiance.
    pub radiance_over_pdf: Colour<C>,
    /// Density per solid angle, the choice of the lamp included; zero for lamps without extent.
    pub pdf_solid_angle: f64,
    /// True if the draw alone is good: lamps without extent, and lamps drawn evenly over the solid angle under which they
    /// are seen. Else rays that meet the lamp by chance must share the work.
    pub alone: bool,
    /// Of a lamp at a point, its intensity towards here over its mean; zero for all others.
    pub point_emission: f64,
}

impl<const C: usize> LightDraw<C> {
    /// Draws one lamp and one point of it, from three numbers, as seen from a position.
    pub fn new(world: &World, lamps: &Lamps<C>, from: DVec3, xi: [f64; 3]) -> Option<Self> {
        if lamps.lamps.is_empty() {
            return None;
        }
        Self::of_lamp(world, lamps, lamps.choose(xi[0]), from, [xi[1], xi[2]])
    }

    /// Draws one point, from two numbers, of a lamp that was chosen with its probability.
    pub fn of_lamp(world: &World, lamps: &Lamps<C>, index: usize, from: DVec3, xi: [f64; 2]) -> Option<Self> {
        let chosen = lamps.probability[index];
        match &lamps.lamps[index].kind {
            LampKind::Point { position, intensity, pattern } => {
                let offset = *position - from;
                let distance = offset.length();
                let direction = offset / distance;
                let relative = pattern::relative(pattern, -direction);
                (relative > 0.0).then(|| Self {
                    direction,
                    distance,
                    on: None,
                    radiance_over_pdf: *intensity * (relative / (distance * distance * chosen)),
                    pdf_solid_angle: 0.0,
                    alone: true,
                    point_emission: 4.0 * PI * relative / pattern::integral(pattern),
                })
            }
            LampKind::Directional { direction, irradiance, .. } => Some(Self {
                direction: -*direction,
                distance: f64::INFINITY,
                on: None,
                radiance_over_pdf: *irradiance * (1.0 / chosen),
                pdf_solid_angle: 0.0,
                alone: true,
                point_emission: 0.0,
            }),
            LampKind::Environment { environment, .. } => {
                Self::from_infinity(world, lamps, Ray::new(from, environment.draw(xi)))
            }
            LampKind::Portal { primitive, .. } => {
                let draw = AreaDraw::new(world, *primitive, from);
                let position = draw.position(xi);
                if draw.pdf_solid_angle(position) == 0.0 {
                    return None;
                }
                Self::from_infinity(world, lamps, Ray::new(from, (position - from).normalize()))
            }
            LampKind::Area { primitive, radiance, .. } => {
                Self::on_surface(world, *primitive, *radiance, chosen, from, xi)
            }
            LampKind::Faces { shape, radiance, .. } => {
                let (primitive, rest) = world.primitive_by_area(*shape, xi[0]);
                Self::on_surface(world, primitive, *radiance, chosen, from, [rest, xi[1]])
            }
        }
    }

    /// Light of the environment, however its direction was drawn: all draws that could have found it share in its density.
    fn from_infinity(world: &World, lamps: &Lamps<C>, ray: Ray) -> Option<Self> {
        let (radiance, pdf) = lamps.from_infinity(world, &ray)?;
        (pdf > 0.0).then(|| Self {
            direction: ray.direction,
            distance: f64::INFINITY,
            on: None,
            radiance_over_pdf: radiance * (1.0 / pdf),
            pdf_solid_angle: pdf,
            alone: false,
            point_emission: 0.0,
        })
    }

    /// Draws a point of an emitting primitive whose lamp was chosen with a probability.
    fn on_surface(
        world: &World,
        primitive: u32,
        radiance: Colour<C>,
        chosen: f64,
        from: DVec3,
        xi: [f64; 2],
    ) -> Option<Self> {
        let draw = AreaDraw::new(world, primitive, from);
        let position = draw.position(xi);
        let offset = position - from;
        let distance = offset.length();
        let pdf = chosen * draw.pdf_solid_angle(position);
        (pdf > 0.0).then(|| Self {
            direction: offset / distance,
            distance,
            on: Some(primitive),
            radiance_over_pdf: radiance * (1.0 / pdf),
            pdf_solid_angle: pdf,
            alone: is_drawn_alone(world, primitive),
            point_emission: 0.0,
        })
    }

    /// The share of the light that reaches a point on a primitive or in the open, in a medium: 0 where something stands
    /// between, less than 1 behind masks and panes and in media; and the panes that it passes, a segment each.
    pub fn reaches(
        &self,
        world: &World,
        optics: &Optics<C>,
        position: DVec3,
        on: Option<u32>,
        medium: Option<u32>,
    ) -> (Colour<C>, u32) {
        optics.passes(world, &Ray::new(position, self.direction), on, medium, self.distance, self.on)
    }
}

/// One draw of direct light that was found unblocked.
#[derive(Clone, Copy, Debug)]
pub struct DirectSample<const C: usize> {
    /// Towards the lamp, unit.
    pub direction: DVec3,
    /// Panes between, each of which ends a segment.
    pub panes: u32,
    /// Irradiance on the point's side, all densities divided out: its mean is the direct irradiance.
    pub irradiance: Colour<C>,
    /// Density per solid angle of the draw, the choice of the lamp included, where rays that meet the lamp by chance must
    /// share the work with it; zero where the draw alone is good: lamps without extent, and lamps drawn evenly over the
    /// solid angle under which they are seen, whose estimate is bounded.
    pub pdf_solid_angle: f64,
    /// Cosine over squared distance for a point lamp, 1/m^2, times its intensity towards here over its mean; zero for all
    /// others.
    pub point_factor: f64,
}

/// Draws one lamp and one point of it, from three numbers, as seen from a point by `sight`.
/// `None` if what was drawn does not light that side or is hidden.
pub fn sample_direct<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    point: &SurfacePoint,
    sight: &Sight<C>,
    xi: [f64; 3],
) -> Option<DirectSample<C>> {
    let draw = LightDraw::new(world, &optics.lamps, point.position, xi)?;
    let cosine = sight.normals.cosine(draw.direction);
    if cosine <= 0.0 {
        return None;
    }
    let (reaches, panes) = draw.reaches(world, optics, point.position, Some(point.primitive), sight.medium);
    (!reaches.is_zero()).then(|| DirectSample {
        direction: draw.direction,
        panes,
        irradiance: draw.radiance_over_pdf * reaches * cosine,
        pdf_solid_angle: if draw.alone { 0.0 } else { draw.pdf_solid_angle },
        point_factor: if draw.point_emission > 0.0 {
            draw.point_emission * cosine / (draw.distance * draw.distance)
        } else {
            0.0
        },
    })
}

/// Density per solid angle with which [`LightDraw::new`] draws the point `position` of an emitting primitive, seen from
/// `from`, the choice of the lamp included; zero if it does not emit.
pub fn balance_pdf<const C: usize>(
    world: &World,
    lamps: &Lamps<C>,
    primitive: u32,
    from: DVec3,
    position: DVec3,
) -> f64 {
    lamps.of_primitive(primitive).map_or(0.0, |lamp| {
        lamps.probability[lamp as usize] * AreaDraw::new(world, primitive, from).pdf_solid_angle(position)
    })
}

/// Density per solid angle with which [`sample_direct`] draws the point `position` of an emitting primitive, seen from
/// `from`, the choice of the lamp included; `None` where [`sample_direct`] leaves nothing to rays that meet the lamp by
/// chance.
pub fn lamp_pdf_solid_angle<const C: usize>(
    world: &World,
    lamps: &Lamps<C>,
    primitive: u32,
    from: DVec3,
    position: DVec3,
) -> Option<f64> {
    lamps.of_primitive(primitive)?;
    (!is_drawn_alone(world, primitive)).then(|| balance_pdf(world, lamps, primitive, from, position))
}

/// Density per solid angle with which the point `position` of a primitive is drawn, seen from `from`.
pub(crate) fn area_pdf_solid_angle(world: &World, primitive: u32, from: DVec3, position: DVec3) -> f64 {
    AreaDraw::new(world, primitive, from).pdf_solid_angle(position)
}

/// True for emitting primitives whose direct light is drawn evenly over the solid angle under which they are seen: the
/// estimate is bounded and leaves nothing to rays that meet the lamp by chance.
pub(crate) fn is_drawn_alone(world: &World, primitive: u32) -> bool {
    match &world.primitives[primitive as usize].surface {
        Surface::Parallelogram(face) => face.is_rectangle(),
        Surface::Ball(ball) => !ball.inwards,
        Surface::Disk(_) | Surface::Tube(_) | Surface::Triangle(_) | Surface::Dish(_) => false,
    }
}

/// How a point of an emitting primitive is drawn as seen from somewhere.
struct AreaDraw<'w> {
    surface: &'w Surface,
    world: &'w World,
    primitive: u32,
    from: DVec3,
    /// Square metres over which points are drawn evenly, where they are: of all faces of a mesh.
    area: f64,
    way: Way,
}

enum Way {
    /// A sphere that shines outwards, from outside: evenly over its cone, whose 1 - cos is given.
    Cone(f64),
    /// A sphere that shines inwards: evenly by area, which from a point of the same sphere is even in irradiance.
    Inside,
    /// A rectangle: evenly over its solid angle.
    Rectangle(SphericalRectangle),
    /// Evenly by area: all other surfaces, and rectangles under next to no solid angle.
    Area,
}

impl<'w> AreaDraw<'w> {
    fn new(world: &'w World, primitive: u32, from: DVec3) -> Self {
        let Primitive { surface, shape } = &world.primitives[primitive as usize];
        let area = match surface {
            Surface::Triangle(_) => world.area_of(*shape as usize),
            surface => surface.area(),
        };
        let way = match surface {
            Surface::Ball(ball) if ball.inwards => Way::Inside,
            Surface::Ball(ball) => cone_of(ball, from).map_or(Way::Area, Way::Cone),
            Surface::Parallelogram(face) => SphericalRectangle::new(face, from).map_or(Way::Area, Way::Rectangle),
            Surface::Disk(_) | Surface::Tube(_) | Surface::Triangle(_) | Surface::Dish(_) => Way::Area,
        };
        Self { surface, world, primitive, from, area, way }
    }

    fn position(&self, xi: [f64; 2]) -> DVec3 {
        match (&self.way, self.surface) {
            (Way::Rectangle(rectangle), _) => rectangle.point(xi),
            (Way::Cone(cone), Surface::Ball(ball)) => {
                let axis = (ball.centre - self.from).normalize();
                let ray = Ray::new(self.from, warp::square_to_uniform_cone(xi, axis, *cone));
                // A draw on the very rim may miss by rounding; the rim's nearest point stands for it.
                let near = ball.intersect(&ray, 0.0, false);
                let distance = near.unwrap_or_else(|| (ball.centre - self.from).dot(ray.direction));
                ball.project(ray.at(distance))
            }
            (_, surface) => surface.point_by_area(xi),
        }
    }

    /// Zero where the lamp shows its dark side.
    fn pdf_solid_angle(&self, position: DVec3) -> f64 {
        let offset = position - self.from;
        let cosine = -offset.dot(self.world.point_on(self.primitive, position).normal);
        if cosine <= 0.0 {
            return 0.0;
        }
        match &self.way {
            Way::Cone(cone) => warp::uniform_cone_pdf_solid_angle(*cone),
            Way::Rectangle(rectangle) => 1.0 / rectangle.solid_angle,
            Way::Inside | Way::Area => offset.length_squared() * offset.length() / (cosine * self.area),
        }
    }
}

/// 1 - cos of the half-angle under which an outward-shining sphere is seen from outside.
fn cone_of(ball: &Ball, from: DVec3) -> Option<f64> {
    let offset = ball.centre - from;
    let is_outside = ball.radius * ball.radius < offset.length_squared();
    (!ball.inwards && is_outside).then(|| warp::cone_of_sphere(ball.radius, offset))
}
