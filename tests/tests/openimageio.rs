//! Our images read and compared by OpenImageIO's command line, and its verdict against our own metric's.
//!
//! Its traps: without `-a` only the first channels are compared; there is no limit on the RMS difference, so that is read
//! from what it prints; and a NaN in one image passes, so NaN are counted apart.

use std::path::PathBuf;

use photonlab_tests::{Exr, ImageError, OpenImageIo, Program, scene_file};

/// Renders a small Cornell box and returns the image's path.
fn render(program: &Program, seed: u32, passes: u32, name: &str) -> PathBuf {
    let scene =
        scene_file("cornell-box.xml").canonicalize().expect("one of the project's scenes").display().to_string();
    let counts = format!("--photons 40000 --passes {passes} --spp 64");
    program.succeed(&format!("render {scene} --size 24x20 {counts} --seed {seed} -o {name}"));
    program.path(name)
}

fn program() -> Program {
    Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"))
}

/// The RMS difference is printed with this many digits.
const PRINTED: f64 = 1e-5;

#[test]
fn both_metrics_agree_on_equal_and_on_different_images() {
    let program = program();
    let [a, same, other] =
        [(1, "a.exr"), (1, "same.exr"), (2, "other.exr")].map(|(s, name)| render(&program, s, 16, name));
    let read = [&a, &same, &other].map(|path| Exr::read(path));
    assert_eq!(read[0].rms_difference(&read[1]), Ok(0.0), "the same seed");
    let ours = read[0].rms_difference(&read[2]).expect("finite images of one size");
    assert!(ours > 0.0, "another seed");
    let Some(tool) = OpenImageIo::find("EXR files and the RMS difference") else {
        return;
    };
    assert_eq!(tool.compare(0.0, &a, &same).status, 0, "the same seed");
    let differ = tool.compare(1e-9, &a, &other);
    assert!([1, 2].contains(&differ.status), "another seed: {differ:?}");
    let theirs = tool.rms_difference(&a, &other);
    assert!((theirs / ours - 1.0).abs() < PRINTED, "RMS difference: idiff says {theirs}, we say {ours}");
    assert_eq!(tool.compare(1e9, &a, &program.path("absent.exr")).status, 4, "a missing file");
}

/// Two seeds differ by what their error layers say: the squared difference is the sum of the squared errors.
#[test]
fn another_seed_differs_within_the_error_layers() {
    let program = program();
    let [a, b] = [(3, "a.exr"), (4, "b.exr")].map(|(s, name)| Exr::read(&render(&program, s, 16, name)));
    for channel in ["R", "G", "B"] {
        let errors = format!("std_error.{channel}");
        let squares = |x: &[f32], y: &[f32], sign: f64| -> f64 {
            x.iter().zip(y).map(|(&x, &y)| (f64::from(x) + sign * f64::from(y)).powi(2)).sum()
        };
        let differences = squares(a.channel(channel), b.channel(channel), -1.0);
        let none = vec![0.0; a.size[0] * a.size[1]];
        let expected = squares(a.channel(&errors), &none, 1.0) + squares(b.channel(&errors), &none, 1.0);
        let ratio = differences / expected;
        // 480 pixels share photons and are worth fewer; half and double are far outside chance.
        assert!((0.5..2.0).contains(&ratio), "{channel}: squared differences over squared errors {ratio:.2}");
    }
}

/// A single pass has no error bar: its error layers are NaN. `idiff` lets that pass; our metric refuses it.
#[test]
fn a_nan_in_one_image_is_not_overlooked() {
    let program = program();
    let (whole, single) = (render(&program, 5, 16, "whole.exr"), render(&program, 5, 1, "single.exr"));
    let ours = Exr::read(&whole).rms_difference(&Exr::read(&single));
    assert!(matches!(&ours, Err(ImageError::NotFinite(what)) if what.contains("NaN")), "{ours:?}");
    let Some(tool) = OpenImageIo::find("NaN in images") else {
        return;
    };
    assert_eq!(tool.compare(1e9, &whole, &single).status, 0, "the trap: idiff passes a NaN");
    assert_eq!(tool.nan_count(&whole), 0);
    // Six layers of error and bias.
    assert_eq!(tool.nan_count(&single), 6 * 24 * 20);
}
