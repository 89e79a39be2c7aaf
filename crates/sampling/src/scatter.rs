//! What happens to light at a surface.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Bsdf, Hit, Ray, World};

use crate::Stream;

/// What a surface does to light that arrives at a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interaction<const C: usize> {
    /// Everything ends here, and nothing is stored (the back of a one-sided coating).
    Absorbed,
    /// Lambertian reflection on the side of the hit.
    Diffuse {
        /// Reflected share.
        reflectance: Colour<C>,
    },
    /// One or two directions with finite probability.
    Specular(Specular<C>),
}

/// Specular interactions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Specular<const C: usize> {
    /// Mirror reflection.
    Mirror {
        /// Reflected share.
        reflectance: Colour<C>,
    },
    /// Reflection or refraction by Fresnel's formulae, unpolarised.
    Dielectric {
        /// Index on the far side over the index on the side of the hit.
        relative_index: f64,
    },
}

/// The interaction at a hit.
pub fn interaction<const C: usize>(world: &World, hit: &Hit) -> Interaction<C> {
    match world.coating(hit.point.primitive, hit.front) {
        None | Some(Bsdf::TwoSided { .. }) => Interaction::Absorbed,
        Some(Bsdf::Diffuse { reflectance }) => Interaction::Diffuse { reflectance: Colour::from_rgb(*reflectance) },
        Some(Bsdf::Mirror { reflectance }) => {
            Interaction::Specular(Specular::Mirror { reflectance: Colour::from_rgb(*reflectance) })
        }
        Some(Bsdf::Dielectric { interior_index, exterior_index }) => {
            let ratio = interior_index / exterior_index;
            let relative_index = if hit.front { ratio } else { 1.0 / ratio };
            Interaction::Specular(Specular::Dielectric { relative_index })
        }
    }
}

impl<const C: usize> Specular<C> {
    /// Draws how the ray goes on from a hit: the new ray, the factor of its flux, and the factor by which radiance seen
    /// along the reversed path differs from it (n1^2 / n2^2 when refracted; flux does not change there).
    pub fn follow(&self, ray: &Ray, hit: &Hit, stream: &mut Stream) -> (Ray, Colour<C>, f64) {
        let normal = hit.facing_normal();
        let cosine = -ray.direction.dot(normal);
        let mirrored = Ray::new(hit.point.position, (ray.direction + 2.0 * cosine * normal).normalize());
        match *self {
            Specular::Mirror { reflectance } => (mirrored, reflectance, 1.0),
            Specular::Dielectric { relative_index } => {
                let (reflected, cosine_beyond) = fresnel_dielectric(cosine, relative_index);
                if stream.next() < reflected {
                    return (mirrored, Colour::ONE, 1.0);
                }
                let direction = refracted(ray.direction, normal, cosine, cosine_beyond, relative_index);
                let compression = 1.0 / (relative_index * relative_index);
                (Ray::new(hit.point.position, direction), Colour::ONE, compression)
            }
        }
    }

    /// The largest share of light that goes on, over the channels.
    pub fn largest_share(&self) -> f64 {
        match self {
            Specular::Mirror { reflectance } => reflectance.max(),
            Specular::Dielectric { .. } => 1.0,
        }
    }
}

fn refracted(direction: DVec3, normal: DVec3, cosine: f64, cosine_beyond: f64, relative_index: f64) -> DVec3 {
    ((direction + cosine * normal) / relative_index - cosine_beyond * normal).normalize()
}

/// Share of unpolarised light that a smooth interface reflects, and the cosine of the refracted ray (zero under total
/// reflection). `cosine` is that of the incident ray, `relative_index` the far side's index over the near side's.
pub fn fresnel_dielectric(cosine: f64, relative_index: f64) -> (f64, f64) {
    let sine2_beyond = (1.0 - cosine * cosine).max(0.0) / (relative_index * relative_index);
    if sine2_beyond >= 1.0 {
        return (1.0, 0.0);
    }
    let beyond = (1.0 - sine2_beyond).sqrt();
    let s = (cosine - relative_index * beyond) / (cosine + relative_index * beyond);
    let p = (relative_index * cosine - beyond) / (relative_index * cosine + beyond);
    (0.5 * (s * s + p * p), beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fresnel_at_known_angles() {
        let (normal, _) = fresnel_dielectric(1.0, 1.5);
        assert!((normal - 0.04).abs() < 1e-12);
        // At Brewster's angle only the s component is reflected: ((n^2 - 1) / (n^2 + 1))^2 / 2.
        let brewster = (1.5f64).atan().cos();
        let (share, _) = fresnel_dielectric(brewster, 1.5);
        assert!((share - 0.5 * (1.25f64 / 3.25).powi(2)).abs() < 1e-12);
        assert_eq!(fresnel_dielectric(0.5, 1.0 / 1.5).0, 1.0);
        assert_eq!(fresnel_dielectric(0.0, 1.5).0, 1.0);
    }

    #[test]
    fn fresnel_is_the_same_from_both_sides() {
        for i in 1..100 {
            let cosine = f64::from(i) / 100.0;
            let (share, beyond) = fresnel_dielectric(cosine, 1.5);
            let (back, cosine_back) = fresnel_dielectric(beyond, 1.0 / 1.5);
            assert!((share - back).abs() < 1e-12 && (cosine_back - cosine).abs() < 1e-12);
        }
    }
}
