//! Transforms: steps applied in the order of the file.

use glam::{DAffine3, DMat3, DVec3};

use super::element::Element;
use super::error::{Fault, SceneError};
use super::names::quote;
use super::number::{LONGEST, Range, SHORTEST, float, list};

/// Smallest determinant of a transform's linear part whose largest entry is 1.
const SMALLEST_DETERMINANT: f64 = 1e-18;
/// Smallest sine between the direction of a `lookat` and its `up`.
const SMALLEST_SINE: f64 = 1e-9;

/// The transform that `element` states; never singular.
pub(super) fn to_world(element: &Element) -> Result<DAffine3, SceneError> {
    let mut total = DAffine3::IDENTITY;
    for child in &element.children {
        total = step(child).map_err(|fault| child.fault(fault))? * total;
    }
    check_invertible(&total).map_err(|fault| element.fault(fault))?;
    Ok(total)
}

/// The vector along `vector`, if it has a direction, whatever its length.
pub(super) fn unit(vector: DVec3) -> Option<DVec3> {
    let largest = vector.abs().max_element();
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // The square of a length is lost only outside these bounds.
    let vector = if (1e-100..1e100).contains(&largest) { vector } else { vector / largest };
    Some(vector / vector.length())
}

/// The rotation of a transform that rotates, moves and scales evenly, and with it a mirror if it `mirrors`; `None` of any
/// other.
pub(super) fn turn(transform: &DAffine3, mirrors: bool) -> Option<DMat3> {
    let axes = transform.matrix3 * transform.matrix3.x_axis.length().recip();
    let error = axes.transpose() * axes - DMat3::IDENTITY;
    let turns =
        error.to_cols_array().into_iter().all(|entry| entry.abs() <= 1e-5) && (mirrors || axes.determinant() > 0.0);
    turns.then_some(axes)
}

/// Three numbers from `x`, `y`, `z` or from `value` (one number for all three, or three). A missing coordinate is
/// `missing`, or an error if that is `None`.
pub(super) fn three(element: &Element, missing: Option<f64>) -> Result<DVec3, Fault> {
    let coordinates = ["x", "y", "z"].map(|axis| element.attribute(axis));
    let Some(value) = element.attribute("value") else {
        if coordinates.iter().all(Option::is_none) {
            return Err(Fault::new("has no coordinates", "add x, y and z, or value"));
        }
        let read = |index: usize| match (coordinates[index], missing) {
            (Some(text), _) => float(text),
            (None, Some(number)) => Ok(number),
            (None, None) => Err(Fault::new(format!("{} is missing", ["x", "y", "z"][index]), "give x, y and z")),
        };
        return Ok(DVec3::new(read(0)?, read(1)?, read(2)?));
    };
    if coordinates.iter().any(Option::is_some) {
        return Err(Fault::new("has both value and x, y, z", "keep one of them"));
    }
    match list(value, &[1, 3])?[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        [all, ..] => Ok(DVec3::splat(all)),
        [] => Ok(DVec3::ZERO),
    }
}

fn step(element: &Element) -> Result<DAffine3, Fault> {
    match element.tag.name {
        "translate" => Ok(DAffine3::from_translation(three(element, Some(0.0))?)),
        "scale" => Ok(DAffine3::from_scale(three(element, Some(1.0))?)),
        "rotate" => rotate(element),
        "lookat" => look_at(element),
        _ => matrix(element.required("value")),
    }
}

fn rotate(element: &Element) -> Result<DAffine3, Fault> {
    let axis = unit(three(element, Some(0.0))?).ok_or_else(|| Fault::new("the axis is zero", "give x, y or z"))?;
    let degrees = float(element.required("angle"))?;
    let (sin, cos) = sin_cos_degrees(degrees);
    let along = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
    let across = DMat3::from_cols(axis.cross(DVec3::X), axis.cross(DVec3::Y), axis.cross(DVec3::Z));
    Ok(DAffine3::from_mat3(DMat3::IDENTITY * cos + across * sin + along * (1.0 - cos)))
}

/// Sine and cosine, exact at right angles, so that walls turned by them meet.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        turned => turned.to_radians().sin_cos(),
    }
}

/// Mitsuba's: +z to the target, +x to the left, +y up.
fn look_at(element: &Element) -> Result<DAffine3, Fault> {
    let read =
        |name: &str| list(element.required(name), &[3]).map(|numbers| DVec3::new(numbers[0], numbers[1], numbers[2]));
    let (origin, target) = (read("origin")?, read("target")?);
    let forward =
        unit(target - origin).ok_or_else(|| Fault::new("origin and target are the same point", "move one of them"))?;
    let up = match element.attribute("up") {
        Some(_) => unit(read("up")?).ok_or_else(|| Fault::new("up is zero", "give a direction such as 0 1 0"))?,
        None => any_up(forward),
    };
    let left = up.cross(forward);
    if left.length() < SMALLEST_SINE {
        return Err(Fault::new("up is along the direction of view", "give another up"));
    }
    let left = left.normalize();
    Ok(DAffine3::from_mat3_translation(DMat3::from_cols(left, forward.cross(left), forward), origin))
}

/// The `up` that Mitsuba takes if none is given (Duff and others 2017, "Building an Orthonormal Basis, Revisited").
fn any_up(n: DVec3) -> DVec3 {
    let sign = 1f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    DVec3::new(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x)
}

/// Sixteen numbers row by row, or nine without translation.
fn matrix(text: &str) -> Result<DAffine3, Fault> {
    let numbers = list(text, &[9, 16])?;
    let columns = if numbers.len() == 9 { 3 } else { 4 };
    let column = |c: usize| DVec3::new(numbers[c], numbers[columns + c], numbers[2 * columns + c]);
    let linear = DMat3::from_cols(column(0), column(1), column(2));
    if columns == 3 {
        return Ok(DAffine3::from_mat3(linear));
    }
    if numbers[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(Fault::new(format!("the last row of {} is not 0 0 0 1", quote(text)), "give an affine matrix"));
    }
    Ok(DAffine3::from_mat3_translation(linear, column(3)))
}

fn check_invertible(transform: &DAffine3) -> Result<(), Fault> {
    for number in transform.to_cols_array() {
        Range::COORDINATE.check(number).map_err(|fault| Fault::new(format!("an entry {}", fault.what), fault.mend))?;
    }
    let linear = transform.matrix3;
    let largest = linear.to_cols_array().into_iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
    debug_assert!(largest <= LONGEST);
    let determinant = (linear * largest.recip()).determinant();
    if largest < SHORTEST || determinant.abs() < SMALLEST_DETERMINANT {
        return Err(Fault::new("the transform is singular: it flattens space", "scale no axis by zero"));
    }
    Ok(())
}
