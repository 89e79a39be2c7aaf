//! What LM-63 files say.

use photonlab_scene::luminaire::{Format, IntensityTable, Symmetry};

use super::samples::{LM63, ies, read, rotational};

#[test]
fn factors_symmetry_and_words_of_a_file() {
    let luminaire = ies(LM63);
    let intensity = [100.0, 80.0, 0.0, 100.0, 60.0, 10.0, 100.0, 90.0, 20.0];
    let table = IntensityTable::new(Symmetry::Quadrant, &[0.0, 30.0, 90.0], &[0.0, 45.0, 90.0], &intensity);
    assert_eq!(luminaire.table, table.expect("a table"), "multiplier 2 and ballast factor 0.5 leave the numbers");
    assert_eq!(luminaire.table.c(), [0.0, 30.0, 90.0, 150.0, 180.0, 210.0, 270.0, 330.0, 360.0]);
    for (c, expected) in [(30.0, 60.0), (150.0, 60.0), (210.0, 60.0), (330.0, 60.0), (0.0, 80.0), (270.0, 90.0)] {
        assert_eq!(luminaire.table.intensity(c, 45.0), expected, "{c}");
    }
    let [flux, opening] = &luminaire.notes[..] else { panic!("{:?}", luminaire.notes) };
    assert!(flux.contains("of the 500.0 lm that it states of its lamps"), "{flux}");
    assert!(opening.contains("0.400 x 0.200 x 0.000 m, which is not modelled"), "{opening}");
}

/// A rotational file with the first line, the two lines of numbers before the angles, and 100 cd everywhere.
fn file(first: &str, header: &str, ballast: &str) -> String {
    format!("{first}\nTILT=NONE\n{header}\n{ballast}\n0 90 180\n0\n100 100 100\n")
}

#[test]
fn every_version_has_its_own_second_factor() {
    let header = "1 -1 1 3 1 1 1 0 0 0";
    for (first, second, factor, noted) in [
        ("A lamp of 1986", "0.8", 0.8, false),
        ("IESNA91", "0.8", 0.8, false),
        ("IESNA:LM-63-1991", "0.8", 0.8, false),
        ("IESNA:LM-63-1995", "0.8", 1.0, true),
        ("IESNA:LM-63-2002", "1", 1.0, false),
        ("IESNA:LM-63-2002", "0.8", 1.0, true),
        ("IES:LM-63-2019", "1.10000", 1.0, false),
        ("\u{feff}IES:LM-63-2019", "1.00001", 1.0, false),
    ] {
        let luminaire = ies(&file(first, header, &format!("0.5 {second} 0")));
        assert_eq!(luminaire.table.brightest(), 100.0 * 0.5 * factor, "{first}");
        assert_eq!(!luminaire.notes.is_empty(), noted, "{first} {:?}", luminaire.notes);
    }
}

#[test]
fn absolute_photometry_has_no_lumens_to_compare() {
    let notes = |lumens: &str| ies(&file("IESNA91", &format!("2 {lumens} 1 3 1 1 2 0 0 0"), "1 1 9")).notes;
    assert!(notes("-1").is_empty());
    // 400 pi lm are 1256.6.
    assert!(notes("628.3").is_empty());
    assert!(notes("623").is_empty());
    let [note] = &notes("1000")[..] else { panic!() };
    assert_eq!(note, "emits 1256.6 lm by its intensities, 62.8 % of the 2000.0 lm that it states of its lamps");
}

/// Horizontal angles and the turn they unfold to; the intensity at the i-th is i + 1.
#[test]
fn ranges_of_horizontal_angles_state_the_symmetry() {
    for (c, at) in [
        ("0", &[(0.0, 1.0), (123.0, 1.0)][..]),
        ("45", &[(0.0, 1.0)]),
        ("0 90", &[(90.0, 2.0), (180.0, 1.0), (270.0, 2.0)]),
        ("0 90 180", &[(90.0, 2.0), (180.0, 3.0), (270.0, 2.0)]),
        ("90 180 270", &[(90.0, 1.0), (180.0, 2.0), (270.0, 3.0), (0.0, 2.0)]),
        ("-90 0 90", &[(270.0, 1.0), (0.0, 2.0), (90.0, 3.0), (180.0, 2.0)]),
        ("0 120 240 360", &[(0.0, 1.0), (120.0, 2.0), (240.0, 3.0), (359.999_999, 4.0)]),
        ("0 120 240", &[(0.0, 1.0), (120.0, 2.0), (240.0, 3.0), (300.0, 2.0)]),
    ] {
        let count = c.split(' ').count();
        let candela: String = (1..=count).map(|i| format!("{i} {i} {i}\n")).collect();
        let text = format!("IESNA91\nTILT=NONE\n1 -1 1 3 {count} 1 2 0 0 0\n1 1 0\n0 45 90\n{c}\n{candela}");
        let table = ies(&text).table;
        for &(c, expected) in at {
            assert!((table.intensity(c, 45.0) - expected).abs() < 1e-6, "{text} {c}");
        }
    }
    let wide = "IESNA91\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 0\n0 90\n0 120\n1 1 1 1";
    assert!(read(wide, Format::Lm63).expect_err("a third of a turn").what.contains("run from 0 to 120"));
}

#[test]
fn lines_end_and_numbers_part_in_many_ways() {
    let expected = ies(LM63);
    for text in [
        LM63.replace("\r\n", "\n"),
        LM63.replace("\r\n", "\r"),
        LM63.replace(' ', "  "),
        LM63.replace(' ', ", "),
        LM63.replace("TILT=NONE", "  Tilt = None "),
        format!("{LM63}\x1a"),
        format!("{LM63}\r\n\r\n"),
        LM63.replace("0 45 90", "0\n4.5e1\n\n90."),
    ] {
        assert_eq!(ies(&text), expected, "{text:?}");
    }
    let latin: Vec<u8> = LM63.chars().map(|c| u8::try_from(c).expect("Latin-1")).collect();
    assert_eq!(photonlab_scene::luminaire::parse_luminaire(&latin, Format::Lm63), Ok(expected));
}

#[test]
fn vertical_ranges_end_in_the_dark() {
    let up = ies("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n90 180\n0\n5 5");
    assert_eq!(up.table, rotational(&[90.0, 180.0], &[5.0, 5.0]));
    assert_eq!((up.table.intensity(0.0, 89.9), up.notes.len()), (0.0, 0));
    let short = ies("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 85\n0\n5 5");
    assert_eq!(short.notes, ["has vertical angles from 0 to 85 degrees; it is dark outside them"]);
}
