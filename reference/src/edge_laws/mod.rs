//! What a gather with a fixed radius reads near edges: exact laws, no photons needed.
//!
//! The estimate is the flux inside a search ball (or disc) over `pi r^2`. Where part of the disc has no surface the
//! estimate is too low, where the ball reaches other surfaces it is too high; for uniform irradiance both are areas.
//! All lengths are in units of the search radius, all results relative to the true irradiance. (Catalogue entries B1,
//! B2, B4, B5.)

mod concave_corner;
mod crease;
mod flat;
mod half_plane;
mod moments;
mod thin_wall;

pub use concave_corner::ConcaveCorner;
pub use crease::{CreaseReading, crease, right_angle_maximum};
pub use flat::{corner, rectangle_mean, strip};
pub use half_plane::{half_plane, half_plane_kernel};
pub use moments::HalfPlaneMoments;
pub use thin_wall::{sheet_over_floor, thin_wall, wall_on_floor};

/// Independent areas for the checks, by polar integration: no formula of this module is used.
#[cfg(test)]
mod polar {
    use std::f64::consts::TAU;

    /// The mean over the unit disc around the origin of a radial kernel, cut off by half-planes.
    ///
    /// `cumulative(r)` is the kernel's flux within radius `r` (1 at `r = 1`); each half-plane is `n . p > -d`, given as
    /// the angle of `n` and `d >= 0`.
    pub(super) fn mean(half_planes: &[(f64, f64)], cumulative: impl Fn(f64) -> f64) -> f64 {
        let n = 400_000;
        let along = |i: usize| {
            let phi = TAU * (i as f64 + 0.5) / n as f64;
            let reach = half_planes.iter().map(|&(angle, d)| {
                let cosine = -(phi - angle).cos();
                if cosine > 0.0 { d / cosine } else { f64::INFINITY }
            });
            cumulative(reach.fold(1.0, f64::min))
        };
        (0..n).map(along).sum::<f64>() / n as f64
    }

    /// The share of the unit disc inside the half-planes.
    pub(super) fn area(half_planes: &[(f64, f64)]) -> f64 {
        mean(half_planes, |r| r * r)
    }
}
