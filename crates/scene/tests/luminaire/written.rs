//! What is written reads back the same.

use photonlab_scene::luminaire::{IntensityTable, Symmetry, write_lm63};

use super::samples::{LM63, ies, rotational};

#[test]
fn tables_survive_the_round_trip() {
    let third = [1.0 / 3.0, 1e-9, 0.0, 12345.678901234567, 2e7, 1e-300, 7.0, 8.0, 1e30];
    let odd = IntensityTable::new(Symmetry::None, &[7.3, 100.0, 350.1], &[0.0, 33.3, 180.0], &third).expect("a table");
    let jumping = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let jumping = IntensityTable::new(Symmetry::None, &[0.0, 180.0, 360.0], &[0.0, 90.0], &jumping).expect("a table");
    let gamma: Vec<f64> = (0..=90).map(|g| 2.0 * f64::from(g)).collect();
    let long = rotational(&gamma, &gamma);
    for table in [ies(LM63).table, rotational(&[0.0, 90.0], &[3.0, 1.0]), odd, jumping, long] {
        let text = write_lm63(&table, &[]);
        let read = ies(&text);
        assert_eq!(read.table, table, "{text}");
        assert_eq!(format!("{:?}", read.table), format!("{table:?}"));
        assert!(read.notes.is_empty(), "{:?}", read.notes);
        assert!(text.is_ascii() && text.lines().all(|line| line.len() <= 254), "{text}");
    }
}

#[test]
fn labels_stay_on_their_lines() {
    let table = rotational(&[0.0, 90.0], &[100.0, 50.0]);
    let words = "x".repeat(1000);
    let labels = [("TEST", "one\nTILT=INCLUDE"), ("MANUFAC", "Gl\u{fc}hwurm"), ("OTHER", words.as_str())];
    let text = write_lm63(&table, &labels);
    let start =
        "IESNA:LM-63-2002\r\n[TESTLAB] none\r\n[ISSUEDATE] none\r\n[TEST] one TILT=INCLUDE\r\n[MANUFAC] Gl hwurm\r\n";
    assert!(text.starts_with(start), "{text}");
    let end = "TILT=NONE\r\n1 -1 1 2 1 1 2 0 0 0\r\n1 1 0\r\n0.0 90.0\r\n0.0\r\n100.0 50.0\r\n";
    assert!(text.ends_with(end), "{text}");
    assert_eq!(ies(&text).table, table);
}
