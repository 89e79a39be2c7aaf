//! Intensities over all directions.

use std::f64::consts::PI;

use glam::DVec3;

use super::text::Short;
use super::{LuminaireError, Symmetry};

/// Most cells of a table: steps of a tenth of a degree fit.
const MOST_CELLS: usize = 1 << 23;
/// Smallest step between angles, degrees: a draw inside a cell still has a thousand places to fall on.
const SMALLEST_STEP: f64 = 1e-4;
/// Largest intensity, cd.
const LARGEST: f64 = 1e30;
/// Smallest flux, lm: ratios with it are exact.
const SMALLEST_FLUX: f64 = 1e-30;

/// Far-field intensities in cd over C and gamma, bilinear in both angles; dark outside the range of gamma.
/// [`super`] says how the angles lie in the lamp's own axes.
#[derive(Clone, PartialEq)]
pub struct IntensityTable {
    /// Degrees, from 0 to 360, rising.
    c: Vec<f64>,
    /// Degrees, within [0, 180], rising.
    gamma: Vec<f64>,
    /// cd, plane by plane along gamma.
    intensity: Vec<f64>,
    /// The largest, cd.
    brightest: f64,
    /// Running sum of the cells' flux, lm; cells in the order of their first corners.
    cumulative: Vec<f64>,
}

/// The part of a table between two neighbouring angles each way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Degrees.
    pub c: [f64; 2],
    /// Degrees.
    pub gamma: [f64; 2],
    /// cd at (C, gamma).
    pub corners: [[f64; 2]; 2],
}

impl IntensityTable {
    /// A table from the planes that a file or a goniometer states: `intensity` in cd holds the values along `gamma` of one
    /// angle of `c` after the other. Angles in degrees, rising by at least 1e-4, gamma within [0, 180]; `symmetry` says how
    /// the planes stand for all. Something must shine.
    pub fn new(symmetry: Symmetry, c: &[f64], gamma: &[f64], intensity: &[f64]) -> Result<Self, LuminaireError> {
        let wrong = |what: String, mend: &str| Err(LuminaireError::new(what, mend));
        if gamma.len() < 2 || gamma[0] < 0.0 || gamma[gamma.len() - 1] > 180.0 {
            return wrong("has no range of vertical angles".into(), "give at least two within 0 and 180 degrees");
        }
        if !(rise(c) && rise(gamma)) {
            return wrong("has angles that do not rise".into(), "put them in order, at least 1e-4 degrees apart");
        }
        if c.len().checked_mul(gamma.len()) != Some(intensity.len()) {
            let what = format!("has {} intensities for {} x {} angles", intensity.len(), c.len(), gamma.len());
            return wrong(what, "give one for each pair");
        }
        if symmetry.most_planes(c.len()).saturating_mul(gamma.len()) > MOST_CELLS {
            return wrong("has too many angles".into(), "give a table with wider steps");
        }
        if let Some(bad) = intensity.iter().find(|x| !(0.0..=LARGEST).contains(*x)) {
            return wrong(format!("has an intensity of {} cd", Short(*bad)), "give intensities between 0 and 1e30 cd");
        }
        let planes: Vec<&[f64]> = intensity.chunks(gamma.len()).collect();
        let (c, planes) = symmetry.unfold(c, &planes)?;
        Self::unfolded(c, gamma.to_vec(), planes.concat())
    }

    fn unfolded(c: Vec<f64>, gamma: Vec<f64>, intensity: Vec<f64>) -> Result<Self, LuminaireError> {
        if !rise(&c) {
            return Err(LuminaireError::new(
                "has planes too close to each other",
                "put them at least 1e-4 degrees apart",
            ));
        }
        let brightest = intensity.iter().copied().fold(0.0, f64::max);
        let mut table = Self { c, gamma, intensity, brightest, cumulative: Vec::new() };
        let (mut sum, cells) = (0.0, (table.c.len() - 1) * (table.gamma.len() - 1));
        table.cumulative.reserve_exact(cells);
        for index in 0..cells {
            sum += table.cell(index).flux();
            table.cumulative.push(sum);
        }
        if sum < SMALLEST_FLUX {
            return Err(LuminaireError::new("emits nothing", "give a table that shines, or take the lamp out"));
        }
        Ok(table)
    }

    /// Angles C in degrees, from 0 to 360.
    pub fn c(&self) -> &[f64] {
        &self.c
    }

    /// Angles gamma in degrees.
    pub fn gamma(&self) -> &[f64] {
        &self.gamma
    }

    /// Intensities in cd along gamma at the angle C of this index.
    pub fn plane(&self, index: usize) -> &[f64] {
        &self.intensity[index * self.gamma.len()..][..self.gamma.len()]
    }

    /// The largest intensity, cd.
    pub fn brightest(&self) -> f64 {
        self.brightest
    }

    /// The integral over all directions, lm: exact for what the table is between its angles.
    pub fn flux(&self) -> f64 {
        self.cumulative[self.cumulative.len() - 1]
    }

    /// Intensity in cd at angles in degrees, C of any turn.
    pub fn intensity(&self, c: f64, gamma: f64) -> f64 {
        if !(self.gamma[0]..=self.gamma[self.gamma.len() - 1]).contains(&gamma) {
            return 0.0;
        }
        let c = c.rem_euclid(360.0);
        let below = |angles: &[f64], x: f64| angles.partition_point(|a| *a <= x).clamp(1, angles.len() - 1) - 1;
        let cell = self.cell(below(&self.c, c) * (self.gamma.len() - 1) + below(&self.gamma, gamma));
        cell.intensity(c, gamma)
    }

    /// Intensity in cd along a unit vector in the lamp's own axes.
    pub fn intensity_along(&self, direction: DVec3) -> f64 {
        let DVec3 { x, y, z } = direction;
        self.intensity(y.atan2(x).to_degrees(), x.hypot(y).atan2(-z).to_degrees())
    }

    /// The cell chosen by a number in [0, 1), in proportion to its flux.
    pub fn choose(&self, xi: f64) -> Cell {
        let target = xi * self.flux();
        // A cell without flux is never first above a target.
        let index = self.cumulative.partition_point(|sum| *sum <= target);
        self.cell(index.min(self.cumulative.partition_point(|sum| *sum < self.flux())))
    }

    fn cell(&self, index: usize) -> Cell {
        let rows = self.gamma.len() - 1;
        let (i, j) = (index / rows, index % rows);
        let corner = |i: usize, j: usize| self.intensity[i * self.gamma.len() + j];
        Cell {
            c: [self.c[i], self.c[i + 1]],
            gamma: [self.gamma[j], self.gamma[j + 1]],
            corners: [i, i + 1].map(|i| [j, j + 1].map(|j| corner(i, j))),
        }
    }
}

fn rise(angles: &[f64]) -> bool {
    // Angles as files round them: the step is met up to rounding.
    angles.iter().all(|a| a.is_finite()) && angles.windows(2).all(|pair| pair[1] - pair[0] > 0.999 * SMALLEST_STEP)
}

impl Cell {
    /// Intensity in cd at angles inside the cell, degrees; angles outside are taken to its rim.
    pub fn intensity(&self, c: f64, gamma: f64) -> f64 {
        let share = |[low, high]: [f64; 2], x: f64| ((x - low) / (high - low)).clamp(0.0, 1.0);
        let (u, v) = (share(self.c, c), share(self.gamma, gamma));
        let along = |ends: [f64; 2]| (1.0 - v) * ends[0] + v * ends[1];
        // The mean of equal corners may round to more than they are, which no bound by the brightest allows.
        ((1.0 - u) * along(self.corners[0]) + u * along(self.corners[1])).min(self.brightest())
    }

    /// The largest intensity in it, cd.
    pub fn brightest(&self) -> f64 {
        self.corners.as_flattened().iter().copied().fold(0.0, f64::max)
    }

    /// Integral over its directions, lm: of (a + b gamma) sin gamma in closed form, times the width in C, since the mean
    /// over C is linear in gamma.
    pub fn flux(&self) -> f64 {
        let [top, bottom] = [0, 1].map(|j| 0.5 * (self.corners[0][j] + self.corners[1][j]));
        let middle = 0.5 * (self.gamma[0] + self.gamma[1]).to_radians();
        let half = 0.5 * (self.gamma[1] - self.gamma[0]).to_radians();
        let even = (top + bottom) * middle.sin() * half.sin();
        let tilted = (bottom - top) * middle.cos() * moment(half);
        (self.c[1] - self.c[0]) / 180.0 * PI * (even + tilted).max(0.0)
    }
}

/// (sin d - d cos d) / d: the integral of x sin x over [-d, d], halved, over d.
fn moment(d: f64) -> f64 {
    if d < 0.1 {
        // The closed form cancels for small d.
        let d2 = d * d;
        d2 * (1.0 / 3.0 - d2 * (1.0 / 30.0 - d2 * (1.0 / 840.0 - d2 / 45360.0)))
    } else {
        d.sin() / d - d.cos()
    }
}

impl std::fmt::Debug for IntensityTable {
    /// With a hash in place of the numbers: the debug form stands for the table's identity.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let numbers = self.c.iter().chain(&self.gamma).chain(&self.intensity);
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        let hash = xxhash_rust::xxh3::xxh3_128(&bytes);
        write!(f, "IntensityTable {{ {} x {}, {hash:x} }}", self.c.len(), self.gamma.len())
    }
}
