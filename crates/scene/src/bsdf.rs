//! What surfaces do to light.

use photonlab_photometry::Spectrum;

use crate::Index;

/// What a surface does to light.
#[derive(Clone, Debug, PartialEq)]
pub enum Bsdf {
    /// Lambertian on the front side; the back absorbs.
    Diffuse {
        /// Reflected share, in [0, 1].
        reflectance: Spectrum,
    },
    /// Lambertian reflection and transmission, the same from either side (extension `diffusetransmitter`).
    Transmitter {
        /// Share reflected to the side from which light comes.
        reflectance: Spectrum,
        /// Share that leaves on the other side; with `reflectance` at most 1 in each channel.
        transmittance: Spectrum,
    },
    /// Lambertian body under a smooth coat, front side only (Mitsuba `plastic`).
    Plastic {
        /// Reflected share of what the body scatters once, each channel in [0, 1].
        reflectance: Spectrum,
        /// Further factor of the coat's own reflection, each channel in [0, 1].
        specular_reflectance: Spectrum,
        /// Index of the coat over that before it.
        relative_index: f64,
        /// True if light that the coat sends back into the body is coloured by it again each time.
        nonlinear: bool,
    },
    /// Interface between two lossless media (Fresnel, unpolarised), smooth or of microfacets.
    Dielectric(Dielectric),
    /// Thin plate of a lossless medium: all reflections between its two faces, no displacement.
    ThinDielectric {
        /// Index of the plate over that around it.
        relative_index: f64,
        /// Further factors of the reflected and the transmitted share.
        specular: [Spectrum; 2],
    },
    /// Mirror on the front side; the back absorbs.
    Mirror {
        /// Reflected share, in [0, 1].
        reflectance: Spectrum,
    },
    /// Metal on the front side, smooth or of microfacets; the back absorbs.
    Conductor(Conductor),
    /// A different surface on each side (Mitsuba `twosided`).
    TwoSided {
        /// The side of the normal; never itself two-sided.
        front: Box<Bsdf>,
        /// The other side, seen from there; never itself two-sided.
        back: Box<Bsdf>,
    },
    /// A surface with holes too small to see (Mitsuba `mask`).
    Mask {
        /// Share of light that meets the surface; the rest goes on unchanged.
        opacity: f64,
        /// The surface; never itself a mask.
        surface: Box<Bsdf>,
    },
    /// No surface at all: light goes on unchanged, which is no bounce.
    Null,
}

/// An interface between two lossless media.
#[derive(Clone, Debug, PartialEq)]
pub struct Dielectric {
    /// Index on the side opposite to the normal.
    pub interior_index: Index,
    /// Index on the side of the normal.
    pub exterior_index: Index,
    /// Further factors of the reflected and the transmitted share, each channel in [0, 1].
    pub specular: [Spectrum; 2],
    /// `None` if smooth.
    pub roughness: Option<Roughness>,
}

/// The surface of a metal.
#[derive(Clone, Debug, PartialEq)]
pub struct Conductor {
    /// Real part of the index over that before the metal.
    pub eta: Spectrum,
    /// Imaginary part.
    pub k: Spectrum,
    /// Further factor of the reflected share, each channel in [0, 1].
    pub specular_reflectance: Spectrum,
    /// `None` if smooth.
    pub roughness: Option<Roughness>,
}

/// How microfacets lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Their distribution.
    pub facets: Microfacets,
    /// Root of the mean square slope (Beckmann) or its like (GGX), positive.
    pub alpha: f64,
}

/// Distributions of microfacet normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Microfacets {
    /// Trowbridge and Reitz.
    Ggx,
    /// Gaussian slopes.
    Beckmann,
}

impl Bsdf {
    /// Every spectrum of it.
    pub fn spectra(&self) -> Vec<&Spectrum> {
        match self {
            Bsdf::Diffuse { reflectance } | Bsdf::Mirror { reflectance } => vec![reflectance],
            Bsdf::Transmitter { reflectance, transmittance } => vec![reflectance, transmittance],
            Bsdf::Plastic { reflectance, specular_reflectance, .. } => vec![reflectance, specular_reflectance],
            Bsdf::Dielectric(Dielectric { specular, .. }) | Bsdf::ThinDielectric { specular, .. } => {
                specular.iter().collect()
            }
            Bsdf::Conductor(metal) => vec![&metal.eta, &metal.k, &metal.specular_reflectance],
            Bsdf::TwoSided { front, back } => [front.spectra(), back.spectra()].concat(),
            Bsdf::Mask { surface, .. } => surface.spectra(),
            Bsdf::Null => Vec::new(),
        }
    }

    /// The refractive indices on its sides, where they may differ with the wavelength.
    pub fn indices(&self) -> Vec<&Index> {
        match self {
            Bsdf::Dielectric(glass) => vec![&glass.interior_index, &glass.exterior_index],
            Bsdf::Mask { surface, .. } => surface.indices(),
            _ => Vec::new(),
        }
    }

    /// True if it refracts wavelengths differently.
    pub fn disperses(&self) -> bool {
        self.indices().into_iter().any(Index::disperses)
    }

    /// True if light can leave it in directions of a lobe or a line: by mirror reflection, refraction or microfacets.
    pub fn is_specular(&self) -> bool {
        match self {
            Bsdf::Diffuse { .. } | Bsdf::Transmitter { .. } | Bsdf::Null => false,
            Bsdf::Plastic { specular_reflectance, .. } => !specular_reflectance.is_black(),
            Bsdf::Dielectric(_) | Bsdf::ThinDielectric { .. } => true,
            Bsdf::Mirror { reflectance } => !reflectance.is_black(),
            Bsdf::Conductor(metal) => !metal.specular_reflectance.is_black(),
            Bsdf::TwoSided { front, back } => front.is_specular() || back.is_specular(),
            Bsdf::Mask { surface, .. } => surface.is_specular(),
        }
    }

    /// True if light can leave it in all directions.
    pub fn is_diffuse(&self) -> bool {
        match self {
            Bsdf::Diffuse { reflectance } | Bsdf::Plastic { reflectance, .. } => !reflectance.is_black(),
            Bsdf::Transmitter { reflectance, transmittance } => !reflectance.is_black() || !transmittance.is_black(),
            Bsdf::Dielectric(_)
            | Bsdf::ThinDielectric { .. }
            | Bsdf::Mirror { .. }
            | Bsdf::Conductor(_)
            | Bsdf::Null => false,
            Bsdf::TwoSided { front, back } => front.is_diffuse() || back.is_diffuse(),
            Bsdf::Mask { surface, .. } => surface.is_diffuse(),
        }
    }

    /// True if a ray may go straight through it unchanged.
    pub fn lets_through(&self) -> bool {
        matches!(self, Bsdf::Null | Bsdf::Mask { .. })
    }

    /// True if light can pass from one side to the other.
    pub fn joins_its_sides(&self) -> bool {
        match self {
            Bsdf::Transmitter { .. } | Bsdf::Dielectric(_) | Bsdf::ThinDielectric { .. } | Bsdf::Null => true,
            Bsdf::Mask { .. } => true,
            Bsdf::Diffuse { .. }
            | Bsdf::Plastic { .. }
            | Bsdf::Mirror { .. }
            | Bsdf::Conductor(_)
            | Bsdf::TwoSided { .. } => false,
        }
    }
}
