//! `plan`, `chart` and `auto` as their users meet them.

use std::time::Duration;

use photonlab_tests::{LAMP_OVER_FLOOR, Program, scene_file};
use serde_json::Value;

fn program() -> Program {
    Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"))
}

fn scene(name: &str) -> String {
    scene_file(name).display().to_string()
}

#[test]
fn plan_tells_the_choice_and_the_command_that_follows_it() {
    let program = program();
    let told = program.succeed(&format!("plan {} --target-error 0.7%", scene("cube.xml")));
    for word in [
        "needed:",
        "left out:",
        "to a half-width of 0.7%",
        "* final-gather",
        "path",
        "progressive",
        "--target-error 0.7%",
    ] {
        assert!(told.contains(word), "`{word}` is not in:\n{told}");
    }
    program.write("a scene.xml", LAMP_OVER_FLOOR);
    let folder = program.path("a scene.xml").display().to_string();
    let line = format!("photonlab plan '{folder}' --target-error 2%");
    let Some(answer) = program.shell(&line) else {
        println!("NOT CHECKED: the command that a plan names (no sh)");
        return;
    };
    let told = answer.success(&line);
    assert!(told.contains("no map is needed"), "{told}");
    let command = told.lines().find_map(|line| line.strip_prefix("run: ")).expect("a command");
    let ran = program.shell(command).expect("sh").success(command);
    assert!(ran.contains("W/m^2"), "{ran}");
    for (options, mend) in [("--target-error 0", "--target-error"), ("--target-error x", "--target-error")] {
        let answer = program.run(&format!("plan {} {options}", scene("cube.xml")));
        assert_eq!(answer.status, Some(2), "{options}");
        assert!(answer.err.contains(mend), "{}", answer.err);
    }
}

/// Pilots are part of the time that a user allows.
#[test]
fn a_race_keeps_to_a_time_limit() {
    let program = program();
    let answer = program.run(&format!("measure {} --target-error 0.0001% --time-limit 3 --json", scene("cube.xml")));
    let told: Value = serde_json::from_str(&answer.success("measure")).expect("JSON");
    assert_eq!(told["stopped"], "time");
    assert!(told["readings"].as_array().is_some_and(|readings| readings.len() == 6));
    assert!(told["seconds"].as_f64().is_some_and(|seconds| seconds < 3.0 * 1.1 + 1.0), "{}", told["seconds"]);
}

/// An option that some methods use alone leaves those in the race.
#[test]
fn a_race_obeys_the_options() {
    let program = program();
    let cube = scene("cube.xml");
    for (options, method, words) in [
        ("--k 20", "nearest", "--k 20"),
        ("--gather-rays 3", "final-gather", "--gather-rays 3"),
        ("--cache", "final-gather", "--cache"),
        ("--radius 0.2 --area disc", "radius", "--radius 0.2"),
    ] {
        let told = program.measure(&format!("{cube} --sensor C --target-error 20% {options}"));
        assert_eq!(told["method"], method, "{options}");
        assert!(
            told["command"].as_str().is_some_and(|command| command.contains(words)),
            "{options}: {}",
            told["command"]
        );
    }
    let answer = program.run(&format!("render {} --method bins --size 4x4 -o x.png", scene("cornell-box.xml")));
    assert_eq!(answer.status, Some(2));
    assert!(answer.err.contains("photons cannot be counted along a ray"), "{}", answer.err);
}

#[test]
fn chart_leaves_two_figures_and_their_numbers() {
    let program = program();
    program.write("open.xml", LAMP_OVER_FLOOR);
    let answer = program.run(&format!("chart {} -o made", program.path("open.xml").display()));
    assert!(answer.took < Duration::from_secs(300));
    let told = answer.success("chart");
    for word in ["final-gather", "half-width", "made/error.svg"] {
        assert!(told.contains(word), "`{word}` is not in:\n{told}");
    }
    for figure in ["made/error.svg", "made/certainty.svg"] {
        assert!(String::from_utf8_lossy(&program.bytes(figure)).starts_with("<svg"), "{figure}");
    }
    let rows: Value = serde_json::from_slice(&program.bytes("made/chart.json")).expect("JSON");
    let marks = rows["marks"].as_array().expect("marks");
    assert!(marks.len() > 1 && marks.iter().any(|mark| mark["on_front"] == true));
    // Evenly spread points: more of them err less.
    let error = |mark: &Value| mark["error"].as_f64().expect("an error");
    assert!(error(&marks[marks.len() - 1]) < error(&marks[0]), "{rows:#}");
    let answer = program.run(&format!("chart {} -o open.xml", program.path("open.xml").display()));
    assert_eq!(answer.status, Some(2), "a file is no folder");
}
