//! Sensors: cameras and meters, each with its film.

use glam::{DAffine3, DVec3};

use crate::{Bsdf, DistantTarget, Film, Geometry, Meter, Receiver, Sensor};

use super::camera::camera;
use super::element::Element;
use super::emitter::check_one_of;
use super::environment::rotation;
use super::error::SceneError;
use super::film::{self, Window};
use super::integrator::sampler;
use super::medium::surrounding;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;
use super::shape::shape;
use super::transform::unit;

/// Where a sensor stands in the file.
#[derive(Clone, Copy, Debug)]
pub(super) enum Position {
    /// By itself.
    Free,
    /// Inside the shape of this index.
    OnShape(usize),
}

/// Reads a sensor and adds it to the scene.
pub(super) fn sensor<'e>(
    element: &'e Element,
    position: Position,
    builder: &mut Builder<'e>,
) -> Result<(), SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let window = object.single(&["film"])?.map(|film| film::film(film, builder)).transpose()?;
    let film = window.map(|window| window.whole);
    let is_camera = matches!(object.plugin, "perspective" | "thinlens");
    if !is_camera && window.is_some_and(|window| window.part != window.whole) {
        return Err(
            element.error("the film of a meter is cropped", "give the cells that are wanted as its width and height")
        );
    }
    if let Some(element) = object.single(&["sampler"])? {
        sampler(element, builder)?;
    }
    check_shutter(&mut object)?;
    let medium = surrounding(&mut object, builder)?;
    let (receiver, film) = match (object.plugin, position) {
        ("perspective" | "thinlens", Position::Free) => {
            let window = window.unwrap_or(Window::of(film::DEFAULT));
            (Receiver::Camera(camera(&mut object, window, builder)?), window.part)
        }
        ("distant", Position::Free) => {
            let film = one_cell(&object, film)?;
            (Receiver::Meter(distant(&mut object, builder)?), film)
        }
        ("radiancemeter", Position::Free) => (Receiver::Meter(radiancemeter(&mut object)?), one_cell(&object, film)?),
        ("irradiancemeter", Position::OnShape(shape)) => {
            (Receiver::Meter(Meter::Irradiancemeter { shape }), cells(&object, shape, film, builder)?)
        }
        ("fluxmeter", Position::OnShape(shape)) => {
            (Receiver::Meter(Meter::Fluxmeter { shape }), cells(&object, shape, film, builder)?)
        }
        ("intensitymeter", Position::Free) => {
            let to_world = rotation(&mut object)?;
            (Receiver::Meter(Meter::Intensitymeter { to_world }), film.unwrap_or(GONIOMETER))
        }
        (plugin @ ("irradiancemeter" | "fluxmeter"), Position::Free) => {
            let what = format!("a meter `{plugin}` outside a shape");
            return Err(element.error(what, "put it into the shape that it measures"));
        }
        (plugin, _) => {
            return Err(element.error(format!("a {plugin} inside a shape"), "put it beside the shape"));
        }
    };
    object.close(&["srf"])?;
    let id = builder.id(element, "sensor", builder.scene.sensors.len())?;
    builder.scene.sensors.push(Sensor { id, receiver, film, medium });
    Ok(())
}

const ONE_CELL: Film = Film { width: 1, height: 1 };
/// Cells of a goniometer that does not say: 15 degrees in C, 10 in gamma.
const GONIOMETER: Film = Film { width: 24, height: 18 };

fn one_cell(object: &Object, film: Option<Film>) -> Result<Film, SceneError> {
    match film.unwrap_or(ONE_CELL) {
        ONE_CELL => Ok(ONE_CELL),
        Film { width, height } => {
            let what = format!("a {} has one cell, its film {width} x {height}", object.plugin);
            Err(object.element.error(what, "set width and height to 1, or remove the film"))
        }
    }
}

/// The cells of a meter on a shape; one alone where (u, v) mean another thing on each part of it.
fn cells(object: &Object, shape: usize, film: Option<Film>, builder: &Builder) -> Result<Film, SceneError> {
    match builder.scene.shapes[shape].geometry {
        Geometry::Lens { .. } | Geometry::Mesh(_) => one_cell(object, film),
        _ => Ok(film.unwrap_or(ONE_CELL)),
    }
}

fn radiancemeter(object: &mut Object) -> Result<Meter, SceneError> {
    let origin = object.vector("origin", Range::COORDINATE)?;
    let direction = object.vector("direction", Range::ANY)?;
    let to_world = object.transform()?;
    let fail = |what: &str, mend: &str| Err(object.element.error(what, mend));
    let (origin, along) = match (origin, direction, to_world) {
        (Some(origin), Some(direction), None) => (origin, direction),
        (None, None, transform) => {
            let transform = transform.unwrap_or(DAffine3::IDENTITY);
            (transform.translation, transform.matrix3.z_axis)
        }
        (_, _, Some(_)) => {
            return fail("to_world is given beside origin or direction", "keep one of the two");
        }
        (_, _, None) => {
            return fail("origin and direction are not both given", "give both, or to_world");
        }
    };
    match unit(along) {
        Some(direction) => Ok(Meter::Radiancemeter { origin, direction }),
        None => fail("direction is zero", "give a direction such as 0 0 1"),
    }
}

/// Mitsuba's `distant`: radiance that leaves the scene, averaged over a target.
fn distant<'e>(object: &mut Object<'e>, builder: &mut Builder<'e>) -> Result<Meter, SceneError> {
    let given = object.vector("direction", Range::ANY)?;
    let to_world = object.transform()?;
    check_one_of(object, given, to_world, "direction")?;
    let along = given.or(to_world.map(|transform| transform.matrix3.z_axis)).unwrap_or(DVec3::Z);
    let direction = unit(along)
        .ok_or_else(|| object.element.error("direction is zero", "give the one in which it looks, such as 0 0 -1"))?;
    let target = match object.vector_or("target", &["shape"], Range::COORDINATE)? {
        None => DistantTarget::Whole,
        Some(Ok(point)) => DistantTarget::Point(point),
        Some(Err(element)) => DistantTarget::Shape(target(element, builder)?),
    };
    Ok(Meter::Distant { direction, target })
}

/// Adds a shape that is a target alone.
fn target<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<usize, SceneError> {
    if let Some(other) = element.children.iter().find(|child| ["emitter", "sensor"].contains(&child.tag.name)) {
        return Err(other.error("a target neither shines nor measures", "put the shape itself into the scene"));
    }
    shape(element, builder)?;
    let index = builder.scene.shapes.len() - 1;
    let target = &mut builder.scene.shapes[index];
    (target.bsdf, target.boundary) = (Bsdf::Null, None);
    Ok(index)
}

/// The scene stands still, so only the default shutter is the same thing in both programs.
fn check_shutter(object: &mut Object) -> Result<(), SceneError> {
    for name in ["shutter_open", "shutter_close"] {
        if object.float(name, Range::ANY)?.is_some_and(|time| time != 0.0) {
            return Err(object.element.error(format!("{name} other than 0 is known but not built yet"), "remove it"));
        }
    }
    Ok(())
}
