//! What is read: one pixel, or one cell of a meter.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};
use photonlab_photometry::Quantity;
use photonlab_scene::{Camera, DistantTarget, Film, Meter, Ray, Receiver, Scene, Sensor, World};

/// One place to read.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Index into [`Scene::sensors`].
    pub sensor: usize,
    /// Column and row.
    pub cell: [u32; 2],
    /// Where its light is sought.
    pub target: Target,
}

/// Where a cell's light is sought.
#[derive(Clone, Debug)]
pub enum Target {
    /// Radiance through a pixel.
    Pixel {
        /// The camera.
        camera: Camera,
        /// Columns and rows of the image.
        film: Film,
    },
    /// Radiance along a ray.
    Along(Ray),
    /// Mean radiance against a direction.
    Distant {
        /// Unit vector in which it looks.
        direction: DVec3,
        /// Where its rays go.
        target: DistantTarget,
    },
    /// Irradiance on a part of a shape's front side.
    Patch {
        /// Index into [`Scene::shapes`].
        shape: usize,
        /// Columns and rows of the shape's (u, v) square.
        film: Film,
        /// True if the flux is read, not the irradiance.
        flux: bool,
    },
    /// Intensity of what leaves the scene, in type C angles; counted alone.
    Leaving {
        /// A rotation from the goniometer's axes.
        to_world: DMat3,
        /// Columns along C, rows along gamma.
        film: Film,
    },
}

impl Cell {
    /// The cells of one sensor, row by row.
    pub fn of_sensor(scene: &Scene, index: usize) -> Vec<Cell> {
        let sensor = &scene.sensors[index];
        let film = sensor.film;
        (0..film.height)
            .flat_map(|row| (0..film.width).map(move |column| [column, row]))
            .map(|cell| Cell { sensor: index, cell, target: target(sensor) })
            .collect()
    }

    /// The cells of all meters.
    pub fn of_meters(scene: &Scene) -> Vec<Cell> {
        let meters = scene.sensors.iter().enumerate().filter(|(_, s)| matches!(s.receiver, Receiver::Meter(_)));
        meters.flat_map(|(index, _)| Cell::of_sensor(scene, index)).collect()
    }

    /// What irradiance is multiplied by to give the reading: the area in square metres of a cell whose flux is read.
    pub(crate) fn area_read(&self, world: &World) -> f64 {
        match self.target {
            Target::Patch { shape, film, flux: true } => world.cell_area(shape, self.cell, [film.width, film.height]),
            _ => 1.0,
        }
    }

    /// What a radiance all around makes a cell read; `None` for pixels, which are too many and too coarse for bounds on what each
    /// has missed.
    pub(crate) fn all_around(&self, world: &World) -> Option<f64> {
        match self.target {
            Target::Patch { .. } => Some(PI * self.area_read(world)),
            Target::Along(_) | Target::Distant { .. } => Some(1.0),
            Target::Pixel { .. } | Target::Leaving { .. } => None,
        }
    }

    /// What is read, in watts; the caller relabels.
    pub fn quantity(&self) -> Quantity {
        match self.target {
            Target::Patch { flux: true, .. } => Quantity::Flux,
            Target::Patch { flux: false, .. } => Quantity::Irradiance,
            Target::Leaving { .. } => Quantity::Intensity,
            Target::Pixel { .. } | Target::Along(_) | Target::Distant { .. } => Quantity::Radiance,
        }
    }
}

fn target(sensor: &Sensor) -> Target {
    match &sensor.receiver {
        Receiver::Camera(camera) => Target::Pixel { camera: camera.clone(), film: sensor.film },
        Receiver::Meter(Meter::Radiancemeter { origin, direction }) => Target::Along(Ray::new(*origin, *direction)),
        Receiver::Meter(Meter::Distant { direction, target }) => {
            Target::Distant { direction: *direction, target: *target }
        }
        Receiver::Meter(Meter::Irradiancemeter { shape }) => {
            Target::Patch { shape: *shape, film: sensor.film, flux: false }
        }
        Receiver::Meter(Meter::Fluxmeter { shape }) => Target::Patch { shape: *shape, film: sensor.film, flux: true },
        Receiver::Meter(Meter::Intensitymeter { to_world }) => {
            Target::Leaving { to_world: *to_world, film: sensor.film }
        }
    }
}

/// The ray through a point of a pixel and a point of the lens, from the near clipping plane, and its length to the far one.
pub(crate) fn pixel_ray(camera: &Camera, film: Film, cell: [u32; 2], xi: [f64; 2], on_lens: [f64; 2]) -> (Ray, f64) {
    let across = (f64::from(cell[0]) + xi[0]) / f64::from(film.width) + camera.principal_point_offset[0];
    let down = (f64::from(cell[1]) + xi[1]) / f64::from(film.height) + camera.principal_point_offset[1];
    let local =
        DVec3::new((1.0 - 2.0 * across) * camera.tan_half_width, (1.0 - 2.0 * down) * camera.tan_half_height, 1.0);
    // All rays of a pixel's point meet where it is in focus.
    let (start, along) = match camera.lens {
        None => (DVec3::ZERO, local),
        Some(lens) => {
            let start = in_disc(lens.aperture_radius, on_lens).extend(0.0);
            (start, local - start / lens.focus_distance)
        }
    };
    let stretch = along.length();
    let direction = camera.to_world.transform_vector3(along).normalize();
    let origin = camera.to_world.transform_point3(start) + camera.near_clip * stretch * direction;
    (Ray::new(origin, direction), (camera.far_clip - camera.near_clip) * stretch)
}

/// The ray of a distant meter through a point of its target, from outside the scene.
pub(crate) fn distant_ray(world: &World, direction: DVec3, target: DistantTarget, xi: [f64; 3]) -> Ray {
    let (low, high) = world.bounds();
    let (centre, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
    let through = match target {
        DistantTarget::Point(point) => point,
        DistantTarget::Shape(shape) => world.point_in_cell(shape, [0, 0], [1, 1], xi).position,
        DistantTarget::Whole => {
            let (tangent, bitangent) = direction.any_orthonormal_pair();
            let offset = in_disc(radius, [xi[0], xi[1]]);
            centre + offset.x * tangent + offset.y * bitangent
        }
    };
    // A hair farther than the scene reaches: nothing that could stand before the target is behind the start.
    let back = (through - centre).dot(direction) + 1.001 * radius;
    Ray::new(through - back.max(0.0) * direction, direction)
}

/// A point of a disc, evenly by area.
fn in_disc(radius: f64, xi: [f64; 2]) -> DVec2 {
    radius * xi[0].sqrt() * DVec2::from_angle(TAU * xi[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DAffine3;

    #[test]
    fn the_image_is_left_to_right_and_top_to_bottom() {
        let camera = Camera {
            to_world: DAffine3::IDENTITY,
            tan_half_width: 1.0,
            tan_half_height: 0.5,
            principal_point_offset: [0.0; 2],
            near_clip: 0.1,
            far_clip: 10.0,
            lens: None,
        };
        let film = Film { width: 4, height: 2 };
        let (ray, reach) = pixel_ray(&camera, film, [0, 0], [0.0, 0.0], [0.3, 0.7]);
        let expected = DVec3::new(1.0, 0.5, 1.0);
        assert!((ray.direction - expected.normalize()).length() < 1e-12, "+x is left and +y is up");
        assert!((ray.origin - 0.1 * expected).length() < 1e-12);
        assert!((reach - 9.9 * expected.length()).abs() < 1e-12);
    }

    /// From all over the lens the rays of one point of the film meet in the plane in focus, where the pinhole's ray goes
    /// through it, and start in the plane of the near clipping distance.
    /// Where Mitsuba 3.9.1 looks with these offsets, at the film's first corner and its middle.
    #[test]
    fn a_principal_point_is_mitsubas() {
        let camera = Camera {
            to_world: DAffine3::IDENTITY,
            tan_half_width: 20f64.to_radians().tan(),
            tan_half_height: 20f64.to_radians().tan() / 1.5,
            principal_point_offset: [0.2, -0.15],
            near_clip: 0.1,
            far_clip: 10.0,
            lens: None,
        };
        for (place, x, y) in [(0.0, 0.218382, 0.315441), (0.5, -0.145588, 0.072794)] {
            let (ray, _) = pixel_ray(&camera, Film { width: 1, height: 1 }, [0, 0], [place; 2], [0.0; 2]);
            let seen = ray.direction / ray.direction.z;
            assert!((seen - DVec3::new(x, y, 1.0)).length() < 1e-6, "{seen}");
        }
    }

    #[test]
    fn a_lens_brings_its_plane_to_focus() {
        let to_world = DAffine3::from_scale_rotation_translation(
            DVec3::ONE,
            glam::DQuat::from_rotation_x(0.7),
            DVec3::new(1.0, -2.0, 3.0),
        );
        let pinhole = Camera {
            to_world,
            tan_half_width: 0.8,
            tan_half_height: 0.6,
            principal_point_offset: [0.1, 0.0],
            near_clip: 0.5,
            far_clip: 10.0,
            lens: None,
        };
        let lens = photonlab_scene::Lens { aperture_radius: 0.3, focus_distance: 4.0 };
        let camera = Camera { lens: Some(lens), ..pinhole.clone() };
        let film = Film { width: 4, height: 3 };
        let at = |ray: &Ray, z: f64| {
            let local = to_world.inverse();
            let (start, along) = (local.transform_point3(ray.origin), local.transform_vector3(ray.direction));
            start + (z - start.z) / along.z * along
        };
        let (straight, _) = pixel_ray(&pinhole, film, [3, 0], [0.2, 0.9], [0.0; 2]);
        for (on_lens, expected) in [([1.0, 0.0], [0.3, 0.0]), ([0.25, 0.25], [0.0, 0.15]), ([1.0, 0.5], [-0.3, 0.0])] {
            let (ray, reach) = pixel_ray(&camera, film, [3, 0], [0.2, 0.9], on_lens);
            assert!((at(&ray, 4.0) - at(&straight, 4.0)).length() < 1e-12);
            assert!((at(&ray, 0.0).truncate() - DVec2::from(expected)).length() < 1e-12);
            assert!((ray.origin - to_world.transform_point3(at(&ray, 0.0))).length() > 0.5);
            let local = to_world.inverse();
            assert!((local.transform_point3(ray.origin).z - 0.5).abs() < 1e-12);
            assert!((local.transform_point3(ray.at(reach)).z - 10.0).abs() < 1e-12);
        }
    }
}
