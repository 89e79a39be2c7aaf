//! Reading ANSI/IES LM-63.
//!
//! A file is a line with the version (none in 1986), lines of words, a line `TILT=...`, and numbers separated by space or
//! commas: number of lamps, lumens per lamp (-1: absolute photometry), multiplier, counts of vertical and horizontal angles,
//! photometric type, units, width, length, height; ballast factor, a second factor, input watts; the angles; candela plane
//! by plane.

use super::header::{count, factor, flux_note, intensity, opening_note, range_note, rising};
use super::text::{Lines, Short, Words};
use super::{IntensityTable, Luminaire, LuminaireError, Symmetry};

/// Metres in a foot, the unit of type 1.
const FOOT: f64 = 0.3048;

/// What the second number after the ballast factor is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SecondFactor {
    /// The ballast-lamp photometric factor of 1986 and 1991.
    Applies,
    /// Kept for the future in 1995 and 2002.
    Reserved,
    /// The code of how the file was made, of 2019.
    Code,
}

pub(super) fn parse(bytes: &[u8]) -> Result<Luminaire, LuminaireError> {
    let mut lines = Lines::new(bytes)?;
    let second = labels(&mut lines)?;
    let mut words = Words::new(lines);
    let header = Header::read(&mut words, second)?;
    let gamma = angles(&mut words, header.vertical, "vertical")?;
    let c = angles(&mut words, header.horizontal, "horizontal")?;
    let (symmetry, closing) = symmetry(&c, &words.lines)?;
    let mut candela = Vec::new();
    for plane in &c {
        for angle in &gamma {
            let name = format_args!("the intensity at {plane}, {angle} degrees");
            let number = words.number(name)?;
            candela.push(header.scale * intensity(number, name, &words.lines)?);
        }
    }
    words.end()?;
    let table = IntensityTable::new(symmetry, &c, &gamma, &candela)?;
    let lamps = header.flux.and_then(|flux| flux_note(&table, flux, "its lamps"));
    let notes = [header.note, closing, lamps, range_note(&table), opening_note(header.opening)];
    Ok(Luminaire { table, notes: notes.into_iter().flatten().collect() })
}

/// Reads up to the line `TILT=NONE`.
fn labels(lines: &mut Lines) -> Result<SecondFactor, LuminaireError> {
    let mut second = SecondFactor::Applies;
    while let Some(line) = lines.next() {
        let line = String::from_utf8_lossy(line).to_ascii_uppercase();
        if lines.number == 1 {
            second = version(&line);
        }
        let Some(tilt) = line.strip_prefix("TILT").and_then(|rest| rest.trim_start().strip_prefix('=')) else {
            continue;
        };
        if tilt.trim() == "NONE" {
            return Ok(second);
        }
        let what = format!("TILT={}: its flux depends on its tilt, which is not modelled", tilt.trim());
        let what = what.chars().take(120).collect::<String>();
        return Err(lines.error(what, "write TILT=NONE if it hangs as it was measured, and take out the tilt factors"));
    }
    Err(LuminaireError::new("is not an LM-63 file: it has no line TILT=", "give a valid .ies file"))
}

/// `IESNA91`, `IESNA:LM-63-1995`, `IES:LM-63-2019` and the like; nothing in 1986.
fn version(line: &str) -> SecondFactor {
    match line.split_once("LM-63-").and_then(|(_, year)| year.get(..4)).and_then(|year| year.parse::<u32>().ok()) {
        Some(2019..) => SecondFactor::Code,
        Some(1995..) => SecondFactor::Reserved,
        _ => SecondFactor::Applies,
    }
}

struct Header {
    /// Factor of all intensities.
    scale: f64,
    /// Of the lamps together, lm; `None` in absolute photometry.
    flux: Option<f64>,
    vertical: usize,
    horizontal: usize,
    /// Sides in metres; negative ones stand for round ones.
    opening: [f64; 3],
    note: Option<String>,
}

impl Header {
    fn read(words: &mut Words, second: SecondFactor) -> Result<Self, LuminaireError> {
        let number_of_lamps = words.number(format_args!("the number of lamps"))?;
        let lumens_per_lamp = words.number(format_args!("lumens per lamp"))?;
        let multiplier = words.number(format_args!("the multiplier"))?;
        let multiplier = factor(multiplier, format_args!("the multiplier"), &words.lines)?;
        let mut angles = |name: &str| {
            let number = words.number(format_args!("the number of {name} angles"))?;
            count(number, format_args!("the number of {name} angles"), &words.lines)
        };
        let (vertical, horizontal) = (angles("vertical")?, angles("horizontal")?);
        type_c(words)?;
        let metres = match words.number(format_args!("the type of units"))? {
            1.0 => FOOT,
            2.0 => 1.0,
            other => {
                return Err(words
                    .lines
                    .error(format!("the type of units is {}", Short(other)), "give 1 (feet) or 2 (metres)"));
            }
        };
        let mut side = |name: &str| words.number(format_args!("the {name}")).map(|side| metres * side);
        let (width, length, height) = (side("width")?, side("length")?, side("height")?);
        let ballast = words.number(format_args!("the ballast factor"))?;
        let ballast = factor(ballast, format_args!("the ballast factor"), &words.lines)?;
        let (second, note) = second_factor(words, second)?;
        words.number(format_args!("input watts"))?;
        let flux = number_of_lamps * lumens_per_lamp * ballast * second;
        Ok(Self {
            scale: multiplier * ballast * second,
            flux: (lumens_per_lamp > 0.0 && flux.is_finite()).then_some(flux),
            vertical,
            horizontal,
            opening: [length, width, height],
            note,
        })
    }
}

fn type_c(words: &mut Words) -> Result<(), LuminaireError> {
    let what = match words.number(format_args!("the photometric type"))? {
        1.0 => return Ok(()),
        2.0 => "is of photometric type B".to_owned(),
        3.0 => "is of photometric type A".to_owned(),
        other => format!("has the photometric type {}", Short(other)),
    };
    Err(words
        .lines
        .error(what, "give type C photometry (1); convert it, since a table is linear in its own angles only"))
}

fn second_factor(words: &mut Words, second: SecondFactor) -> Result<(f64, Option<String>), LuminaireError> {
    let number = words.number(format_args!("the number after the ballast factor"))?;
    match second {
        SecondFactor::Applies => {
            Ok((factor(number, format_args!("the ballast-lamp photometric factor"), &words.lines)?, None))
        }
        SecondFactor::Reserved if number != 1.0 => {
            let note = format!(
                "has {} in the place that its version keeps for future use; it is no factor there",
                Short(number)
            );
            Ok((1.0, Some(note)))
        }
        SecondFactor::Reserved | SecondFactor::Code => Ok((1.0, None)),
    }
}

fn angles(words: &mut Words, count: usize, name: &str) -> Result<Vec<f64>, LuminaireError> {
    let mut angles = Vec::new();
    for index in 1..=count {
        let name = format_args!("{name} angle {index} of {count}");
        let number = words.number(name)?;
        angles.push(rising(angles.last().copied(), number, name, &words.lines)?);
    }
    Ok(angles)
}

/// What the range of horizontal angles says of the symmetry, and a note where it is not the standard's.
fn symmetry(c: &[f64], lines: &Lines) -> Result<(Symmetry, Option<String>), LuminaireError> {
    let (first, last) = (c[0], c[c.len() - 1]);
    let symmetry = match (first, last) {
        _ if c.len() == 1 => Symmetry::Rotational,
        (0.0, 90.0) => Symmetry::Quadrant,
        (0.0, 180.0) => Symmetry::AboutC0,
        (90.0, 270.0) | (-90.0, 90.0) => Symmetry::AboutC90,
        (0.0, 360.0) => Symmetry::None,
        _ => {
            let widest = c.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            if !(first >= 0.0 && last < 360.0 && first + 360.0 - last <= 1.001 * widest) {
                let what = format!("its horizontal angles run from {} to {} degrees", Short(first), Short(last));
                return Err(lines.error(what, "end them at 0, 90, 180 or 360 degrees, starting at 0"));
            }
            let note = format!(
                "has horizontal angles from {} to {} degrees; the first closes the turn",
                Short(first),
                Short(last)
            );
            return Ok((Symmetry::None, Some(note)));
        }
    };
    Ok((symmetry, None))
}
