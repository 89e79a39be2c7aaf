//! How the command fails: its status, its words, and nothing else on standard output or on the disk.

use photonlab_tests::{Answer, Program, scene_file};

fn program() -> Program {
    Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"))
}

fn scene(name: &str) -> String {
    scene_file(name).canonicalize().expect("one of the project's scenes").display().to_string()
}

/// Runs a line that must fail with a status and these words, and leave standard output empty.
fn fails(program: &Program, line: &str, status: i32, words: &[&str]) -> Answer {
    let answer = program.run(line);
    assert_eq!(answer.status, Some(status), "`{line}`: {}{}", answer.out, answer.err);
    assert_eq!(answer.out, "", "standard output of `{line}`");
    for word in words {
        assert!(answer.err.contains(word), "`{line}` should say `{word}`: {}", answer.err);
    }
    answer
}

#[test]
fn a_wrong_scene_is_named_with_file_line_and_mend() {
    let program = program();
    fails(&program, "measure nowhere.xml", 2, &["nowhere.xml:1: scene:", "cannot be read", "give the path"]);
    let broken = [
        ("<scene version=\"3.0.0\">\n<shape type=\"sphere\">\n</scene>\n", "bad.xml:"),
        ("<scene version=\"3.0.0\">\n<shape type=\"spher\"/>\n</scene>", "bad.xml:2: shape"),
        (
            "<scene version=\"3.0.0\">\n\n<shape type=\"sphere\"><float name=\"raduis\" value=\"1\"/></shape></scene>",
            "bad.xml:3:",
        ),
        (
            "<scene version=\"3.0.0\"><shape type=\"sphere\"><float name=\"radius\" value=\"x\"/></shape></scene>",
            "bad.xml:1:",
        ),
        ("", "bad.xml:1:"),
    ];
    for (text, place) in broken {
        program.write("bad.xml", text);
        for line in
            ["measure bad.xml", "render bad.xml -o image.exr", "map build bad.xml -o photons.map", "plan bad.xml"]
        {
            fails(&program, line, 2, &[place]);
        }
    }
    fails(&program, &format!("measure {} -D ro=0.5", scene("integrating-sphere.xml")), 2, &["\"ro\" names no default"]);
}

#[test]
fn a_scene_that_cannot_be_read_says_what_it_lacks() {
    let program = program();
    let (cube, lamp) = (scene("cube.xml"), scene("square-lamp.xml"));
    fails(&program, &format!("measure {lamp}"), 2, &["square-lamp.xml:1: scene: no meter; add a <sensor>"]);
    fails(&program, &format!("render {cube} -o image.exr"), 2, &["cube.xml:1: scene: no camera; add a <sensor>"]);
    fails(&program, &format!("measure {cube} --sensor Q"), 2, &["--sensor Q", "`A-face-centre`, `B`"]);
    let text = std::fs::read_to_string(&cube).expect("readable");
    let (start, end) = (text.find("<emitter").expect("a lamp"), text.find("</emitter>").expect("its end"));
    program.write("dark.xml", format!("{}{}", &text[..start], &text[end + "</emitter>".len()..]));
    program.write("black.xml", text.replace("value=\"50000\"", "value=\"0\""));
    for line in ["measure dark.xml", "map build dark.xml -o photons.map"] {
        fails(&program, line, 2, &["dark.xml:1: scene: no lamp; add an <emitter>"]);
    }
    fails(&program, "measure black.xml", 2, &["every lamp is black"]);
    // A scene that never absorbs has no answer; that shows only while running.
    let lossless = format!("measure {} -D rho=1 --photons 16 --spp 16", scene("integrating-sphere.xml"));
    fails(&program, &lossless, 1, &["`wall`", "no steady state", "--max-depth"]);
}

#[test]
fn a_luminaire_file_needs_one_goniometer_in_candela() {
    let program = program();
    let meter = r#"<sensor type="intensitymeter"/>"#;
    let lit = |lamp: &str, rest: &str| {
        format!(
            r#"<scene version="3.0.0"><emitter type="point"><rgb name="intensity" value="{lamp}"/></emitter>{rest}</scene>"#
        )
    };
    program.write("one.xml", lit("1", meter));
    program.write("two.xml", lit("1", &meter.repeat(2)));
    program.write("coloured.xml", lit("1 0 1", meter));
    let dark = r#"<shape type="cube"><bsdf type="diffuse"/></shape>"#;
    program.write("dark.xml", lit("1", &format!("{meter}{dark}")));
    for (line, words) in [
        (format!("measure {} --ies lamp.ies", scene("cube.xml")), "no goniometer is read; add a <sensor"),
        ("measure two.xml --units photometric --ies lamp.ies".into(), "2 goniometers are read; choose one by --sensor"),
        ("measure one.xml --ies lamp.ies".into(), "a luminaire file is in candela; add --units photometric"),
        ("measure one.xml --units photometric --ies lamp.ldt".into(), "a luminaire file's name ends in .ies"),
        ("measure one.xml --units photometric --ies no/lamp.ies".into(), "the folder no does not exist; make it first"),
        ("measure coloured.xml --units photometric --ies lamp.ies".into(), "has colours and a luminaire file has none"),
        (
            "measure dark.xml --units photometric --photons 1000 --ies lamp.ies".into(),
            "the luminaire of sensor `sensor-0` emits nothing",
        ),
    ] {
        fails(&program, &line, 2, &[words]);
        assert!(!program.path("lamp.ies").exists(), "{line}");
    }
    let told = program.run("measure two.xml --sensor sensor-1 --units photometric --photons 20000 --ies lamp.ies");
    assert_eq!(told.status, Some(0), "{}", told.err);
    assert!(program.bytes("lamp.ies").starts_with(b"IESNA:LM-63-2002\r\n"));
}

#[test]
fn an_option_that_is_unknown_unused_or_impossible_is_an_error() {
    let program = program();
    let cube = scene("cube.xml");
    for (options, word) in [
        ("--nonsense 3", "--nonsense"),
        ("--method radius --k 5", "--k is not used by the method radius"),
        ("--method path --photons 100", "--photons is not used by the method path"),
        ("--method bins", "photons cannot be counted along a ray"),
        ("--method bins --spp 4", "--spp is not used by the method bins"),
        ("--photons -5", "not a whole number"),
        ("--method final-gather --direct photons", "--direct photons is not used"),
        ("--method nearest --gather-rays 4", "--gather-rays is not used"),
        ("--method path --map photons.map", "--map is not used"),
        ("--k 5 --radius 1", "no method uses all of --k, --radius"),
        ("--size 8x8", "--size is for images"),
        ("--method nearest --k 1", "--k must be at least 2"),
        ("--photons 0", "must be at least 1"),
        ("--photons 1.5", "not a whole number"),
        ("--radius 0", "above 0"),
        ("--radius nan", "above 0"),
        ("--target-error 0%", "above 0"),
        ("--confidence 1", "below 1"),
        ("--method path --cache", "--cache is not used by the method path"),
        ("--cache --time-limit 5", "not built yet together with --time-limit"),
        ("--method path --kernel cone", "--kernel is not used by the method path"),
        ("--kernel triweight", "[possible values: disc, cone, epanechnikov, biweight, gaussian]"),
        ("--method final-gather --area clipped", "--area is not used by the method final-gather"),
        ("--device gpu", "not built yet"),
    ] {
        fails(&program, &format!("measure {cube} {options}"), 2, &[word]);
    }
    fails(&program, &format!("map build {cube} -o photons.map --k 5"), 2, &["--k is not used when a map is built"]);
    fails(
        &program,
        &format!("map build {cube} -o photons.map --cache"),
        2,
        &["--cache is not used when a map is built"],
    );
    let cornell = scene("cornell-box.xml");
    fails(&program, &format!("render {cornell} -o image.exr --false-colour"), 2, &["ends in .png"]);
    fails(&program, &format!("render {cornell} -o image.exr --size 0x5"), 2, &["1 to 65536"]);
    fails(&program, "", 2, &["Usage"]);
}

#[test]
fn an_output_that_cannot_be_written_leaves_nothing() {
    let program = program();
    let (cube, cornell) = (scene("cube.xml"), scene("cornell-box.xml"));
    let quick = "--size 4x4 --spp 2 --photons 100";
    fails(&program, &format!("render {cornell} -o none/image.exr {quick}"), 2, &["the folder none does not exist"]);
    fails(&program, &format!("render {cornell} -o image.jpg {quick}"), 2, &["must end in .exr or .png"]);
    fails(&program, &format!("map build {cube} -o none/photons.map"), 2, &["the folder none does not exist"]);
    std::fs::create_dir(program.path("folder.exr")).expect("writable");
    fails(&program, &format!("render {cornell} -o folder.exr {quick}"), 2, &["this is a folder"]);
    fails(&program, &format!("map build {cube} -o folder.exr"), 2, &["this is a folder"]);
    let left: Vec<_> =
        std::fs::read_dir(program.folder()).expect("readable").map(|e| e.expect("entry").file_name()).collect();
    assert_eq!(left, ["folder.exr"]);
}

#[test]
fn an_output_replaces_no_device_and_no_other_file() {
    let (program, cube) = (program(), scene("cube.xml"));
    program.write("photons.partial", "mine");
    program.write("photons.map.partial", "mine too");
    program.succeed(&format!("map build {cube} -o photons.map --photons 2000 --passes 2"));
    assert_eq!(program.bytes("photons.partial"), b"mine");
    assert_eq!(program.bytes("photons.map.partial"), b"mine too");
    #[cfg(unix)]
    fails(&program, &format!("map build {cube} -o /dev/null"), 2, &["this is a device or a pipe"]);
}

#[test]
fn a_map_that_does_not_fit_is_refused() {
    let program = program();
    let (cube, sphere) = (scene("cube.xml"), scene("integrating-sphere.xml"));
    program.succeed(&format!("map build {cube} -o good.map --photons 2000 --passes 2"));
    program.succeed(&format!("map build {cube} -o indirect.map --photons 2000 --passes 2 --direct sampled"));
    let with = |map: &str| format!("measure {cube} --map {map}");
    fails(&program, &format!("measure {sphere} --map good.map"), 2, &["good.map: this map is of another scene"]);
    fails(&program, &with("indirect.map"), 2, &["no direct photons, which the method final-gather needs"]);
    fails(&program, &format!("{} --photons 5", with("good.map")), 2, &["--photons was decided when the map was built"]);
    fails(&program, &with("absent.map"), 2, &["absent.map"]);
    program.succeed(&format!("{} --method radius", with("indirect.map")));

    let good = program.bytes("good.map");
    let mut worse =
        vec![Vec::new(), b"PHOTONLB".to_vec(), good[..good.len() - 1].to_vec(), good[..good.len() / 2].to_vec()];
    worse.push([good.as_slice(), b"x"].concat());
    for at in [0, 8, 12, 20, good.len() / 2, good.len() - 1] {
        let mut flipped = good.clone();
        flipped[at] ^= 0x40;
        worse.push(flipped);
    }
    worse.push(std::fs::read(&cube).expect("readable"));
    // A sound map of an earlier version says so.
    let mut earlier = good[..good.len() - 16].to_vec();
    earlier[8..12].copy_from_slice(&1_u32.to_le_bytes());
    let hash = xxhash_rust::xxh3::xxh3_128(&earlier).to_le_bytes();
    earlier.extend(hash);
    program.write("earlier.map", &earlier);
    fails(&program, &with("earlier.map"), 2, &["earlier.map:", "its version is 1", "build the map again"]);
    for bytes in worse {
        program.write("bad.map", &bytes);
        fails(&program, &with("bad.map"), 2, &["bad.map:", "build the map again"]);
        fails(&program, "map info bad.map", 2, &["bad.map:"]);
    }
}
