//! Optical devices: the scenes of `experiments/scenes/optics/` against their answers in the reference.

use photonlab_measure::z_test;
use photonlab_photometry::{Response, WAVELENGTHS};
use photonlab_readout::{CellResult, Method};
use photonlab_reference::optics::{
    condenser::Condenser, light_guide::LightGuide, port_sphere::PortSphere, reflector::Reflector,
    spectrograph::Spectrograph,
};
use photonlab_scene::luminaire::{Format, parse_luminaire};
use photonlab_tests::{Family, Lab, Program, scene_file, scene_text, seed, settings};
use photonlab_trace::Classes;

const GATHER: Method = Method::FinalGather { radius: None };

fn lab(name: &str) -> Lab {
    Lab::open(&scene_file(&format!("optics/{name}.xml")))
}

/// A reading against an answer that is itself known to a precision: whatever lies within that is right.
fn judge(family: &mut Family, what: &str, cell: &CellResult<1>, answer: f64, precision: f64) {
    let read = cell.value[0].mean().expect("a pass");
    family.reading(what, cell, 0, read.clamp(answer - precision, answer + precision));
}

/// Hundreds of total reflections lose nothing: not a bit of flux stays in the glass, and what comes out is what both ends let
/// through. A share of 1e-4 lost at each would be booked at once.
#[test]
fn a_light_guide_keeps_its_light() {
    let (mut family, guide, lab) = (Family::new("light guide, lamp before it"), LightGuide::SCENE, lab("light-guide"));
    for (method, number) in [(Method::Bins, 1200), (GATHER, 1201)] {
        let outcome = lab.measure::<1>(settings(method, seed(number)), 160_000, 16, 1 << 12);
        judge(&mut family, method.name(), &outcome.cells[0], guide.transmitted(), 1e-9);
    }
    let ledger = lab.trace::<1>(20_000, seed(1202), 0, Classes::NONE).ledger;
    let (glass, total) = (&ledger.surfaces[0], ledger.total());
    assert!(glass.incident[0] > 20.0 * ledger.emitted[0], "light meets the glass {} times", glass.incident[0]);
    assert_eq!(glass.absorbed[0], 0.0, "flux left in the glass");
    assert_eq!((total.cut_off[0], total.roulette()[0]), (0.0, 0.0));
    family.decide();
}

/// The sphere multiplier by the flux that leaves, counted and gathered, and by the wall's radiance through the port.
#[test]
fn a_port_lets_out_what_the_sphere_multiplier_says() {
    let (mut family, sphere, lab) = (Family::new("port sphere"), PortSphere::SCENE, lab("port-sphere"));
    let counted = lab.measure::<1>(settings(Method::Bins, seed(1210)), 1_000_000, 16, 1 << 10);
    judge(&mut family, "counted", &counted.cells[0], sphere.port_flux(), 0.0);
    let gathered = lab.measure::<1>(settings(GATHER, seed(1211)), 1_000_000, 16, 1 << 14);
    let answers = [("gathered", sphere.port_flux()), ("unlit", sphere.radiance(0.15)), ("lit", sphere.radiance(-0.2))];
    for (cell, (what, answer)) in gathered.cells.iter().zip(answers) {
        judge(&mut family, what, cell, answer, 0.0);
    }
    family.decide();
}

/// Flux on the target and around it, ghosts included.
#[test]
fn a_condenser_gathers_what_its_rays_say() {
    let (mut family, lab, answers) = (Family::new("condenser"), lab("condenser"), Condenser::SCENE.gathered());
    for (method, number) in [(Method::Bins, 1220), (GATHER, 1221)] {
        let outcome = lab.measure::<1>(settings(method, seed(number)), 2_000_000, 16, 1 << 12);
        for (cell, (place, answer)) in outcome.cells.iter().zip(["target", "beside"].into_iter().zip(answers)) {
            judge(&mut family, &format!("{} {place}", method.name()), cell, answer, 1e-4 * answer);
        }
    }
    family.decide();
}

/// Every strip of the screen gets the light of the lines that land there, by N-BK7's own formula, and the others none.
#[test]
fn a_spectrograph_puts_each_line_in_its_place() {
    let (mut family, device) = (Family::new("spectrograph"), Spectrograph::SCENE);
    let outcome = lab("spectrograph").measure_as::<WAVELENGTHS>(
        Response::Radiometric,
        settings(Method::Bins, seed(1230)),
        3_000_000,
        64,
        1 << 10,
    );
    let flux = |strip: [f64; 2]| Spectrograph::LINES.map(|line| device.flux(line, strip)).iter().sum::<f64>();
    for (row, cell) in outcome.cells.iter().enumerate() {
        let low = -0.03 + 0.002 * row as f64;
        let (expected, read) = (flux([low, low + 0.002]), cell.value[0].mean().expect("a pass"));
        if expected > 1e-4 {
            family.mean(format!("strip {row}"), &cell.value[0], expected);
        } else {
            assert!(read <= 1e-4, "strip {row} reads {read}, of {expected}");
        }
    }
    family.decide();
}

/// The luminaire with its mirror, and the same by the file that its goniometer wrote: one flux, to rounding, and one reading of
/// the beam within what both counted. The beam ends sharply at 4 degrees, the file's with its rows at 5.
#[test]
fn a_reflector_and_its_luminaire_file_light_alike() {
    let (mut family, reflector, photons) = (Family::new("reflector"), Reflector::SCENE, 4_000_000);
    let (angle, radius) = (10f64.to_radians(), 17.632698070846);
    let (truth, far) = (reflector.flux_within(radius, 100.0), reflector.far_flux_within(angle));
    assert!((truth - far).abs() < 1e-4 * truth, "the disc is far: {truth} {far}");
    let program = Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"));
    let scene = scene_file("optics/reflector.xml");
    let counts = format!("--method bins --photons {photons} --passes 16 --seed {}", seed(1240));
    program.measure(&format!("{} --units photometric {counts} --ies reflector.ies", scene.display()));
    let file = parse_luminaire(&program.bytes("reflector.ies"), Format::Lm63).expect("a luminaire");
    assert!((file.table.flux() / reflector.flux - 1.0).abs() < 1e-9, "{}", file.table.flux());

    program.write("by-file.xml", scene_text("optics/reflector-by-file.xml"));
    let by_file = Lab::open(&program.path("by-file.xml"));
    let count = |lab: &Lab, method, number| lab.measure::<1>(settings(method, seed(number)), photons, 16, 1 << 14);
    let with_mirror = count(&lab("reflector"), Method::Bins, 1241);
    judge(&mut family, "counted, mirror", &with_mirror.cells[0], truth, 2e-5 * reflector.flux);
    // The file has the spread of its own count.
    let share = truth / reflector.flux;
    let of_file = reflector.flux * (share * (1.0 - share) / photons as f64).sqrt();
    for (what, method, number) in [("counted, file", Method::Bins, 1242), ("gathered, file", GATHER, 1243)] {
        let read = &count(&by_file, method, number).cells[0].value[0];
        let (mean, error) = (read.mean().expect("passes"), read.std_error().expect("passes").hypot(of_file));
        let apart = ((mean - truth).abs() - 1e-4 * truth).max(0.0);
        family.compare(what, z_test(apart, 0.0, error), format!("expected {truth}, read {mean} +- {error}"));
    }
    // The committed file is one such count.
    let committed = count(&lab("reflector-by-file"), GATHER, 1244).cells[0].value[0].mean().expect("passes");
    let p_value = z_test(((committed - truth).abs() - 1e-4 * truth).max(0.0), 0.0, of_file);
    family.compare("gathered, committed file", p_value, format!("expected {truth}, read {committed} +- {of_file}"));
    family.decide();
}
