//! Every way for a luminaire file to be wrong, with the line and the words of the answer.

use photonlab_scene::luminaire::{Format, LuminaireError, parse_luminaire};

use super::samples::{LM63, ldt, read};

#[track_caller]
fn refused(text: &str, format: Format, start: &str) -> LuminaireError {
    let error = read(text, format).expect_err(start);
    assert!(error.to_string().starts_with(start), "{error}\n wanted {start}");
    assert!(!error.to_string().contains('\n') && error.to_string().len() < 400, "{error}");
    error
}

#[test]
fn broken_lm63() {
    for (from, to, start) in [
        ("TILT=NONE", "TILD=NONE", "is not an LM-63 file: it has no line TILT="),
        (
            "TILT=NONE",
            "TILT=INCLUDE",
            "line 4: TILT=INCLUDE: its flux depends on its tilt, which is not modelled; write",
        ),
        ("TILT=NONE", "TILT=other.til", "line 4: TILT=OTHER.TIL: its flux depends"),
        ("1 1000 2 3", "one 1000 2 3", "line 5: the number of lamps is \"one\", no finite number"),
        ("1 1000 2 3", "1 nan 2 3", "line 5: lumens per lamp is \"nan\", no finite number"),
        ("1 1000 2 3", "1 1000 0 3", "line 5: the multiplier is 0; give a positive number"),
        ("1 1000 2 3", "1 1000 -2 3", "line 5: the multiplier is -2"),
        ("1000 2 3 3", "1000 2 0 3", "line 5: the number of vertical angles is 0; give a whole number"),
        ("1000 2 3 3", "1000 2 3 -3", "line 5: the number of horizontal angles is -3"),
        ("1000 2 3 3", "1000 2 3 2.5", "line 5: the number of horizontal angles is 2.5"),
        ("1000 2 3 3", "1000 2 1e18 3", "line 5: the number of vertical angles is 1e18"),
        ("1000 2 3 3", "1000 2 16777216 16777216", "line 8: vertical angle 4 of 16777216 is 0 after 90"),
        ("1000 2 3 3", "1000 2 4 3", "line 8: vertical angle 4 of 4 is 0 after 90; put the angles in rising order"),
        ("3 3 1 2", "3 3 2 2", "line 5: is of photometric type B; give type C"),
        ("3 3 1 2", "3 3 3 2", "line 5: is of photometric type A"),
        ("3 3 1 2", "3 3 4 2", "line 5: has the photometric type 4"),
        ("3 3 1 2", "3 3 1 3", "line 5: the type of units is 3"),
        ("0.5 1 20", "0 1 20", "line 6: the ballast factor is 0"),
        ("0 45 90\r", "0 90 45\r", "line 7: vertical angle 3 of 3 is 45 after 90"),
        ("0 45 90\r", "0 inf 90\r", "line 7: vertical angle 2 of 3 is \"inf\""),
        ("0 45 90\r", "0 45 190\r", "has no range of vertical angles; give at least two within 0 and 180 degrees"),
        ("0 30, 90", "0 30, 30", "line 8: horizontal angle 3 of 3 is 30 after 30"),
        ("0 30, 90", "0 30, 100", "line 8: its horizontal angles run from 0 to 100 degrees; end them at"),
        ("100 80 0", "100 -80 0", "line 9: the intensity at 0, 45 degrees is -80; no intensity is negative"),
        ("100 80 0", "100 NaN 0", "line 9: the intensity at 0, 45 degrees is \"NaN\""),
        ("100 80 0", "100 1e999 0", "line 9: the intensity at 0, 45 degrees is \"1e999\""),
        ("100 80 0", "100 1e30 0", ""),
        ("100,90,20", "100,90", "line 12: the file ends before the intensity at 90, 90 degrees; complete it"),
        ("100,90,20", "100,90,20,7", "line 12: \"7\" follows the last intensity; mend the counts of angles"),
        ("100,90,20", "100,90,20\r\nEND", "line 13: \"END\" follows the last intensity"),
    ] {
        let text = LM63.replacen(from, to, 1);
        assert_ne!(text, LM63, "{from}");
        if start.is_empty() {
            assert!(read(&text, Format::Lm63).is_ok(), "{to}");
        } else {
            refused(&text, Format::Lm63, start);
        }
    }
    let dark = "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n0 0";
    refused(dark, Format::Lm63, "emits nothing; give a table that shines");
}

#[test]
fn broken_eulumdat() {
    let good = ldt(4, 4, |_, _| 100.0);
    let line = |number: usize, value: &str| {
        let mut lines: Vec<&str> = good.lines().collect();
        lines[number - 1] = value;
        lines.join("\n")
    };
    for (number, value, start) in [
        (3, "5", "line 3: the symmetry indicator is 5; give"),
        (3, "", "line 3: the symmetry indicator is \"\", no finite number"),
        (3, "2", "the file ends before the intensity at 120"),
        (3, "1", "\"100\" follows the last intensity"),
        (4, "0", "line 4: the number of C-planes is 0"),
        (4, "99999999999", "line 4: the number of C-planes is 99999999999"),
        (4, "13", "line 55: C angle 13 of 13 is 0 after 330"),
        (6, "0", "line 6: the number of gamma angles is 0"),
        (6, "16000000", "line 59: gamma angle 5 of 16000000 is 100 after 100"),
        (24, "0", "line 24: the conversion factor is 0"),
        (26, "-1", "line 26: the number of lamp sets is -1"),
        (26, "9000000", "line 69: the file ends before the direct ratios"),
        (29, "0", "line 29: the total flux of the lamps is 0"),
        (29, "lots", "line 29: the total flux of the lamps is \"lots\""),
        (44, "0", "line 44: C angle 2 of 12 is 0 after 0"),
        (
            46,
            "91",
            "has 4 horizontal angles from 0 to 91 degrees; with symmetry about both planes give them from 0 to 90",
        ),
        (56, "-45", "line 56: gamma angle 2 of 3 is -45 after 0"),
        (60, "-1", "line 60: the intensity at 0, 90 degrees is -1"),
        (60, "1e400", "line 60: the intensity at 0, 90 degrees is \"1e400\""),
    ] {
        let error = read(&line(number, value), Format::Eulumdat).expect_err(start).to_string();
        assert!(error.contains(start), "{number} {value}: {error}");
    }
    refused("one line", Format::Eulumdat, "is not a EULUMDAT file: it ends on line 1; give a valid .ldt file");
    refused("Maker\n1\n0\n2", Format::Eulumdat, "is not a EULUMDAT file: it ends on line 4");
}

#[test]
fn what_is_no_text_is_no_luminaire() {
    let noise: Vec<u8> = (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    for format in [Format::Lm63, Format::Eulumdat] {
        let error = parse_luminaire(&noise, format).expect_err("noise").to_string();
        assert!(error.starts_with("is not a luminaire file: it holds no text"), "{error}");
        assert!(parse_luminaire(b"", format).is_err());
        let without_nul: Vec<u8> = noise.iter().copied().filter(|b| *b != 0).collect();
        assert!(parse_luminaire(&without_nul, format).is_err());
    }
}
