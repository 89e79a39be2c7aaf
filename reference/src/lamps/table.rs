//! A point lamp whose intensity is given by a table, as luminaire files give it.
//!
//! The intensity depends on the angle `t` from straight down alone; between rows it is linear in `t` (the usual reading
//! of a luminaire file) or in `cos t`. Irradiance of the plane as for any point lamp, `I(t) h / (h^2 + x^2)^(3/2)`; the
//! flux in a zone is `2 pi` times the integral of `I sin t`: with `I = c + m t` it is
//! `2 pi [-(c + m t) cos t + m sin t]`, with `I` linear in `cos t` the mean of both rows times `2 pi` times the
//! difference of cosines. (Textbook; catalogue entry C6.) Exact to rounding.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// How the intensity runs between the rows of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear in the angle.
    Angle,
    /// Linear in its cosine.
    Cosine,
}

/// A lamp above the origin with an intensity for each of equally spaced angles from straight down (0) to the horizon.
#[derive(Clone, Debug, PartialEq)]
pub struct TableLamp {
    height: f64,
    intensity: Vec<f64>,
    interpolation: Interpolation,
}

impl TableLamp {
    /// A lamp at `height` (m) with these intensities (W/sr or cd), at least two, the first straight down, the last
    /// horizontal; nothing is sent upwards.
    pub fn new(height: f64, intensity: Vec<f64>, interpolation: Interpolation) -> Result<Self, OutOfRange> {
        require_positive("height", height)?;
        require(intensity.len() >= 2, "number of intensities", intensity.len() as f64, "at least 2")?;
        for &i in &intensity {
            require(i >= 0.0 && i.is_finite(), "intensity", i, "finite and at least 0")?;
        }
        Ok(TableLamp { height, intensity, interpolation })
    }

    fn step(&self) -> f64 {
        FRAC_PI_2 / (self.intensity.len() - 1) as f64
    }

    /// Intensity at this angle from straight down (radians, 0 to pi/2), in W/sr or cd.
    pub fn intensity(&self, angle: f64) -> f64 {
        let row = ((angle / self.step()) as usize).min(self.intensity.len() - 2);
        let [from, to] = [row, row + 1].map(|i| i as f64 * self.step());
        let share = match self.interpolation {
            Interpolation::Angle => (angle - from) / (to - from),
            Interpolation::Cosine => (angle.cos() - from.cos()) / (to.cos() - from.cos()),
        };
        self.intensity[row] + share * (self.intensity[row + 1] - self.intensity[row])
    }

    /// Irradiance of the plane z = 0 at distance `x` (m) from the point below the lamp, in W/m^2 or lx.
    pub fn irradiance(&self, x: f64) -> f64 {
        self.intensity((x / self.height).atan()) * self.height / self.height.hypot(x).powi(3)
    }

    /// Flux within the cone of this half-angle (radians, up to pi/2) around straight down, in W or lm.
    pub fn flux_within_angle(&self, angle: f64) -> f64 {
        let zones = (0..self.intensity.len() - 1).map(|row| {
            let [from, to] = [row, row + 1].map(|i| (i as f64 * self.step()).min(angle));
            let [first, last] = [from, to].map(|t| self.intensity(t));
            match self.interpolation {
                _ if to <= from => 0.0,
                Interpolation::Cosine => 0.5 * (first + last) * (from.cos() - to.cos()),
                Interpolation::Angle => {
                    let slope = (last - first) / (to - from);
                    first * from.cos() - last * to.cos() + slope * (to.sin() - from.sin())
                }
            }
        });
        2.0 * PI * zones.sum::<f64>()
    }

    /// The lamp's whole flux in W or lm.
    pub fn flux(&self) -> f64 {
        self.flux_within_angle(FRAC_PI_2)
    }

    /// The lamp as a luminaire file (IESNA LM-63-2002): type C, one plane, candela as given.
    pub fn ies(&self) -> String {
        let n = self.intensity.len();
        let words = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let angles: Vec<f64> = (0..n).map(|i| 90.0 * i as f64 / (n - 1) as f64).collect();
        let (angles, candela) = (words(&angles), words(&self.intensity));
        format!(
            "IESNA:LM-63-2002\n[TEST] closed form\n[MANUFAC] none\nTILT=NONE\n1 -1 1 {n} 1 1 2 0 0 0\n1 1 0\n{angles}\n0\n{candela}\n"
        )
    }

    /// The lamp with square meters at these distances (m) and, in a second scene, a disc of this radius that reads flux.
    pub fn cases(&self, distances: &[f64], radius: f64) -> Vec<Case> {
        let start = || {
            let mut draft = Draft::with(mitsuba::file_lamp([0.0, 0.0, self.height], [0.0, 0.0, -1.0], "table.ies"));
            draft.file("table.ies", self.ies());
            draft
        };
        let (mut squares, mut disc) = (start(), start());
        for &x in distances {
            // Rows of the table inside a meter leave a kink under the quadrature: below 1e-4 of the irradiance.
            let uncertainty = 1e-4 * self.irradiance(x);
            squares.square(Place::floor([x, 0.0, 0.0], [0.03; 2]), uncertainty, |p| self.irradiance(p[0].hypot(p[1])));
        }
        let flux = self.flux_within_angle((radius / self.height).atan());
        disc.receiver(Reads::Flux, "disk", Place::floor([0.0; 3], [radius; 2]), flux, 1e-9 * flux);
        vec![squares.case("irradiance"), disc.case("flux")]
    }
}

/// The catalogue's C6 table, 3 m above the plane.
pub fn catalogue_lamp(interpolation: Interpolation) -> TableLamp {
    let intensity = vec![1000.0, 980.0, 900.0, 760.0, 560.0, 340.0, 160.0, 60.0, 15.0, 0.0];
    TableLamp { height: 3.0, intensity, interpolation }
}

/// The catalogue's C6, linear in the angle.
pub fn cases() -> Vec<Case> {
    catalogue_lamp(Interpolation::Angle).cases(&[0.0, 0.5, 1.0, 2.0, 3.0, 5.0], 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    #[test]
    fn catalogue_values() {
        let [angle, cosine] = [Interpolation::Angle, Interpolation::Cosine].map(catalogue_lamp);
        for (got, want) in [
            (angle.flux(), 1878.395),
            (cosine.flux(), 1889.5822),
            (angle.flux_within_angle((2.0f64 / 3.0).atan()), 895.79158),
            (angle.irradiance(0.0), 111.11111),
            (angle.irradiance(1.0), 86.569287),
            (cosine.irradiance(1.0), 86.893948),
            (angle.irradiance(5.0), 2.6836646),
            (cosine.irradiance(5.0), 2.697676),
        ] {
            assert!((got / want - 1.0).abs() < 1e-7, "{got} {want}");
        }
    }

    #[test]
    fn the_flux_is_the_integral_of_the_irradiance() {
        for interpolation in [Interpolation::Angle, Interpolation::Cosine] {
            let lamp = catalogue_lamp(interpolation);
            let rule = Gauss::new(16);
            // In pieces that end where a row does.
            let pieces = (0..6).map(|row| {
                let at = |row: i32| 3.0 * (10.0 * f64::from(row)).to_radians().tan();
                rule.composite(at(row), at(row + 1), 4, |x| 2.0 * PI * x * lamp.irradiance(x))
            });
            let (sum, flux) = (pieces.sum::<f64>(), lamp.flux_within_angle(60f64.to_radians()));
            assert!((sum / flux - 1.0).abs() < 1e-12, "{interpolation:?}: {sum} {flux}");
        }
    }

    #[test]
    fn the_file_carries_the_table() {
        let cases = cases();
        mitsuba::assert_balanced(&cases[0].xml);
        let ies = &cases[0].files[0].1;
        assert!(ies.contains("\n0 10 20 30 40 50 60 70 80 90\n0\n1000 980 900"), "{ies}");
        assert!(TableLamp::new(1.0, vec![1.0], Interpolation::Angle).is_err());
    }
}
