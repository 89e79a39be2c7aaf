//! What a scene file says, in world units, checked but not yet prepared for ray casting.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use photonlab_photometry::{Channels, Spectrum, UnitSystem, VISIBLE};

use crate::{Boundary, Bsdf, Emitter, EnvironmentLight, Frame, Medium, Mesh, Sensor};

/// A whole scene: the promise of the door "file -> scene" is that nothing of the file was ignored in silence.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Shapes in the order of the file.
    pub shapes: Vec<Shape>,
    /// Lamps that are not shapes: point and directional. Area lamps are in [`Shape::radiance`].
    pub emitters: Vec<Emitter>,
    /// Media in the order of the file.
    pub media: Vec<Medium>,
    /// Sensors in the order of the file.
    pub sensors: Vec<Sensor>,
    /// Longest light path in segments, from the file's integrator (Mitsuba's `max_depth`); `None` is unlimited.
    pub max_depth: Option<u32>,
    /// True if cameras see no lamp directly (Mitsuba `hide_emitters`): they look through shapes that shine, and before the
    /// environment all is black.
    pub hides_lamps: bool,
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
    /// The media that it parts, if it parts any.
    pub boundary: Option<Boundary>,
    /// Emitted radiance of the front side, W/(m^2 sr) or cd/m^2, if it is an area lamp.
    pub radiance: Option<Spectrum>,
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
    /// The image of the unit disk in the plane z = 0, normal +z (Mitsuba `disk`).
    Disk {
        /// From the unit disk to the world, in metres; never singular.
        to_world: DAffine3,
    },
    /// The wall of a circular cylinder without its ends, normals outwards.
    Cylinder {
        /// The middle of one end, and the axis as local +z.
        frame: Frame,
        /// Metres, positive.
        radius: f64,
        /// Metres, positive.
        length: f64,
    },
    /// Triangles.
    Mesh(Arc<Mesh>),
    /// The points z = (x^2 + y^2) / (4 f) of a frame, normals towards the focus (extension).
    Paraboloid {
        /// The vertex; local +z points to the focus.
        frame: Frame,
        /// f in metres, positive.
        focal_length: f64,
        /// Distance of the rim from the axis, metres, positive.
        rim: f64,
    },
    /// A lens, normals outwards (extension).
    Lens {
        /// The vertex of the first face; local +z points to that of the second.
        frame: Frame,
        /// Its faces.
        lens: LensBody,
    },
}

/// A body between two faces, each part of a sphere or flat, and a cylindrical rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensBody {
    /// Of the first and the second face, 1/m: positive if it opens towards local +z, zero if flat.
    pub curvatures: [f64; 2],
    /// Distance of the vertices, metres, positive.
    pub thickness: f64,
    /// Distance of the rim from the axis, metres, positive; the faces do not meet within it.
    pub rim: f64,
}

impl Scene {
    /// One channel if every colour in the scene is grey, else three; wavelengths if anything is given by wavelength or
    /// refracts by it.
    pub fn channels(&self) -> Channels {
        let media = || self.media.iter().flat_map(|medium| [&medium.sigma_t, &medium.albedo]);
        let surfaces = || self.shapes.iter().flat_map(|shape| shape.bsdf.spectra());
        let spectra = || self.emissions().into_iter().chain(surfaces()).chain(media());
        let map_is_grey = self.emitters.iter().all(|emitter| match emitter {
            Emitter::Environment { light: EnvironmentLight::Map(map), .. } => map.is_grey(),
            _ => true,
        });
        if spectra().any(Spectrum::is_curve) || self.shapes.iter().any(|shape| shape.bsdf.disperses()) {
            Channels::Spectral
        } else if map_is_grey && spectra().all(Spectrum::is_grey) {
            Channels::Grey
        } else {
            Channels::Rgb
        }
    }

    /// What each lamp emits, but for environment maps.
    pub fn emissions(&self) -> Vec<&Spectrum> {
        let surfaceless = self.emitters.iter().filter_map(|emitter| match emitter {
            Emitter::Point { intensity, .. } => Some(intensity),
            Emitter::Directional { irradiance, .. } => Some(irradiance),
            Emitter::Environment { light, .. } => match light {
                EnvironmentLight::Constant { radiance } | EnvironmentLight::Sky { radiance, .. } => Some(radiance),
                EnvironmentLight::Map(_) => None,
            },
        });
        surfaceless.chain(self.shapes.iter().filter_map(|shape| shape.radiance.as_ref())).collect()
    }

    /// The shortest and the longest wavelength that any lamp emits, nm: the visible ones, and those of lamps given by
    /// wavelength.
    pub fn band(&self) -> [f64; 2] {
        let ranges = self.emissions().into_iter().filter_map(|emission| match emission {
            Spectrum::Curve(curve) => Some(curve.range()),
            _ => None,
        });
        ranges.fold(VISIBLE, |band, range| [band[0].min(range[0]), band[1].max(range[1])])
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
