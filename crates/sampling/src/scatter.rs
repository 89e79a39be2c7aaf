//! What happens to light at a surface.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Hit, Normals, Ray};

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
    /// The same, once a wavelength has been chosen.
    Dispersed(Dispersive<C>),
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
    /// Factor of flux, but not of radiance, where a mesh stands for a smooth surface: |cos in, smooth| |cos out| over
    /// |cos in| |cos out, smooth| (Veach 1997, section 5.3). One on all others.
    pub tilt: f64,
    /// Density per solid angle of the direction; `None` for one with finite probability.
    pub pdf_solid_angle: Option<f64>,
    /// True if it goes on as it came, through a thin plate.
    pub straight: bool,
}

impl<const C: usize> Onward<C> {
    /// With its tilt, if both normals agree on which side the light goes on.
    pub(crate) fn on_the_right_side(self, ray: &Ray, normals: &Normals) -> Option<Self> {
        if normals.geometric == normals.shading {
            return Some(self);
        }
        let side = if self.ray.direction.dot(normals.shading) > 0.0 { *normals } else { normals.turned() };
        let (arriving, leaving) = (normals.tilt(-ray.direction), side.tilt(self.ray.direction));
        (arriving > 0.0 && leaving > 0.0).then(|| Self { tilt: arriving / leaving, ..self })
    }
}

/// Draws whether light goes through what a mask leaves open.
pub fn goes_through(opacity: f64, stream: &mut Stream) -> bool {
    opacity < 1.0 && stream.next() >= opacity
}

/// An interface at which each wavelength goes on in a direction of its own: one of them must be chosen first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dispersive<const C: usize> {
    /// Index on the far side over the index on the side of the hit, at each wavelength.
    pub relative_index: Colour<C>,
    /// Further factor of the reflected share.
    pub reflectance: Colour<C>,
    /// Further factor of the transmitted share.
    pub transmittance: Colour<C>,
    /// `None` if smooth.
    pub facets: Option<Facets>,
}

impl<const C: usize> Dispersive<C> {
    /// Chooses the wavelength that goes on, in proportion to what each carries: the interface as that wavelength meets it,
    /// and the factor of mean one that leaves the other wavelengths nothing.
    pub fn settle(&self, carried: Colour<C>, stream: &mut Stream) -> (Followed<C>, Colour<C>) {
        let total: f64 = carried.0.into_iter().sum();
        let mut rest = stream.next() * total;
        let mut chosen = 0;
        for (channel, light) in carried.0.into_iter().enumerate().filter(|(_, light)| *light > 0.0) {
            chosen = channel;
            rest -= light;
            if rest < 0.0 {
                break;
            }
        }
        let mut factor = Colour::ZERO;
        factor[chosen] = if carried[chosen] > 0.0 { total / carried[chosen] } else { 1.0 };
        let followed =
            Followed::dielectric(self.relative_index[chosen], [self.reflectance, self.transmittance], self.facets);
        (followed, factor)
    }
}

impl<const C: usize> Followed<C> {
    /// The interface between two lossless media of a relative index, with further factors of the reflected and the
    /// transmitted share.
    pub fn dielectric(relative_index: f64, factors: [Colour<C>; 2], facets: Option<Facets>) -> Self {
        let [reflectance, transmittance] = factors;
        match facets {
            None => Followed::Specular(Specular::Dielectric { relative_index, reflectance, transmittance }),
            Some(facets) => Followed::Rough(Rough {
                facets,
                material: FacetMaterial::Dielectric { relative_index, reflectance, transmittance },
            }),
        }
    }

    /// Draws how light goes on from a hit; `None` where it is lost.
    pub fn draw(&self, ray: &Ray, hit: &Hit, stream: &mut Stream) -> Option<Onward<C>> {
        match self {
            Followed::Specular(specular) => specular.draw(ray, hit, stream),
            Followed::Rough(rough) => {
                let normals = hit.facing_normals();
                let frame = Frame::around(normals.shading);
                let w = frame.local(-ray.direction);
                if w.z <= 0.0 {
                    return None;
                }
                let drawn = rough.draw(w, [stream.next(), stream.next(), stream.next()])?;
                let onward = Onward {
                    ray: Ray::new(hit.point.position, frame.world(drawn.v)),
                    share: drawn.share,
                    compression: drawn.compression,
                    tilt: 1.0,
                    pdf_solid_angle: Some(rough.pdf_solid_angle(w, drawn.v)),
                    straight: false,
                };
                onward.on_the_right_side(ray, &normals)
            }
        }
    }

    /// What radiance from `direction` contributes to radiance back along the ray, per solid angle, the cosine included;
    /// and the density with which [`Followed::draw`] draws the direction. `None` for directions of finite probability.
    pub fn eval(&self, ray: &Ray, hit: &Hit, direction: DVec3) -> Option<(Colour<C>, f64)> {
        let Followed::Rough(rough) = self else { return None };
        let normals = hit.facing_normals();
        let frame = Frame::around(normals.shading);
        let (w, v) = (frame.local(-ray.direction), frame.local(direction));
        let beyond = direction.dot(normals.geometric);
        if w.z <= 0.0 || v.z * beyond <= 0.0 {
            return Some((Colour::ZERO, 0.0));
        }
        Some((rough.eval(w, v), rough.pdf_solid_angle(w, v)))
    }
}
