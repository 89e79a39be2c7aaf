//! What is read: one pixel, or one cell of a meter.

use glam::{DMat3, DVec3};
use photonlab_photometry::Quantity;
use photonlab_scene::{Camera, Film, Meter, Ray, Receiver, Scene, Sensor, World};

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
            Target::Patch { shape, film, flux: true } => {
                world.cell_area(shape, self.cell[1], [film.width, film.height])
            }
            _ => 1.0,
        }
    }

    /// What is read, in watts; the caller relabels.
    pub fn quantity(&self) -> Quantity {
        match self.target {
            Target::Patch { flux: true, .. } => Quantity::Flux,
            Target::Patch { flux: false, .. } => Quantity::Irradiance,
            Target::Leaving { .. } => Quantity::Intensity,
            Target::Pixel { .. } | Target::Along(_) => Quantity::Radiance,
        }
    }
}

fn target(sensor: &Sensor) -> Target {
    match &sensor.receiver {
        Receiver::Camera(camera) => Target::Pixel { camera: camera.clone(), film: sensor.film },
        Receiver::Meter(Meter::Radiancemeter { origin, direction }) => Target::Along(Ray::new(*origin, *direction)),
        Receiver::Meter(Meter::Irradiancemeter { shape }) => {
            Target::Patch { shape: *shape, film: sensor.film, flux: false }
        }
        Receiver::Meter(Meter::Fluxmeter { shape }) => Target::Patch { shape: *shape, film: sensor.film, flux: true },
        Receiver::Meter(Meter::Intensitymeter { to_world }) => {
            Target::Leaving { to_world: *to_world, film: sensor.film }
        }
    }
}

/// The ray through a point of a pixel, from the near clipping plane, and its length to the far one.
pub(crate) fn pixel_ray(camera: &Camera, film: Film, cell: [u32; 2], xi: [f64; 2]) -> (Ray, f64) {
    let across = (f64::from(cell[0]) + xi[0]) / f64::from(film.width) - camera.principal_point_offset[0];
    let down = (f64::from(cell[1]) + xi[1]) / f64::from(film.height) - camera.principal_point_offset[1];
    let local =
        DVec3::new((1.0 - 2.0 * across) * camera.tan_half_width, (1.0 - 2.0 * down) * camera.tan_half_height, 1.0);
    let stretch = local.length();
    let direction = camera.to_world.transform_vector3(local).normalize();
    let origin = camera.to_world.translation + camera.near_clip * stretch * direction;
    (Ray::new(origin, direction), (camera.far_clip - camera.near_clip) * stretch)
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
        };
        let film = Film { width: 4, height: 2 };
        let (ray, reach) = pixel_ray(&camera, film, [0, 0], [0.0, 0.0]);
        let expected = DVec3::new(1.0, 0.5, 1.0);
        assert!((ray.direction - expected.normalize()).length() < 1e-12, "+x is left and +y is up");
        assert!((ray.origin - 0.1 * expected).length() < 1e-12);
        assert!((reach - 9.9 * expected.length()).abs() < 1e-12);
    }
}
