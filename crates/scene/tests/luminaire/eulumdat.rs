//! What EULUMDAT files say.

use photonlab_scene::luminaire::{Format, IntensityTable, Luminaire};

use super::samples::{ldt, read};

/// The table of a file whose intensity is 100 times its plane's index plus its angle's, in cd/klm.
fn luminaire(text: &str) -> Luminaire {
    read(text, Format::Eulumdat).unwrap_or_else(|error| panic!("{error}\nin {text}"))
}

fn table(isym: usize, planes: usize) -> IntensityTable {
    luminaire(&ldt(isym, planes, |c, g| (100 * c + g) as f64)).table
}

#[test]
fn symmetries_state_which_planes_stand_in_the_file() {
    // With 2000 lm of lamps, 1 cd/klm is 2 cd; the middle angle is 45 degrees.
    for (isym, planes, at) in [
        (0, 12, &[(0.0, 0), (90.0, 3), (180.0, 6), (330.0, 11)][..]),
        (1, 1, &[(0.0, 0), (77.0, 0)]),
        (2, 7, &[(0.0, 0), (90.0, 3), (180.0, 6), (270.0, 3)]),
        (3, 7, &[(270.0, 0), (300.0, 1), (0.0, 3), (90.0, 6), (180.0, 3), (240.0, 1)]),
        (4, 4, &[(0.0, 0), (30.0, 1), (90.0, 3), (150.0, 1), (180.0, 0), (330.0, 1)]),
    ] {
        let table = table(isym, planes);
        for &(c, plane) in at {
            assert_eq!(table.intensity(c, 45.0), 2.0 * f64::from(100 * plane + 1), "Isym {isym}, C{c}");
        }
        assert_eq!(table.intensity(0.0, 91.0), 0.0);
    }
    // Between C330 and the plane that closes the turn.
    assert!((table(0, 12).intensity(345.0, 0.0) - 1100.0).abs() < 1e-9);
}

#[test]
fn candela_are_those_of_the_first_set_of_lamps() {
    let one = ldt(1, 1, |_, g| [300.0, 150.0, 0.0][g]);
    let set = "2\r\nT16\r\n2000\r\n830\r\n1B\r\n58\r\n";
    let two = one.replace(&format!("1\r\n{set}"), &format!("2\r\n{set}{}", set.replace("2000", "9000")));
    let halved = one.replace("\r\n1.0\r\n", "\r\n0,5\r\n");
    let tilted = one.replace("\r\n1.0\r\n0\r\n", "\r\n1.0\r\n5\r\n");
    for (text, brightest, note) in [
        (&one, 600.0, None),
        (&two, 600.0, Some("has 2 sets of lamps; it is lit by the first, of 2000 lm")),
        (&halved, 300.0, None),
        (&tilted, 600.0, Some("was measured at a tilt of 5 degrees, which is not undone")),
    ] {
        let luminaire = luminaire(text);
        assert_eq!(luminaire.table.brightest(), brightest);
        assert!(note.is_none_or(|note| luminaire.notes[0] == note), "{:?}", luminaire.notes);
        let opening = luminaire.notes.last().expect("a note");
        assert!(opening.contains("1.100 x 0.250 x 0.000 m"), "{opening}");
    }
}

/// Its lamps of 2000 lm times 75 % are 1500 lm: 477.5 / pi cd/klm over the lower half are 1500.1.
#[test]
fn the_light_output_ratio_is_compared_only() {
    let notes = |value: f64| luminaire(&ldt(1, 1, |_, _| value)).notes;
    assert_eq!(notes(375.0 / std::f64::consts::PI).len(), 1, "the opening alone");
    let [flux, _] = &notes(119.37 * 0.98)[..] else { panic!() };
    let words =
        "emits 1470.0 lm by its intensities, 98.0 % of the 1500.0 lm that it states of its lamps times its light";
    assert!(flux.starts_with(words), "{flux}");
    let without = ldt(1, 1, |_, _| 100.0).replace("75,0", "");
    assert_eq!(luminaire(&without).notes.len(), 1);
}
