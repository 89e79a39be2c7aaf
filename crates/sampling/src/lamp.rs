//! Lamps: their flux, and rays drawn from them in proportion to it.

use std::{f64::consts::PI, sync::Arc};

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Pattern, Ray, World};

use crate::{Environment, Portal, Stream, pattern, portal::crosses, warp};

/// A source of light with its total flux.
#[derive(Clone, Debug)]
pub struct Lamp<const C: usize> {
    /// Name in messages.
    pub id: String,
    /// Geometry and emission.
    pub kind: LampKind<C>,
    /// The medium into which it shines, if any.
    pub medium: Option<u32>,
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
        /// The primitives of its portals.
        portals: Arc<[u32]>,
    },
    /// Light of the environment that comes through an opening.
    Portal {
        /// Index into [`World::primitives`].
        primitive: u32,
        /// The directions of its light.
        portal: Arc<Portal<C>>,
        /// The primitives of the portals before it in the file.
        earlier: Arc<[u32]>,
    },
    /// Lambertian front side of all faces of a mesh.
    Faces {
        /// Index into [`Scene::shapes`](photonlab_scene::Scene::shapes).
        shape: usize,
        /// W/(m^2 sr) or cd/m^2.
        radiance: Colour<C>,
        /// Square metres, of all faces.
        area: f64,
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
    /// Flux over the lamp's mean per ray: one for most lamps, one on average for all but environments with portals and
    /// portals with something before them, whose dark rays stand for light that another lamp sends or that is hidden.
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
            LampKind::Environment { environment, centre, radius, portals } => {
                let (towards, weight) = environment.emit(stream);
                let on_disc = warp::square_to_uniform_disc(stream.next2(), towards);
                let origin = *centre + *radius * (on_disc + 1.01 * towards);
                let ray = Ray::new(origin, -towards);
                let free = || first_hit(world, &ray, None);
                let weight = if crosses(world, portals, &ray, free) { Colour::ZERO } else { weight };
                Emission { ray, from: None, weight }
            }
            LampKind::Portal { primitive, portal, earlier } => {
                let from = Some(*primitive);
                let position = world.primitives[*primitive as usize].surface.point_by_area(stream.next2());
                let (direction, weight) = portal.emit(stream);
                let ray = Ray::new(position, direction);
                let hidden = || first_hit(world, &Ray::new(position, -direction), from) < f64::INFINITY;
                let dark =
                    weight.is_zero() || hidden() || crosses(world, earlier, &ray, || first_hit(world, &ray, from));
                Emission { ray, from, weight: if dark { Colour::ZERO } else { weight } }
            }
            LampKind::Area { primitive, .. } => even_from(world, *primitive, stream),
            LampKind::Faces { shape, .. } => even_from(world, world.primitive_by_area(*shape, stream.next()).0, stream),
        }
    }

    /// What photons and draws are shared out by: the flux in the strongest channel, but none of an environment that has
    /// portals for what matters of it.
    pub fn importance(&self) -> f64 {
        match &self.kind {
            LampKind::Environment { portals, .. } if !portals.is_empty() => 0.0,
            _ => self.flux.max(),
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

/// Distance to the first surface along a ray; infinite if there is none.
fn first_hit(world: &World, ray: &Ray, from: Option<u32>) -> f64 {
    world.cast(ray, from, f64::INFINITY).map_or(f64::INFINITY, |hit| hit.distance)
}

/// A ray from a primitive whose front side shines evenly.
fn even_from<const C: usize>(world: &World, primitive: u32, stream: &mut Stream) -> Emission<C> {
    let position = world.primitives[primitive as usize].surface.point_by_area(stream.next2());
    let normal = world.point_on(primitive, position).normal;
    let direction = warp::square_to_cosine_hemisphere(stream.next2(), normal);
    Emission { ray: Ray::new(position, direction), from: Some(primitive), weight: Colour::ONE }
}
