//! What a scene file says, in world units, checked but not yet prepared for ray casting.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use photonlab_photometry::{Channels, UnitSystem};

use crate::luminaire::IntensityTable;
use crate::sky::Sky;

/// A colour as the file gives it; grey if its three numbers are equal. Unit: that of the parameter.
pub type Rgb = [f64; 3];

/// A whole scene: the promise of the door "file -> scene" is that nothing of the file was ignored in silence.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Shapes in the order of the file.
    pub shapes: Vec<Shape>,
    /// Lamps that are not shapes: point and directional. Area lamps are in [`Shape::radiance`].
    pub emitters: Vec<Emitter>,
    /// Sensors in the order of the file.
    pub sensors: Vec<Sensor>,
    /// Longest light path in segments, from the file's integrator (Mitsuba's `max_depth`); `None` is unlimited.
    pub max_depth: Option<u32>,
    /// Things the reader superseded, to be said once on standard error.
    pub notes: Vec<String>,
}

/// One surface with its coating.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The `id` of the file, or `shape-N` (N counted from 0 in the file's order).
    pub id: String,
    /// Where it is.
    pub geometry: Geometry,
    /// True if the file turned its normals around (`flip_normals`).
    pub flip_normals: bool,
    /// What happens to light there.
    pub bsdf: Bsdf,
    /// Emitted radiance of the front side, W/(m^2 sr) or cd/m^2, if it is an area lamp.
    pub radiance: Option<Rgb>,
}

/// The kinds of surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// The image of the square [-1, 1]^2 in the plane z = 0, normal +z (Mitsuba `rectangle`).
    Rectangle {
        /// From the unit square to the world, in metres; never singular.
        to_world: DAffine3,
    },
    /// The image of the cube [-1, 1]^3, normals outwards (Mitsuba `cube`).
    Cube {
        /// From the unit cube to the world, in metres; never singular.
        to_world: DAffine3,
    },
    /// A sphere, normals outwards.
    Sphere {
        /// Centre in metres.
        centre: DVec3,
        /// Radius in metres, positive.
        radius: f64,
        /// From the sphere's own axes, in which u is the azimuth from +x over 2 pi and v the angle from +z over pi.
        /// Orthonormal: a rotation, or a rotation and a mirror (determinant -1) where the file mirrors the sphere.
        to_world: DMat3,
    },
}

/// What a surface does to light.
#[derive(Clone, Debug, PartialEq)]
pub enum Bsdf {
    /// Lambertian on the front side; the back absorbs.
    Diffuse {
        /// Reflected share, each channel in [0, 1].
        reflectance: Rgb,
    },
    /// Lambertian reflection and transmission, the same from either side (extension `diffusetransmitter`).
    Transmitter {
        /// Share reflected to the side from which light comes.
        reflectance: Rgb,
        /// Share that leaves on the other side; with `reflectance` at most 1 in each channel.
        transmittance: Rgb,
    },
    /// Lambertian body under a smooth coat, front side only (Mitsuba `plastic`).
    Plastic {
        /// Reflected share of what the body scatters once, each channel in [0, 1].
        reflectance: Rgb,
        /// Further factor of the coat's own reflection, each channel in [0, 1].
        specular_reflectance: Rgb,
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
        specular: [Rgb; 2],
    },
    /// Mirror on the front side; the back absorbs.
    Mirror {
        /// Reflected share, each channel in [0, 1].
        reflectance: SpecularReflectance,
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Index on the side opposite to the normal.
    pub interior_index: f64,
    /// Index on the side of the normal.
    pub exterior_index: f64,
    /// Further factors of the reflected and the transmitted share, each channel in [0, 1].
    pub specular: [Rgb; 2],
    /// `None` if smooth.
    pub roughness: Option<Roughness>,
}

/// The surface of a metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Real part of the index over that before the metal, per channel.
    pub eta: Rgb,
    /// Imaginary part, per channel.
    pub k: Rgb,
    /// Further factor of the reflected share, each channel in [0, 1].
    pub specular_reflectance: Rgb,
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

/// Reflected share of a mirror.
pub type SpecularReflectance = Rgb;

/// Lamps without a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// Point source.
    Point {
        /// The `id` of the file, or `emitter-N`.
        id: String,
        /// Position in metres.
        position: DVec3,
        /// Radiant or luminous intensity where the pattern is 1, W/sr or cd.
        intensity: Rgb,
        /// How the intensity depends on direction.
        pattern: Pattern,
    },
    /// Parallel light from infinity.
    Directional {
        /// The `id` of the file, or `emitter-N`.
        id: String,
        /// Unit vector along which the light travels.
        direction: DVec3,
        /// Irradiance on a plane across the direction, W/m^2 or lx.
        irradiance: Rgb,
    },
    /// Light from all directions, from infinity; at most one in a scene.
    Environment {
        /// The `id` of the file, or `emitter-N`.
        id: String,
        /// Its radiance by direction.
        light: EnvironmentLight,
    },
}

/// How the intensity of a point source depends on direction, 1 in the brightest.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// The same in all directions.
    Isotropic,
    /// A power of the cosine to an axis (extension: `exponent` and `direction` of `point`).
    Cosine {
        /// Unit vector.
        axis: DVec3,
        /// At least 0.
        exponent: f64,
    },
    /// Even in a beam, then linear in the angle down to a cutoff (Mitsuba `spot`).
    Spot {
        /// Unit vector.
        axis: DVec3,
        /// Half-angle of the even beam in radians.
        beam: f64,
        /// Half-angle beyond which there is nothing, in radians, at least `beam`.
        cutoff: f64,
    },
    /// In proportion to a luminaire's table (extension `ies`).
    Table {
        /// Its intensities; the pattern is 1 at the brightest.
        table: Arc<IntensityTable>,
        /// A rotation from the lamp's own axes, which [`crate::luminaire`] explains.
        to_world: DMat3,
    },
}

/// Light from infinity by direction, W/(m^2 sr) or cd/m^2.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentLight {
    /// The same from everywhere (Mitsuba `constant`).
    Constant {
        /// Radiance.
        radiance: Rgb,
    },
    /// A sky by law (extension `sky`).
    Sky {
        /// Radiance at the zenith.
        radiance: Rgb,
        /// Relative luminance.
        sky: Sky,
    },
    /// A picture (Mitsuba `envmap`).
    Map(SkyMap),
}

/// A picture of all directions in azimuth (columns) and polar angle from local +y (rows), radiance.
#[derive(Clone, PartialEq)]
pub struct SkyMap {
    /// Columns.
    pub width: usize,
    /// Rows, from local +y down.
    pub height: usize,
    /// Row by row.
    pub pixels: Vec<[f32; 3]>,
    /// A rotation from the picture's own axes, in which the left edge looks along -z and columns turn towards +x.
    pub to_world: DMat3,
}

impl std::fmt::Debug for SkyMap {
    /// With a hash in place of the pixels: the debug form stands for the map's identity.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let bytes: Vec<u8> = self.pixels.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let hash = xxhash_rust::xxh3::xxh3_128(&bytes);
        write!(f, "SkyMap {{ {} x {}, {hash:x}, {:?} }}", self.width, self.height, self.to_world)
    }
}

/// A receiver and where it is.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// The `id` of the file, or `sensor-N` (N counted from 0 in the file's order).
    pub id: String,
    /// What it is.
    pub receiver: Receiver,
    /// Its cells.
    pub film: Film,
}

/// The kinds of receiver.
#[derive(Clone, Debug)]
pub enum Receiver {
    /// An image; for `render`.
    Camera(Camera),
    /// A number; for `measure`.
    Meter(Meter),
}

/// A pinhole camera with Mitsuba's conventions: it looks along +z, +x is to the left of the image, +y is up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// From camera space to the world (rotation and translation, possibly with scale; directions are normalised).
    pub to_world: DAffine3,
    /// Half the field of view along the image's width, as a tangent, for the film's own aspect ratio.
    pub tan_half_width: f64,
    /// Half the field of view along the image's height, as a tangent.
    pub tan_half_height: f64,
    /// Shift of the image's centre in parts of the film's width and height (Mitsuba `principal_point_offset_x|y`).
    pub principal_point_offset: [f64; 2],
    /// Nothing nearer than this along the optical axis is seen, in metres.
    pub near_clip: f64,
    /// Nothing farther than this along the optical axis is seen, in metres.
    pub far_clip: f64,
}

/// A meter.
#[derive(Clone, Debug, PartialEq)]
pub enum Meter {
    /// Radiance along one ray.
    Radiancemeter {
        /// Where the ray starts, metres.
        origin: DVec3,
        /// Unit vector in which it looks.
        direction: DVec3,
    },
    /// Irradiance on the front side of a shape, one reading per cell of (u, v).
    Irradiancemeter {
        /// Index into [`Scene::shapes`].
        shape: usize,
    },
    /// Flux that arrives on the front side of a shape, one reading per cell of (u, v) (extension).
    Fluxmeter {
        /// Index into [`Scene::shapes`].
        shape: usize,
    },
    /// Intensity of the light that leaves the scene, seen from infinity (extension). Cells in type C angles: columns along C
    /// from local +x towards +y, rows along gamma from local -z to +z.
    Intensitymeter {
        /// A rotation from the goniometer's axes.
        to_world: DMat3,
    },
}

impl Meter {
    /// The shape that it stands on, if any.
    pub fn shape(&self) -> Option<usize> {
        match self {
            Meter::Irradiancemeter { shape } | Meter::Fluxmeter { shape } => Some(*shape),
            Meter::Radiancemeter { .. } | Meter::Intensitymeter { .. } => None,
        }
    }
}

/// The cells of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Film {
    /// Columns.
    pub width: u32,
    /// Rows; row 0 is the top of an image, and v = 0 of a meter.
    pub height: u32,
}

impl Scene {
    /// One channel if every colour in the scene is grey, else three.
    pub fn channels(&self) -> Channels {
        let grey = |rgb: &Rgb| rgb[0] == rgb[1] && rgb[1] == rgb[2];
        let emitters_grey = self.emitters.iter().all(|emitter| match emitter {
            Emitter::Point { intensity, .. } => grey(intensity),
            Emitter::Directional { irradiance, .. } => grey(irradiance),
            Emitter::Environment { light, .. } => match light {
                EnvironmentLight::Constant { radiance } | EnvironmentLight::Sky { radiance, .. } => grey(radiance),
                EnvironmentLight::Map(map) => map.pixels.iter().all(|p| p[0] == p[1] && p[1] == p[2]),
            },
        });
        let shapes_grey =
            self.shapes.iter().all(|shape| shape.bsdf.is_grey() && shape.radiance.as_ref().is_none_or(grey));
        if emitters_grey && shapes_grey { Channels::Grey } else { Channels::Rgb }
    }

    /// True if the scene holds anything that emits.
    pub fn has_light(&self) -> bool {
        !self.emitters.is_empty() || self.shapes.iter().any(|shape| shape.radiance.is_some())
    }

    /// The unit system that the scene's numbers are read in unless the caller says otherwise.
    pub fn default_units(&self) -> UnitSystem {
        UnitSystem::Radiometric
    }
}

impl Bsdf {
    /// True if every colour of it is grey.
    fn is_grey(&self) -> bool {
        let grey = |rgb: &Rgb| rgb[0] == rgb[1] && rgb[1] == rgb[2];
        match self {
            Bsdf::Diffuse { reflectance } | Bsdf::Mirror { reflectance } => grey(reflectance),
            Bsdf::Transmitter { reflectance, transmittance } => grey(reflectance) && grey(transmittance),
            Bsdf::Plastic { reflectance, specular_reflectance, .. } => grey(reflectance) && grey(specular_reflectance),
            Bsdf::Dielectric(Dielectric { specular, .. }) | Bsdf::ThinDielectric { specular, .. } => {
                specular.iter().all(grey)
            }
            Bsdf::Conductor(metal) => [metal.eta, metal.k, metal.specular_reflectance].iter().all(grey),
            Bsdf::TwoSided { front, back } => front.is_grey() && back.is_grey(),
            Bsdf::Mask { surface, .. } => surface.is_grey(),
            Bsdf::Null => true,
        }
    }

    /// True if light can leave it in directions of a lobe or a line: by mirror reflection, refraction or microfacets.
    pub fn is_specular(&self) -> bool {
        match self {
            Bsdf::Diffuse { .. } | Bsdf::Transmitter { .. } | Bsdf::Null => false,
            Bsdf::Plastic { specular_reflectance, .. } => *specular_reflectance != [0.0; 3],
            Bsdf::Dielectric(_) | Bsdf::ThinDielectric { .. } => true,
            Bsdf::Mirror { reflectance } => *reflectance != [0.0; 3],
            Bsdf::Conductor(metal) => metal.specular_reflectance != [0.0; 3],
            Bsdf::TwoSided { front, back } => front.is_specular() || back.is_specular(),
            Bsdf::Mask { surface, .. } => surface.is_specular(),
        }
    }

    /// True if light can leave it in all directions.
    pub fn is_diffuse(&self) -> bool {
        match self {
            Bsdf::Diffuse { reflectance } | Bsdf::Plastic { reflectance, .. } => *reflectance != [0.0; 3],
            Bsdf::Transmitter { reflectance, transmittance } => *reflectance != [0.0; 3] || *transmittance != [0.0; 3],
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
