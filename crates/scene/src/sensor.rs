//! Receivers: cameras and meters.

use glam::{DAffine3, DMat3, DVec3};

/// A receiver and where it is.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// The `id` of the file, or `sensor-N` (N counted from 0 in the file's order).
    pub id: String,
    /// What it is.
    pub receiver: Receiver,
    /// Its cells.
    pub film: Film,
    /// The medium in which it stands, where no shape tells; index into [`Scene::media`](crate::Scene::media).
    pub medium: Option<u32>,
}

/// The kinds of receiver.
#[derive(Clone, Debug)]
pub enum Receiver {
    /// An image; for `render`.
    Camera(Camera),
    /// A number; for `measure`.
    Meter(Meter),
}

/// A camera with Mitsuba's conventions: it looks along +z, +x is to the left of the image, +y is up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// From camera space to the world (rotation and translation, possibly with scale; directions are normalised).
    pub to_world: DAffine3,
    /// Half the field of view along the image's width, as a tangent, for the film's own aspect ratio.
    pub tan_half_width: f64,
    /// Half the field of view along the image's height, as a tangent.
    pub tan_half_height: f64,
    /// What is added to a place on the film, right and down in parts of its width and height, before it is looked through
    /// (Mitsuba `principal_point_offset_x|y`): what is seen moves to the left and up.
    pub principal_point_offset: [f64; 2],
    /// Nothing nearer than this along the optical axis is seen, in metres.
    pub near_clip: f64,
    /// Nothing farther than this along the optical axis is seen, in metres.
    pub far_clip: f64,
    /// Its lens; a pinhole if `None`.
    pub lens: Option<Lens>,
}

/// A thin lens without a colour or an error: every point of its aperture sees the plane in focus alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of the aperture, around the camera's position across the optical axis, metres.
    pub aperture_radius: f64,
    /// Distance to the plane in focus along the optical axis, metres.
    pub focus_distance: f64,
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
    /// Mean radiance that leaves the scene against a direction (Mitsuba `distant`).
    Distant {
        /// Unit vector in which it looks.
        direction: DVec3,
        /// Where its rays go.
        target: DistantTarget,
    },
    /// Irradiance on the front side of a shape, one reading per cell of (u, v).
    Irradiancemeter {
        /// Index into [`Scene::shapes`](crate::Scene::shapes).
        shape: usize,
    },
    /// Flux that arrives on the front side of a shape, one reading per cell of (u, v) (extension).
    Fluxmeter {
        /// Index into [`Scene::shapes`](crate::Scene::shapes).
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
            Meter::Radiancemeter { .. } | Meter::Distant { .. } | Meter::Intensitymeter { .. } => None,
        }
    }
}

/// What a distant meter averages over, seen from outside the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DistantTarget {
    /// The cross-section of the scene's bounding sphere, around the middle of its bounding box.
    Whole,
    /// One point, metres.
    Point(DVec3),
    /// The area of a shape: an index into [`Scene::shapes`](crate::Scene::shapes). A shape that is a target alone has no
    /// coating, so that no ray notices it.
    Shape(usize),
}

/// The cells of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Film {
    /// Columns.
    pub width: u32,
    /// Rows; row 0 is the top of an image, and v = 0 of a meter.
    pub height: u32,
}
