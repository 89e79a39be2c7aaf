//! Luminaires: far-field intensities by direction, in the files that makers publish.
//!
//! *Axes.* Type C photometry (CIE 121; LM-63 type C): the vertical angle gamma is measured from the lamp's own -z (nadir,
//! 0 degrees) to +z (180 degrees); the half-plane C0 lies towards its own +x, C90 towards +y, so C runs counterclockwise
//! seen from above. A lamp that nothing turns shines down in a world whose z points up. The two formats agree on the
//! angles but not on how makers lay a long luminaire into them: along C0 in LM-63, along C90 in EULUMDAT.
//!
//! *Between the angles* intensities are linear in both, bilinear in a cell of the table; outside the vertical range of the
//! table there is no light.
//!
//! *What the numbers mean.* A table is in cd. LM-63: the file's candela times its multiplier and ballast factors; its lumens
//! per lamp play no part. EULUMDAT: the file's cd per 1000 lm times its conversion factor and the total flux of the first
//! set of lamps over 1000 lm; the luminaire's light output ratio and its downward flux fraction are in the table already.
//! The flux of a luminaire is the table's own integral; where the file's statement of it differs, a note says so.

mod eulumdat;
mod goniometer;
mod header;
mod lm63;
mod symmetry;
mod table;
mod text;
mod write;

use std::{fs::File, io::Read, path::Path};

pub use symmetry::Symmetry;
pub use table::{Cell, IntensityTable};
pub use write::write_lm63;

/// Most bytes in a file: a table in steps of a tenth of a degree fits.
const BYTE_LIMIT: u64 = 64 << 20;

/// A luminaire as its file states it.
#[derive(Clone, Debug, PartialEq)]
pub struct Luminaire {
    /// Intensities in cd.
    pub table: IntensityTable,
    /// What the file says that is not used or does not agree, one sentence each, to go after the file's name.
    pub notes: Vec<String>,
}

/// Formats of luminaire files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// ANSI/IES LM-63 of 1986, 1991, 1995, 2002 or 2019 (`.ies`).
    Lm63,
    /// EULUMDAT (`.ldt`; A. Stockmar 1990).
    Eulumdat,
}

/// What is wrong with a luminaire, to go after the file's name, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{what}; {mend}", .line.map(|line| format!("line {line}: ")).unwrap_or_default())]
pub struct LuminaireError {
    /// Line of the luminaire file, counted from 1; `None` if it is about the whole.
    pub line: Option<usize>,
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub mend: String,
}

impl LuminaireError {
    fn new(what: impl Into<String>, mend: impl Into<String>) -> Self {
        Self { line: None, what: what.into(), mend: mend.into() }
    }

    fn at(line: usize, what: impl Into<String>, mend: impl Into<String>) -> Self {
        Self { line: Some(line), ..Self::new(what, mend) }
    }
}

/// Reads the luminaire at `path`; its extension says which format it is in. Anything but a plain file is refused before it
/// is opened, since opening a pipe waits.
pub fn read_luminaire(path: &Path) -> Result<Luminaire, LuminaireError> {
    if !path.is_file() {
        return Err(LuminaireError::new(crate::absent::absent(path), "name a file, relative to the scene's"));
    }
    let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
    let format = match extension.as_deref().and_then(|extension| extension.to_str()) {
        Some("ies") => Format::Lm63,
        Some("ldt") => Format::Eulumdat,
        _ => {
            return Err(LuminaireError::new("is neither .ies nor .ldt", "give an LM-63 or a EULUMDAT file"));
        }
    };
    let unreadable =
        |error: std::io::Error| LuminaireError::new(format!("cannot be read: {error}"), "give a file that can be");
    let mut bytes = Vec::new();
    File::open(path).map_err(unreadable)?.take(BYTE_LIMIT + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > BYTE_LIMIT {
        let what = format!("holds more than {} MiB", BYTE_LIMIT >> 20);
        return Err(LuminaireError::new(what, "give a table with wider steps"));
    }
    parse_luminaire(&bytes, format)
}

/// Reads a luminaire from the bytes of a file. Text in them may be in any code that has ASCII's digits.
pub fn parse_luminaire(bytes: &[u8], format: Format) -> Result<Luminaire, LuminaireError> {
    match format {
        Format::Lm63 => lm63::parse(bytes),
        Format::Eulumdat => eulumdat::parse(bytes),
    }
}
