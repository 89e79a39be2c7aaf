//! CUBE: the inside of a diffuse cube with an isotropic point source in its centre (Khodulev and Kopylov 1996).
//!
//! A face at distance `h` from the source receives directly `I / h^2 (1 + u^2 + v^2)^(-3/2)`, with `u`, `v` the
//! position from the face's centre in half-edges. By symmetry all six faces carry one function with the symmetry of
//! the square, and the total irradiance solves `E = E_direct + rho K E`, where `K` gathers the exitance of the other
//! five faces. It is solved on two meshes graded differently towards the edges; the difference is
//! the error bar.
//!
//! Evidence in the tests: a uniform exitance must come back as itself (row sums are not adjusted); the mean over a
//! face must be [`Cube::mean_irradiance`] (energy, not built in either); one bounce against brute force over directions;
//! all bounces against path tracing; the published table.

#[cfg(test)]
mod checks;
pub(crate) mod mesh;
pub(crate) mod operator;
mod solution;

use std::f64::consts::PI;

use crate::mitsuba;
use crate::out_of_range::{OutOfRange, require_albedo, require_positive};

pub use solution::CubeSolution;

/// A cube seen from inside, with an isotropic point source in its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cube {
    half_edge: f64,
    intensity: f64,
    reflectance: f64,
}

/// A luminance of the published table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Published {
    /// Position on a face, from its centre in half-edges.
    pub at: [f64; 2],
    /// Luminance in cd/m^2, four digits; at an edge or corner it is the limit from inside the face.
    pub luminance: f64,
}

impl Cube {
    /// The published benchmark: edge 10 m, 50 000 cd, reflectance 2/3.
    pub const BENCHMARK: Cube = Cube { half_edge: 5.0, intensity: 50_000.0, reflectance: 2.0 / 3.0 };

    /// The table published for [`Cube::BENCHMARK`] (Khodulev and Kopylov, GraphiCon 1996). The positions of the second,
    /// third and fifth row are inferred, and confirmed by [`Cube::solve`].
    pub const PUBLISHED: [Published; 6] = [
        Published { at: [0.0, 0.0], luminance: 892.8 },
        Published { at: [0.5, 0.0], luminance: 768.7 },
        Published { at: [0.5, 0.5], luminance: 686.6 },
        Published { at: [1.0, 0.0], luminance: 565.1 },
        Published { at: [1.0, 0.5], luminance: 522.4 },
        Published { at: [1.0, 1.0], luminance: 388.4 },
    ];

    /// A cube of edge `2 half_edge` (m), a source of `intensity` (W/sr or cd), and the diffuse `reflectance` of all
    /// faces, in `[0, 1)`.
    pub fn new(half_edge: f64, intensity: f64, reflectance: f64) -> Result<Self, OutOfRange> {
        require_positive("half_edge", half_edge)?;
        require_positive("intensity", intensity)?;
        require_albedo("reflectance", reflectance)?;
        Ok(Cube { half_edge, intensity, reflectance })
    }

    /// Half the edge in metres.
    pub fn half_edge(&self) -> f64 {
        self.half_edge
    }

    /// The source's intensity in W/sr or cd.
    pub fn intensity(&self) -> f64 {
        self.intensity
    }

    /// The faces' reflectance.
    pub fn reflectance(&self) -> f64 {
        self.reflectance
    }

    /// Irradiance straight from the source at `(u, v)` in half-edges from a face's centre, in W/m^2 or lx: exact.
    pub fn direct(&self, u: f64, v: f64) -> f64 {
        self.intensity / (self.half_edge * self.half_edge) * (1.0 + u * u + v * v).powf(-1.5)
    }

    /// Mean irradiance over a face in W/m^2 or lx, exact by energy: the lamp's `4 pi I` is absorbed by `24 h^2` of wall,
    /// so that the mean is `4 pi I / (24 h^2 (1 - rho))`.
    pub fn mean_irradiance(&self) -> f64 {
        PI * self.intensity / (6.0 * self.half_edge * self.half_edge * (1.0 - self.reflectance))
    }

    /// Solves for the irradiance everywhere; about a second in an optimised build.
    pub fn solve(&self) -> CubeSolution {
        CubeSolution::new(*self)
    }

    /// The scene as Mitsuba 3 XML with a radiance meter in the source's place looking at each `(u, v)` of the face +x.
    ///
    /// A meter at `(1, v)` would look at an edge; keep a little inside and compare with the solution at the same place.
    pub fn xml(&self, meters: &[[f64; 2]]) -> String {
        let h = self.half_edge;
        let mut body = mitsuba::point_lamp([0.0; 3], &[self.intensity]);
        let walls = mitsuba::diffuse(&[self.reflectance]);
        body += &mitsuba::inside_cube("room", h, &walls);
        for (i, [u, v]) in meters.iter().enumerate() {
            body += &mitsuba::radiance_meter(&format!("meter-{i}"), [0.0; 3], [h, u * h, v * h]);
        }
        mitsuba::scene(&body)
    }
}
