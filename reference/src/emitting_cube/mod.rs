//! A closed diffuse cube whose ceiling also emits.
//!
//! All faces reflect `rho`; the ceiling sends out the exitance `M` besides. The irradiance solves `E = E_direct + rho K E`
//! with `K` the one-bounce operator of [`crate::cube`]; `E_direct` is a rectangle's closed form. Light that is even and
//! light that is odd under exchange of floor and ceiling do not mix, so each is solved by itself, on two meshes
//! whose difference is the error bar. (Radiosity, Goral and others 1984; catalogue entry D4.)
//!
//! Energy demands `(1 - rho) (C + 4 W + F) = M` of the means of ceiling, wall and floor; the method does not use it.

mod solution;

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_albedo};
use crate::vector::Vector;

pub use solution::{EmittingCube, EmittingCubeSolution, Face};

/// The cube `[0, 1]^3` with meters on whole faces and radiance meters towards points of them.
fn case(cube: &EmittingCube, reflectance: f64) -> Result<Case, OutOfRange> {
    let solution = cube.solve(reflectance)?;
    let mut draft = Draft::default();
    let coating = mitsuba::diffuse(&[reflectance]);
    let lamp = coating.clone() + &mitsuba::area_lamp(&[1.0 / PI]);
    for (i, place) in Place::inside_box([0.0; 3], [1.0; 3]).into_iter().enumerate() {
        let (face, on_it) = match i {
            5 => (Face::Ceiling, &lamp),
            4 => (Face::Floor, &coating),
            _ => (Face::Wall, &coating),
        };
        draft.metered(Reads::Irradiance, place, on_it, solution.mean(face), solution.error_bound());
    }
    let points: [(Face, [f64; 2], Vector); 6] = [
        (Face::Floor, [0.5, 0.5], [0.5, 0.5, 0.0]),
        (Face::Floor, [0.1, 0.1], [0.1, 0.1, 0.0]),
        (Face::Wall, [0.5, 0.5], [0.5, 0.0, 0.5]),
        (Face::Wall, [0.5, 0.9], [0.5, 0.0, 0.9]),
        (Face::Ceiling, [0.5, 0.5], [0.5, 0.5, 1.0]),
        (Face::Ceiling, [0.01, 0.01], [0.01, 0.01, 1.0]),
    ];
    for (face, at, target) in points {
        let emitted = if face == Face::Ceiling { 1.0 } else { 0.0 };
        let radiance = (emitted + reflectance * solution.irradiance(face, at[0], at[1])) / PI;
        draft.radiance([0.4, 0.45, 0.55], target, &[radiance], solution.error_bound());
    }
    Ok(draft.case(format!("reflectance {reflectance}")))
}

/// The catalogue's D4: unit cube, exitance 1, six reflectances.
///
/// Seconds in an optimised build.
pub fn cases() -> Vec<Case> {
    let cube = EmittingCube::new();
    [0.0, 0.2, 0.5, 0.7, 0.8, 0.9].into_iter().flat_map(|rho| case(&cube, rho)).collect()
}

#[cfg(test)]
mod checks;
