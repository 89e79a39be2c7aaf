//! Cylinders: Mitsuba's `to_world` after a wall of a radius from one point to another, taken apart again.

use glam::{DAffine3, DMat3, DVec3};

use crate::{Frame, Geometry};

use super::error::SceneError;
use super::number::Range;
use super::object::Object;

/// Most that the scale of two directions, or their cosine, may differ: matrices are written with six digits.
const TOLERANCE: f64 = 1e-5;

/// The cylinder. Its normals point outwards however the transform mirrors it.
pub(super) fn cylinder(object: &mut Object) -> Result<Geometry, SceneError> {
    let from = object.vector("p0", Range::COORDINATE)?.unwrap_or(DVec3::ZERO);
    let to = object.vector("p1", Range::COORDINATE)?.unwrap_or(DVec3::Z);
    let radius = object.float("radius", Range::LENGTH)?.unwrap_or(1.0);
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    let element = object.element;
    let Some(axis) = (to - from).try_normalize() else {
        return Err(element.error("p0 and p1 are the same point", "give two ends"));
    };
    let (x, y) = axis.any_orthonormal_pair();
    let [x, y, along] = [x, y, to - from].map(|vector| to_world.transform_vector3(vector));
    let (scale, length) = (x.length(), along.length());
    let axes = DMat3::from_cols(x / scale, y / scale, along / length);
    let error = axes.transpose() * axes - DMat3::IDENTITY;
    if error.to_cols_array().into_iter().any(|entry| entry.abs() > TOLERANCE) {
        return Err(element.error(
            "to_world makes the cylinder's section an ellipse, or shears it",
            "scale its radius alike in all directions",
        ));
    }
    // Rebuilt about the axis, so that six digits of a matrix do not bend it.
    let z = axes.z_axis.normalize();
    let x = (axes.x_axis - axes.x_axis.dot(z) * z).normalize();
    let y = z.cross(x) * axes.determinant().signum();
    let origin = to_world.transform_point3(from);
    for (number, range) in [(radius * scale, Range::LENGTH), (length, Range::LENGTH)]
        .into_iter()
        .chain(origin.to_array().map(|number| (number, Range::COORDINATE)))
    {
        range.check(number).map_err(|fault| element.fault(fault))?;
    }
    let frame = Frame { origin, axes: DMat3::from_cols(x, y, z) };
    Ok(Geometry::Cylinder { frame, radius: radius * scale, length })
}
