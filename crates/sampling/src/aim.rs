//! Photons aimed at what is specular.
//!
//! A small lens takes a small part of a lamp's light and makes of it the brightest thing in the picture. So the rays of a
//! lamp are parted: a ray that meets the ball around a specular shape belongs to that shape's [`Aim`] (to the first of
//! those it meets), every other to the lamp itself. An aim draws from its own rays alone, so that as many photons as one
//! likes can be sent there; a ray that is another's is dark. No light is left out and none is sent twice, however the
//! balls stand.

use std::{f64::consts::PI, f64::consts::TAU, ops::Range};

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Geometry, Ray, World};

use crate::{Emission, Lamp, LampKind, Purpose, Stream, pattern, warp};

/// Rays that find an aim's flux. They decide how many photons it gets, not what they carry.
const LOOKS: u64 = 256;
/// More shapes than this are aimed at as one.
const MOST_TARGETS: usize = 16;
/// More lamps than this are not aimed: a test for every ball would cost more than it gains.
const MOST_LAMPS: usize = 64;

/// The ball around a specular shape.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Target {
    /// Metres.
    centre: DVec3,
    /// Metres.
    radius: f64,
}

/// The rays of one lamp that meet one target.
#[derive(Clone, Debug)]
pub(crate) struct Aim<const C: usize> {
    /// Index into [`Lamps::lamps`](crate::Lamps::lamps).
    pub(crate) lamp: usize,
    target: Target,
    /// 1 - cos of the half-angle under which the middle of the lamp sees the target; zero of lamps at infinity.
    cone: f64,
    /// Flux, W or lm, of all its rays if each had weight one.
    pub(crate) base: Colour<C>,
    /// Its flux in the strongest channel, as looks found it.
    pub(crate) importance: f64,
}

/// All aims of a scene, those of one lamp after another.
#[derive(Clone, Debug)]
pub(crate) struct Aims<const C: usize> {
    pub(crate) aims: Vec<Aim<C>>,
    /// True if every ray from a lamp to a specular surface is an aim's.
    pub(crate) complete: bool,
}

impl<const C: usize> Aims<C> {
    /// Every lamp at every shape that mirrors or refracts and does not stand around it.
    pub(crate) fn new(world: &World, lamps: &[Lamp<C>]) -> Self {
        let (mut targets, mut complete) = targets(world);
        if lamps.len() > MOST_LAMPS {
            (targets, complete) = (Vec::new(), false);
        }
        let mut aims = Vec::new();
        for (index, lamp) in lamps.iter().enumerate() {
            for &target in &targets {
                match Aim::new(world, index, lamp, target) {
                    Some(aim) => aims.push(aim),
                    None => complete &= lamp.importance() == 0.0,
                }
            }
        }
        for (number, aim) in aims.iter_mut().enumerate() {
            aim.look(world, &lamps[aim.lamp], number as u64);
        }
        // One that no look met stays the lamp's own.
        aims.retain(|aim| aim.importance > 0.0);
        Self { aims, complete }
    }

    /// Those that take no more than a flux together: of more, the largest are left out.
    pub(crate) fn up_to(&self, flux: f64) -> Self {
        let mut some = self.clone();
        while some.importance() > flux {
            let largest = some.aims.iter().map(|aim| aim.importance).fold(0.0, f64::max);
            some.aims.retain(|aim| aim.importance < largest);
            some.complete = false;
        }
        some
    }

    /// Flux of all, in the strongest channel.
    pub(crate) fn importance(&self) -> f64 {
        self.aims.iter().map(|aim| aim.importance).sum()
    }

    /// The aims of a lamp.
    pub(crate) fn of_lamp(&self, lamp: usize) -> Range<usize> {
        self.aims.partition_point(|aim| aim.lamp < lamp)..self.aims.partition_point(|aim| aim.lamp <= lamp)
    }

    /// True if a ray meets the target of one of these aims.
    pub(crate) fn have(&self, aims: Range<usize>, ray: &Ray) -> bool {
        self.aims[aims].iter().any(|aim| aim.target.is_met(ray))
    }

    /// A ray of an aim, dark if it is an earlier one's.
    pub(crate) fn emit(&self, aim: usize, world: &World, lamp: &Lamp<C>, stream: &mut Stream) -> Emission<C> {
        let mut emission = self.aims[aim].emit(world, lamp, stream);
        if self.have(self.of_lamp(self.aims[aim].lamp).start..aim, &emission.ray) {
            emission.weight = Colour::ZERO;
        }
        emission
    }
}

/// The balls around what mirrors or refracts and does nothing else, and whether nothing else mirrors.
fn targets(world: &World) -> (Vec<Target>, bool) {
    let shapes = world.scene.shapes.iter().enumerate();
    let specular: Vec<_> = shapes.filter(|(_, shape)| shape.bsdf.is_specular()).collect();
    let alone = specular.iter().filter(|(_, shape)| !shape.bsdf.is_diffuse());
    let targets: Vec<Target> = alone
        .map(|&(index, shape)| match shape.geometry {
            Geometry::Sphere { centre, radius, .. } => Target { centre, radius },
            _ => Target::around(world.bounds_of(index)),
        })
        .collect();
    let complete = targets.len() == specular.len();
    if targets.len() <= MOST_TARGETS {
        return (targets, complete);
    }
    let ends = targets.iter().map(|t| (t.centre - t.radius, t.centre + t.radius));
    let all = ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    (all.map(Target::around).into_iter().collect(), complete)
}

impl Target {
    fn around((low, high): (DVec3, DVec3)) -> Self {
        Self { centre: 0.5 * (low + high), radius: 0.5 * (high - low).length() }
    }

    fn is_met(&self, ray: &Ray) -> bool {
        let to = self.centre - ray.origin;
        let along = to.dot(ray.direction);
        along > 0.0 && to.length_squared() - along * along < self.radius * self.radius
    }

    /// 1 - cos of the half-angle under which it is seen from outside.
    fn cone(&self, from: DVec3) -> f64 {
        warp::cone_of_sphere(self.radius, self.centre - from)
    }

    fn draw(&self, from: DVec3, stream: &mut Stream) -> (DVec3, f64) {
        let cone = self.cone(from);
        (warp::square_to_uniform_cone(stream.next2(), (self.centre - from).normalize(), cone), cone)
    }

    /// A point of its disc across a direction.
    fn across(&self, direction: DVec3, stream: &mut Stream) -> DVec3 {
        self.centre + self.radius * warp::square_to_uniform_disc(stream.next2(), direction)
    }

    /// Square metres.
    fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }
}

impl<const C: usize> Aim<C> {
    /// `None` from inside the ball, and where light comes through portals.
    fn new(world: &World, index: usize, lamp: &Lamp<C>, target: Target) -> Option<Self> {
        let outside = |(low, high): (DVec3, DVec3)| {
            let lamp = Target::around((low, high));
            (lamp.centre - target.centre).length() > 1.001 * (lamp.radius + target.radius)
        };
        let (base, cone) = match &lamp.kind {
            LampKind::Point { position, intensity, .. } => {
                let cone = outside((*position, *position)).then(|| target.cone(*position))?;
                (*intensity * (TAU * cone), cone)
            }
            LampKind::Directional { irradiance, .. } => (*irradiance * target.area(), 0.0),
            LampKind::Environment { environment, portals, .. } => {
                (portals.is_empty().then(|| environment.total * target.area())?, 0.0)
            }
            LampKind::Area { radiance, area, .. } | LampKind::Faces { radiance, area, .. } => {
                let bounds = world.bounds_of(shape_of(world, lamp)?);
                let cone = outside(bounds).then(|| target.cone(0.5 * (bounds.0 + bounds.1)))?;
                (*radiance * (area * TAU * cone), cone)
            }
            LampKind::Portal { .. } => return None,
        };
        Some(Self { lamp: index, target, cone, base, importance: 0.0 })
    }

    fn look(&mut self, world: &World, lamp: &Lamp<C>, number: u64) {
        let mut stream = Stream::new(0, Purpose::Aims, 0, number);
        let mean = (0..LOOKS).fold(Colour::ZERO, |sum, _| sum + self.emit(world, lamp, &mut stream).weight);
        self.importance = (self.base * mean).max() / LOOKS as f64;
    }

    /// A ray of the lamp that meets the target; its weight is the flux that it stands for over [`Aim::base`].
    fn emit(&self, world: &World, lamp: &Lamp<C>, stream: &mut Stream) -> Emission<C> {
        let target = &self.target;
        match &lamp.kind {
            LampKind::Point { position, pattern, .. } => {
                let (direction, _) = target.draw(*position, stream);
                let weight = Colour::splat(pattern::relative(pattern, direction));
                Emission { ray: Ray::new(*position, direction), from: None, weight }
            }
            LampKind::Directional { direction, corner, sides, .. } => {
                let through = target.across(*direction, stream);
                let origin = through - (through - *corner).dot(*direction) * *direction;
                let inside = sides.iter().all(|side| {
                    let along = (origin - *corner).dot(*side) / side.length_squared();
                    (0.0..=1.0).contains(&along)
                });
                let weight = if inside { Colour::ONE } else { Colour::ZERO };
                Emission { ray: Ray::new(origin, *direction), from: None, weight }
            }
            LampKind::Environment { environment, centre, radius, .. } => {
                let (towards, weight) = environment.emit(stream);
                let through = target.across(towards, stream) - *centre;
                let on_disc = through - through.dot(towards) * towards;
                let weight = if on_disc.length() <= *radius { weight } else { Colour::ZERO };
                let origin = *centre + on_disc + 1.01 * *radius * towards;
                Emission { ray: Ray::new(origin, -towards), from: None, weight }
            }
            LampKind::Area { primitive, .. } => self.off_surface(world, *primitive, stream),
            LampKind::Faces { shape, .. } => {
                self.off_surface(world, world.primitive_by_area(*shape, stream.next()).0, stream)
            }
            LampKind::Portal { .. } => unreachable!("portals are not aimed"),
        }
    }

    fn off_surface(&self, world: &World, primitive: u32, stream: &mut Stream) -> Emission<C> {
        let position = world.primitives[primitive as usize].surface.point_by_area(stream.next2());
        let (direction, cone) = self.target.draw(position, stream);
        let cosine = direction.dot(world.point_on(primitive, position).normal).max(0.0);
        let weight = Colour::splat(cosine * cone / self.cone);
        Emission { ray: Ray::new(position, direction), from: Some(primitive), weight }
    }
}

/// The shape of a lamp with a surface.
fn shape_of<const C: usize>(world: &World, lamp: &Lamp<C>) -> Option<usize> {
    match lamp.kind {
        LampKind::Area { primitive, .. } => Some(world.primitives[primitive as usize].shape as usize),
        LampKind::Faces { shape, .. } => Some(shape),
        _ => None,
    }
}
