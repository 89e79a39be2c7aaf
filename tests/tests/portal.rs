//! Portals: light of an environment through openings (catalogue I4), aimed through a portal or not.

use photonlab_measure::welch_test;
use photonlab_readout::{Method, Outcome};
use photonlab_reference::catalogue::Case;
use photonlab_reference::daylight::{
    roof_opening::{RoofOpening, cases_without_portals as cases},
    sky::Sky,
};
use photonlab_tests::{Answer, Family, Lab, Program, seed, settings};

const GATHER: Method = Method::FinalGather { radius: None };

/// A rectangle of these half-edges that looks down from above this place, with a portal.
fn portal([x, y, z]: [f64; 3], half: [f64; 2]) -> String {
    format!(
        r#"<shape type="rectangle"><transform name="to_world"><scale x="{}" y="{}"/><rotate x="1" angle="180"/>
        <translate x="{x}" y="{y}" z="{z}"/></transform><emitter type="portal"/></shape>"#,
        half[0], half[1]
    )
}

fn with(case: &Case, portals: &str) -> Lab {
    Lab::new(&case.xml.replace("</scene>", &format!("{portals}</scene>")))
}

fn measure(lab: &Lab, method: Method, number: u32) -> Outcome<1> {
    let photons = if method == Method::Bins { 4_000_000 } else { 400_000 };
    lab.measure::<1>(settings(method, seed(number)), photons, 32, 1 << 12)
}

/// Does every meter hold the truth?
fn hold(family: &mut Family, what: &str, case: &Case, outcome: &Outcome<1>) {
    for (cell, answer) in outcome.cells.iter().zip(&case.expected) {
        family.reading(format!("{} {what} {}", case.name, answer.sensor), cell, 0, answer.value[0]);
    }
}

/// The opening of 1 x 1 m, 3 m above the floor, under an even and an overcast sky and with a pane, a millimetre above which a
/// larger portal then lies: four meters each, by final gather and by counting.
#[test]
fn meters_below_an_opening_read_the_sky_component() {
    let mut family = Family::new("portal, sky component");
    let cases = cases();
    for (index, height, half) in [(0, 3.0, 0.5), (1, 3.0, 0.5), (3, 3.001, 0.55)] {
        let lab = with(&cases[index], &portal([0.0, 0.0, height], [half; 2]));
        for (method, number) in [(GATHER, 340), (Method::Bins, 350)] {
            let outcome = measure(&lab, method, number + index as u32);
            hold(&mut family, method.name(), &cases[index], &outcome);
        }
    }
    family.decide();
}

/// The flux on the whole floor by photons that start in a portal, and by those of the environment that come in beside it: all
/// through the portal, half through it, and through one larger than the opening.
#[test]
fn photons_through_and_beside_a_portal_add_up() {
    let mut family = Family::new("portal, photons");
    let opening = RoofOpening::new([1.0, 1.0], 3.0, None).expect("valid");
    // The mean over the floor by the midpoint rule, for 10 000 lx in the open; its error is below 1e-4.
    let at = |i: i32| -2.0 + 4.0 * (f64::from(i) + 0.5) / 40.0;
    let sum: f64 = (0..1600).map(|i| opening.illuminance(Sky::Uniform, at(i % 40), at(i / 40))).sum();
    let truth = 10_000.0 / Sky::Uniform.horizontal_illuminance() * sum / 1600.0;
    let floor = r#"<shape type="rectangle"><transform name="to_world"><scale value="2"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><sensor type="irradiancemeter" id="floor"/></shape>"#;
    let case = &cases()[0];
    let without_meters =
        case.xml.split("<shape").filter(|shape| !shape.contains("<sensor")).collect::<Vec<_>>().join("<shape");
    let end = if without_meters.contains("</scene>") { "" } else { "</scene>" };
    let room = Case { xml: without_meters + end, ..case.clone() };
    for (index, (name, portal)) in [
        ("all", portal([0.0, 0.0, 3.0], [0.5; 2])),
        ("half", portal([0.25, 0.0, 3.0], [0.25, 0.5])),
        ("larger", portal([0.0, 0.0, 3.05], [0.8; 2])),
    ]
    .into_iter()
    .enumerate()
    {
        let outcome = measure(&with(&room, &format!("{portal}{floor}")), Method::Bins, 400 + index as u32);
        family.reading(name, &outcome.cells[0], 0, truth);
    }
    family.decide();
}

/// Portals beyond need change nothing: twice in the same place, and a larger one below that stands apart from the walls.
#[test]
fn portals_over_each_other_change_no_reading() {
    let mut family = Family::new("portal, one over another");
    let case = &cases()[0];
    let opening = portal([0.0, 0.0, 3.0], [0.5; 2]);
    let lab = with(case, &format!("{opening}{opening}{}", portal([0.2, 0.0, 2.5], [0.7; 2])));
    for (method, number) in [(GATHER, 360), (Method::Bins, 370)] {
        hold(&mut family, method.name(), case, &measure(&lab, method, number));
    }
    family.decide();
}

/// Direct light that comes beside a portal is found all the same, however the portal stands.
#[test]
fn direct_light_beside_a_portal_is_found() {
    let mut family = Family::new("portal, placed badly");
    let case = &cases()[0];
    for (index, (name, portal)) in [
        ("half", portal([0.25, 0.0, 3.0], [0.25, 0.5])),
        ("upside down", portal([0.0, 0.0, 3.0], [0.5; 2]).replace("<rotate x=\"1\" angle=\"180\"/>", "")),
        ("in the room", portal([0.5, 0.0, 1.0], [1.0; 2])),
    ]
    .into_iter()
    .enumerate()
    {
        let lab = with(case, &portal);
        hold(&mut family, name, case, &measure(&lab, GATHER, 371 + index as u32));
    }
    family.decide();
}

/// But few photons go beside a portal, so that a scene with other ways in is refused, and one with next to none is read
/// without being certified. Black walls hide no hole.
#[test]
fn a_scene_open_beside_its_portals_is_refused() {
    let program = Program::new(env!("CARGO_BIN_EXE_photonlab-under-test"));
    let case = &cases()[0];
    let measure = |portals: &str| {
        program.write("room.xml", case.xml.replace("</scene>", &format!("{portals}</scene>")));
        program.run("measure room.xml --json --photons 10000 --spp 64")
    };
    let opening = portal([0.0, 0.0, 3.0], [0.5; 2]);
    for bad in [
        portal([0.25, 0.0, 3.0], [0.25, 0.5]),
        opening.replace("<rotate x=\"1\" angle=\"180\"/>", ""),
        portal([0.5, 0.0, 1.0], [1.0; 2]),
    ] {
        let told = measure(&bad);
        assert_eq!((told.status, told.out.as_str()), (Some(2), ""), "{}", told.err);
        assert!(told.err.contains("room.xml:1: scene: its portals are not the only ways in"), "{}", told.err);
    }
    let certified = |told: &Answer| {
        assert_eq!(told.status, Some(0), "{}", told.err);
        let measured: serde_json::Value = serde_json::from_str(&told.out).expect("JSON");
        measured["readings"].as_array().expect("a list").iter().all(|reading| reading["certified"] == true)
    };
    assert!(certified(&measure(&opening)));
    assert!(!certified(&measure(&portal([0.0, 0.0, 3.0], [0.499; 2]))), "a slit of a millimetre");
}

/// With walls that reflect 60 %, the light of all bounces is what path tracing without a portal finds: by final gather with a
/// portal and without, by counting and by paths with one. (Counting without one meets next to nothing.)
#[test]
fn interreflection_is_the_same_with_a_portal() {
    let mut family = Family::new("portal, interreflection");
    let mut case = cases().swap_remove(0);
    case.xml = case.xml.replace(r#"name="reflectance" value="0""#, r#"name="reflectance" value="0.6""#);
    let (plain, aimed) = (with(&case, ""), with(&case, &portal([0.0, 0.0, 3.0], [0.5; 2])));
    let patient = |method, number| plain.measure::<1>(settings(method, seed(number)), 4_000_000, 32, 1 << 18);
    let control = patient(Method::Path, 380);
    for (name, lab, method, number) in [
        ("gathered without", &plain, GATHER, 381),
        ("gathered through it", &aimed, GATHER, 382),
        ("counted through it", &aimed, Method::Bins, 384),
        ("paths through it", &aimed, Method::Path, 385),
    ] {
        let outcome = if number == 381 { patient(method, number) } else { measure(lab, method, number) };
        for (meter, (a, b)) in outcome.cells.iter().zip(&control.cells).enumerate() {
            let bias = a.bias_bound(0, 0.99);
            let test = welch_test(&a.value[0], &b.value[0]).expect("two sets of passes");
            let (x, y) = (a.value[0].mean().expect("passes"), b.value[0].mean().expect("passes"));
            assert!(bias < 0.01 * x, "{name}: a bias of up to {bias} of {x}");
            // The bias bound moves the difference towards nothing, never beyond.
            let p_value = if (x - y).abs() <= bias { 1.0 } else { test.p_value };
            family.compare(format!("{name} {meter}"), p_value, format!("{x} and {y} by paths, bias up to {bias}"));
        }
    }
    family.decide();
}

/// What a portal is worth where it is right: the standard error of the counted meters at equal photons, at most a third.
#[test]
fn a_portal_takes_most_of_the_noise() {
    let case = &cases()[0];
    let error = |outcome: Outcome<1>| -> f64 {
        let squares = outcome.cells.iter().map(|cell| cell.value[0].std_error().expect("passes").powi(2));
        squares.sum::<f64>().sqrt()
    };
    for (method, number) in [(Method::Bins, 390), (GATHER, 392)] {
        let without = error(measure(&with(case, ""), method, number));
        let aimed = error(measure(&with(case, &portal([0.0, 0.0, 3.0], [0.5; 2])), method, number + 1));
        println!("{}: standard error {without:.4} without, {aimed:.4} through a portal", method.name());
        assert!(aimed < without / 3.0, "{}: {without} without, {aimed} through a portal", method.name());
    }
}
