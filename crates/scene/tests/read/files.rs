//! Files and what they include.

use std::fs;
use std::path::Path;

use photonlab_photometry::Spectrum;
use photonlab_scene::read::{SceneError, read_scene};
use photonlab_scene::{Bsdf, Scene};
use tempfile::TempDir;

fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }
    folder
}

fn read(folder: &Path) -> Result<Scene, SceneError> {
    read_scene(&folder.join("main.xml"), &[])
}

fn including(filename: &str) -> Vec<u8> {
    format!("<scene version='3.0.0'>\n\n<include filename='{filename}'/></scene>").into_bytes()
}

#[track_caller]
fn fails(files: &[(&str, &[u8])], file: &str, line: u32, fragment: &str) {
    let folder = folder(files);
    let error = read(folder.path()).expect_err("a broken scene");
    assert!(error.to_string().contains(fragment), "{error}");
    assert_eq!((error.file.as_str(), error.line), (folder.path().join(file).to_str().expect("UTF-8"), line), "{error}");
}

#[test]
fn includes_stand_for_what_they_hold() {
    let folder = folder(&[
        (
            "main.xml",
            b"<scene version='3.0.0'><default name='r' value='0.25'/><include filename='parts/all.xml'/>
              <shape type='cube'><include filename='parts/coat.xml'/></shape><shape type='cube'><ref id='late'/></shape>
              </scene>",
        ),
        // Its own default does not replace the one before it; its includes are found beside it.
        (
            "parts/all.xml",
            b"<scene version='3.1.0'><default name='r' value='1'/><include filename='late.xml'/></scene>",
        ),
        ("parts/late.xml", b"<bsdf type='diffuse' id='late'><float name='reflectance' value='0.75'/></bsdf>"),
        ("parts/coat.xml", b"<?xml version='1.0'?><bsdf type='diffuse'><float name='reflectance' value='$r'/></bsdf>"),
    ]);
    let scene = read(folder.path()).unwrap_or_else(|error| panic!("{error}"));
    let found: Vec<Bsdf> = scene.shapes.into_iter().map(|shape| shape.bsdf).collect();
    assert_eq!(found, [0.25, 0.75].map(|value| Bsdf::Diffuse { reflectance: Spectrum::Uniform(value) }));
    assert_eq!(scene.notes.len(), 1, "{:?}", scene.notes);
}

#[test]
fn an_error_names_the_included_file() {
    let part = b"<scene>\n<shape type='cube'>\n<float name='radius' value='1'/></shape></scene>";
    fails(&[("main.xml", &including("part.xml")), ("part.xml", part)], "part.xml", 3, "unknown parameter \"radius\"");
    let twice = b"<scene version='3.0.0'><include filename='a.xml'/>\n<include filename='a.xml'/></scene>";
    fails(&[("main.xml", twice), ("a.xml", b"<shape type='cube' id='a'/>")], "a.xml", 1, "used twice");
    fails(&[("main.xml", &including("a.xml")), ("a.xml", b"<scene version='1.0.0'/>")], "a.xml", 1, "older");
    fails(
        &[("main.xml", &including("a.xml")), ("a.xml", b"<rfilter type='box'/>")],
        "a.xml",
        1,
        "cannot stand directly",
    );
}

#[test]
fn what_cannot_be_included_is_an_error_at_the_include() {
    fails(&[("main.xml", &including("none.xml"))], "main.xml", 3, "none.xml\" cannot be read");
    fails(&[("main.xml", &including("sub")), ("sub/x", b"")], "main.xml", 3, "is not a plain file");
    fails(&[("main.xml", &including("/dev/zero"))], "main.xml", 3, "is not a plain file");
    fails(&[("main.xml", &including("main.xml"))], "main.xml", 3, "includes itself");
    let (there, back) = (including("sub/../b.xml"), including("./main.xml"));
    fails(&[("main.xml", &there), ("b.xml", &back), ("sub/x", b"")], "sub/../b.xml", 3, "includes itself");
    fails(&[("main.xml", &including(""))], "main.xml", 3, "is not a plain file");
}

#[cfg(unix)]
#[test]
fn a_pipe_is_refused_without_waiting() {
    let folder = folder(&[("main.xml", &including("pipe"))]);
    let made = std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status().expect("mkfifo");
    assert!(made.success());
    assert!(read(folder.path()).expect_err("a pipe").what.contains("is not a plain file"));
    let direct = read_scene(&folder.path().join("pipe"), &[]).expect_err("a pipe");
    assert!(direct.what.contains("is not a plain file"));
}

#[test]
fn unreadable_files_are_named() {
    fails(&[], "main.xml", 1, "main.xml\" cannot be read");
    fails(&[("main.xml", b"")], "main.xml", 1, "holds no element");
    fails(&[("main.xml", b" \n\n ")], "main.xml", 1, "holds no element");
    fails(&[("main.xml", b"<!-- nothing -->")], "main.xml", 1, "holds no element");
    fails(&[("main.xml", b"<scene version='3.0.0'>\n\n<shape id='\xff'/></scene>")], "main.xml", 3, "not UTF-8");
    fails(&[("main.xml", b"\xff\xfe<\0s\0")], "main.xml", 1, "not UTF-8");
    fails(&[("main.xml", b"<scene version='3.0.0'>\n<shape type='cube'>\n")], "main.xml", 2, "ends inside");
    fails(&[("main.xml", b"<scene version='3.0.0'>\n<shape type='cu")], "main.xml", 2, "ends inside");
    fails(&[("main.xml", b"<scene version='3.0.0'>\n<!-- ")], "main.xml", 2, "not XML");
    fails(&[("main.xml", b"<scene version='3.0.0'>\n</shape>")], "main.xml", 2, "not XML");
    fails(&[("main.xml", b"<scene version='3.0.0'/>\n<scene version='3.0.0'/>")], "main.xml", 2, "not XML");
    fails(&[("main.xml", b"photons")], "main.xml", 1, "not XML");
}

#[test]
fn a_file_beyond_the_limit_is_refused() {
    let folder = folder(&[]);
    let file = fs::File::create(folder.path().join("main.xml")).expect("a file");
    file.set_len((256 << 20) + 1).expect("a sparse file");
    assert!(read(folder.path()).expect_err("too large").what.contains("more than 256 MiB"));
}

#[test]
fn includes_that_multiply_are_stopped() {
    let twice = |next: usize| {
        format!("<scene><include filename='{next}.xml'/><include filename='{next}.xml'/></scene>").into_bytes()
    };
    let folder = folder(&[("main.xml", &including("0.xml"))]);
    for level in 0..20 {
        fs::write(folder.path().join(format!("{level}.xml")), twice(level + 1)).expect("a file");
    }
    assert!(read(folder.path()).expect_err("too deep").what.contains("include each other"));
    fs::write(folder.path().join("13.xml"), "<scene/>").expect("a file");
    assert!(read(folder.path()).expect_err("too many").what.contains("more than 4096 includes"));
}
