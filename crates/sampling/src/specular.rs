//! Smooth surfaces: one or two directions with finite probability.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Hit, Ray};

use crate::{
    Onward, Stream,
    fresnel::{fresnel_conductor, fresnel_dielectric, refracted},
};

/// Specular interactions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Specular<const C: usize> {
    /// Mirror reflection.
    Mirror {
        /// Reflected share.
        reflectance: Colour<C>,
    },
    /// Reflection by Fresnel's formulae for a metal, unpolarised.
    Conductor {
        /// Real part of the index.
        eta: Colour<C>,
        /// Imaginary part of the index.
        k: Colour<C>,
        /// Further factor.
        reflectance: Colour<C>,
    },
    /// Reflection or refraction by Fresnel's formulae, unpolarised.
    Dielectric {
        /// Index on the far side over the index on the side of the hit.
        relative_index: f64,
        /// Further factor of the reflected share.
        reflectance: Colour<C>,
        /// Further factor of the transmitted share.
        transmittance: Colour<C>,
    },
    /// A thin plate: all reflections between its faces, light passes straight.
    Thin {
        /// Index of the plate over that around it.
        relative_index: f64,
        /// Further factor of the reflected share.
        reflectance: Colour<C>,
        /// Further factor of the transmitted share.
        transmittance: Colour<C>,
    },
}

impl<const C: usize> Specular<C> {
    /// Draws how the ray goes on from a hit; `None` where the smooth surface that a mesh stands for sends it to the wrong side of
    /// the mesh, where it is lost.
    pub fn draw(&self, ray: &Ray, hit: &Hit, stream: &mut Stream) -> Option<Onward<C>> {
        let normals = hit.facing_normals();
        let normal = normals.shading;
        let cosine = -ray.direction.dot(normal);
        if cosine < 0.0 {
            return None;
        }
        let mirrored = (ray.direction + 2.0 * cosine * normal).normalize();
        let onward = self.drawn(ray, hit, (normal, cosine, mirrored), stream);
        onward.on_the_right_side(ray, &normals)
    }

    fn drawn(
        &self,
        ray: &Ray,
        hit: &Hit,
        (normal, cosine, mirrored): (DVec3, f64, DVec3),
        stream: &mut Stream,
    ) -> Onward<C> {
        let to = |direction, share, compression| Onward {
            ray: Ray::new(hit.point.position, direction),
            share,
            compression,
            tilt: 1.0,
            pdf_solid_angle: None,
            straight: false,
        };
        match *self {
            Specular::Mirror { reflectance } => to(mirrored, reflectance, 1.0),
            Specular::Conductor { eta, k, reflectance } => {
                let fresnel = Colour(std::array::from_fn(|c| fresnel_conductor(cosine, eta[c], k[c])));
                to(mirrored, reflectance * fresnel, 1.0)
            }
            Specular::Dielectric { relative_index, reflectance, transmittance } => {
                let (reflected, cosine_beyond) = fresnel_dielectric(cosine, relative_index);
                if stream.next() < reflected {
                    return to(mirrored, reflectance, 1.0);
                }
                let direction = refracted(ray.direction, normal, cosine, cosine_beyond, relative_index);
                to(direction, transmittance, 1.0 / (relative_index * relative_index))
            }
            Specular::Thin { relative_index, reflectance, transmittance } => {
                if stream.next() < reflected_by_plate(cosine, relative_index) {
                    to(mirrored, reflectance, 1.0)
                } else {
                    Onward { straight: true, ..to(ray.direction, transmittance, 1.0) }
                }
            }
        }
    }

    /// The share of light along a ray that goes on straight from a hit: zero but for thin plates.
    pub(crate) fn straight(&self, ray: &Ray, hit: &Hit) -> Colour<C> {
        let Specular::Thin { relative_index, transmittance, .. } = *self else { return Colour::ZERO };
        let normals = hit.facing_normals();
        let cosine = -ray.direction.dot(normals.shading);
        if cosine < 0.0 || normals.tilt(-ray.direction) == 0.0 {
            return Colour::ZERO;
        }
        transmittance * (1.0 - reflected_by_plate(cosine, relative_index))
    }
}

/// R + T R T + T R^3 T + ... with R at one face, the same at both.
fn reflected_by_plate(cosine: f64, relative_index: f64) -> f64 {
    let (face, _) = fresnel_dielectric(cosine, relative_index);
    2.0 * face / (1.0 + face)
}
