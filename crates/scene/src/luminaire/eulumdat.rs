//! Reading EULUMDAT.
//!
//! One value a line (A. Stockmar 1990; numbers of lines as there): 26 of header, six for each set of lamps, ten direct
//! ratios, the C angles of all planes, the gamma angles, and the intensities in cd per 1000 lm of those planes that the
//! symmetry needs.

use super::header::{count, factor, flux_note, intensity, opening_note, range_note, rising};
use super::text::{Lines, Short, number, too_much};
use super::{IntensityTable, Luminaire, LuminaireError, Symmetry};

pub(super) fn parse(bytes: &[u8]) -> Result<Luminaire, LuminaireError> {
    let mut values = Values { lines: Lines::new(bytes)? };
    let header = Header::read(&mut values)?;
    let all = values.angles(header.planes, "C")?;
    let gamma = values.angles(header.heights, "gamma")?;
    let c = stated(header.symmetry, &all);
    let mut candela = Vec::new();
    for plane in &c {
        for angle in &gamma {
            let name = format_args!("the intensity at {plane}, {angle} degrees");
            let number = values.number(name)?;
            candela.push(header.scale * intensity(number, name, &values.lines)?);
        }
    }
    while let Some(line) = values.lines.next() {
        if !line.is_empty() {
            return Err(too_much(&values.lines, line));
        }
    }
    let table = IntensityTable::new(header.symmetry, &c, &gamma, &candela)?;
    let flux = flux_note(&table, header.flux, "its lamps times its light output ratio");
    let notes = [header.lamps_note, header.tilt_note, flux, range_note(&table), opening_note(header.opening)];
    Ok(Luminaire { table, notes: notes.into_iter().flatten().collect() })
}

/// The angles of the planes whose intensities the file states: of a symmetric table a part of all.
fn stated(symmetry: Symmetry, all: &[f64]) -> Vec<f64> {
    let count = all.len();
    match symmetry {
        Symmetry::None => all.to_vec(),
        // Whatever the one plane is called, it stands for all.
        Symmetry::Rotational => vec![0.0],
        Symmetry::AboutC0 => all[..(count / 2 + 1).min(count)].to_vec(),
        // From C270 through C0 to C90.
        Symmetry::AboutC90 => {
            let (before, after) = (&all[(3 * count / 4).min(count)..], &all[..(count / 4 + 1).min(count)]);
            before.iter().map(|angle| angle - 360.0).chain(after.iter().copied()).collect()
        }
        Symmetry::Quadrant => all[..(count / 4 + 1).min(count)].to_vec(),
    }
}

struct Header {
    symmetry: Symmetry,
    /// Counts of C-planes all around, stated or not, and of gamma angles.
    planes: usize,
    heights: usize,
    /// From the file's numbers to cd.
    scale: f64,
    /// Of the luminaire with its first set of lamps, as the header has it, lm.
    flux: f64,
    /// Sides in metres.
    opening: [f64; 3],
    lamps_note: Option<String>,
    tilt_note: Option<String>,
}

impl Header {
    fn read(values: &mut Values) -> Result<Self, LuminaireError> {
        values.skip(2, "the symmetry indicator")?;
        let symmetry = symmetry(values)?;
        let planes = values.count("the number of C-planes")?;
        values.skip(1, "the number of gamma angles")?;
        let heights = values.count("the number of gamma angles")?;
        values.skip(9, "the luminous area")?;
        let mut millimetres = |name| values.optional(name).map(|side| 1e-3 * side.unwrap_or(0.0));
        let (length, width) = (millimetres("the length of the luminous area")?, millimetres("its width")?);
        let height = (0..4).try_fold(0.0, |most: f64, _| millimetres("its height").map(|height| most.max(height)))?;
        values.skip(1, "the light output ratio")?;
        let output_ratio = values.optional("the light output ratio")?;
        let conversion = values.number(format_args!("the conversion factor"))?;
        let conversion = factor(conversion, format_args!("the conversion factor"), &values.lines)?;
        let tilt = values.optional("the tilt")?.unwrap_or(0.0);
        let sets = values.count("the number of lamp sets")?;
        let lamps = lamp_flux(values, sets)?;
        values.skip(10, "the C angles")?;
        Ok(Self {
            symmetry,
            planes,
            heights,
            scale: conversion * lamps / 1000.0,
            flux: lamps * output_ratio.unwrap_or(0.0) / 100.0,
            opening: [length, width, height],
            lamps_note: (sets > 1)
                .then(|| format!("has {sets} sets of lamps; it is lit by the first, of {} lm", Short(lamps))),
            tilt_note: (tilt != 0.0)
                .then(|| format!("was measured at a tilt of {} degrees, which is not undone", Short(tilt))),
        })
    }
}

fn symmetry(values: &mut Values) -> Result<Symmetry, LuminaireError> {
    Ok(match values.number(format_args!("the symmetry indicator"))? {
        0.0 => Symmetry::None,
        1.0 => Symmetry::Rotational,
        2.0 => Symmetry::AboutC0,
        3.0 => Symmetry::AboutC90,
        4.0 => Symmetry::Quadrant,
        other => {
            let what = format!("the symmetry indicator is {}", Short(other));
            return Err(values.lines.error(what, "give a EULUMDAT file with a whole number from 0 to 4 there"));
        }
    })
}

/// Total flux of the first set of lamps, lm; the values of each set stand together.
fn lamp_flux(values: &mut Values, sets: usize) -> Result<f64, LuminaireError> {
    let name = format_args!("the total flux of the lamps");
    values.skip(2, "the total flux of the lamps")?;
    let flux = values.number(name)?;
    if !(flux > 0.0 && flux <= 1e12) {
        let mend = "give it in lm: the intensities are per 1000 lm of it";
        return Err(values.lines.error(format!("{name} is {}", Short(flux)), mend));
    }
    values.skip(3, "the direct ratios")?;
    // A count that the file does not bear out ends with the file.
    for _ in 1..sets {
        values.skip(6, "the direct ratios")?;
    }
    Ok(flux)
}

struct Values<'f> {
    lines: Lines<'f>,
}

impl<'f> Values<'f> {
    fn line(&mut self, name: std::fmt::Arguments) -> Result<&'f [u8], LuminaireError> {
        match self.lines.next() {
            Some(line) => Ok(line),
            None if self.lines.number < 26 => {
                let what = format!("is not a EULUMDAT file: it ends on line {}", self.lines.number);
                Err(LuminaireError::new(what, "give a valid .ldt file"))
            }
            None => Err(self.lines.error(format!("the file ends before {name}"), "complete it")),
        }
    }

    fn skip(&mut self, count: usize, name: &str) -> Result<(), LuminaireError> {
        (0..count).try_for_each(|_| self.line(format_args!("{name}")).map(drop))
    }

    /// A number, with a decimal point or comma.
    fn number(&mut self, name: std::fmt::Arguments) -> Result<f64, LuminaireError> {
        let line = self.line(name)?;
        let pointed: Vec<u8> = line.iter().map(|&b| if b == b',' { b'.' } else { b }).collect();
        number(&pointed, name).map_err(|(what, mend)| self.lines.error(what, mend))
    }

    /// A number, or `None` where the line is empty.
    fn optional(&mut self, name: &str) -> Result<Option<f64>, LuminaireError> {
        match self.lines.peek() {
            Some(b"") => self.line(format_args!("{name}")).map(|_| None),
            _ => self.number(format_args!("{name}")).map(Some),
        }
    }

    fn count(&mut self, name: &str) -> Result<usize, LuminaireError> {
        let number = self.number(format_args!("{name}"))?;
        count(number, format_args!("{name}"), &self.lines)
    }

    fn angles(&mut self, count: usize, name: &str) -> Result<Vec<f64>, LuminaireError> {
        let mut angles = Vec::new();
        for index in 1..=count {
            let name = format_args!("{name} angle {index} of {count}");
            let number = self.number(name)?;
            angles.push(rising(angles.last().copied(), number, name, &self.lines)?);
        }
        Ok(angles)
    }
}
