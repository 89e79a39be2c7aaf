//! Surfaces that light leaves in all directions: Lambertian ones, bare, letting light through, or under a smooth coat.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_scene::{Hit, Normals, Ray};

use crate::{
    Stream,
    fresnel::{diffuse_fresnel, fresnel_dielectric},
    warp,
};

/// A Lambertian body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matte<const C: usize> {
    /// Share of the light that enters the body and leaves it again on the side where it came from.
    reflectance: Colour<C>,
    /// The same for the other side.
    transmittance: Colour<C>,
    coat: Option<Coat<C>>,
}

/// A smooth interface over the body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coat<const C: usize> {
    relative_index: f64,
    reflectance: Colour<C>,
}

/// The light that an eye sees of a matte surface: `factor` / pi times the irradiance on the side of `normals`, by the cosine to
/// the shading one, each direction of which counts with [`Sight::weight`].
#[derive(Clone, Copy, Debug)]
pub struct Sight<const C: usize> {
    /// Of the side whose light is seen.
    pub normals: Normals,
    /// Reflectance or transmittance, what was drawn against divided out.
    pub factor: Colour<C>,
    /// The medium on that side; index into [`Scene::media`](photonlab_scene::Scene::media).
    pub medium: Option<u32>,
    /// Relative index of the coat that light passes on its way in, and the reciprocal of its share of diffuse light.
    coat: Option<(f64, f64)>,
}

impl<const C: usize> Sight<C> {
    /// A meter: all light that arrives at the surface itself counts alike.
    pub fn meter(normal: DVec3, medium: Option<u32>) -> Self {
        Self { normals: Normals::flat(normal), factor: Colour::ONE, medium, coat: None }
    }

    /// Weight of light that arrives under a cosine: the share that passes the coat, over its mean for diffuse light.
    #[inline]
    pub fn weight(&self, cosine: f64) -> f64 {
        self.coat
            .map_or(1.0, |(index, over_mean)| (1.0 - fresnel_dielectric(cosine.clamp(0.0, 1.0), index).0) * over_mean)
    }

    /// What a photon that lies near counts: it came from a direction and is flux per area of a surface of its own normal.
    pub fn weight_of_flux(&self, from: DVec3, normal: DVec3) -> f64 {
        if self.normals.geometric == self.normals.shading {
            return self.weight(from.dot(self.normals.geometric));
        }
        let (cosine, own) = (from.dot(self.normals.shading), from.dot(normal));
        if cosine > 0.0 && own > 0.0 { self.weight(cosine) * cosine / own } else { 0.0 }
    }

    /// True if all photons count one.
    pub fn is_plain(&self) -> bool {
        self.coat.is_none() && self.normals.geometric == self.normals.shading
    }
}

impl<const C: usize> Matte<C> {
    /// Plain Lambertian reflection.
    pub fn bare(reflectance: Colour<C>) -> Self {
        Self { reflectance, transmittance: Colour::ZERO, coat: None }
    }

    /// Lambertian reflection and transmission.
    pub fn transmitting(reflectance: Colour<C>, transmittance: Colour<C>) -> Self {
        Self { reflectance, transmittance, coat: None }
    }

    /// A body of a single-scattering reflectance under a coat: light that the coat keeps inside meets the body again, which
    /// colours it each time if `nonlinear` (Mitsuba's `plastic`). What leaves again of all that entered is r (1 - f) /
    /// (1 - r f), or r without `nonlinear`, with f the share that the coat reflects of diffuse light from below.
    pub fn coated(reflectance: Colour<C>, specular: Colour<C>, relative_index: f64, nonlinear: bool) -> Self {
        let inside = diffuse_fresnel(1.0 / relative_index);
        let leaves = |r: f64| if nonlinear { r * (1.0 - inside) / (1.0 - r * inside) } else { r };
        Self {
            reflectance: reflectance.map(leaves),
            transmittance: Colour::ZERO,
            coat: Some(Coat { relative_index, reflectance: specular }),
        }
    }

    /// Whether the coat mirrors a ray that arrives under a cosine; always `false`, and no number drawn, without a coat.
    fn coat_mirrors(&self, cosine: f64, stream: &mut Stream) -> bool {
        self.coat.is_some_and(|coat| stream.next() < fresnel_dielectric(cosine, coat.relative_index).0)
    }

    /// Draws whether light that arrived along a ray is mirrored by the coat, and the share of it that goes on.
    pub fn enter(&self, ray: &Ray, hit: &Hit, stream: &mut Stream) -> (bool, Colour<C>) {
        let cosine = hit.facing_normals().cosine(-ray.direction);
        match &self.coat {
            Some(coat) if self.coat_mirrors(cosine, stream) => (true, coat.reflectance),
            _ => (false, self.reflectance + self.transmittance),
        }
    }

    /// True if no light at all is lost in the body.
    pub fn is_lossless(&self) -> bool {
        self.reflectance + self.transmittance == Colour::ONE
    }

    /// Draws the side on which light leaves the body: `true` for the other one; and the factor that makes up for the draw.
    pub fn side(&self, stream: &mut Stream) -> (bool, Colour<C>) {
        let (back, beyond) = (self.reflectance, self.transmittance);
        if beyond.is_zero() {
            return (false, Colour::ONE);
        }
        let crossing = beyond.max() / (beyond.max() + back.max());
        let crosses = stream.next() < crossing;
        let (chosen, probability) = if crosses { (beyond, crossing) } else { (back, 1.0 - crossing) };
        let whole = back + beyond;
        let factor = |c: usize| if whole[c] > 0.0 { chosen[c] / (whole[c] * probability) } else { 0.0 };
        (crosses, Colour(std::array::from_fn(factor)))
    }

    /// Draws the direction in which light leaves the body on the side of `normals`, and the factor of flux that makes up for
    /// the draw, one on a flat surface: of a bare body by the cosine to the surface itself, under a coat by that to the smooth
    /// surface and the share that the coat lets out. `None` where it leaves beyond either horizon and is lost.
    pub fn leave(&self, normals: &Normals, stream: &mut Stream) -> Option<(DVec3, f64)> {
        if self.coat.is_none() {
            let direction = warp::square_to_cosine_hemisphere(stream.next2(), normals.geometric);
            return (normals.cosine(direction) > 0.0).then_some((direction, 1.0));
        }
        loop {
            let direction = warp::square_to_cosine_hemisphere(stream.next2(), normals.shading);
            let kept = self.coat_mirrors(direction.dot(normals.shading).min(1.0), stream);
            if !kept {
                let tilt = normals.tilt(direction);
                return (tilt > 0.0).then_some((direction, 1.0 / tilt));
            }
        }
    }

    /// The direction in which the coat mirrors a ray, with the factor of flux; `None` if that is into the surface.
    pub fn mirrored(ray: &Ray, hit: &Hit) -> Option<(Ray, f64)> {
        let normals = hit.facing_normals();
        let cosine = -ray.direction.dot(normals.shading);
        let direction = (ray.direction + 2.0 * cosine * normals.shading).normalize();
        let tilts = [-ray.direction, direction].map(|direction| normals.tilt(direction));
        tilts.iter().all(|tilt| *tilt > 0.0).then(|| (Ray::new(hit.point.position, direction), tilts[0] / tilts[1]))
    }

    /// What an eye that looks along a ray sees: the coat's reflection, which goes on, or light of one side of the body. The
    /// media on the eye's side and on the other are given.
    pub fn look(
        &self,
        ray: &Ray,
        hit: &Hit,
        media: [Option<u32>; 2],
        stream: &mut Stream,
    ) -> Result<Sight<C>, Colour<C>> {
        let normals = hit.facing_normals();
        let cosine = normals.cosine(-ray.direction);
        if let Some(coat) = &self.coat
            && self.coat_mirrors(cosine, stream)
        {
            return Err(coat.reflectance);
        }
        let (crosses, factor) = self.side(stream);
        let coat = self.coat.map(|c| (c.relative_index, 1.0 / (1.0 - diffuse_fresnel(c.relative_index))));
        // The smooth surface may face away where the surface itself does not: it is black there.
        let seen = if cosine > 0.0 { self.reflectance + self.transmittance } else { Colour::ZERO };
        Ok(Sight {
            normals: if crosses { normals.turned() } else { normals },
            factor: seen * factor,
            medium: media[usize::from(crosses)],
            coat,
        })
    }
}
