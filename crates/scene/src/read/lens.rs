//! The extensions `paraboloid` and `lens`.

use glam::{DAffine3, DMat3, DVec3};

use crate::{Dish, Frame, Geometry, LensBody, Section};

use super::error::SceneError;
use super::number::Range;
use super::object::Object;
use super::sphere::{is_orthonormal, orthonormalised};

/// A paraboloid around +z with its vertex at the origin, its front towards the focus.
pub(super) fn paraboloid(object: &mut Object) -> Result<Geometry, SceneError> {
    let focal_length = required(object, "focal_length")?;
    let rim = required(object, "aperture")?;
    let (frame, scale) = frame(object)?;
    let (focal_length, rim) = (focal_length * scale, rim * scale);
    check(object, &frame, &[focal_length, rim])?;
    Ok(Geometry::Paraboloid { frame, focal_length, rim })
}

/// A lens around +z with the vertex of its first face at the origin. A face's radius is positive if its centre lies beyond
/// it, towards +z, negative if before, and 0 if the face is flat.
pub(super) fn lens(object: &mut Object) -> Result<Geometry, SceneError> {
    let rim = required(object, "aperture")?;
    let thickness = required(object, "thickness")?;
    let mut radii = [0.0; 2];
    for (radius, name) in radii.iter_mut().zip(["radius1", "radius2"]) {
        let given = object.float(name, Range::COORDINATE)?;
        *radius = given.ok_or_else(|| {
            object.element.error(format!("{name} is missing"), "give the radius of that face, or 0 if it is flat")
        })?;
        if *radius != 0.0 && radius.abs() < rim {
            let what = format!("{name} = {radius} is shorter than the aperture {rim}: no sphere is that wide");
            return Err(object.element.error(what, "give a longer radius or a smaller aperture"));
        }
    }
    let (frame, scale) = frame(object)?;
    let curvatures = radii.map(|radius| if radius == 0.0 { 0.0 } else { 1.0 / (radius * scale) });
    let (thickness, rim) = (thickness * scale, rim * scale);
    check(object, &frame, &[thickness, rim])?;
    let edge = thickness + sag(curvatures[1], rim) - sag(curvatures[0], rim);
    if edge <= 0.0 {
        let what = format!("the faces cross within the aperture: at its rim the lens is {} thick", edge / scale);
        return Err(object.element.error(what, "give a larger thickness, a smaller aperture or flatter faces"));
    }
    Ok(Geometry::Lens { frame, lens: LensBody { curvatures, thickness, rim } })
}

fn sag(curvature: f64, rim: f64) -> f64 {
    let frame = Frame { origin: DVec3::ZERO, axes: DMat3::IDENTITY };
    Dish { frame, section: Section::Circle, curvature, rim, front_up: true }.sag(rim)
}

fn required(object: &mut Object, name: &'static str) -> Result<f64, SceneError> {
    let given = object.float(name, Range::LENGTH)?;
    given.ok_or_else(|| object.element.error(format!("{name} is missing"), "give it as a float, in metres"))
}

/// Where a rotation, a shift and one scale put a shape, and that scale.
fn frame(object: &mut Object) -> Result<(Frame, f64), SceneError> {
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    let scale = to_world.matrix3.x_axis.length();
    let axes = to_world.matrix3 * scale.recip();
    if !is_orthonormal(&axes) {
        let what = format!("to_world scales the {} unevenly or shears it", object.plugin);
        return Err(object.element.error(what, "scale by one value in all directions"));
    }
    Ok((Frame { origin: to_world.translation, axes: orthonormalised(axes) }, scale))
}

fn check(object: &Object, frame: &Frame, lengths: &[f64]) -> Result<(), SceneError> {
    let coordinates = frame.origin.to_array().map(|x| Range::COORDINATE.check(x));
    let lengths = lengths.iter().map(|&length| Range::LENGTH.check(length));
    coordinates.into_iter().chain(lengths).try_for_each(|x| x.map(drop)).map_err(|fault| object.element.fault(fault))
}
