//! The light in CUBE by the independent solution.

use photonlab_reference::cube::{Cube, CubeSolution};

/// The six meters: name and position from the face's centre in half-edges.
pub(super) const METERS: [(&str, [f64; 2]); 6] = [
    ("A, face centre", [0.0, 0.0]),
    ("B", [0.5, 0.0]),
    ("C", [0.5, 0.5]),
    ("D, edge middle", [0.998, 0.0]),
    ("E, edge quarter", [0.998, 0.5]),
    ("F, corner", [0.998, 0.998]),
];
/// Knots per axis of the table.
const KNOTS: usize = 48;

/// Illuminance on a face, from a table of the indirect part (direct light is a formula).
pub(super) struct CubeField {
    cube: Cube,
    indirect: Vec<f64>,
}

impl CubeField {
    /// Solves the benchmark and tabulates it.
    pub(super) fn new() -> Self {
        Self::of(&Cube::BENCHMARK.solve())
    }

    fn of(solution: &CubeSolution) -> Self {
        let knot = |i: usize| 1.0 - (i as f64 / KNOTS as f64).powi(3);
        let mut indirect = vec![0.0; (KNOTS + 1) * (KNOTS + 1)];
        for i in 0..=KNOTS {
            for j in 0..=i {
                let value = solution.indirect(knot(i), knot(j));
                indirect[i * (KNOTS + 1) + j] = value;
                indirect[j * (KNOTS + 1) + i] = value;
            }
        }
        Self { cube: *solution.cube(), indirect }
    }

    /// The cube.
    pub(super) fn cube(&self) -> &Cube {
        &self.cube
    }

    /// Lux at (u, v), interpolated: good to about 1e-4; zero outside the face.
    pub(super) fn illuminance(&self, u: f64, v: f64) -> f64 {
        let (u, v) = (u.abs(), v.abs());
        if u > 1.0 || v > 1.0 {
            return 0.0;
        }
        let place = |x: f64| {
            let at = (1.0 - x).cbrt() * KNOTS as f64;
            let low = (at as usize).min(KNOTS - 1);
            (low, at - low as f64)
        };
        let ((i, s), (j, t)) = (place(u), place(v));
        let knot = |i: usize, j: usize| self.indirect[i * (KNOTS + 1) + j];
        let along = |j: usize| knot(i, j) + s * (knot(i + 1, j) - knot(i, j));
        self.cube.direct(u, v) + along(j) + t * (along(j + 1) - along(j))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_agrees_with_the_solution() {
        let solution = Cube::BENCHMARK.solve();
        let field = CubeField::of(&solution);
        for (u, v) in [(0.0, 0.0), (0.3, 0.7), (0.998, 0.5), (0.998, 0.998), (0.93, 0.2), (1.0, 0.95)] {
            let relative = field.illuminance(u, v) / solution.illuminance(u, v) - 1.0;
            assert!(relative.abs() < 3e-4, "({u}, {v}): {relative}");
        }
    }
}
