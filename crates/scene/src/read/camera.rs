//! Cameras: `perspective`, a pinhole, and `thinlens`.

use glam::{DAffine3, DMat3};

use crate::{Camera, Lens};

use super::error::{Fault, SceneError};
use super::film::Window;
use super::names::quote;
use super::number::{Range, float};
use super::object::Object;
use super::scene::Builder;

/// Diagonal of the 36 x 24 mm film that `focal_length` refers to, in millimetres.
const DIAGONAL: f64 = 43.266_615_305_567_87;
/// Most that a squared length or a cosine of the camera's axes may be off, as in Mitsuba.
const TOLERANCE: f64 = 1e-3;

/// Reads what is the camera's own of a `perspective` or `thinlens` sensor.
pub(super) fn camera(object: &mut Object, window: Window, builder: &mut Builder) -> Result<Camera, SceneError> {
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    check_rigid(object, &to_world)?;
    let aspect = f64::from(window.whole.width) / f64::from(window.whole.height);
    let tan_half_width = field_of_view(object, aspect)?;
    let near_clip = object.float("near_clip", Range::LENGTH)?.unwrap_or(1e-2);
    let far_clip = object.float("far_clip", Range::LENGTH)?.unwrap_or(1e4);
    if near_clip >= far_clip {
        let what = format!("near_clip {near_clip} is not below far_clip {far_clip}");
        return Err(object.element.error(what, "set near_clip < far_clip"));
    }
    let principal_point_offset = [
        object.float("principal_point_offset_x", Range::COORDINATE)?.unwrap_or(0.0),
        object.float("principal_point_offset_y", Range::COORDINATE)?.unwrap_or(0.0),
    ];
    let tan_half_height = tan_half_width / aspect;
    let focus_distance = object.float("focus_distance", Range::LENGTH)?;
    let lens = if object.plugin == "thinlens" {
        let aperture_radius = object.float("aperture_radius", Range::LENGTH)?.ok_or_else(|| {
            object.element.error("thinlens has no aperture_radius", "give one in metres, or use perspective")
        })?;
        // Mitsuba focuses on the far clipping plane unless told otherwise.
        Some(Lens { aperture_radius, focus_distance: focus_distance.unwrap_or(far_clip) })
    } else {
        if focus_distance.is_some() {
            builder.note("focus_distance has no effect on a pinhole; thinlens has a depth of field");
        }
        None
    };
    let whole = Camera { to_world, tan_half_width, tan_half_height, principal_point_offset, near_clip, far_clip, lens };
    Ok(cropped(whole, &window))
}

/// The camera whose whole film is the part of another's.
fn cropped(camera: Camera, window: &Window) -> Camera {
    let [whole, part] = [window.whole, window.part].map(|film| [film.width, film.height].map(f64::from));
    let offset = window.offset.map(f64::from);
    let shift = |axis: usize| {
        let from_middle = offset[axis] - 0.5 * (whole[axis] - part[axis]);
        (from_middle + camera.principal_point_offset[axis] * whole[axis]) / part[axis]
    };
    Camera {
        tan_half_width: camera.tan_half_width * part[0] / whole[0],
        tan_half_height: camera.tan_half_height * part[1] / whole[1],
        principal_point_offset: [shift(0), shift(1)],
        ..camera
    }
}

fn check_rigid(object: &Object, to_world: &DAffine3) -> Result<(), SceneError> {
    let error = to_world.matrix3.transpose() * to_world.matrix3 - DMat3::IDENTITY;
    if error.to_cols_array().into_iter().all(|entry| entry.abs() <= TOLERANCE) {
        return Ok(());
    }
    Err(object.element.error("to_world scales or shears the camera", "use lookat, rotate and translate only"))
}

/// Half the field of view along the width, as a tangent.
fn field_of_view(object: &mut Object, aspect: f64) -> Result<f64, SceneError> {
    let fov = object.float("fov", Range::ANY)?;
    let axis = object.choice("fov_axis", &["x", "y", "diagonal", "smaller", "larger"])?;
    let focal_length = object.string("focal_length")?;
    let fail = |fault| object.element.fault(fault);
    match (fov, focal_length) {
        (Some(_), Some(_)) => Err(fail(Fault::new("both fov and focal_length are given", "keep one of them"))),
        (Some(fov), None) => along_width(half_tangent(fov).map_err(fail)?, axis.unwrap_or("x"), aspect).map_err(fail),
        (None, _) if axis.is_some() => Err(fail(Fault::new(
            "fov_axis without fov",
            "add fov, or remove fov_axis: focal_length is on the diagonal",
        ))),
        (None, focal_length) => {
            let millimetres = focal_millimetres(focal_length.unwrap_or("50mm")).map_err(fail)?;
            along_width(0.5 * DIAGONAL / millimetres, "diagonal", aspect).map_err(fail)
        }
    }
}

fn half_tangent(fov: f64) -> Result<f64, Fault> {
    if fov > 0.0 && fov < 180.0 {
        return Ok((0.5 * fov).to_radians().tan());
    }
    Err(Fault::new(format!("fov {fov} is out of range"), "give an angle between 0 and 180 degrees"))
}

fn along_width(tangent: f64, axis: &str, aspect: f64) -> Result<f64, Fault> {
    let along_height = match axis {
        "y" => true,
        "smaller" => aspect > 1.0,
        "larger" => aspect <= 1.0,
        _ => false,
    };
    let width = match axis {
        "diagonal" => tangent / (1.0 + 1.0 / (aspect * aspect)).sqrt(),
        _ if along_height => tangent * aspect,
        _ => tangent,
    };
    // A tangent this large or small leaves no directions apart in single precision.
    if (1e-12..=1e12).contains(&width) {
        return Ok(width);
    }
    Err(Fault::new("the field of view is too narrow or too wide", "give another fov or focal_length"))
}

/// Millimetres of a focal length such as `50mm`.
fn focal_millimetres(text: &str) -> Result<f64, Fault> {
    let number = text.trim();
    let number = number.strip_suffix("mm").unwrap_or(number);
    let mend = "write it like 50mm";
    match float(number) {
        Ok(millimetres) if millimetres > 0.0 => Ok(millimetres),
        Ok(_) => Err(Fault::new(format!("focal_length {} is not positive", quote(text)), mend)),
        Err(_) => Err(Fault::new(format!("focal_length {} is not a length", quote(text)), mend)),
    }
}
