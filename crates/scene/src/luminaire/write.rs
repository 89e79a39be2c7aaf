//! Writing LM-63.

use std::fmt::Write;

use super::IntensityTable;

/// Keywords that LM-63-2002 asks for.
const REQUIRED: [&str; 4] = ["TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"];
/// Most characters of the words after a keyword: lines of LM-63-2002 have at most 256.
const LONGEST_WORDS: usize = 200;
/// Numbers on a line: the longest make 250 characters.
const ON_A_LINE: usize = 10;

/// The text of an LM-63-2002 file: type C, absolute photometry (lumens per lamp -1), a point without size, all factors 1.
///
/// `labels` are keywords without brackets and their words; those of the four that the standard asks for (`TEST`, `TESTLAB`,
/// `ISSUEDATE`, `MANUFAC`) that are not among them get the word `none`. Words are cut to 200 characters of ASCII. The numbers
/// are written so that reading gives the same table. The vertical angles are the table's: the standard wants them to start
/// at 0 or 90 and to end at 90 or 180 degrees, this program reads any.
pub fn write_lm63(table: &IntensityTable, labels: &[(&str, &str)]) -> String {
    let mut text = String::from("IESNA:LM-63-2002\r\n");
    let missing = REQUIRED.iter().filter(|name| !labels.iter().any(|(given, _)| given == *name));
    for (name, words) in missing.map(|name| (*name, "none")).chain(labels.iter().copied()) {
        let line: String = format!("[{}] {}", plain(name), plain(words)).chars().take(LONGEST_WORDS).collect();
        text.push_str(line.trim_end());
        text.push_str("\r\n");
    }
    // One plane where all are the same, as the standard has it.
    let rotational = table.c().len() == 2 && table.plane(0) == table.plane(1);
    let c = if rotational { &table.c()[..1] } else { table.c() };
    text.push_str("TILT=NONE\r\n");
    for line in [format!("1 -1 1 {} {} 1 2 0 0 0", table.gamma().len(), c.len()), "1 1 0".to_owned()] {
        text.push_str(&line);
        text.push_str("\r\n");
    }
    numbers(&mut text, table.gamma());
    numbers(&mut text, c);
    for plane in 0..c.len() {
        numbers(&mut text, table.plane(plane));
    }
    text
}

fn plain(words: &str) -> String {
    words.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' }).collect()
}

fn numbers(text: &mut String, numbers: &[f64]) {
    for line in numbers.chunks(ON_A_LINE) {
        for (index, number) in line.iter().enumerate() {
            let space = if index > 0 { " " } else { "" };
            // The debug form is the shortest that reads back the same, with an exponent where that is shorter.
            write!(text, "{space}{number:?}").expect("a string takes all that is written");
        }
        text.push_str("\r\n");
    }
}
