//! Spectra of colours given as RGB.
//!
//! A colour's spectrum is the sum of its three numbers times three fixed curves, as in Mallett and Yuksel 2019 ("Spectral
//! primary decomposition for rendering with sRGB reflectance"): each curve lies in [0, 1], they add up to one at every
//! wavelength, and under daylight D65 each looks exactly like its sRGB primary. Among all such curves these are the
//! smoothest (least sum of squared steps between rows 10 nm apart; computed for this table by quadratic programming).

use crate::VISIBLE;

const STEP: f64 = 10.0;

/// Value at a wavelength in nanometres of the spectrum of a linear sRGB colour; zero outside [`VISIBLE`].
pub(crate) fn spectrum_of_rgb(rgb: [f64; 3], nm: f64) -> f64 {
    if !(VISIBLE[0]..=VISIBLE[1]).contains(&nm) {
        return 0.0;
    }
    let place = (nm - VISIBLE[0]) / STEP;
    let row = (place as usize).min(RED.len() - 2);
    let share = place - row as f64;
    let at = |rows: &[f64; 48]| rows[row] * (1.0 - share) + rows[row + 1] * share;
    let (red, green) = (at(&RED), at(&GREEN));
    rgb[0] * red + rgb[1] * green + rgb[2] * (1.0 - red - green)
}

#[rustfmt::skip]
const RED: [f64; 48] = [
    0.024944, 0.024944, 0.024939, 0.024925, 0.024871, 0.024650, 0.023893, 0.021853, 0.018913, 0.019152,
    0.031831, 0.012768, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
    0.000000, 0.022259, 0.210981, 0.476511, 0.733727, 0.919098, 1.000000, 1.000000, 1.000000, 1.000000,
    1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000,
    1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000, 1.000000,
];

#[rustfmt::skip]
const GREEN: [f64; 48] = [
    0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
    0.000000, 0.115378, 0.300496, 0.509553, 0.713337, 0.882110, 0.985888, 1.000000, 1.000000, 1.000000,
    1.000000, 0.932236, 0.737860, 0.488846, 0.253002, 0.080902, 0.000000, 0.000000, 0.000000, 0.000000,
    0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
    0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SRGB_OF_XYZ, daylight, matching};

    /// Under daylight a colour looks as it was given (sums of 5 nm rows, for which the curves were made).
    #[test]
    fn colours_come_back() {
        for rgb in [[1.0, 1.0, 1.0], [0.8, 0.1, 0.3], [0.0, 0.0, 1.0]] {
            let rows = (0..95).map(|i| (360.0 + 5.0 * f64::from(i), if i == 0 || i == 94 { 2.5 } else { 5.0 }));
            let mut xyz = [0.0; 3];
            let mut white = 0.0;
            for (nm, weight) in rows {
                let light = daylight(nm) * weight;
                white += light * matching(nm)[1];
                (0..3).for_each(|k| xyz[k] += light * spectrum_of_rgb(rgb, nm) * matching(nm)[k]);
            }
            for (row, wanted) in SRGB_OF_XYZ.iter().zip(rgb) {
                let seen = (0..3).map(|k| row[k] * xyz[k]).sum::<f64>() / white;
                assert!((seen - wanted).abs() < 1e-6, "{rgb:?}: {seen} for {wanted}");
            }
        }
    }

    #[test]
    fn the_curves_are_reflectances() {
        for nm in 360..=830 {
            for rgb in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
                let value = spectrum_of_rgb(rgb, f64::from(nm));
                assert!((-1e-9..=1.0 + 1e-9).contains(&value), "{rgb:?} at {nm} nm: {value}");
            }
        }
    }
}
