//! Lamps: their flux, and rays drawn from them in proportion to it.

use std::{f64::consts::PI, sync::Arc};

use glam::{DVec2, DVec3};
use photonlab_photometry::Colour;
use photonlab_scene::{Pattern, Ray, Surface, World};

use crate::{Environment, Stream, pattern, warp};

/// A source of light with its total flux.
#[derive(Clone, Debug)]
pub struct Lamp<const C: usize> {
    /// Name in messages.
    pub id: String,
    /// Geometry and emission.
    pub kind: LampKind<C>,
    /// Total flux in W or lm; of a directional lamp, the flux through its window.
    pub flux: Colour<C>,
}

/// The kinds of lamp.
#[derive(Clone, Debug)]
pub enum LampKind<const C: usize> {
    /// Point.
    Point {
        /// Metres.
        position: DVec3,
        /// W/sr or cd where the pattern is 1.
        intensity: Colour<C>,
        /// How it depends on direction.
        pattern: Pattern,
    },
    /// Parallel light through a window that covers the whole scene.
    Directional {
        /// Unit vector along which the light travels.
        direction: DVec3,
        /// W/m^2 or lx across the direction.
        irradiance: Colour<C>,
        /// Corner of the window, before the scene.
        corner: DVec3,
        /// The window's two sides, metres, across the direction.
        sides: [DVec3; 2],
    },
    /// Light from all directions through a disc that covers the scene's bounding sphere.
    Environment {
        /// Its radiance.
        environment: Arc<Environment<C>>,
        /// Middle of the sphere, metres.
        centre: DVec3,
        /// Its radius, metres.
        radius: f64,
    },
    /// Lambertian front side of one primitive.
    Area {
        /// Index into [`World::primitives`].
        primitive: u32,
        /// W/(m^2 sr) or cd/m^2.
        radiance: Colour<C>,
        /// Square metres.
        area: f64,
    },
}

/// A photon's start.
#[derive(Clone, Copy, Debug)]
pub struct Emission<const C: usize> {
    /// Where it starts and goes.
    pub ray: Ray,
    /// The primitive it starts on, if any.
    pub from: Option<u32>,
    /// Flux over the lamp's mean per ray: one for most lamps, one on average for all.
    pub weight: Colour<C>,
}

impl<const C: usize> Lamp<C> {
    /// A ray drawn in proportion to the emitted flux: of environments in proportion up to [`Emission::weight`], of all
    /// others every ray carries the same share of [`Lamp::flux`].
    pub fn emit(&self, world: &World, stream: &mut Stream) -> Emission<C> {
        let even = |ray, from| Emission { ray, from, weight: Colour::ONE };
        match &self.kind {
            LampKind::Point { position, pattern, .. } => {
                even(Ray::new(*position, pattern::draw(pattern, stream)), None)
            }
            LampKind::Directional { direction, corner, sides, .. } => {
                let [s, t] = stream.next2();
                even(Ray::new(*corner + s * sides[0] + t * sides[1], *direction), None)
            }
            LampKind::Environment { environment, centre, radius } => {
                let (towards, weight) = environment.emit(stream);
                let [s, t] = stream.next2();
                let (sin, cos) = (2.0 * PI * t).sin_cos();
                let (tangent, bitangent) = towards.any_orthonormal_pair();
                let on_disc = s.sqrt() * (cos * tangent + sin * bitangent);
                let origin = *centre + *radius * (on_disc + 1.01 * towards);
                Emission { ray: Ray::new(origin, -towards), from: None, weight }
            }
            LampKind::Area { primitive, .. } => {
                let position = point_on_surface(&world.primitives[*primitive as usize].surface, stream.next2());
                let point = world.point_on(*primitive, position);
                let direction = warp::square_to_cosine_hemisphere(stream.next2(), point.normal);
                even(Ray::new(position, direction), Some(*primitive))
            }
        }
    }

    /// Of a lamp at a point, its intensity in a direction over its mean over all directions; zero for all others.
    pub fn point_emission(&self, direction: DVec3) -> f64 {
        match &self.kind {
            LampKind::Point { pattern, .. } => {
                4.0 * PI * pattern::relative(pattern, direction) / pattern::integral(pattern)
            }
            _ => 0.0,
        }
    }

    /// The largest value of [`Lamp::point_emission`].
    pub fn brightest_point_emission(&self) -> f64 {
        match &self.kind {
            LampKind::Point { pattern, .. } => 4.0 * PI / pattern::integral(pattern),
            _ => 0.0,
        }
    }

    /// True for lamps that no ray from a surface can meet by chance.
    pub fn is_delta(&self) -> bool {
        matches!(self.kind, LampKind::Point { .. } | LampKind::Directional { .. })
    }
}

/// A point uniform by area.
pub(crate) fn point_on_surface(surface: &Surface, xi: [f64; 2]) -> DVec3 {
    match surface {
        Surface::Parallelogram(face) => face.point(DVec2::from(xi)),
        Surface::Ball(ball) => ball.point(xi[0], 1.0 - 2.0 * xi[1]),
    }
}

/// All lamps of a scene, one per emitting primitive, with the probability of choosing each for direct light.
#[derive(Clone, Debug)]
pub struct Lamps<const C: usize> {
    /// The lamps that emit anything, in the order of the file; lamps without a surface first.
    pub lamps: Vec<Lamp<C>>,
    /// Probability of each when one is chosen.
    pub probability: Vec<f64>,
    /// The lamp of each primitive, if it emits.
    of_primitive: Vec<Option<u32>>,
    /// The lamp that is the environment, if there is one.
    environment: Option<usize>,
}

impl<const C: usize> Lamps<C> {
    /// Collects the lamps of a scene.
    pub fn new(world: &World) -> Self {
        let mut lamps: Vec<Lamp<C>> = world.scene.emitters.iter().map(|e| surfaceless(world, e)).collect();
        for (index, shape) in world.scene.shapes.iter().enumerate() {
            let Some(radiance) = shape.radiance.map(Colour::<C>::from_rgb) else {
                continue;
            };
            for primitive in world.primitives_of(index) {
                let area = world.primitives[primitive as usize].surface.area();
                let kind = LampKind::Area { primitive, radiance, area };
                lamps.push(Lamp { id: shape.id.clone(), kind, flux: radiance * (PI * area) });
            }
        }
        lamps.retain(|lamp| !lamp.flux.is_zero());
        let mut of_primitive = vec![None; world.primitives.len()];
        for (index, lamp) in lamps.iter().enumerate() {
            if let LampKind::Area { primitive, .. } = lamp.kind {
                of_primitive[primitive as usize] = Some(index as u32);
            }
        }
        let environment = lamps.iter().position(|lamp| matches!(lamp.kind, LampKind::Environment { .. }));
        let total: f64 = lamps.iter().map(|lamp| lamp.flux.max()).sum();
        // Half by flux and half evenly: a weak lamp close to a receiver is not starved.
        let even = 1.0 / lamps.len() as f64;
        let probability = lamps.iter().map(|lamp| 0.5 * lamp.flux.max() / total + 0.5 * even).collect();
        Self { lamps, probability, of_primitive, environment }
    }

    /// The lamp of a primitive, if that emits.
    pub fn of_primitive(&self, primitive: u32) -> Option<u32> {
        self.of_primitive[primitive as usize]
    }

    /// Radiance that a primitive emits towards a ray that comes from its given side.
    pub fn emitted(&self, primitive: u32, front: bool) -> Colour<C> {
        match self.of_primitive(primitive) {
            Some(lamp) if front => match self.lamps[lamp as usize].kind {
                LampKind::Area { radiance, .. } => radiance,
                _ => Colour::ZERO,
            },
            _ => Colour::ZERO,
        }
    }

    /// Radiance that comes from infinity along a direction, outwards, and the density per solid angle with which
    /// [`crate::LightDraw`] draws it, the choice of the lamp included; `None` without an environment.
    pub fn from_infinity(&self, direction: DVec3) -> Option<(Colour<C>, f64)> {
        let index = self.environment?;
        match &self.lamps[index].kind {
            LampKind::Environment { environment, .. } => {
                let pdf = self.probability[index] * environment.pdf_solid_angle(direction);
                Some((environment.radiance(direction), pdf))
            }
            _ => None,
        }
    }

    /// Chooses a lamp; its probability is in [`Lamps::probability`].
    pub fn choose(&self, xi: f64) -> usize {
        let mut rest = xi;
        for (index, p) in self.probability.iter().enumerate() {
            rest -= p;
            if rest < 0.0 {
                return index;
            }
        }
        self.lamps.len() - 1
    }

    /// True if direct light is found by drawing lamps alone, with no help from rays that meet one by chance: lamps without
    /// extent, rectangles, and spheres that shine outwards.
    pub fn are_sampled_alone(&self, world: &World) -> bool {
        self.lamps.iter().all(|lamp| match lamp.kind {
            LampKind::Point { .. } | LampKind::Directional { .. } => true,
            LampKind::Environment { .. } => false,
            LampKind::Area { primitive, .. } => crate::direct::is_drawn_alone(world, primitive),
        })
    }

    /// Sum of all lamps' flux.
    pub fn total_flux(&self) -> Colour<C> {
        self.lamps.iter().fold(Colour::ZERO, |sum, lamp| sum + lamp.flux)
    }
}

fn surfaceless<const C: usize>(world: &World, emitter: &photonlab_scene::Emitter) -> Lamp<C> {
    match emitter {
        photonlab_scene::Emitter::Point { id, position, intensity, pattern } => {
            let intensity = Colour::from_rgb(*intensity);
            let kind = LampKind::Point { position: *position, intensity, pattern: pattern.clone() };
            Lamp { id: id.clone(), kind, flux: intensity * pattern::integral(pattern) }
        }
        photonlab_scene::Emitter::Environment { id, light } => {
            let environment = Arc::new(Environment::new(light));
            let (low, high) = world.bounds();
            let radius = 0.5 * (high - low).length() * (1.0 + 1e-9);
            let flux = environment.total * (PI * radius * radius);
            Lamp {
                id: id.clone(),
                kind: LampKind::Environment { environment, centre: 0.5 * (low + high), radius },
                flux,
            }
        }
        photonlab_scene::Emitter::Directional { id, direction, irradiance } => {
            let irradiance = Colour::from_rgb(*irradiance);
            let (corner, sides) = covering_window(world.bounds(), *direction);
            let area = sides[0].cross(sides[1]).length();
            let kind = LampKind::Directional { direction: *direction, irradiance, corner, sides };
            Lamp { id: id.clone(), kind, flux: irradiance * area }
        }
    }
}

/// The smallest rectangle (among 90 turns by one degree) across a direction whose shadow covers a box: its corner,
/// before the box, and its sides.
fn covering_window(bounds: (DVec3, DVec3), direction: DVec3) -> (DVec3, [DVec3; 2]) {
    let corners: Vec<DVec3> = (0..8)
        .map(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 { bounds.0[axis] } else { bounds.1[axis] }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
        .collect();
    let range = |axis: DVec3| {
        let along = corners.iter().map(|c| c.dot(axis));
        (along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max))
    };
    let (tangent, bitangent) = direction.any_orthonormal_pair();
    let window = (0..90).map(|degree| {
        let (sin, cos) = f64::from(degree).to_radians().sin_cos();
        let axes = [cos * tangent + sin * bitangent, cos * bitangent - sin * tangent];
        (axes, [range(axes[0]), range(axes[1])])
    });
    let area = |r: &[(f64, f64); 2]| (r[0].1 - r[0].0) * (r[1].1 - r[1].0);
    let (axes, ranges) = window.min_by(|a, b| area(&a.1).total_cmp(&area(&b.1))).expect("ninety turns were tried");
    // A hair wider than the box, so that a surface on its rim is lit to the edge.
    let size = (bounds.1 - bounds.0).length();
    let margin = 1e-9 * size;
    let before = range(direction).0 - 0.1 * size.max(f64::MIN_POSITIVE);
    let corner = (ranges[0].0 - margin) * axes[0] + (ranges[1].0 - margin) * axes[1] + before * direction;
    let side = |r: (f64, f64), axis: DVec3| (r.1 - r.0 + 2.0 * margin) * axis;
    (corner, [side(ranges[0], axes[0]), side(ranges[1], axes[1])])
}
