//! What a scene does to light, in the channels in which it is followed.

use photonlab_photometry::{Colour, Palette};
use photonlab_scene::{Bsdf, Conductor, Dielectric, Hit, Ray, Shape, World};

use crate::{
    Dispersive, FacetMaterial, Facets, Followed, Interaction, Lamps, Matte, Rough, Specular, Volume, compiled::maker,
};

/// Lamps and coatings in `C` channels: of a scene, or of one pass where wavelengths are drawn for each.
#[derive(Clone, Debug)]
pub struct Optics<const C: usize> {
    /// What the channels stand for.
    pub palette: Palette<C>,
    /// What emits.
    pub lamps: Lamps<C>,
    /// By shape.
    coatings: Vec<Coating<C>>,
    /// True if any shape is a pane.
    has_panes: bool,
    /// By medium.
    volumes: Vec<Volume<C>>,
}

/// What a shape does to light on either side.
#[derive(Clone, Copy, Debug)]
struct Coating<const C: usize> {
    front: Interaction<C>,
    back: Interaction<C>,
    /// Share of light that meets the surface at all.
    opacity: f64,
    /// True if the shape is a lamp.
    shines: bool,
}

impl<const C: usize> Optics<C> {
    /// Of a scene whose channels the palette fits.
    pub fn new(world: &World, palette: Palette<C>) -> Self {
        maker().optics(world, palette)
    }

    pub(crate) fn make(world: &World, palette: Palette<C>) -> Self {
        let coating =
            |shape: &Shape| Coating { shines: shape.radiance.is_some(), ..Coating::new(&shape.bsdf, &palette) };
        let coatings: Vec<_> = world.scene.shapes.iter().map(coating).collect();
        let has_panes = coatings.iter().any(Coating::is_pane);
        let volumes = world.scene.media.iter().map(|medium| Volume::new(medium, &palette)).collect();
        Self { lamps: Lamps::new(world, &palette), coatings, has_panes, volumes, palette }
    }

    /// A medium of the scene.
    pub fn volume(&self, medium: u32) -> &Volume<C> {
        &self.volumes[medium as usize]
    }

    /// True if a primitive is a pane: a thin plate, with no mask over it, that does not shine. Light that it lets through goes on straight, so it is drawn
    /// and classed as if it came directly; what it mirrors is caustic light.
    pub fn is_pane(&self, world: &World, primitive: u32) -> bool {
        self.coating_of(world, primitive).is_pane()
    }

    fn coating_of(&self, world: &World, primitive: u32) -> &Coating<C> {
        &self.coatings[world.primitives[primitive as usize].shape as usize]
    }

    /// The share of light along a ray that goes on straight from a hit, and the segments that end there: what a mask leaves open
    /// ends none, and a pane one.
    pub fn straight(&self, world: &World, ray: &Ray, hit: &Hit) -> (Colour<C>, u32) {
        let coating = self.coating_of(world, hit.point.primitive);
        let side = if hit.front { &coating.front } else { &coating.back };
        match side {
            Interaction::Followed(Followed::Specular(plate)) if coating.is_pane() => (plate.straight(ray, hit), 1),
            _ => (Colour::splat(world.openness(hit.point.primitive)), 0),
        }
    }

    /// The share of light that passes from the start of a ray, on the primitive `from` and in a medium, to a point at a distance
    /// on `to`: what surfaces and media between leave of it; and the panes that it passes.
    pub fn passes(
        &self,
        world: &World,
        ray: &Ray,
        from: Option<u32>,
        medium: Option<u32>,
        distance: f64,
        to: Option<u32>,
    ) -> (Colour<C>, u32) {
        if self.volumes.is_empty() && !self.has_panes {
            return (Colour::splat(world.unblocked(ray, from, distance, to)), 0);
        }
        let (mut share, mut rest, mut ray, mut from, mut medium) = (Colour::ONE, distance, *ray, from, medium);
        let mut panes = 0;
        loop {
            let arrived =
                |hit: &Hit| Some(hit.point.primitive) == to && world.is_end(hit.point.primitive, hit.distance, rest);
            let hit = world.cast(&ray, from, rest).filter(|hit| !arrived(hit));
            let flown = hit.map_or(rest, |hit| hit.distance);
            if let Some(medium) = medium {
                share = share * self.volume(medium).transmittance(flown);
            }
            let Some(hit) = hit else { return (share, panes) };
            let (straight, segments) = self.straight(world, &ray, &hit);
            share = share * straight;
            panes += segments;
            if share.is_zero() {
                return (share, panes);
            }
            medium = world.medium_beside(hit.point.primitive, !hit.front, medium);
            rest -= flown;
            (ray, from) = (Ray::new(hit.point.position, ray.direction), Some(hit.point.primitive));
        }
    }

    /// True if photons that arrive on a side of a primitive are stored there.
    pub fn stores(&self, world: &World, primitive: u32, front: bool) -> bool {
        let coating = &self.coatings[world.primitives[primitive as usize].shape as usize];
        let side = if front { &coating.front } else { &coating.back };
        matches!(side, Interaction::Matte(_)) || world.is_metered(primitive)
    }

    /// What happens at a hit to the light that meets the surface, and the share of light that does: what a mask leaves open
    /// goes on as if there were none. Photons are stored before that is drawn, for they have arrived.
    #[inline]
    pub fn interaction(&self, world: &World, hit: &Hit) -> (&Interaction<C>, f64) {
        let coating = &self.coatings[world.primitives[hit.point.primitive as usize].shape as usize];
        (if hit.front { &coating.front } else { &coating.back }, coating.opacity)
    }
}

impl<const C: usize> Coating<C> {
    fn new(bsdf: &Bsdf, palette: &Palette<C>) -> Self {
        let side = |bsdf: &Bsdf, front: bool| match bsdf {
            bsdf if front || bsdf.joins_its_sides() => interaction(bsdf, front, palette),
            _ => Interaction::Absorbed,
        };
        match bsdf {
            Bsdf::Mask { opacity, surface } => Self { opacity: *opacity, ..Self::new(surface, palette) },
            Bsdf::TwoSided { front, back } => {
                Self { front: side(front, true), back: side(back, true), opacity: 1.0, shines: false }
            }
            bsdf => Self { front: side(bsdf, true), back: side(bsdf, false), opacity: 1.0, shines: false },
        }
    }

    fn is_pane(&self) -> bool {
        let is_thin = |side| matches!(side, &Interaction::Followed(Followed::Specular(Specular::Thin { .. })));
        !self.shines && self.opacity == 1.0 && (is_thin(&self.front) || is_thin(&self.back))
    }
}

fn interaction<const C: usize>(bsdf: &Bsdf, front: bool, palette: &Palette<C>) -> Interaction<C> {
    let colour = |spectrum| palette.colour(spectrum);
    let followed = |specular| Interaction::Followed(Followed::Specular(specular));
    match bsdf {
        Bsdf::TwoSided { .. } | Bsdf::Mask { .. } => Interaction::Absorbed,
        Bsdf::Null => Interaction::Passed,
        Bsdf::Diffuse { reflectance } => Interaction::Matte(Matte::bare(colour(reflectance))),
        Bsdf::Transmitter { reflectance, transmittance } => {
            Interaction::Matte(Matte::transmitting(colour(reflectance), colour(transmittance)))
        }
        Bsdf::Plastic { reflectance, specular_reflectance, relative_index, nonlinear } => Interaction::Matte(
            Matte::coated(colour(reflectance), colour(specular_reflectance), *relative_index, *nonlinear),
        ),
        Bsdf::Mirror { reflectance } => followed(Specular::Mirror { reflectance: colour(reflectance) }),
        Bsdf::ThinDielectric { relative_index, specular: [reflected, transmitted] } => followed(Specular::Thin {
            relative_index: *relative_index,
            reflectance: colour(reflected),
            transmittance: colour(transmitted),
        }),
        Bsdf::Conductor(metal) => Interaction::Followed(conductor(metal, palette)),
        Bsdf::Dielectric(glass) => dielectric(glass, front, palette),
    }
}

fn conductor<const C: usize>(metal: &Conductor, palette: &Palette<C>) -> Followed<C> {
    let [eta, k, reflectance] = [&metal.eta, &metal.k, &metal.specular_reflectance].map(|s| palette.colour(s));
    match metal.roughness {
        None => Followed::Specular(Specular::Conductor { eta, k, reflectance }),
        Some(roughness) => Followed::Rough(Rough {
            facets: Facets::new(roughness),
            material: FacetMaterial::Conductor { eta, k, reflectance },
        }),
    }
}

fn dielectric<const C: usize>(glass: &Dielectric, front: bool, palette: &Palette<C>) -> Interaction<C> {
    let relative = |nm: f64| {
        let ratio = glass.interior_index.at(nm) / glass.exterior_index.at(nm);
        if front { ratio } else { 1.0 / ratio }
    };
    let [reflectance, transmittance] = [&glass.specular[0], &glass.specular[1]].map(|s| palette.colour(s));
    let facets = glass.roughness.map(Facets::new);
    let disperses = glass.interior_index.disperses() || glass.exterior_index.disperses();
    match palette {
        Palette::Wavelengths(drawn) if disperses => Interaction::Dispersed(Dispersive {
            relative_index: Colour(drawn.nm.map(relative)),
            reflectance,
            transmittance,
            facets,
        }),
        // An index that does not disperse is the same at any wavelength.
        _ => Interaction::Followed(Followed::dielectric(relative(550.0), [reflectance, transmittance], facets)),
    }
}
