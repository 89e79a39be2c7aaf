//! Final gather's aids: guided rays and precomputed irradiance go to the same means.

use photonlab_readout::{Aids, Method, Settings};
use photonlab_reference::cube::Cube;
use photonlab_tests::{Family, Lab, seed, settings};

const PLAIN: Aids = Aids { cache: false, guide: false, precompute: false };
const BOTH: [(&str, Aids); 2] =
    [("guided", Aids { guide: true, ..PLAIN }), ("precomputed", Aids { precompute: true, ..PLAIN })];

fn aided(aids: Aids, number: u32) -> Settings {
    Settings { aids, ..settings(Method::FinalGather { radius: None }, seed(number)) }
}

/// CUBE's meters, where light comes from all around.
#[test]
fn cubes_meters_read_the_radiosity_solution() {
    let mut family = Family::new("aided cube");
    let cube = Cube::BENCHMARK;
    let lab = Lab::new(&cube.xml(&[[0.0, 0.0], [0.5, 0.5]]));
    let solution = cube.solve();
    for (number, (name, aids)) in BOTH.into_iter().enumerate() {
        let outcome = lab.measure::<1>(aided(aids, 1910 + number as u32), 800_000, 16, 1 << 14);
        for (cell, place) in outcome.cells.iter().zip([[0.0, 0.0], [0.5, 0.5]]) {
            let truth = solution.luminance(place[0], place[1]);
            let half = cell.half_width(0, 0.99).expect("light");
            println!("{name} {place:?}: {:?} +- {half} of {truth}", cell.value[0].mean());
            assert!(half < 0.03 * truth, "{name}: it says something: {half} of {truth}");
            family.reading(format!("{name} {place:?}"), cell, 0, truth);
        }
    }
    family.decide();
}

/// A room that is lit past the end of a wall, and a ball in it, against path tracing.
#[test]
fn a_room_lit_through_a_gap_reads_as_by_paths() {
    let mut family = Family::new("aided room");
    let meter = |name: &str, place: &str| {
        format!(
            r#"<shape type="rectangle"><transform name="to_world"><scale value="0.2"/>{place}</transform><ref id="white"/>
            <sensor type="irradiancemeter" id="{name}"/></shape>"#
        )
    };
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="-1.2" y="0.8" z="2"/></emitter>
        <bsdf type="diffuse" id="white"><rgb name="reflectance" value="0.6"/></bsdf>
        <shape type="cube"><transform name="to_world"><scale x="2" y="2" z="1.3"/><translate z="1.3"/></transform>
        <boolean name="flip_normals" value="true"/><ref id="white"/></shape>
        <shape type="cube"><transform name="to_world"><scale x="0.05" y="1.8" z="1.3"/><translate y="-0.2" z="1.3"/></transform>
        <ref id="white"/></shape>
        <shape type="sphere"><point name="center" x="0.8" y="1.2" z="0.4"/><float name="radius" value="0.3"/><ref id="white"/></shape>
        {}{}</scene>"#,
        meter("near", r#"<translate x="0.6" y="0.6" z="0.001"/>"#),
        meter("far", r#"<rotate y="1" angle="-90"/><translate x="1.999" y="-0.5" z="1"/>"#)
    ));
    let control = lab.measure::<1>(settings(Method::Path, seed(1914)), 0, 16, 1 << 20);
    for (number, (name, aids)) in BOTH.into_iter().enumerate() {
        let outcome = lab.measure::<1>(aided(aids, 1912 + number as u32), 3_200_000, 16, 1 << 15);
        for (cell, by_paths) in outcome.cells.iter().zip(&control.cells) {
            family.beside_control(name, cell, by_paths, 0.1);
        }
    }
    family.decide();
}
