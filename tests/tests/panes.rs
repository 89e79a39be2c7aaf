//! Thin panes: light that they let through is direct light, whichever way it is found.

use photonlab_measure::welch_test;
use photonlab_readout::{CellResult, Method};
use photonlab_reference::catalogue::{ALL, Case};
use photonlab_tests::{Family, Lab, seed, settings};
use photonlab_trace::Limits;

const GATHER: Method = Method::FinalGather { radius: None };

fn cases(entry: &str, wanted: impl Fn(&str) -> bool) -> Vec<Case> {
    let entry = ALL.iter().find(|found| found.id == entry).expect("an entry of the catalogue");
    (entry.cases)().into_iter().filter(|case| wanted(&case.name)).collect()
}

/// Parallel light through a pane reads what Fresnel's formulae leave of it, to rounding: it is drawn, not found by chance.
#[test]
fn parallel_light_through_a_pane_is_read_without_noise() {
    let cases = cases("E1", |name| name.ends_with("degrees, thin pane"));
    assert_eq!(cases.len(), 9);
    for case in cases {
        let read = Lab::new(&case.xml).measure::<1>(settings(GATHER, seed(1300)), 20_000, 4, 64);
        let (read, truth) = (read.cells[0].value[0].mean().expect("a pass"), case.expected[0].value[0]);
        assert!((read / truth - 1.0).abs() < 1e-9, "{}: {read}, {truth}", case.name);
    }
}

/// A sky through a glazed roof opening: with the same noise as without the glass.
#[test]
fn a_sky_is_read_through_glass() {
    let mut family = Family::new("glazed opening");
    for (number, case) in cases("I4", |name| name.ends_with("Uniform, glazed")).iter().enumerate() {
        for (way, method) in [GATHER, Method::Path].into_iter().enumerate() {
            let number = seed(1310 + 2 * number as u32 + way as u32);
            let outcome = Lab::new(&case.xml).measure::<1>(settings(method, number), 100_000, 32, 1 << 15);
            for (cell, answer) in outcome.cells.iter().zip(&case.expected) {
                family.reading(format!("{} {}", method.name(), answer.sensor), cell, 0, answer.value[0]);
                let width = cell.value[0].half_width(0.95).expect("passes") / answer.value[0];
                assert!(width < 0.01, "{}: {width}", answer.sensor);
            }
        }
    }
    family.decide();
}

/// A lamp without extent close above a meter, of one square metre at the origin, with `between` in its light.
fn below_a_lamp(between: &str, height: f64, rest: &str) -> Lab {
    Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="0" y="0" z="0.3"/>
        <rgb name="intensity" value="1"/></emitter>
        <shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="{height}"/></transform>
        {between}</shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.5"/></transform><bsdf type="diffuse">
        <rgb name="reflectance" value="0"/></bsdf><sensor type="irradiancemeter" id="below"/></shape>{rest}</scene>"#
    ))
}

const MASK: &str = r#"<bsdf type="mask"><float name="opacity" value="0.6"/><bsdf type="diffuse"/></bsdf>"#;
const PANE: &str = r#"<bsdf type="thindielectric"/>"#;

fn alike(family: &mut Family, what: &str, one: &CellResult<1>, other: &CellResult<1>) {
    let test = welch_test(&one.value[0], &other.value[0]).expect("two sets of passes");
    let means = [one, other].map(|cell| (cell.value[0].mean(), cell.value[0].std_error()));
    family.compare(what, test.p_value, format!("{means:?}"));
}

/// Points of the meter and rays from the lamp share the work, and both see it through what is between. Under a mask the answer is
/// the solid angle of the square; under a pane, photons counted.
#[test]
fn a_near_lamp_is_read_through_a_mask_and_a_pane() {
    let mut family = Family::new("near lamp behind glass");
    let read = |lab: &Lab, method, number| {
        lab.measure::<1>(settings(method, seed(number)), 1_000_000, 32, 1 << 15).cells.swap_remove(0)
    };
    let solid_angle = 4.0 * (0.25_f64 / (0.3 * (0.09 + 0.5_f64).sqrt())).atan();
    let masked = below_a_lamp(MASK, 0.15, "");
    family.reading("masked", &read(&masked, GATHER, 1320), 0, 0.4 * solid_angle);
    let glazed = below_a_lamp(PANE, 0.15, "");
    alike(&mut family, "glazed", &read(&glazed, GATHER, 1321), &read(&glazed, Method::Bins, 1322));
    let fog = r#"<shape type="cube"><transform name="to_world"><scale value="0.06"/><translate x="0.1" z="0.08"/></transform>
        <bsdf type="null"/><medium type="homogeneous" name="interior"><float name="sigma_t" value="8"/>
        <rgb name="albedo" value="0.9"/></medium></shape>"#;
    let hazy = below_a_lamp(PANE, 0.2, fog);
    let counted = read(&hazy, Method::Bins, 1323);
    alike(&mut family, "glazed, above fog, gathered", &read(&hazy, GATHER, 1324), &counted);
    family.decide();
}

/// A pane ends a segment of every path that goes through it, drawn or traced.
#[test]
fn a_pane_counts_as_a_segment() {
    let lab = below_a_lamp(PANE, 0.15, "");
    for (most, lit) in [(1, false), (2, true)] {
        for method in [GATHER, Method::Bins] {
            let limits = Limits { max_segments: Some(most), ..Limits::default() };
            let limited = photonlab_readout::Settings { limits, ..settings(method, seed(1330)) };
            let read = lab.measure::<1>(limited, 20_000, 4, 256).cells[0].value[0].mean().expect("a pass");
            assert_eq!(read > 0.0, lit, "{most} segments, {}: {read}", method.name());
        }
    }
}
