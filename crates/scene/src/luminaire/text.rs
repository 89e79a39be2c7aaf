//! Lines and numbers of a luminaire file, whatever code its words are in.

use std::fmt::{self, Arguments};
use std::slice::Split;

use crate::read::quote;

use super::LuminaireError;

/// The lines of a file without the space around them, counted from 1.
pub(super) struct Lines<'f> {
    rest: Split<'f, u8, fn(&u8) -> bool>,
    /// The line read last; 0 before the first.
    pub(super) number: usize,
}

impl<'f> Lines<'f> {
    /// Starts on the first line. Lines end with a line feed, or with a carriage return where there is no line feed.
    pub(super) fn new(bytes: &'f [u8]) -> Result<Self, LuminaireError> {
        if bytes.contains(&0) {
            return Err(LuminaireError::new(
                "is not a luminaire file: it holds no text",
                "give an LM-63 or a EULUMDAT file",
            ));
        }
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_end();
        // Files of old end with control-Z.
        let bytes = bytes.strip_suffix(b"\x1a").unwrap_or(bytes).trim_ascii_end();
        let ends: fn(&u8) -> bool = if bytes.contains(&b'\n') { |b| *b == b'\n' } else { |b| *b == b'\r' };
        Ok(Self { rest: bytes.split(ends), number: 0 })
    }

    /// The line that [`Iterator::next`] will give.
    pub(super) fn peek(&self) -> Option<&'f [u8]> {
        self.rest.clone().next().map(<[u8]>::trim_ascii)
    }

    /// An error about the line read last.
    pub(super) fn error(&self, what: impl Into<String>, mend: impl Into<String>) -> LuminaireError {
        LuminaireError::at(self.number.max(1), what, mend)
    }
}

impl<'f> Iterator for Lines<'f> {
    type Item = &'f [u8];

    fn next(&mut self) -> Option<&'f [u8]> {
        let line = self.rest.next()?.trim_ascii();
        self.number += 1;
        Some(line)
    }
}

/// A finite number, or what is wrong with it.
pub(super) fn number(word: &[u8], name: Arguments) -> Result<f64, (String, &'static str)> {
    let parsed = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
    match parsed {
        // Adding zero turns -0 into 0.
        Some(number) if number.is_finite() => Ok(number + 0.0),
        _ => Err((format!("{name} is {}, no finite number", quote(&String::from_utf8_lossy(word))), "give one")),
    }
}

/// A number in a sentence: in powers of ten where its digits would fill lines.
pub(super) struct Short(pub(super) f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = self;
        if *number == 0.0 || (1e-5..1e16).contains(&number.abs()) {
            fmt::Display::fmt(number, f)
        } else {
            fmt::LowerExp::fmt(number, f)
        }
    }
}

/// Words separated by space, commas and ends of lines.
pub(super) struct Words<'f> {
    pub(super) lines: Lines<'f>,
    line: &'f [u8],
}

impl<'f> Words<'f> {
    /// Starts on the line after those read so far.
    pub(super) fn new(lines: Lines<'f>) -> Self {
        Self { lines, line: b"" }
    }

    /// The next word.
    pub(super) fn word(&mut self) -> Option<&'f [u8]> {
        let separates = |b: &u8| *b == b',' || b.is_ascii_whitespace();
        loop {
            if let Some(start) = self.line.iter().position(|b| !separates(b)) {
                let rest = &self.line[start..];
                let end = rest.iter().position(separates).unwrap_or(rest.len());
                self.line = &rest[end..];
                return Some(&rest[..end]);
            }
            self.line = self.lines.next()?;
        }
    }

    /// The next number.
    pub(super) fn number(&mut self, name: Arguments) -> Result<f64, LuminaireError> {
        let word =
            self.word().ok_or_else(|| self.lines.error(format!("the file ends before {name}"), "complete it"))?;
        number(word, name).map_err(|(what, mend)| self.lines.error(what, mend))
    }

    /// Checks that nothing follows.
    pub(super) fn end(mut self) -> Result<(), LuminaireError> {
        match self.word() {
            Some(word) => Err(too_much(&self.lines, word)),
            None => Ok(()),
        }
    }
}

/// An error about what follows the last number.
pub(super) fn too_much(lines: &Lines, word: &[u8]) -> LuminaireError {
    let what = format!("{} follows the last intensity", quote(&String::from_utf8_lossy(word)));
    lines.error(what, "mend the counts of angles, or take it out")
}
