//! All lamps of a scene, and how one of them is chosen.

use std::{f64::consts::PI, sync::Arc};

use photonlab_photometry::{Colour, Palette};
use photonlab_scene::{Emitter, Geometry, Ray, World};

use crate::{
    Environment, Lamp, LampKind, Portal, aim::Aims, direct::area_pdf_solid_angle, pattern, portal::way_out,
    window::covering_window,
};

/// All lamps of a scene, one per emitting primitive, with the probability of choosing each for direct light.
#[derive(Clone, Debug)]
pub struct Lamps<const C: usize> {
    /// The lamps that emit anything, in the order of the file; lamps without a surface first.
    pub lamps: Vec<Lamp<C>>,
    /// Probability of each when one is chosen.
    pub probability: Vec<f64>,
    /// Sum of the probabilities before each.
    before: Vec<f64>,
    /// The lamp of each primitive, if it emits.
    of_primitive: Vec<Option<u32>>,
    /// The lamp that is the environment, if there is one.
    environment: Option<usize>,
    /// The environment's portals: lamps and their primitives.
    portals: Vec<(usize, u32)>,
    /// What photons can be aimed at.
    pub(crate) aims: Aims<C>,
}

impl<const C: usize> Lamps<C> {
    /// The largest radiance of any lamp in each channel; `None` if one has no extent, which no ray meets by chance.
    pub fn brightest(&self) -> Option<Colour<C>> {
        self.lamps.iter().try_fold(Colour::ZERO, |most: Colour<C>, lamp| {
            let radiance = match &lamp.kind {
                LampKind::Point { .. } | LampKind::Directional { .. } => return None,
                LampKind::Environment { environment, .. } => environment.brightest(),
                // What comes through it is the environment's.
                LampKind::Portal { .. } => Colour::ZERO,
                LampKind::Area { radiance, .. } | LampKind::Faces { radiance, .. } => *radiance,
            };
            Some(Colour(std::array::from_fn(|c| most[c].max(radiance[c]))))
        })
    }

    /// Collects the lamps of a scene.
    pub fn new(world: &World, palette: &Palette<C>) -> Self {
        let mut lamps: Vec<Lamp<C>> = world
            .scene
            .emitters
            .iter()
            .filter(|e| !e.is_black())
            .flat_map(|e| surfaceless(world, e, palette))
            .collect();
        for (index, shape) in world.scene.shapes.iter().enumerate() {
            let Some(emission) = shape.radiance.as_ref().filter(|emission| !emission.is_black()) else { continue };
            let radiance = palette.emission(emission);
            let area = world.area_of(index);
            let id = || shape.id.clone();
            if let Geometry::Mesh(_) = shape.geometry {
                let kind = LampKind::Faces { shape: index, radiance, area };
                let medium = world.medium_beside(world.primitives_of(index).start, true, None);
                lamps.push(Lamp { id: id(), kind, medium, flux: radiance * (PI * area) });
                continue;
            }
            for primitive in world.primitives_of(index) {
                let area = world.primitives[primitive as usize].surface.area();
                let kind = LampKind::Area { primitive, radiance, area };
                let medium = world.medium_beside(world.primitives_of(index).start, true, None);
                lamps.push(Lamp { id: id(), kind, medium, flux: radiance * (PI * area) });
            }
        }
        let mut of_primitive = vec![None; world.primitives.len()];
        for (index, lamp) in lamps.iter().enumerate() {
            match lamp.kind {
                LampKind::Area { primitive, .. } => of_primitive[primitive as usize] = Some(index as u32),
                LampKind::Faces { shape, .. } => {
                    world.primitives_of(shape).for_each(|p| of_primitive[p as usize] = Some(index as u32));
                }
                _ => {}
            }
        }
        let environment = lamps.iter().position(|lamp| matches!(lamp.kind, LampKind::Environment { .. }));
        let portals = lamps.iter().enumerate().filter_map(|(index, lamp)| match lamp.kind {
            LampKind::Portal { primitive, .. } => Some((index, primitive)),
            _ => None,
        });
        let portals: Vec<_> = portals.collect();
        let total: f64 = lamps.iter().map(Lamp::importance).sum();
        // Half by flux and half evenly: a weak lamp close to a receiver is not starved.
        let even = 1.0 / lamps.len() as f64;
        // In a pass whose wavelengths no lamp emits, all are alike.
        let share = |flux: f64| if total > 0.0 { flux / total } else { even };
        let probability: Vec<f64> = lamps.iter().map(|lamp| 0.5 * share(lamp.importance()) + 0.5 * even).collect();
        let sum = |sum: &mut f64, p: &f64| Some(std::mem::replace(sum, *sum + p));
        let before = probability.iter().scan(0.0, sum).collect();
        let aims = Aims::new(world, &lamps);
        Self { lamps, probability, before, of_primitive, environment, portals, aims }
    }

    /// The lamp of a primitive, if that emits.
    pub fn of_primitive(&self, primitive: u32) -> Option<u32> {
        self.of_primitive[primitive as usize]
    }

    /// Radiance that a primitive emits towards a ray that comes from its given side.
    pub fn emitted(&self, primitive: u32, front: bool) -> Colour<C> {
        match self.of_primitive(primitive) {
            Some(lamp) if front => match self.lamps[lamp as usize].kind {
                LampKind::Area { radiance, .. } | LampKind::Faces { radiance, .. } => radiance,
                _ => Colour::ZERO,
            },
            _ => Colour::ZERO,
        }
    }

    /// Radiance that comes from infinity along a ray, and the density per solid angle with which [`crate::LightDraw`] draws
    /// its direction from its start, the choice of the lamp included; `None` without an environment.
    pub fn from_infinity(&self, world: &World, ray: &Ray) -> Option<(Colour<C>, f64)> {
        let index = self.environment?;
        match &self.lamps[index].kind {
            LampKind::Environment { environment, .. } => {
                let mut pdf = self.probability[index] * environment.pdf_solid_angle(ray.direction);
                for &(lamp, primitive) in &self.portals {
                    if let Some(position) = way_out(world, primitive, ray) {
                        pdf += self.probability[lamp] * area_pdf_solid_angle(world, primitive, ray.origin, position);
                    }
                }
                Some((environment.radiance(ray.direction), pdf))
            }
            _ => None,
        }
    }

    /// Chooses a lamp; its probability is in [`Lamps::probability`].
    pub fn choose(&self, xi: f64) -> usize {
        self.before.partition_point(|&sum| sum <= xi).clamp(1, self.lamps.len()) - 1
    }

    /// True if direct light is found by drawing lamps alone, with no help from rays that meet one by chance: lamps without
    /// extent, rectangles, and spheres that shine outwards.
    pub fn are_sampled_alone(&self, world: &World) -> bool {
        self.lamps.iter().all(|lamp| match lamp.kind {
            LampKind::Point { .. } | LampKind::Directional { .. } => true,
            LampKind::Environment { .. } | LampKind::Portal { .. } | LampKind::Faces { .. } => false,
            LampKind::Area { primitive, .. } => crate::direct::is_drawn_alone(world, primitive),
        })
    }

    /// Sum of all lamps' flux; what comes through portals is in that of the environment.
    pub fn total_flux(&self) -> Colour<C> {
        let apart = self.lamps.iter().filter(|lamp| !matches!(lamp.kind, LampKind::Portal { .. }));
        apart.fold(Colour::ZERO, |sum, lamp| sum + lamp.flux)
    }
}

/// The lamp of an emitter; of an environment, with one for each portal.
fn surfaceless<const C: usize>(world: &World, emitter: &Emitter, palette: &Palette<C>) -> Vec<Lamp<C>> {
    vec![match emitter {
        Emitter::Point { id, position, intensity, pattern, medium } => {
            let intensity = palette.emission(intensity);
            let kind = LampKind::Point { position: *position, intensity, pattern: pattern.clone() };
            Lamp { id: id.clone(), kind, medium: *medium, flux: intensity * pattern::integral(pattern) }
        }
        Emitter::Environment { id, light, portals } => {
            let environment = Arc::new(Environment::new(light, palette));
            let primitives: Arc<[u32]> = portals.iter().flat_map(|&shape| world.primitives_of(shape)).collect();
            let (low, high) = world.bounds();
            let radius = 0.5 * (high - low).length() * (1.0 + 1e-9);
            let flux = environment.total * (PI * radius * radius);
            let mut lamps = through_portals(world, &environment, &primitives);
            let (centre, portals) = (0.5 * (low + high), primitives);
            let kind = LampKind::Environment { environment, centre, radius, portals };
            lamps.push(Lamp { id: id.clone(), kind, medium: None, flux });
            return lamps;
        }
        Emitter::Directional { id, direction, irradiance } => {
            let irradiance = palette.emission(irradiance);
            let (corner, sides) = covering_window(world.bounds(), *direction);
            let area = sides[0].cross(sides[1]).length();
            let kind = LampKind::Directional { direction: *direction, irradiance, corner, sides };
            Lamp { id: id.clone(), kind, medium: None, flux: irradiance * area }
        }
    }]
}

fn through_portals<const C: usize>(
    world: &World,
    environment: &Arc<Environment<C>>,
    primitives: &[u32],
) -> Vec<Lamp<C>> {
    let lamp = |(place, &primitive): (usize, &u32)| {
        let surface = &world.primitives[primitive as usize].surface;
        let normal = world.point_on(primitive, surface.point_by_area([0.5; 2])).normal;
        let portal = Arc::new(Portal::new(environment, normal));
        let flux = portal.irradiance * surface.area();
        let kind = LampKind::Portal { primitive, portal, earlier: primitives[..place].into() };
        Lamp { id: world.shape_of(primitive).id.clone(), kind, medium: None, flux }
    };
    primitives.iter().enumerate().map(lamp).collect()
}
