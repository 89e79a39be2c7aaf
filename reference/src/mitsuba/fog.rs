//! Participating media: shapes without a surface of their own, filled with one homogeneous medium.

use super::{block, point_lamp, radiance_meter, sphere};
use crate::vector::Vector;

/// A homogeneous medium, the only one of its scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Medium {
    /// Extinction coefficient (1/m).
    pub(crate) extinction: f64,
    /// Share of the extinguished light that is scattered.
    pub(crate) albedo: f64,
    /// Mean cosine of the scattering angle; isotropic at 0.
    pub(crate) asymmetry: f64,
}

impl Medium {
    /// The coating and content of a shape that is nothing but a boundary of the medium.
    fn inside(self) -> String {
        let Medium { extinction, albedo, asymmetry } = self;
        let phase = if asymmetry == 0.0 {
            "<phase type=\"isotropic\"/>".to_string()
        } else {
            format!("<phase type=\"hg\"><float name=\"g\" value=\"{asymmetry}\"/></phase>")
        };
        format!(
            "<bsdf type=\"null\"/><medium type=\"homogeneous\" name=\"interior\" id=\"fog\">\
             <float name=\"sigma_t\" value=\"{extinction}\"/><rgb name=\"albedo\" value=\"{albedo}\"/>{phase}</medium>"
        )
    }
}

/// A ball of the medium.
pub(crate) fn fog_ball(centre: Vector, radius: f64, medium: Medium) -> String {
    sphere("fog-ball", centre, radius, false, &medium.inside())
}

/// A box of the medium with these half-edges.
pub(crate) fn fog_block(centre: Vector, half: Vector, medium: Medium) -> String {
    block("fog-block", centre, half, &medium.inside())
}

/// Tells Mitsuba, which does not find out by itself, that a lamp or sensor stands in the medium.
const IN_FOG: &str = "<ref name=\"medium\" id=\"fog\"/>";

/// An isotropic point lamp in the medium.
pub(crate) fn point_lamp_in_fog(position: Vector, intensity: &[f64]) -> String {
    point_lamp(position, intensity).replacen("</emitter>", &(IN_FOG.to_string() + "</emitter>"), 1)
}

/// A radiance meter in the medium.
pub(crate) fn radiance_meter_in_fog(id: &str, origin: Vector, target: Vector) -> String {
    radiance_meter(id, origin, target).replacen("</sensor>", &(IN_FOG.to_string() + "</sensor>"), 1)
}
