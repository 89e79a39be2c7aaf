//! Shapes, with the coating, lamp and meters that stand inside them.

use glam::DAffine3;

use photonlab_photometry::Spectrum;

use crate::{Bsdf, Geometry, Shape};

use super::bsdf::{TAGS, bsdf};
use super::cylinder::cylinder;
use super::element::Element;
use super::emitter::area;
use super::error::SceneError;
use super::lens::{lens, paraboloid};
use super::medium::boundary;
use super::mesh::mesh;
use super::number::Range;
use super::object::Object;
use super::plugins;
use super::scene::Builder;
use super::sensor::{Position, sensor};
use super::sphere::sphere;

/// Reads a shape and adds it, with its meters, to the scene.
pub(super) fn shape<'e>(element: &'e Element, builder: &mut Builder<'e>) -> Result<(), SceneError> {
    let mut object = Object::open(element)?;
    plugins::check(&object)?;
    let (geometry, mirrored) = geometry(&mut object, builder)?;
    let flipped = object.boolean("flip_normals")?.unwrap_or(false);
    if object.float("silhouette_sampling_weight", Range::ANY)?.is_some() {
        builder.note("silhouette_sampling_weight is for Mitsuba's own sampling and has no effect here");
    }
    let boundary = boundary(&mut object, builder)?;
    let coating = object.single(&TAGS)?;
    let lamp = object.single(&["emitter"])?;
    let portal = lamp.filter(|lamp| lamp.attribute("type") == Some("portal"));
    let lamp = lamp.filter(|_| portal.is_none());
    let meters = object.objects(&["sensor"]);
    object.close(&["to_uv"])?;

    if let Some(portal) = portal {
        check_portal(portal, &geometry, &meters)?;
    }
    let radiance = lamp.map(|lamp| area(lamp, builder)).transpose()?;
    let bsdf = match coating {
        Some(coating) => bsdf(coating, builder)?,
        None if portal.is_some() => Bsdf::Null,
        None => uncoated(radiance.is_some()),
    };
    if let (Some(lamp), true) = (lamp, bsdf.lets_through()) {
        let what = "a lamp on a surface that light passes (mask, null) is known but not built yet";
        return Err(lamp.error(what, "give the lamp a shape of its own, without bsdf"));
    }
    if let (Some(portal), true) = (portal, boundary.is_some()) {
        return Err(
            portal.error("a portal in a shape that bounds a medium", "put it before that, into a rectangle of its own")
        );
    }
    if let (Some(portal), true) = (portal, bsdf != Bsdf::Null) {
        return Err(portal.error("a portal in a coated shape", "take its bsdf out, or make it null"));
    }
    let index = builder.scene.shapes.len();
    builder.portals.extend(portal.map(|portal| (portal, index)));
    let id = builder.id(element, "shape", index)?;
    builder.scene.shapes.push(Shape { id, geometry, flip_normals: flipped != mirrored, bsdf, boundary, radiance });
    meters.into_iter().try_for_each(|meter| sensor(meter, Position::OnShape(index), builder))
}

/// Checks what a portal stands in and with.
fn check_portal(portal: &Element, geometry: &Geometry, meters: &[&Element]) -> Result<(), SceneError> {
    Object::open(portal)?.close(&[])?;
    if !matches!(geometry, Geometry::Rectangle { .. }) {
        return Err(portal.error("a portal in a shape that is no rectangle", "put a rectangle into the opening"));
    }
    if let Some(other) = meters.first() {
        return Err(other.error("a meter on a portal", "put it on a rectangle of its own, a little before the portal"));
    }
    Ok(())
}

/// The geometry, and whether a mirror in `to_world` turns its normals around beyond what [`Geometry`] says.
fn geometry(object: &mut Object, builder: &mut Builder) -> Result<(Geometry, bool), SceneError> {
    match object.plugin {
        "sphere" => return sphere(object),
        "cylinder" => return cylinder(object).map(|cylinder| (cylinder, false)),
        "paraboloid" => return paraboloid(object).map(|paraboloid| (paraboloid, false)),
        "lens" => return lens(object).map(|lens| (lens, false)),
        "obj" | "ply" => return mesh(object, builder).map(|mesh| (mesh, false)),
        _ => {}
    }
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    Ok(match object.plugin {
        "cube" => (Geometry::Cube { to_world }, false),
        "disk" => (Geometry::Disk { to_world }, false),
        _ => (Geometry::Rectangle { to_world }, false),
    })
}

/// Mitsuba's coating of a shape without one.
fn uncoated(shines: bool) -> Bsdf {
    Bsdf::Diffuse { reflectance: Spectrum::Uniform(if shines { 0.0 } else { 0.5 }) }
}
