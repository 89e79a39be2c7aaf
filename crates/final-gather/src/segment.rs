//! From a point or an eye along a ray, through specular surfaces, to where light is read.

use photonlab_photometry::Colour;
use photonlab_sampling::{Interaction, Lamps, Stream, interaction};
use photonlab_scene::{Hit, Ray, World};

/// When a ray that looks for light gives up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EyeLimits {
    /// Longest path from sensor to lamp in segments; `None` is unlimited.
    pub max_segments: Option<u32>,
    /// Longest run of specular interactions.
    pub max_specular: u32,
}

impl EyeLimits {
    /// True if a path may have this many segments.
    pub fn allows(&self, segments: u32) -> bool {
        self.max_segments.is_none_or(|max| segments <= max)
    }
}

/// Where a ray that looks for light ended.
#[derive(Clone, Copy, Debug)]
pub struct Landing<const C: usize> {
    /// Radiance that reached the ray from lamps behind at least one specular surface.
    pub emitted: Colour<C>,
    /// The lamp's hit, if the very first surface emits towards the ray.
    pub first_emission: Option<(Hit, Colour<C>)>,
    /// The diffuse point it ended on, with its reflectance and the weight of radiance from there.
    pub diffuse: Option<(Hit, Colour<C>, Colour<C>)>,
    /// Segments travelled.
    pub segments: u32,
    /// Distance travelled, metres.
    pub distance: f64,
    /// True if a specular surface was met.
    pub specular: bool,
}

/// Where a ray that looks for light starts.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// The ray.
    pub ray: Ray,
    /// The primitive it starts on, if any.
    pub from: Option<u32>,
    /// Nothing beyond this distance is seen before the first specular surface, metres; usually infinite.
    pub reach: f64,
    /// Segments between the sensor and here.
    pub used: u32,
}

/// Follows a ray through specular surfaces to the first diffuse one.
pub fn follow<const C: usize>(
    world: &World,
    lamps: &Lamps<C>,
    limits: &EyeLimits,
    start: Start,
    stream: &mut Stream,
) -> Landing<C> {
    let Start { mut ray, mut from, mut reach, used } = start;
    let mut weight = Colour::ONE;
    let mut landing = Landing {
        emitted: Colour::ZERO,
        first_emission: None,
        diffuse: None,
        segments: used,
        distance: 0.0,
        specular: false,
    };
    for _ in 0..=limits.max_specular {
        if !limits.allows(landing.segments + 1) {
            break;
        }
        let Some(hit) = world.cast(&ray, from, reach) else {
            break;
        };
        landing.segments += 1;
        landing.distance += hit.distance;
        let emitted = lamps.emitted(hit.point.primitive, hit.front);
        if !emitted.is_zero() {
            if landing.specular {
                landing.emitted += emitted * weight;
            } else {
                landing.first_emission = Some((hit, emitted));
            }
        }
        match interaction(world, &hit) {
            Interaction::Absorbed => break,
            Interaction::Diffuse { reflectance } => {
                landing.diffuse = Some((hit, reflectance, weight));
                break;
            }
            Interaction::Specular(specular) => {
                let (next, share, compression) = specular.follow(&ray, &hit, stream);
                weight = weight * share * compression;
                if weight.is_zero() {
                    break;
                }
                landing.specular = true;
                reach = f64::INFINITY;
                ray = next;
                from = Some(hit.point.primitive);
            }
        }
    }
    landing
}
