//! The irradiance cache: what it tells of places between is right within its interval, and only what lies on one surface.

use std::f64::consts::PI;

use photonlab_readout::{Aids, Method, Settings};
use photonlab_reference::cube::Cube;
use photonlab_tests::{Family, Lab, seed, settings};

const PIXELS: u32 = 24;

fn cached(number: u32) -> Settings {
    let plain = settings(Method::FinalGather { radius: None }, seed(number));
    Settings { aids: Aids { cache: true, ..Aids::default() }, gather_rays: 64, ..plain }
}

/// A picture of one face of CUBE: along an edge into the corner, and along the middle.
#[test]
fn a_face_of_cube_is_read_right_from_the_middle_to_the_corner() {
    let mut family = Family::new("cached cube");
    let camera = format!(
        r#"<sensor type="perspective"><float name="fov" value="90"/>
        <transform name="to_world"><lookat origin="0 0 0" target="5 0 0" up="0 0 1"/></transform><film type="hdrfilm">
        <integer name="width" value="{PIXELS}"/><integer name="height" value="{PIXELS}"/><rfilter type="box"/></film></sensor></scene>"#
    );
    let lab = Lab::new(&Cube::BENCHMARK.xml(&[]).replace("</scene>", &camera));
    let outcome = lab.render::<1>(cached(1900), 1_600_000, 16, 128);
    let solution = Cube::BENCHMARK.solve();
    let place = |pixel: u32, share: f64| 2.0 * (f64::from(pixel) + share) / f64::from(PIXELS) - 1.0;
    for [column, row] in [[0, 0], [0, 1], [0, 4], [0, 12], [1, 1], [3, 3], [7, 12], [12, 12]] {
        let shares = [0.1, 0.3, 0.5, 0.7, 0.9];
        let points = shares.iter().flat_map(|&x| shares.map(|y| (place(column, x), place(row, y))));
        let truth = points.map(|(u, v)| solution.luminance(u, v)).sum::<f64>() / 25.0;
        let cell = &outcome.cells[(row * PIXELS + column) as usize];
        assert!(cell.half_width(0, 0.99).expect("light") < 0.08 * truth, "it says something: {column} {row}");
        family.reading(format!("{column} {row}"), cell, 0, truth);
    }
    family.decide();
}

/// A closed box whose faces shine and reflect: each ray around meets a lamp, and lamps are drawn as well.
#[test]
fn lamps_that_rays_meet_count_once() {
    let mut family = Family::new("cached furnace");
    let lab = Lab::new(
        r#"<scene version="3.0.0"><shape type="cube"><boolean name="flip_normals" value="true"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
        <emitter type="area"><rgb name="radiance" value="1"/></emitter>
        <sensor type="irradiancemeter"><film type="hdrfilm"><integer name="width" value="2"/>
        <integer name="height" value="2"/><rfilter type="box"/></film></sensor></shape></scene>"#,
    );
    let outcome = lab.measure::<1>(cached(1901), 400_000, 16, 1 << 12);
    for (number, cell) in outcome.cells.iter().enumerate() {
        let half = cell.half_width(0, 0.99).expect("light");
        assert!(half < 0.02 * 2.0 * PI, "it says something: {half}");
        family.reading(number, cell, 0, 2.0 * PI);
    }
    // Faces of a box are drawn alone; an environment shares its draws with rays that find it. White walls hide none of its light.
    let wall = |place: &str| {
        format!(
            r#"<shape type="rectangle"><transform name="to_world">{place}</transform><bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf>
            <sensor type="irradiancemeter"/></shape>"#
        )
    };
    let corner = [wall(r#"<translate x="1"/>"#), wall(r#"<rotate y="1" angle="90"/><translate z="1"/>"#)].concat();
    let open = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="constant"><rgb name="radiance" value="1"/></emitter>{corner}</scene>"#
    ));
    for (number, cell) in open.measure::<1>(cached(1904), 400_000, 16, 1 << 12).cells.iter().enumerate() {
        let half = cell.half_width(0, 0.99).expect("light");
        assert!(half < 0.02 * PI, "it says something: {half}");
        family.reading(format!("open corner {number}"), cell, 0, PI);
    }
    family.decide();
}

/// A table, a book on it, a thin wall and a ball in a room, lit from one side, against path tracing.
#[test]
fn steps_shelves_and_thin_walls_do_not_mix() {
    let mut family = Family::new("cached room");
    let meter = |name: &str, size: f64, place: &str| {
        format!(
            r#"<shape type="rectangle"><transform name="to_world"><scale value="{size}"/>{place}</transform>
            <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf><sensor type="irradiancemeter" id="{name}">
            <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/><rfilter type="box"/></film>
            </sensor></shape>"#
        )
    };
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="-1.5" y="0" z="2.2"/></emitter>
        <bsdf type="diffuse" id="white"><rgb name="reflectance" value="0.7"/></bsdf>
        <shape type="cube"><transform name="to_world"><scale x="2" y="2" z="1.3"/><translate z="1.3"/></transform>
        <boolean name="flip_normals" value="true"/><ref id="white"/></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="0.4" y="0.6"/><translate x="0.6" z="0.695"/></transform>
        <bsdf type="twosided"><ref id="white"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="1.2" y="1.5"/><rotate y="1" angle="90"/>
        <translate x="-0.2" z="1.2"/></transform><bsdf type="twosided"><ref id="white"/></bsdf></shape>
        {}{}{}{}</scene>"#,
        meter("table", 0.3, r#"<translate x="0.6" z="0.7"/>"#),
        meter("book", 0.08, r#"<translate x="0.6" y="0.1" z="0.72"/>"#),
        meter("floor", 0.3, r#"<translate x="0.6" z="0.001"/>"#),
        meter("back", 0.3, r#"<rotate y="1" angle="90"/><translate x="-0.199" z="1.0"/>"#)
    ));
    let finer = Settings { gather_rays: 128, ..cached(1902) };
    let found = lab.measure::<1>(finer, 3_200_000, 16, 1 << 9);
    let control = lab.measure::<1>(settings(Method::Path, seed(1903)), 0, 16, 1 << 16);
    for (meter, name) in ["table", "book", "floor", "back"].into_iter().enumerate() {
        for corner in [0, 15] {
            let [told, by_paths] = [&found, &control].map(|outcome| &outcome.cells[16 * meter + corner]);
            family.beside_control(format!("{name} {corner}"), told, by_paths, 0.3);
        }
    }
    family.decide();
}

/// A wall that stands on a floor: what the bright side's sites say is not for the dark side, though both are one plane.
#[test]
fn a_wall_on_a_floor_parts_its_light() {
    let mut family = Family::new("cached floor with a wall");
    let lab = Lab::new(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="-1" y="0" z="0.7"/></emitter>
        <bsdf type="diffuse" id="white"><rgb name="reflectance" value="0.5"/></bsdf>
        <shape type="cube"><transform name="to_world"><scale x="2" y="2" z="1.3"/><translate z="1.3"/></transform>
        <boolean name="flip_normals" value="true"/><ref id="white"/></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="0.9" y="1.8"/><rotate y="1" angle="90"/>
        <translate z="0.9"/></transform><bsdf type="twosided"><ref id="white"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="0.8" y="0.5"/><translate z="0.001"/></transform>
        <ref id="white"/><sensor type="irradiancemeter"><film type="hdrfilm"><integer name="width" value="16"/>
        <integer name="height" value="1"/><rfilter type="box"/></film></sensor></shape></scene>"#,
    );
    let finer = Settings { gather_rays: 128, ..cached(1905) };
    let found = lab.measure::<1>(finer, 3_200_000, 16, 1 << 9);
    let control = lab.measure::<1>(settings(Method::Path, seed(1906)), 0, 16, 1 << 16);
    for number in [0, 6, 7, 8, 9, 15] {
        let [told, by_paths] = [&found, &control].map(|outcome| &outcome.cells[number]);
        family.beside_control(number, told, by_paths, 0.2);
    }
    family.decide();
}
