//! The same scene, seed and options give the same bits: for any number of threads, again by the printed command, and by
//! way of a saved map.

use photonlab_tests::{Exr, Program, scene_file};
use serde_json::Value;

fn program() -> Program {
    Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"))
}

fn scene(name: &str) -> String {
    scene_file(name).canonicalize().expect("one of the project's scenes").display().to_string()
}

/// The JSON text without what may differ between runs.
fn fixed_lines(text: &str) -> String {
    let changes = ["\"seconds\":", "\"threads\":", "\"peak_bytes\":"];
    let kept = text.lines().filter(|line| !changes.iter().any(|name| line.trim_start().starts_with(name)));
    kept.collect::<Vec<_>>().join("\n")
}

/// A medium and glass that disperses, followed by wavelength.
const HAZE: &str = r#"<scene version="3.0.0">
    <medium type="homogeneous" id="haze"><spectrum name="sigma_t" value="360:2, 830:0.5"/><float name="albedo" value="0.9"/></medium>
    <emitter type="point"><point name="position" x="0.6" y="-0.2" z="0.4"/><ref name="medium" id="haze"/></emitter>
    <shape type="sphere"><float name="radius" value="0.3"/><ref name="exterior" id="haze"/>
        <bsdf type="dielectric"><string name="int_ior" value="n-bk7"/></bsdf></shape>
    <shape type="cube"><boolean name="flip_normals" value="true"/><ref name="exterior" id="haze"/><sensor type="irradiancemeter"/></shape>
    </scene>"#;

/// Every way of reading, every kind of file, on scenes with colour, glass and lamps of each kind.
#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    let program = program();
    let (cube, sphere) = (scene("cube.xml"), scene("integrating-sphere.xml"));
    let (cornell, lens) = (scene("cornell-box.xml"), scene("ball-lens-lamp.xml"));
    program.write("haze.xml", HAZE);
    let texts = |threads: u32| {
        [
            format!("measure {cube} --photons 20011 --spp 300"),
            format!("measure {cube} --method nearest --k 30 --photons 20011 --spp 32"),
            format!("measure {sphere} --method radius --direct photons --photons 20011 --spp 300"),
            format!("measure {sphere} --method path --spp 300"),
            "measure haze.xml --photons 20011 --spp 300 --units photometric".into(),
            "measure haze.xml --photons 20011 --method bins".into(),
        ]
        .map(|line| fixed_lines(&program.succeed(&format!("{line} --seed 5 --json --threads {threads}"))))
    };
    let files = |threads: u32| {
        [
            (format!("render {cornell} --size 23x17 --spp 16 --photons 20011"), "image.exr"),
            (format!("render {lens} --size 23x17 --spp 16 --photons 20011"), "image.exr"),
            (format!("render {cornell} --size 23x17 --spp 16 --photons 20011 --false-colour"), "image.png"),
            (format!("render {cornell} --size 23x17 --spp 16 --photons 20011 --cache --gather-rays 8"), "image.exr"),
            (format!("render {cornell} --size 23x17 --spp 16 --photons 20011 --guided"), "image.exr"),
            (format!("map build {cornell} --photons 20011 --passes 3"), "photons.map"),
        ]
        .map(|(line, file)| {
            program.succeed(&format!("{line} -o {file} --seed 5 --threads {threads}"));
            program.bytes(file)
        })
    };
    let (text_of_one, files_of_one) = (texts(1), files(1));
    for threads in [2, 7] {
        for (i, (one, many)) in text_of_one.iter().zip(texts(threads)).enumerate() {
            assert_eq!(*one, many, "measurement {i} with {threads} threads");
        }
        for (i, (one, many)) in files_of_one.iter().zip(files(threads)).enumerate() {
            assert!(*one == many, "file {i} differs with {threads} threads: {} and {} bytes", one.len(), many.len());
        }
    }
    assert!(
        fixed_lines(&program.succeed(&format!("measure {cube} --photons 20011 --spp 300 --seed 6 --json")))
            != text_of_one[0]
    );
}

fn command(measured: &Value) -> String {
    measured["command"].as_str().expect("the fixed command").to_string()
}

/// However a run was ended, the command that it prints gives its readings and books again, bit for bit.
#[test]
fn the_fixed_command_gives_the_same_bits() {
    let program = program();
    program.write("it's a scene.xml", std::fs::read(scene("integrating-sphere.xml")).expect("readable"));
    let cube = scene("cube.xml");
    for options in [
        format!("measure {cube} --target-error 3%"),
        format!("measure {cube} --time-limit 1 --seed 4"),
        format!("measure {cube} --time-limit 1 --photons 1e9 --passes 3"),
        format!("measure {cube} --photons 1e5 --spp 100 --sensor C --units photometric --confidence 0.9"),
        format!("measure {cube} --k 20 --passes 5 --seed 18446744073709551615"),
        format!("measure {cube} --radius 0.25 --passes 3 --spp 10 --max-depth 4 --area sphere --direct photons"),
        format!("measure {cube} --gather-rays 3 --passes 3 --spp 10 --max-specular 7"),
        format!("measure {cube} --method radius --target-error 8% --sensor C"),
        format!("measure {cube} --method nearest --direct photons --photons 2e5 --sensor C"),
        "measure 'it'\\''s a scene.xml' -D rho=0.25 --passes 2".to_string(),
    ] {
        let Some(first) = program.shell(&format!("photonlab {options} --json")) else {
            println!("NOT CHECKED: the fixed command (no sh)");
            return;
        };
        let first: Value = serde_json::from_str(&first.success(&options)).expect("JSON");
        let fixed = command(&first);
        let again = program.shell(&format!("{fixed} --json")).expect("sh").success(&fixed);
        let again: Value = serde_json::from_str(&again).expect("JSON");
        for part in ["readings", "ledger", "photons", "method", "command"] {
            assert_eq!(first[part], again[part], "{part} of `{options}` and of `{fixed}`");
        }
        for decided in ["--target-error", "--time-limit", "auto"] {
            assert!(!fixed.contains(decided), "{fixed}");
        }
    }
}

#[test]
fn an_image_carries_the_command_that_gives_its_bytes() {
    let program = program();
    let line = format!("render {} --size 16x12 --target-error 20% --seed 3", scene("cornell-box.xml"));
    program.succeed(&format!("{line} -o first.exr"));
    let image = Exr::read(&program.path("first.exr"));
    let attribute = |name: &str| image.attributes.iter().find(|(known, _)| known == name).map(|(_, text)| text.clone());
    let fixed = attribute("command").expect("the command in the image");
    program.succeed(&format!("{} -o second.exr", fixed.strip_prefix("photonlab ").expect("a command")));
    assert!(program.bytes("first.exr") == program.bytes("second.exr"), "`{fixed}` gives other bytes");
    assert_eq!(attribute("seed").as_deref(), Some("3"));
    assert_eq!(attribute("units").as_deref(), Some("W/(m^2 sr)"));
    assert_eq!(attribute("scene"), Some(scene("cornell-box.xml")));
    assert_eq!(image.size, [16, 12]);
    let names: Vec<_> = image.channels.iter().map(|(name, _)| name.as_str()).collect();
    let layers = ["B", "G", "R", "bias_bound.B", "bias_bound.G", "bias_bound.R", "photons_used.Y"];
    assert_eq!(names[..7], layers);
    assert_eq!(names[7..], ["std_error.B", "std_error.G", "std_error.R"]);
}

/// Reading a saved map is the run that traced it, with independent photons as those of maps are.
#[test]
fn a_saved_map_reads_as_the_run_that_traced_it() {
    let program = program();
    for (name, method, draws) in [
        ("cube.xml", "--method final-gather", "--draws independent"),
        ("cube.xml", "--method nearest --k 20", ""),
        ("integrating-sphere.xml", "--method radius --direct photons", "--draws independent"),
    ] {
        let scene = scene(name);
        program.succeed(&format!("map build {scene} -o photons.map --photons 30001 --passes 5 --seed 8"));
        let traced =
            program.measure(&format!("{scene} {method} {draws} --photons 30001 --passes 5 --spp 320 --seed 8"));
        let read = program.measure(&format!("{scene} {method} --map photons.map --passes 5 --spp 320 --seed 8"));
        for part in ["readings", "ledger", "photons"] {
            assert_eq!(traced[part], read[part], "{part} of {name} {method}");
        }
        let fixed = command(&read);
        let again = program.measure(fixed.strip_prefix("photonlab measure ").expect("a command"));
        assert_eq!(again["readings"], read["readings"], "{fixed}");
    }
    let told = program.succeed("map info photons.map");
    for line in
        ["emitted paths   30001", "passes          5", "seed            8", "classes         direct caustic indirect"]
    {
        assert!(told.contains(line), "`{line}` in {told}");
    }
}
