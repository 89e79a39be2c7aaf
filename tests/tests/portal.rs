//! Portals: light of an environment through openings (catalogue I4), aimed through a portal or not.

use photonlab_measure::welch_test;
use photonlab_readout::{Method, Outcome};
use photonlab_reference::catalogue::Case;
use photonlab_reference::daylight::roof_opening::cases;
use photonlab_tests::{Family, Lab, seed, settings};

const PHOTONS: u64 = 400_000;
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
    lab.measure::<1>(settings(method, seed(number)), PHOTONS, 32, 1 << 12)
}

/// Does every meter hold the truth?
fn hold(family: &mut Family, what: &str, case: &Case, outcome: &Outcome<1>) {
    for (cell, answer) in outcome.cells.iter().zip(&case.expected) {
        family.reading(format!("{} {what} {}", case.name, answer.sensor), cell, 0, answer.value[0]);
    }
}

/// The opening of 1 x 1 m, 3 m above the floor, under an even and an overcast sky and with a pane, a millimetre above which the
/// portal then lies: four meters each, by final gather and by counting. Light that comes in beside the portal is counted too.
#[test]
fn meters_below_an_opening_read_the_sky_component() {
    let mut family = Family::new("portal, sky component");
    let cases = cases();
    for (index, height) in [(0, 3.0), (1, 3.0), (3, 3.001)] {
        let lab = with(&cases[index], &portal([0.0, 0.0, height], [0.5; 2]));
        for (method, number) in [(GATHER, 340), (Method::Bins, 350)] {
            let outcome = measure(&lab, method, number + index as u32);
            hold(&mut family, method.name(), &cases[index], &outcome);
        }
    }
    family.decide();
}

/// Portals that no one should place like this change nothing but the noise: over half of the opening, twice in the same place
/// and a third time below, the wrong way round, and in the middle of the room.
#[test]
fn portals_placed_badly_change_no_reading() {
    let mut family = Family::new("portal, placed badly");
    let case = &cases()[0];
    let opening = portal([0.0, 0.0, 3.0], [0.5; 2]);
    let below = portal([0.2, 0.0, 2.5], [0.7; 2]);
    let upside_down = opening.replace("<rotate x=\"1\" angle=\"180\"/>", "");
    for (index, (name, portals)) in [
        ("half", portal([0.25, 0.0, 3.0], [0.25, 0.5])),
        ("thrice", format!("{opening}{opening}{below}")),
        ("upside down", upside_down),
        ("in the room", portal([0.5, 0.0, 1.0], [1.0; 2])),
    ]
    .into_iter()
    .enumerate()
    {
        let lab = with(case, &portals);
        for (method, number) in [(GATHER, 360), (Method::Bins, 370)] {
            let outcome = measure(&lab, method, number + index as u32);
            hold(&mut family, &format!("{name}, {}", method.name()), case, &outcome);
        }
    }
    family.decide();
}

/// With walls that reflect 60 %, the light of all bounces is the same with a portal and without, by final gather and by
/// counting, and as path tracing without a portal finds it.
#[test]
fn interreflection_is_the_same_with_a_portal() {
    let mut family = Family::new("portal, interreflection");
    let mut case = cases().swap_remove(0);
    case.xml = case.xml.replace(r#"name="reflectance" value="0""#, r#"name="reflectance" value="0.6""#);
    let (plain, aimed) = (with(&case, ""), with(&case, &portal([0.0, 0.0, 3.0], [0.5; 2])));
    let control = measure(&plain, Method::Path, 380);
    for (name, lab, method, number) in [
        ("gathered without", &plain, GATHER, 381),
        ("gathered through it", &aimed, GATHER, 382),
        ("counted without", &plain, Method::Bins, 383),
        ("counted through it", &aimed, Method::Bins, 384),
        ("paths through it", &aimed, Method::Path, 385),
    ] {
        let outcome = measure(lab, method, number);
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
