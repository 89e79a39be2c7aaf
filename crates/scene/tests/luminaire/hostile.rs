//! Files meant to hurt: they must be answered soon, without a panic, and what is accepted must be whole.

use photonlab_scene::luminaire::{Format, parse_luminaire, write_lm63};
use proptest::prelude::*;

use super::samples::{LM63, ldt, read};

/// One change to the bytes: at a place, over a length, of a kind.
type Change = (usize, usize, u8, Vec<u8>);

fn mutate(text: &str, changes: &[Change]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (place, length, kind, piece) in changes {
        let start = place % (bytes.len() + 1);
        let end = (start + length).min(bytes.len());
        match kind % 4 {
            0 => drop(bytes.splice(start..(start + piece.len()).min(bytes.len()), piece.iter().copied())),
            1 => drop(bytes.drain(start..end)),
            2 => drop(bytes.splice(start..start, piece.iter().copied())),
            _ => {
                let copy = bytes[start..end].to_vec();
                let target = (place / 7) % (bytes.len() + 1);
                bytes.splice(target..target, copy);
            }
        }
    }
    bytes
}

fn piece() -> impl Strategy<Value = Vec<u8>> {
    let words =
        ["0", "-1", "1e9", "16777216", "90", "180", "360", "1e-320", "nan", ".", "\n", "\r\n", ",", " ", "\x1a"];
    prop_oneof![
        proptest::sample::select(words.to_vec()).prop_map(|word| word.as_bytes().to_vec()),
        proptest::collection::vec(any::<u8>(), 1..4),
    ]
}

fn samples() -> [(String, Format); 4] {
    [
        (LM63.to_owned(), Format::Lm63),
        ("IESNA91\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 0\n0 45 90\n0\n5 4 3\n".to_owned(), Format::Lm63),
        (ldt(3, 7, |c, g| (10 * c + g) as f64), Format::Eulumdat),
        (ldt(0, 12, |c, g| (10 * c + g) as f64), Format::Eulumdat),
    ]
}

/// An accepted table answers everywhere and reads back the same; an error is one line of bounded length.
fn answered(bytes: &[u8], format: Format) -> Result<(), TestCaseError> {
    match parse_luminaire(bytes, format) {
        Ok(luminaire) => {
            let table = &luminaire.table;
            for note in &luminaire.notes {
                prop_assert!(!note.contains('\n') && note.len() < 500, "{}", note);
            }
            prop_assert!(table.flux().is_finite() && table.flux() > 0.0);
            for step in 0..50 {
                let intensity = table.intensity(13.7 * f64::from(step), 3.6 * f64::from(step));
                prop_assert!((0.0..=table.brightest()).contains(&intensity));
                let cell = table.choose(f64::from(step) / 50.0);
                prop_assert!(cell.flux() > 0.0);
            }
            let back = read(&write_lm63(table, &[]), Format::Lm63);
            prop_assert_eq!(back.map(|luminaire| luminaire.table), Ok(table.clone()));
        }
        Err(error) => {
            let shown = error.to_string();
            prop_assert!(!shown.contains('\n') && shown.len() < 500, "{}", shown);
            prop_assert!(error.line != Some(0) && !error.mend.is_empty(), "{}", shown);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_files_are_answered(
        which in 0..4usize,
        changes in proptest::collection::vec((any::<usize>(), 1..40usize, any::<u8>(), piece()), 1..6),
    ) {
        let (text, format) = &samples()[which];
        answered(&mutate(text, &changes), *format)?;
    }

    #[test]
    fn numbers_of_any_kind_are_answered(which in 0..4usize, at in any::<usize>(), number in any::<f64>()) {
        let (text, format) = &samples()[which];
        let starts: Vec<usize> = text.match_indices(char::is_whitespace).map(|(start, _)| start + 1).collect();
        let start = starts[at % starts.len()];
        let end = start + text[start..].find(char::is_whitespace).unwrap_or(0);
        answered(format!("{}{number:e}{}", &text[..start], &text[end..]).as_bytes(), *format)?;
    }

    #[test]
    fn bytes_of_any_kind_are_answered(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        for format in [Format::Lm63, Format::Eulumdat] {
            answered(&bytes, format)?;
            answered(&[b"TILT=NONE\n", &bytes[..]].concat(), format)?;
        }
    }
}

#[test]
fn counts_without_end_are_answered_soon() {
    let start = std::time::Instant::now();
    let spaces = " \n".repeat(1 << 22);
    for text in [
        format!("TILT=NONE\n1 1 1 16777216 16777216 1 1 0 0 0 1 1 1 0 {spaces}"),
        format!("TILT={}", "x".repeat(1 << 22)),
        "x\n".repeat(1 << 22),
    ] {
        for format in [Format::Lm63, Format::Eulumdat] {
            let error = read(&text, format).expect_err("too little of it").to_string();
            assert!(error.len() < 400, "{error}");
        }
    }
    let many: String = (0..5000).map(|i| format!("{} ", 0.01 * f64::from(i))).collect();
    let planes: String = (0..=4000).map(|i| format!("{} ", 0.09 * f64::from(i))).collect();
    let table = "1 ".repeat(5000 * 4001);
    let text = format!("TILT=NONE\n1 1 1 5000 4001 1 1 0 0 0 1 1 1 {many} {planes} {table}");
    let error = read(&text, Format::Lm63).expect_err("20 million cells");
    assert!(error.to_string().contains("has too many angles"), "{error}");
    assert!(start.elapsed() < std::time::Duration::from_secs(60), "{:?}", start.elapsed());
}
