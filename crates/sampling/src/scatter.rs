//! What happens to light at a surface.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Bsdf, Conductor, Dielectric, Hit, Ray, World};

use crate::{FacetMaterial, Facets, Matte, Rough, Specular, Stream, warp::Frame};

/// What a surface does to light that arrives at a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interaction<const C: usize> {
    /// Everything ends here, and nothing is stored (the back of a one-sided coating).
    Absorbed,
    /// Nothing happens: light goes on as if there were no surface, and no bounce is counted.
    Passed,
    /// Light leaves in all directions; photons are stored here.
    Matte(Matte<C>),
    /// Light goes on in a direction drawn from a line or a lobe; nothing is stored here.
    Followed(Followed<C>),
}

/// Interactions after which light goes on in a drawn direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Followed<const C: usize> {
    /// One or two directions with finite probability.
    Specular(Specular<C>),
    /// A lobe around such directions.
    Rough(Rough<C>),
}

/// A direction in which light goes on, drawn.
#[derive(Clone, Copy, Debug)]
pub struct Onward<const C: usize> {
    /// From the surface on.
    pub ray: Ray,
    /// Share of the flux that goes on.
    pub share: Colour<C>,
    /// Radiance seen along the reversed path over the flux share: n1^2 / n2^2 where light is refracted, else 1.
    pub compression: f64,
    /// Density per solid angle of the direction; `None` for one with finite probability.
    pub pdf_solid_angle: Option<f64>,
}

/// What happens at a hit to the light that meets the surface, and the share of light that does: what a mask leaves open
/// goes on as if there were none. Photons are stored before that is drawn, for they have arrived.
pub fn interaction<const C: usize>(world: &World, hit: &Hit) -> (Interaction<C>, f64) {
    let (coating, opacity) = world.coating(hit.point.primitive, hit.front);
    (coating.map_or(Interaction::Absorbed, |bsdf| of_bsdf(bsdf, hit.front)), opacity)
}

/// Draws whether light goes through what a mask leaves open.
pub fn goes_through(opacity: f64, stream: &mut Stream) -> bool {
    opacity < 1.0 && stream.next() >= opacity
}

fn of_bsdf<const C: usize>(bsdf: &Bsdf, front: bool) -> Interaction<C> {
    let colour = Colour::<C>::from_rgb;
    let followed = |specular| Interaction::Followed(Followed::Specular(specular));
    match bsdf {
        Bsdf::TwoSided { .. } | Bsdf::Mask { .. } => Interaction::Absorbed,
        Bsdf::Null => Interaction::Passed,
        Bsdf::Diffuse { reflectance } => Interaction::Matte(Matte::bare(colour(*reflectance))),
        Bsdf::Transmitter { reflectance, transmittance } => {
            Interaction::Matte(Matte::transmitting(colour(*reflectance), colour(*transmittance)))
        }
        Bsdf::Plastic { reflectance, specular_reflectance, relative_index, nonlinear } => Interaction::Matte(
            Matte::coated(colour(*reflectance), colour(*specular_reflectance), *relative_index, *nonlinear),
        ),
        Bsdf::Mirror { reflectance } => followed(Specular::Mirror { reflectance: colour(*reflectance) }),
        Bsdf::ThinDielectric { relative_index, specular: [reflected, transmitted] } => followed(Specular::Thin {
            relative_index: *relative_index,
            reflectance: colour(*reflected),
            transmittance: colour(*transmitted),
        }),
        Bsdf::Conductor(metal) => Interaction::Followed(conductor(metal)),
        Bsdf::Dielectric(glass) => Interaction::Followed(dielectric(glass, front)),
    }
}

fn conductor<const C: usize>(metal: &Conductor) -> Followed<C> {
    let [eta, k, reflectance] = [metal.eta, metal.k, metal.specular_reflectance].map(Colour::<C>::from_rgb);
    match metal.roughness {
        None => Followed::Specular(Specular::Conductor { eta, k, reflectance }),
        Some(roughness) => Followed::Rough(Rough {
            facets: Facets::new(roughness),
            material: FacetMaterial::Conductor { eta, k, reflectance },
        }),
    }
}

fn dielectric<const C: usize>(glass: &Dielectric, front: bool) -> Followed<C> {
    let ratio = glass.interior_index / glass.exterior_index;
    let relative_index = if front { ratio } else { 1.0 / ratio };
    let [reflectance, transmittance] = glass.specular.map(Colour::<C>::from_rgb);
    match glass.roughness {
        None => Followed::Specular(Specular::Dielectric { relative_index, reflectance, transmittance }),
        Some(roughness) => Followed::Rough(Rough {
            facets: Facets::new(roughness),
            material: FacetMaterial::Dielectric { relative_index, reflectance, transmittance },
        }),
    }
}

impl<const C: usize> Followed<C> {
    /// Draws how light goes on from a hit; `None` where it is lost.
    pub fn draw(&self, ray: &Ray, hit: &Hit, stream: &mut Stream) -> Option<Onward<C>> {
        match self {
            Followed::Specular(specular) => Some(specular.draw(ray, hit, stream)),
            Followed::Rough(rough) => {
                let frame = Frame::around(hit.facing_normal());
                let w = frame.local(-ray.direction);
                let drawn = rough.draw(w, [stream.next(), stream.next(), stream.next()])?;
                Some(Onward {
                    ray: Ray::new(hit.point.position, frame.world(drawn.v)),
                    share: drawn.share,
                    compression: drawn.compression,
                    pdf_solid_angle: Some(rough.pdf_solid_angle(w, drawn.v)),
                })
            }
        }
    }

    /// What radiance from `direction` contributes to radiance back along the ray, per solid angle, the cosine included;
    /// and the density with which [`Followed::draw`] draws the direction. `None` for directions of finite probability.
    pub fn eval(&self, ray: &Ray, hit: &Hit, direction: DVec3) -> Option<(Colour<C>, f64)> {
        let Followed::Rough(rough) = self else { return None };
        let frame = Frame::around(hit.facing_normal());
        let (w, v) = (frame.local(-ray.direction), frame.local(direction));
        Some((rough.eval(w, v), rough.pdf_solid_angle(w, v)))
    }
}
