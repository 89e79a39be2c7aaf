//! Luminaires in scenes: the emitter `ies`.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use photonlab_photometry::{Channels, Spectrum};
use photonlab_scene::luminaire::IntensityTable;
use photonlab_scene::read::{SceneError, read_scene};
use photonlab_scene::{Emitter, Scene};
use tempfile::TempDir;

use super::samples::{LM63, ies, ldt};

/// A folder with the files, and `main.xml` with emitters of these insides, each on a line of its own from the second.
fn folder(emitters: &[&str]) -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).expect("a file");
    let emitters: String = emitters.iter().map(|inside| format!("<emitter type='ies'>{inside}</emitter>\n")).collect();
    write("main.xml", format!("<scene version='3.0.0'>\n{emitters}</scene>").as_bytes());
    write("lamp.ies", LM63.as_bytes());
    write("LAMP.LDT", ldt(1, 1, |_, _| 50.0).as_bytes());
    write("bad.ies", LM63.replace("100 80 0", "100 -80 0").as_bytes());
    write("noise.ies", b"\0\x01\x02");
    write("lamp.txt", LM63.as_bytes());
    fs::create_dir(folder.path().join("folder.ies")).expect("a folder");
    folder
}

fn read(folder: &Path) -> Result<Scene, SceneError> {
    read_scene(&folder.join("main.xml"), &[])
}

type Placed<'s> = (DVec3, &'s Spectrum, &'s Arc<IntensityTable>, glam::DMat3);

fn placed(emitter: &Emitter) -> Placed<'_> {
    match emitter {
        Emitter::Point {
            position, intensity, pattern: photonlab_scene::Pattern::Table { table, to_world }, ..
        } => (*position, intensity, table, *to_world),
        other => panic!("{other:?}"),
    }
}

#[test]
fn lamps_have_places_turns_fluxes_and_tints() {
    let file = "<string name='filename' value='lamp.ies'/>";
    let folder = folder(&[
        file,
        &format!("{file}<point name='position' value='1 2 3'/><float name='flux' value='500'/>"),
        &format!(
            "{file}<transform name='to_world'><rotate x='1' angle='90'/><translate z='4'/></transform>
             <rgb name='tint' value='1 0.5 0'/>"
        ),
        "<string name='filename' value='LAMP.LDT'/><float name='tint' value='2'/>",
    ]);
    let scene = read(folder.path()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.channels(), Channels::Rgb);
    let lamps: Vec<Placed> = scene.emitters.iter().map(placed).collect();
    assert_eq!((lamps[0].0, lamps[0].1), (DVec3::ZERO, &Spectrum::Uniform(100.0)));
    assert_eq!(**lamps[0].2, ies(LM63).table);
    assert!(Arc::ptr_eq(lamps[0].2, lamps[1].2), "one file is read once");
    assert_eq!(lamps[1].0, DVec3::new(1.0, 2.0, 3.0));
    let flux = lamps[1].1.max() * lamps[1].2.flux() / lamps[1].2.brightest();
    assert!((flux / 500.0 - 1.0).abs() < 1e-14, "{flux}");
    assert_eq!((lamps[2].0, lamps[2].1), (DVec3::new(0.0, 0.0, 4.0), &Spectrum::Rgb([100.0, 50.0, 0.0])));
    assert_eq!(lamps[2].3 * DVec3::NEG_Z, DVec3::Y, "its nadir turned to +y");
    assert_eq!(lamps[3].1, &Spectrum::Uniform(200.0), "50 cd/klm of 2000 lm, twice");
    assert!((lamps[3].2.flux() / (200.0 * PI) - 1.0).abs() < 1e-14);
    let of_lamp = scene.notes.iter().filter(|note| note.starts_with("\"lamp.ies\" ")).count();
    assert_eq!(of_lamp, 2, "{:?}", scene.notes);
}

/// The nadir looks along the direction; where that turns it by less than a half, C0 goes the shortest way.
#[test]
fn a_direction_turns_the_nadir() {
    let file = "<string name='filename' value='lamp.ies'/><point name='position' value='0 0 3'/>";
    let towards = |value: &str| format!("{file}<vector name='direction' value='{value}'/>");
    let directions = ["0 0 -2", "0 3 0", "0 0 1", "1 0 -1"].map(towards);
    let folder = folder(&directions.each_ref().map(String::as_str));
    let scene = read(folder.path()).unwrap_or_else(|error| panic!("{error}"));
    let half = 0.5f64.sqrt();
    for (emitter, (nadir, c0)) in scene.emitters.iter().zip([
        (DVec3::NEG_Z, DVec3::X),
        (DVec3::Y, DVec3::X),
        (DVec3::Z, DVec3::NEG_X),
        (DVec3::new(half, 0.0, -half), DVec3::new(half, 0.0, half)),
    ]) {
        let (position, _, _, to_world) = placed(emitter);
        assert_eq!(position, DVec3::new(0.0, 0.0, 3.0));
        assert!((to_world * DVec3::NEG_Z - nadir).length() < 1e-15, "{to_world:?}");
        assert!((to_world * DVec3::X - c0).length() < 1e-15, "{to_world:?}");
    }
}

#[test]
fn a_scene_stands_for_its_files() {
    let file = "<string name='filename' value='lamp.ies'/>";
    let folder = folder(&[file]);
    let shown = || format!("{:?}", read(folder.path()).expect("a scene").emitters);
    let before = shown();
    assert!(before.len() < 600, "{before}");
    fs::write(folder.path().join("lamp.ies"), LM63.replace("80", "81")).expect("a file");
    assert_ne!(shown(), before);
}

#[test]
fn broken_files_are_named_with_their_line() {
    for (name, message) in [
        ("none.ies", "emitter: \"none.ies\" is not there; name a file, relative to the scene's"),
        ("folder.ies", "emitter: \"folder.ies\" is a folder"),
        ("lamp.txt", "emitter: \"lamp.txt\" is neither .ies nor .ldt; give an LM-63 or a EULUMDAT file"),
        ("noise.ies", "emitter: \"noise.ies\" is not a luminaire file: it holds no text; give an LM-63"),
        ("bad.ies", "emitter: \"bad.ies\" line 9: the intensity at 0, 45 degrees is -80; no intensity is negative"),
    ] {
        let good = "<string name='filename' value='lamp.ies'/>";
        let folder = folder(&[good, &format!("<string name='filename' value='{name}'/>")]);
        let error = read(folder.path()).expect_err(name);
        let start = format!("{}:3: {message}", folder.path().join("main.xml").display());
        assert!(error.to_string().starts_with(&start), "{error}\n wanted {start}");
    }
    let bright = "<string name='filename' value='lamp.ies'/><float name='tint' value='1e30'/>";
    let error = read(folder(&[bright]).path()).expect_err("too bright").to_string();
    assert!(error.contains("its brightest intensity 1"), "{error}");
}

#[test]
fn a_file_beyond_the_limit_is_refused() {
    let folder = folder(&["<string name='filename' value='huge.ies'/>"]);
    let file = fs::File::create(folder.path().join("huge.ies")).expect("a file");
    file.set_len((64 << 20) + 1).expect("a sparse file");
    assert!(read(folder.path()).expect_err("too large").what.contains("holds more than 64 MiB"));
}
