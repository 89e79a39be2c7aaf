//! Colours: `rgb`, a uniform `spectrum`, or one number.

use crate::Rgb;

use super::element::Element;
use super::error::Fault;
use super::number::{Range, list};

/// The colour that an `rgb`, `spectrum` or `float` states, each channel in `range`.
pub(super) fn colour(element: &Element, range: Range) -> Result<Rgb, Fault> {
    let text = uniform(element)?;
    let counts: &[usize] = if element.tag.name == "rgb" { &[1, 3] } else { &[1] };
    let numbers = list(text, counts)?;
    for &number in &numbers {
        range.check(number)?;
    }
    Ok(match numbers[..] {
        [red, green, blue] => [red, green, blue],
        _ => [numbers[0]; 3],
    })
}

/// The text of its numbers, if it is no spectrum that varies.
fn uniform(element: &Element) -> Result<&str, Fault> {
    let varies = |what: &str| {
        Fault::new(format!("is {what}, known but not built yet"), "give rgb, or a spectrum with one number for now")
    };
    for given in ["type", "filename"] {
        if element.attribute(given).is_some() {
            return Err(varies(&format!("a spectrum with {given}")));
        }
    }
    let text = element.attribute("value").ok_or_else(|| Fault::new("has no value", "add value=\"...\""))?;
    if element.tag.name == "spectrum" && text.contains(':') {
        return Err(varies("a list of wavelengths"));
    }
    Ok(text)
}
