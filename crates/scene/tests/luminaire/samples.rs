//! Files made up for the tests.

use photonlab_scene::luminaire::{Format, IntensityTable, Luminaire, LuminaireError, Symmetry, parse_luminaire};

/// A small valid LM-63-1995 file: one lamp of 1000 lm, multiplier 2, ballast factor 0.5, quadrant symmetry.
pub(crate) const LM63: &str = "IESNA:LM-63-1995\r
[TEST] made up\r
[LUMINAIRE] TILT of words, 15\u{b0}\r
TILT=NONE\r
1 1000 2 3 3 1 2 -0.2 0.4 0\r
0.5 1 20\r
0 45 90\r
0 30, 90\r
100 80 0\r
100 60\r
10\r
100,90,20\r
";

/// A small valid EULUMDAT file: symmetry `isym`, planes every 30 degrees, one set of lamps of 2000 lm, one value a plane
/// and angle from `value`.
pub(crate) fn ldt(isym: usize, planes: usize, value: impl Fn(usize, usize) -> f64) -> String {
    let mut lines: Vec<String> = vec!["Maker".into(), "1".into(), isym.to_string(), "12".into(), "30".into()];
    lines.extend(["3", "45", "report", "name", "number", "file", "date"].map(String::from));
    lines.extend(["1200", "300", "80", "1100", "250", "0", "0", "0", "0"].map(String::from));
    lines.extend(["100", "75,0", "1.0", "0", "1", "2", "T16", "2000", "830", "1B", "58"].map(String::from));
    lines.extend((0..10).map(|_| "0.5".to_owned()));
    lines.extend((0..12).map(|c| (30 * c).to_string()));
    lines.extend(["0", "45", "90"].map(String::from));
    lines.extend((0..planes).flat_map(|c| [0, 1, 2].map(|g| value(c, g).to_string())));
    lines.join("\r\n") + "\r\n"
}

pub(crate) fn read(text: &str, format: Format) -> Result<Luminaire, LuminaireError> {
    parse_luminaire(text.as_bytes(), format)
}

/// The LM-63 file, which must be right.
#[track_caller]
pub(crate) fn ies(text: &str) -> Luminaire {
    read(text, Format::Lm63).unwrap_or_else(|error| panic!("{error}\nin {text}"))
}

/// The same intensities along gamma everywhere around.
pub(crate) fn rotational(gamma: &[f64], intensity: &[f64]) -> IntensityTable {
    IntensityTable::new(Symmetry::Rotational, &[0.0], gamma, intensity).expect("a valid table")
}
