//! Colours and spectra: `rgb`, `spectrum`, or one number.

use std::{fs, sync::Arc};

use photonlab_photometry::{Curve, Spectrum};

use super::element::Element;
use super::error::{Fault, SceneError};
use super::names::quote;
use super::number::{Range, float, list};
use super::picture::beside;

/// Longest spectrum read, in wavelengths: more than any instrument gives.
const MOST_WAVELENGTHS: usize = 100_000;

/// Largest file of a spectrum, bytes.
const LARGEST_FILE: u64 = 1 << 24;

/// What an `rgb`, `spectrum` or `float` states, each value in `range`.
pub(super) fn colour(element: &Element, range: Range) -> Result<Spectrum, SceneError> {
    if let Some(file) = element.attribute("filename") {
        return from_file(element, file, range).map(Spectrum::Curve);
    }
    let wrong = |fault| element.value_fault(fault);
    if element.attribute("type").is_some() {
        let what = "a spectrum with a type is known but not built yet";
        return Err(element.error(what, "give rgb, one number, or a list such as 400:0.1, 700:0.5"));
    }
    let Some(text) = element.attribute("value") else {
        return Err(element.error("has no value", "add value=\"...\""));
    };
    let check = |number: f64| range.check(number).map_err(wrong);
    if element.tag.name == "spectrum" && text.contains(':') {
        return pairs(text).and_then(|points| curve(&points, range)).map(Spectrum::Curve).map_err(wrong);
    }
    if element.tag.name != "rgb" {
        return list(text, &[1]).map_err(wrong).and_then(|numbers| check(numbers[0])).map(Spectrum::Uniform);
    }
    let numbers = list(text, &[1, 3]).map_err(wrong)?;
    numbers.iter().try_for_each(|&number| check(number).map(drop))?;
    Ok(Spectrum::Rgb(match numbers[..] {
        [red, green, blue] => [red, green, blue],
        _ => [numbers[0]; 3],
    }))
}

/// The curve through a list of wavelengths in nanometres with their values.
pub(super) fn curve(points: &[(f64, f64)], range: Range) -> Result<Arc<Curve>, Fault> {
    for &(_, value) in points {
        range.check(value)?;
    }
    let built = Curve::new(points).map(Arc::new);
    built.map_err(|error| {
        Fault::new(error.to_string(), "give wavelengths in nanometres that rise, such as 400:0.1, 700:0.5")
    })
}

/// Pairs such as `400:0.1, 700:0.5`.
pub(super) fn pairs(text: &str) -> Result<Vec<(f64, f64)>, Fault> {
    let pieces = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|piece| !piece.is_empty());
    let pair = |piece: &str| match piece.split_once(':') {
        Some((nm, value)) => Ok((float(nm)?, float(value)?)),
        None => {
            Err(Fault::new(format!("{} is no wavelength with a value", quote(piece)), "write pairs such as 400:0.1"))
        }
    };
    let found = pieces.take(MOST_WAVELENGTHS + 1).map(pair).collect::<Result<Vec<_>, Fault>>()?;
    if found.len() > MOST_WAVELENGTHS {
        return Err(Fault::new(format!("has more than {MOST_WAVELENGTHS} wavelengths"), "thin it out"));
    }
    Ok(found)
}

/// A text file with a wavelength and a value on each line, as Mitsuba reads it (`.spd`); `#` starts a comment.
fn from_file(element: &Element, file: &str, range: Range) -> Result<Arc<Curve>, SceneError> {
    let path = beside(element, file);
    let wrong = |what: String, mend: &str| element.error(format!("{}: {what}", path.display()), mend);
    if !path.is_file() {
        return Err(wrong(crate::absent::absent(&path).into(), "name a text file, relative to the scene's"));
    }
    if path.metadata().is_ok_and(|about| about.len() > LARGEST_FILE) {
        return Err(wrong(format!("has more than {LARGEST_FILE} bytes"), "thin it out"));
    }
    let text = fs::read_to_string(&path).map_err(|error| wrong(error.to_string(), "name a readable text file"))?;
    let mut points = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        let row = list(line, &[2]).map_err(|fault| {
            wrong(
                format!("line {}: {}", number + 1, fault.what),
                "give a wavelength in nanometres and a value on each line",
            )
        })?;
        points.push((row[0], row[1]));
        if points.len() > MOST_WAVELENGTHS {
            return Err(wrong(format!("has more than {MOST_WAVELENGTHS} wavelengths"), "thin it out"));
        }
    }
    curve(&points, range).map_err(|fault| wrong(fault.what, "give wavelengths that rise and values in range"))
}
