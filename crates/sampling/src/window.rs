//! The window through which parallel light enters a scene.

use glam::DVec3;

/// The smallest rectangle (among 90 turns by one degree) across a direction whose shadow covers a box: its corner,
/// before the box, and its sides.
pub(crate) fn covering_window(bounds: (DVec3, DVec3), direction: DVec3) -> (DVec3, [DVec3; 2]) {
    let corners: Vec<DVec3> = (0..8)
        .map(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 { bounds.0[axis] } else { bounds.1[axis] }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        })
        .collect();
    let range = |axis: DVec3| {
        let along = corners.iter().map(|c| c.dot(axis));
        (along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max))
    };
    let (tangent, bitangent) = direction.any_orthonormal_pair();
    let window = (0..90).map(|degree| {
        let (sin, cos) = f64::from(degree).to_radians().sin_cos();
        let axes = [cos * tangent + sin * bitangent, cos * bitangent - sin * tangent];
        (axes, [range(axes[0]), range(axes[1])])
    });
    let area = |r: &[(f64, f64); 2]| (r[0].1 - r[0].0) * (r[1].1 - r[1].0);
    let (axes, ranges) = window.min_by(|a, b| area(&a.1).total_cmp(&area(&b.1))).expect("ninety turns were tried");
    // A hair wider than the box, so that a surface on its rim is lit to the edge.
    let size = (bounds.1 - bounds.0).length();
    let margin = 1e-9 * size;
    let before = range(direction).0 - 0.1 * size.max(f64::MIN_POSITIVE);
    let corner = (ranges[0].0 - margin) * axes[0] + (ranges[1].0 - margin) * axes[1] + before * direction;
    let side = |r: (f64, f64), axis: DVec3| (r.1 - r.0 + 2.0 * margin) * axis;
    (corner, [side(ranges[0], axes[0]), side(ranges[1], axes[1])])
}
