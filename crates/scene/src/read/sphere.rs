//! Spheres: Mitsuba's `to_world * translate(center) * scale(radius)`, taken apart again.

use glam::{DAffine3, DMat3, DVec3};

use crate::Geometry;

use super::error::SceneError;
use super::number::Range;
use super::object::Object;

/// Most that the scale of two directions, or their cosine, may differ: matrices are written with six digits.
const TOLERANCE: f64 = 1e-5;

/// The sphere, and whether the transform mirrors it: Mitsuba then turns its normals around.
pub(super) fn sphere(object: &mut Object) -> Result<(Geometry, bool), SceneError> {
    let centre = object.vector("center", Range::COORDINATE)?.unwrap_or(DVec3::ZERO);
    let radius = object.float("radius", Range::LENGTH)?.unwrap_or(1.0);
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    let scale = to_world.matrix3.x_axis.length();
    let axes = to_world.matrix3 * scale.recip();
    if !is_orthonormal(&axes) {
        let what = "to_world scales the sphere unevenly or shears it";
        return Err(object.element.error(what, "scale by one value in all directions"));
    }
    let radius = radius * scale;
    let centre = to_world.transform_point3(centre);
    for number in centre.to_array() {
        Range::COORDINATE.check(number).map_err(|fault| object.element.fault(fault))?;
    }
    Range::LENGTH.check(radius).map_err(|fault| object.element.fault(fault))?;
    Ok((Geometry::Sphere { centre, radius, to_world: orthonormalised(axes) }, axes.determinant() < 0.0))
}

/// True if the columns are unit vectors at right angles, as nearly as matrices are written.
pub(super) fn is_orthonormal(axes: &DMat3) -> bool {
    let error = axes.transpose() * *axes - DMat3::IDENTITY;
    error.to_cols_array().into_iter().all(|entry| entry.abs() <= TOLERANCE)
}

/// The nearest orthonormal matrix to one that is nearly so: a Newton step leaves the square of the error.
pub(super) fn orthonormalised(axes: DMat3) -> DMat3 {
    let step = |axes: DMat3| (axes + axes.inverse().transpose()) * 0.5;
    if axes.transpose() * axes == DMat3::IDENTITY { axes } else { step(step(axes)) }
}
