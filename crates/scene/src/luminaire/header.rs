//! Checks and notes that both formats share.

use std::fmt::Arguments;

use super::text::{Lines, Short};
use super::{IntensityTable, LuminaireError};

/// Largest relative difference between a file's flux and its table's integral that goes unsaid.
const AGREES: f64 = 0.01;

/// Most of anything that a file counts.
const MOST: f64 = (1 << 24) as f64;

/// A count of angles or lamps.
pub(super) fn count(number: f64, name: Arguments, lines: &Lines) -> Result<usize, LuminaireError> {
    if number.fract() == 0.0 && (1.0..=MOST).contains(&number) {
        return Ok(number as usize);
    }
    Err(lines.error(format!("{name} is {}", Short(number)), "give a whole number from 1 to 16777216"))
}

/// A factor of all intensities.
pub(super) fn factor(number: f64, name: Arguments, lines: &Lines) -> Result<f64, LuminaireError> {
    if (1e-9..=1e9).contains(&number) {
        return Ok(number);
    }
    Err(lines.error(format!("{name} is {}", Short(number)), "give a positive number, 1 if it changes nothing"))
}

/// An intensity as the file writes it.
pub(super) fn intensity(number: f64, name: Arguments, lines: &Lines) -> Result<f64, LuminaireError> {
    if number >= 0.0 {
        return Ok(number);
    }
    Err(lines.error(format!("{name} is {}", Short(number)), "no intensity is negative; write 0 for what is dark"))
}

/// The angle after `before`.
pub(super) fn rising(before: Option<f64>, number: f64, name: Arguments, lines: &Lines) -> Result<f64, LuminaireError> {
    match before {
        Some(before) if number <= before => {
            let what = format!("{name} is {} after {}", Short(number), Short(before));
            Err(lines.error(what, "put the angles in rising order, each once"))
        }
        _ => Ok(number),
    }
}

/// What is to be said of a flux that the file states, called `whose`, against the table's own.
pub(super) fn flux_note(table: &IntensityTable, stated: f64, whose: &str) -> Option<String> {
    let flux = table.flux();
    let differs = stated > 0.0 && (flux / stated - 1.0).abs() > AGREES;
    differs.then(|| {
        let [share, flux, stated] = [100.0 * flux / stated, flux, stated].map(Short);
        format!("emits {flux:.1} lm by its intensities, {share:.1} % of the {stated:.1} lm that it states of {whose}")
    })
}

/// What is to be said of a luminous opening, in metres.
pub(super) fn opening_note(sides: [f64; 3]) -> Option<String> {
    let [length, width, height] = sides.map(|side| Short(side.abs()));
    (sides != [0.0; 3]).then(|| {
        format!(
            "has a luminous opening of {length:.3} x {width:.3} x {height:.3} m, which is not modelled: all light comes \
             from one point"
        )
    })
}

/// What is to be said of vertical angles that end where no format lets them.
pub(super) fn range_note(table: &IntensityTable) -> Option<String> {
    let gamma = table.gamma();
    let (first, last) = (gamma[0], gamma[gamma.len() - 1]);
    let legal = [0.0, 90.0].contains(&first) && [90.0, 180.0].contains(&last);
    let (first, last) = (Short(first), Short(last));
    (!legal).then(|| format!("has vertical angles from {first} to {last} degrees; it is dark outside them"))
}
