//! Lamps without a surface.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use photonlab_photometry::Spectrum;

use crate::Sky;
use crate::luminaire::IntensityTable;

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
        intensity: Spectrum,
        /// How the intensity depends on direction.
        pattern: Pattern,
        /// The medium in which it stands; index into [`Scene::media`](crate::Scene::media).
        medium: Option<u32>,
    },
    /// Parallel light from infinity.
    Directional {
        /// The `id` of the file, or `emitter-N`.
        id: String,
        /// Unit vector along which the light travels.
        direction: DVec3,
        /// Irradiance on a plane across the direction, W/m^2 or lx.
        irradiance: Spectrum,
    },
    /// Light from all directions, from infinity; at most one in a scene.
    Environment {
        /// The `id` of the file, or `emitter-N`.
        id: String,
        /// Its radiance by direction.
        light: EnvironmentLight,
        /// Rectangles without a coating in the openings through which it is sought first, normals along the light's way
        /// (extension `portal`): indices into [`Scene::shapes`](crate::Scene::shapes).
        portals: Vec<usize>,
    },
}

impl Emitter {
    /// True if it emits nothing.
    pub fn is_black(&self) -> bool {
        match self {
            Emitter::Point { intensity, .. } => intensity.is_black(),
            Emitter::Directional { irradiance, .. } => irradiance.is_black(),
            Emitter::Environment { light, .. } => match light {
                EnvironmentLight::Constant { radiance } | EnvironmentLight::Sky { radiance, .. } => radiance.is_black(),
                EnvironmentLight::Map(map) => map.pixels.iter().all(|pixel| *pixel == [0.0; 3]),
            },
        }
    }
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
        radiance: Spectrum,
    },
    /// A sky by law (extension `sky`).
    Sky {
        /// Radiance at the zenith.
        radiance: Spectrum,
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
    /// A rotation, perhaps with a mirror, from the picture's own axes, in which the left edge looks along -z and columns turn towards +x.
    pub to_world: DMat3,
}

impl SkyMap {
    /// True if every pixel is grey.
    pub fn is_grey(&self) -> bool {
        self.pixels.iter().all(|p| p[0] == p[1] && p[1] == p[2])
    }
}

impl std::fmt::Debug for SkyMap {
    /// With a hash in place of the pixels: the debug form stands for the map's identity.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let bytes: Vec<u8> = self.pixels.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let hash = xxhash_rust::xxh3::xxh3_128(&bytes);
        write!(f, "SkyMap {{ {} x {}, {hash:x}, {:?} }}", self.width, self.height, self.to_world)
    }
}
