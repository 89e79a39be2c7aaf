//! Lamps by a luminaire file: where their photons go, and what meters below them read.

use photonlab_readout::Method;
use photonlab_reference::lamps::table::{Interpolation, cases, catalogue_lamp};
use photonlab_scene::luminaire::{IntensityTable, Symmetry, write_lm63};
use photonlab_tests::{Family, Lab, Program, seed, settings};
use photonlab_trace::Classes;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// A scene of the reference with the files that it names, in a folder of its own.
fn lab(xml: &str, files: &[(String, String)]) -> Lab {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("the folder can be written");
    }
    std::fs::write(folder.path().join("scene.xml"), xml).expect("the folder can be written");
    Lab::open(&folder.path().join("scene.xml"))
}

/// Photons of the catalogue's lamp C6, which looks along an oblique direction, by the angle from that: in parts of a third of
/// each row's zone the flux is known in closed form.
#[test]
fn photons_leave_by_the_table() {
    let mut family = Family::new("table lamp");
    let lamp = catalogue_lamp(Interpolation::Angle);
    let xml = r#"<scene version="3.0.0"><emitter type="ies"><string name="filename" value="table.ies"/>
        <vector name="direction" x="0.48" y="0.6" z="0.64"/></emitter>
        <shape type="sphere"><boolean name="flip_normals" value="true"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>"#;
    let photons = 200_000;
    let traced = lab(xml, &[("table.ies".into(), lamp.ies())]).trace::<1>(photons, seed(310), 0, Classes::ALL);
    assert!((traced.ledger.emitted[0] / lamp.flux() - 1.0).abs() < 1e-12, "{}", traced.ledger.emitted[0]);
    let mut counts = [0u64; 27];
    for p in &traced.positions {
        let [x, y, z] = p.map(f64::from);
        let (along, whole) = (0.48 * x + 0.6 * y + 0.64 * z, x.hypot(y).hypot(z));
        let angle = (along / whole).clamp(-1.0, 1.0).acos();
        counts[((angle.to_degrees() * 0.3) as usize).min(26)] += 1;
    }
    let within = |part: usize| lamp.flux_within_angle((part as f64 / 0.3).to_radians());
    let expected: Vec<f64> =
        (0..27).map(|part| photons as f64 * (within(part + 1) - within(part)) / lamp.flux()).collect();
    family.counts("zones", &counts, &expected);
    family.decide();
}

/// The catalogue's meters below it, of irradiance at six places and of flux on a disc, by final gather, whose direct light is
/// the whole, and by counting.
#[test]
fn meters_below_a_table_lamp_read_the_closed_form() {
    let mut family = Family::new("meters below a table lamp");
    for (index, case) in cases().into_iter().enumerate() {
        let lab = lab(&case.xml, &case.files);
        for (method, number) in [(Method::FinalGather { radius: None }, 311), (Method::Bins, 316)] {
            let outcome = lab.measure::<1>(settings(method, seed(number + index as u32)), 4_000_000, 32, 1024);
            for (cell, answer) in outcome.cells.iter().zip(&case.expected) {
                // Whatever lies within the answer's own uncertainty is right.
                let read = cell.value[0].mean().expect("a pass");
                let truth = read.clamp(answer.value[0] - answer.uncertainty, answer.value[0] + answer.uncertainty);
                family.reading(format!("{} {}", method.name(), answer.sensor), cell, 0, truth);
            }
        }
    }
    family.decide();
}

/// A street lamp with two wings and some light everywhere.
fn street_lamp() -> IntensityTable {
    let gamma = [0.0, 20.0, 55.0, 70.0, 100.0, 180.0];
    let planes = [
        [90.0, 80.0, 60.0, 20.0, 10.0, 5.0],
        [90.0, 110.0, 300.0, 120.0, 50.0, 8.0],
        [90.0, 70.0, 30.0, 25.0, 20.0, 8.0],
    ];
    IntensityTable::new(Symmetry::AboutC90, &[-90.0, 10.0, 90.0], &gamma, planes.as_flattened()).expect("a table")
}

/// Flux in parts of a table, by the midpoint rule in steps far smaller than its cells, scaled to the whole.
fn flux_in_cells(table: &IntensityTable, columns: usize, rows: usize) -> Vec<f64> {
    const STEPS: usize = 40;
    let mut flux = vec![0.0; columns * rows];
    for row in 0..rows * STEPS {
        let gamma = (row as f64 + 0.5) * 180.0 / (rows * STEPS) as f64;
        for column in 0..columns * STEPS {
            let c = (column as f64 + 0.5) * 360.0 / (columns * STEPS) as f64;
            flux[row / STEPS * columns + column / STEPS] += table.intensity(c, gamma) * gamma.to_radians().sin();
        }
    }
    let whole: f64 = flux.iter().sum();
    flux.iter().map(|part| part / whole * table.flux()).collect()
}

/// A lamp by a file, read by a goniometer, written to a file, and that lamp read again: the same as the first within the
/// errors of both readings, and the same flux to rounding. Both lamps are turned, and the goniometers with them.
#[test]
fn a_lamp_survives_the_goniometer() {
    let mut family = Family::new("goniometer, round trip");
    let (table, photons, columns, rows) = (street_lamp(), 8_000_000, 24_usize, 18_usize);
    let program = Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"));
    program.write("first.ies", write_lm63(&table, &[]));
    let turned = r#"<transform name="to_world"><rotate x="1" y="2" z="-1" angle="70"/></transform>"#;
    let scene = |file: &str| {
        format!(
            r#"<scene version="3.0.0"><emitter type="ies"><string name="filename" value="{file}"/>{turned}</emitter>
            <sensor type="intensitymeter">{turned}<film type="hdrfilm"><integer name="width" value="{columns}"/>
            <integer name="height" value="{rows}"/></film></sensor></scene>"#
        )
    };
    let read = |file: &str, next: &str, seed: u64| -> Vec<f64> {
        program.write("scene.xml", scene(file));
        let line = format!("scene.xml --units photometric --photons {photons} --passes 4 --seed {seed} --ies {next}");
        let measured = program.measure(&line);
        let readings = measured["readings"].as_array().expect("a list").iter();
        readings.map(|reading| reading["value"].as_f64().expect("light everywhere")).collect()
    };
    let (_, second) = (read("first.ies", "second.ies", seed(313)), read("second.ies", "third.ies", seed(314)));
    let files = ["second.ies", "third.ies"].map(|name| {
        let text = program.bytes(name);
        photonlab_scene::luminaire::parse_luminaire(&text, photonlab_scene::luminaire::Format::Lm63).expect("a table")
    });
    for file in &files {
        assert!((file.table.flux() / table.flux() - 1.0).abs() < 1e-9, "{} {}", file.table.flux(), table.flux());
        assert_eq!(file.notes, Vec::<String>::new());
    }
    // Both readings are counts of as many photons in the same cells, the second around the first.
    let edge = |row: usize| (std::f64::consts::PI * row as f64 / rows as f64).cos();
    let solid_angle =
        |cell: usize| std::f64::consts::TAU / columns as f64 * (edge(cell / columns) - edge(cell / columns + 1));
    let statistic: f64 = flux_in_cells(&table, columns, rows)
        .iter()
        .zip(&second)
        .enumerate()
        .map(|(cell, (flux, intensity))| {
            let (expected, counted) =
                [*flux, intensity * solid_angle(cell)].map(|flux| flux / table.flux() * f64::from(photons)).into();
            (counted - expected).powi(2) / (2.0 * expected)
        })
        .sum();
    let degrees = (columns * rows - 1) as f64;
    let p_value = ChiSquared::new(degrees).expect("degrees").sf(statistic);
    family.compare("second reading", p_value, format!("chi-square {statistic:.1} with {degrees} degrees"));
    family.decide();
}

/// In a scene by wavelength a luminaire keeps its lumens, whatever its spectrum: 1000 cd from 2 m above are 250 lx, read from
/// drawn wavelengths by the eye.
#[test]
fn a_luminaire_keeps_its_lumens_by_wavelength() {
    let mut family = Family::new("luminaire by wavelength");
    let program = Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"));
    let even = IntensityTable::new(Symmetry::Rotational, &[0.0], &[0.0, 90.0, 180.0], &[1000.0; 3]).expect("a table");
    program.write("even.ies", write_lm63(&even, &[]));
    for tint in ["", r#"<spectrum name="tint" value="400:0.1, 600:7, 601:0"/>"#, r#"<float name="tint" value="1"/>"#] {
        program.write(
            "scene.xml",
            format!(
                r#"<scene version="3.0.0"><emitter type="ies"><string name="filename" value="even.ies"/>{tint}
                <point name="position" x="0" y="0" z="2"/></emitter>
                <shape type="rectangle"><transform name="to_world"><scale value="0.01"/></transform>
                <bsdf type="diffuse"><spectrum name="reflectance" value="400:0, 700:0"/></bsdf>
                <sensor type="irradiancemeter"/></shape></scene>"#
            ),
        );
        let measured = program.measure(&format!("scene.xml --units photometric --seed {} --spp 20000", seed(315)));
        let reading = &measured["readings"][0];
        let number = |name: &str| reading[name].as_f64().unwrap_or_else(|| panic!("{name} of {reading}"));
        assert_eq!(reading["unit"], "lx");
        let z = (number("value") - 250.0) / number("std_error");
        let law = statrs::distribution::Normal::standard();
        family.compare(format!("tint `{tint}`"), 2.0 * law.cdf(-z.abs()), format!("{reading}"));
    }
    family.decide();
}
