//! Rough surfaces of microfacets: single scattering with separable masking (Walter et al., "Microfacet models for
//! refraction through rough surfaces", EGSR 2007).
//!
//! Directions are in the local frame of the side on which `w` lies: z along that side's normal; both point away from the
//! surface. Light that would scatter between facets more than once is lost, as in every single-scattering model.

use glam::DVec3;
use photonlab_photometry::Colour;

use crate::{
    Facets,
    fresnel::{fresnel_conductor, fresnel_dielectric, refracted},
};

/// What the facets are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FacetMaterial<const C: usize> {
    /// Metal.
    Conductor {
        /// Real part of the index.
        eta: Colour<C>,
        /// Imaginary part of the index.
        k: Colour<C>,
        /// Further factor of the reflected share.
        reflectance: Colour<C>,
    },
    /// Glass.
    Dielectric {
        /// Index on the far side over the index on the side of `w`.
        relative_index: f64,
        /// Further factor of the reflected share.
        reflectance: Colour<C>,
        /// Further factor of the transmitted share.
        transmittance: Colour<C>,
    },
}

/// A rough surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rough<const C: usize> {
    /// How its facets lie.
    pub facets: Facets,
    /// What they are made of.
    pub material: FacetMaterial<C>,
}

/// One direction in which light goes on, drawn.
#[derive(Clone, Copy, Debug)]
pub struct RoughDraw<const C: usize> {
    /// Away from the surface.
    pub v: DVec3,
    /// Share of the flux that goes on, at most one.
    pub share: Colour<C>,
    /// Radiance seen along the reversed path over the flux share: n1^2 / n2^2 where light is refracted, else 1.
    pub compression: f64,
}

impl<const C: usize> Rough<C> {
    /// Draws how light that came from `w` goes on; `None` where it is lost between facets.
    pub fn draw(&self, w: DVec3, xi: [f64; 3]) -> Option<RoughDraw<C>> {
        let m = self.facets.draw_visible(w, [xi[0], xi[1]]);
        let cosine = w.dot(m);
        let mirrored = 2.0 * cosine * m - w;
        let (v, tint) = match &self.material {
            FacetMaterial::Conductor { .. } => (mirrored, self.tint(cosine, false)),
            FacetMaterial::Dielectric { relative_index, .. } => {
                let (reflected, beyond) = fresnel_dielectric(cosine, *relative_index);
                if xi[2] < reflected {
                    (mirrored, self.tint(cosine, false))
                } else {
                    (refracted(-w, m, cosine, beyond, *relative_index), self.tint(cosine, true))
                }
            }
        };
        let passed = v.z < 0.0;
        let on_its_side = passed == (v.dot(m) < 0.0);
        (on_its_side && v.z != 0.0).then(|| RoughDraw {
            v,
            share: tint * self.facets.unmasked(v),
            compression: self.compression(passed),
        })
    }

    /// Density per solid angle of [`Rough::draw`].
    pub fn pdf_solid_angle(&self, w: DVec3, v: DVec3) -> f64 {
        self.lobe(w, v).map_or(0.0, |(pdf, _)| pdf)
    }

    /// What radiance from `v` contributes to radiance towards `w`, per solid angle, the cosine included: its integral over
    /// `v` is the share seen.
    pub fn eval(&self, w: DVec3, v: DVec3) -> Colour<C> {
        self.lobe(w, v)
            .map_or(Colour::ZERO, |(pdf, tint)| tint * (pdf * self.facets.unmasked(v) * self.compression(v.z < 0.0)))
    }

    /// Radiance seen through an interface over the flux share of the reversed path: n1^2 / n2^2 where it passes.
    fn compression(&self, passed: bool) -> f64 {
        match self.material {
            FacetMaterial::Dielectric { relative_index, .. } if passed => 1.0 / (relative_index * relative_index),
            _ => 1.0,
        }
    }

    /// Density and tint of a pair of directions; `None` if no facet joins them.
    fn lobe(&self, w: DVec3, v: DVec3) -> Option<(f64, Colour<C>)> {
        let passed = v.z < 0.0;
        match &self.material {
            FacetMaterial::Conductor { .. } if passed => None,
            FacetMaterial::Dielectric { relative_index, .. } if passed => {
                let eta = *relative_index;
                let half = w + eta * v;
                let m = if half.z < 0.0 { -half.normalize() } else { half.normalize() };
                let (near, far) = (w.dot(m), v.dot(m));
                if near <= 0.0 || far >= 0.0 || !m.is_finite() {
                    return None;
                }
                let (reflected, _) = fresnel_dielectric(near, eta);
                let jacobian = eta * eta * -far / (near + eta * far).powi(2);
                Some(((1.0 - reflected) * self.facets.visible_pdf(w, m) * jacobian, self.tint(near, true)))
            }
            material => {
                let m = (w + v).normalize();
                let cosine = w.dot(m);
                if cosine <= 0.0 || !m.is_finite() {
                    return None;
                }
                let chosen = match material {
                    FacetMaterial::Conductor { .. } => 1.0,
                    FacetMaterial::Dielectric { relative_index, .. } => fresnel_dielectric(cosine, *relative_index).0,
                };
                Some((chosen * self.facets.visible_pdf(w, m) / (4.0 * cosine), self.tint(cosine, false)))
            }
        }
    }

    /// The share that a facet hands on beyond what its draw decides.
    fn tint(&self, cosine: f64, passed: bool) -> Colour<C> {
        match &self.material {
            FacetMaterial::Conductor { eta, k, reflectance } => {
                let fresnel = Colour(std::array::from_fn(|c| fresnel_conductor(cosine, eta[c], k[c])));
                *reflectance * fresnel
            }
            FacetMaterial::Dielectric { reflectance, transmittance, .. } => {
                if passed {
                    *transmittance
                } else {
                    *reflectance
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Purpose, Stream, warp};
    use photonlab_scene::{Microfacets, Roughness};

    fn glass(facets: Microfacets, alpha: f64, relative_index: f64) -> Rough<1> {
        let material =
            FacetMaterial::Dielectric { relative_index, reflectance: Colour::ONE, transmittance: Colour::ONE };
        Rough { facets: Facets::new(Roughness { facets, alpha }), material }
    }

    fn cases() -> impl Iterator<Item = (Rough<1>, DVec3)> {
        let each = [Microfacets::Ggx, Microfacets::Beckmann]
            .into_iter()
            .flat_map(|f| [(0.1, 1.5), (0.5, 1.5), (0.3, 1.0 / 1.5)].map(|(alpha, n)| glass(f, alpha, n)));
        each.flat_map(|rough| [0.1f64, 0.9, 1.4].map(|t| (rough, DVec3::new(t.sin(), 0.0, t.cos()))))
    }

    /// Draws against the density by the mean of test functions: share reflected, and first
    /// moments on either side, each from draws and from uniform directions weighted by the density. 18 cases of 4 at
    /// |z| < 5: false alarm 4e-5 in all.
    #[test]
    fn draws_follow_their_density() {
        let mut stream = Stream::new(17, Purpose::Synthetic, 0, 0);
        let n = 200_000;
        for (rough, w) in cases() {
            let tests: [fn(DVec3) -> f64; 4] = [
                |v| f64::from(u8::from(v.z > 0.0)),
                |v| v.x * f64::from(u8::from(v.z > 0.0)),
                |v| v.x * f64::from(u8::from(v.z < 0.0)),
                |v| v.z.min(0.0),
            ];
            for test in tests {
                let (mut drawn, mut weighed) = ([0.0; 2], [0.0; 2]);
                let add = |sums: &mut [f64; 2], x: f64| {
                    sums[0] += x;
                    sums[1] += x * x;
                };
                for _ in 0..n {
                    let xi = [stream.next(), stream.next(), stream.next()];
                    add(&mut drawn, rough.draw(w, xi).map_or(0.0, |d| test(d.v)));
                    let v = warp::square_to_uniform_sphere(stream.next2());
                    add(&mut weighed, test(v) * rough.pdf_solid_angle(w, v) * 4.0 * std::f64::consts::PI);
                }
                let mean = |s: [f64; 2]| s[0] / f64::from(n);
                let error2 = |s: [f64; 2]| (s[1] / f64::from(n) - mean(s).powi(2)) / f64::from(n);
                let z = (mean(drawn) - mean(weighed)) / (error2(drawn) + error2(weighed)).sqrt().max(1e-12);
                assert!(z.abs() < 5.0, "{rough:?} {w}: {} {} z {z}", mean(drawn), mean(weighed));
            }
        }
    }

    /// Reciprocity: f(w, v) / n^2 is symmetric, with the frame turned to v's side where light passes.
    #[test]
    fn scattering_is_reciprocal() {
        let mut stream = Stream::new(3, Purpose::Synthetic, 0, 0);
        let mut joined = 0;
        for (rough, w) in cases() {
            let FacetMaterial::Dielectric { relative_index, .. } = rough.material else { unreachable!() };
            for _ in 0..2000 {
                let v = warp::square_to_uniform_sphere(stream.next2());
                let there = rough.eval(w, v)[0] / v.z.abs();
                let back = if v.z > 0.0 {
                    rough.eval(v, w)[0] / w.z
                } else {
                    let other = Rough {
                        material: FacetMaterial::Dielectric {
                            relative_index: 1.0 / relative_index,
                            reflectance: Colour::ONE,
                            transmittance: Colour::ONE,
                        },
                        ..rough
                    };
                    let turned = |d: DVec3| DVec3::new(d.x, d.y, -d.z);
                    other.eval(turned(v), turned(w))[0] / w.z / (relative_index * relative_index)
                };
                joined += usize::from(there > 0.0);
                // Rounding of the half vector is absolute: what matters is small against a lobe's height of about one.
                assert!((there - back).abs() <= 1e-9 * there.max(1.0), "{rough:?} {w} {v}: {there} {back}");
            }
        }
        assert!(joined > 10_000);
    }
}
