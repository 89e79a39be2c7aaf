//! Lamps and optics of every shape against closed forms.

use std::f64::consts::PI;

use photonlab_photometry::PathClass;
use photonlab_readout::Method;
use photonlab_reference::{paraboloid::Paraboloid, square_lamp::RectangularLamp};
use photonlab_tests::{Family, Lab, icosphere, seed, settings};
use photonlab_trace::Classes;

const BLACK: &str = r#"<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>"#;

/// A disc of radius R lights a point of its axis with pi L R^2 / (R^2 + h^2), and of its flux the share (X - sqrt(X^2 - 4)) / 2
/// goes to an equal disc, X = 2 + h^2 / R^2 (catalogue C3; Howell, configuration factor C-41).
#[test]
fn a_disc_lights_its_axis_and_its_like() {
    let mut family = Family::new("disc lamp");
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><shape type="disk"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/>
        <translate z="0.4"/></transform><emitter type="area"><rgb name="radiance" value="3"/></emitter></shape>
        <shape type="disk" id="point"><transform name="to_world"><scale value="1e-4"/></transform>{BLACK}
        <sensor type="irradiancemeter"/></shape></scene>"#
    ));
    let read = lab.measure::<1>(settings(Method::Path, seed(1160)), 32, 32, 1 << 17);
    family.mean("on the axis", &read.cells[0].value[0], PI * 3.0 * 0.25 / (0.25 + 0.16));
    for height in [0.1, 0.5, 2.0f64] {
        let lab = Lab::new(&format!(
            r#"<scene version="3.0.0"><shape type="disk"><transform name="to_world"><scale x="0.5" y="0.5"/>
            <rotate x="1" angle="180"/><translate z="{height}"/></transform>
            <emitter type="area"><rgb name="radiance" value="3"/></emitter></shape>
            <shape type="disk"><transform name="to_world"><scale value="0.5"/></transform>{BLACK}</shape></scene>"#
        ));
        let photons = 400_000;
        let traced = lab.trace::<1>(photons, seed(1161), 0, Classes::ALL);
        assert!((traced.ledger.emitted[0] / (PI * PI * 0.25 * 3.0) - 1.0).abs() < 1e-12);
        let x = 2.0 + (height / 0.5).powi(2);
        family.proportion(
            format!("height {height}"),
            traced.photons.len() as u64,
            photons,
            0.5 * (x - (x * x - 4.0).sqrt()),
        );
    }
    family.decide();
}

/// A rectangle as four triangles of unlike areas shines as a rectangle does.
#[test]
fn unlike_triangles_shine_as_one_lamp() {
    let mut family = Family::new("mesh lamp");
    let strip = "v -0.5 -0.5 1\nv -0.5 0.5 1\nv -0.3 -0.5 1\nv -0.3 0.5 1\nv 0.5 -0.5 1\nv 0.5 0.5 1\n\
        f 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 6 5\n";
    let meter = |x: f64, y: f64| {
        format!(
            r#"<shape type="rectangle"><transform name="to_world"><scale value="0.05"/><translate x="{x}" y="{y}"/></transform>
            {BLACK}<sensor type="irradiancemeter"/></shape>"#
        )
    };
    let places = [(0.0, 0.0), (-0.6, 0.1), (0.6, 0.1), (0.2, -0.7)];
    let meters: String = places.iter().map(|&(x, y)| meter(x, y)).collect();
    let lamp = r#"<shape type="obj"><string name="filename" value="strip.obj"/><emitter type="area">
        <rgb name="radiance" value="10"/></emitter></shape>"#;
    let lab = Lab::beside("strip.obj", strip, &format!("{lamp}{meters}"));
    for (name, method, photons, points) in
        [("counted", Method::Bins, 4_000_000, 32), ("by paths", Method::Path, 32, 1 << 17)]
    {
        let read = lab.measure::<1>(settings(method, seed(1165)), photons, 32, points);
        for (&(x, y), cell) in places.iter().zip(&read.cells) {
            let truth = RectangularLamp::SQUARE.mean_irradiance([x - 0.05, y - 0.05], [x + 0.05, y + 0.05]);
            family.mean(format!("{name} at {x}, {y}"), &cell.value[0], truth);
        }
    }
    family.decide();
}

/// A lamp in the focus of a paraboloid: parallel light, as much within a circle as the closed form says (catalogue E3).
#[test]
fn a_lamp_in_the_focus_of_a_paraboloid_makes_a_parallel_beam() {
    let mut family = Family::new("paraboloid");
    let mirror = Paraboloid::new(0.5, 4.0 * PI).expect("in range");
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><rgb name="intensity" value="1"/></emitter>
        <shape type="paraboloid"><float name="focal_length" value="0.5"/><float name="aperture" value="1.2"/>
        <transform name="to_world"><translate z="-0.5"/></transform>
        <bsdf type="conductor"><string name="material" value="none"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate x="1" angle="180"/><translate z="3"/>
        </transform>{BLACK}</shape></scene>"#
    ));
    let photons = 400_000;
    let traced = lab.trace::<1>(photons, seed(1170), 0, Classes::ALL);
    let beam: Vec<f64> = traced
        .photons
        .iter()
        .zip(&traced.positions)
        .filter(|(photon, _)| photon.class == PathClass::Caustic)
        .map(|(photon, p)| {
            let [x, y, z] = photon.direction.unpack();
            assert!(z > 0.0 && x.hypot(y) < 1e-4, "along the axis but for the packing: {x} {y} {z}");
            f64::from(p[0]).hypot(f64::from(p[1]))
        })
        .collect();
    assert!(beam.iter().all(|&r| r < 1.2 + 1e-6), "nothing beyond the rim");
    for radius in [0.2, 0.5, 1.0, 1.3] {
        let inside = beam.iter().filter(|&&r| r < radius).count() as u64;
        let share = mirror.flux_within(f64::min(radius, 1.2)) / (4.0 * PI);
        family.proportion(format!("within {radius}"), inside, photons, share);
    }
    family.decide();
}

/// Parallel light along the axis of a thick lens meets at its back focus (lensmaker's equation with thickness): from a narrow
/// pupil all within the blur of spherical aberration, which goes with the cube of the pupil; both ways round.
#[test]
fn lenses_bring_parallel_light_to_their_back_focus() {
    for (index, radii, thickness) in
        [(1.5f64, [0.8f64, -1.2], 0.3f64), (1.7, [1.0, 0.0], 0.2), (1.5, [0.5, 0.9], 0.15), (1.5, [0.0, -1.0], 0.4)]
    {
        let power = |radius: f64, from: f64, to: f64| if radius == 0.0 { 0.0 } else { (to - from) / radius };
        let [first, second] = [power(radii[0], 1.0, index), power(radii[1], index, 1.0)];
        let total = first + second - first * second * thickness / index;
        let back = (1.0 - first * thickness / index) / total;
        for pupil in [0.02, 0.04f64] {
            let lab = Lab::new(&format!(
                r#"<scene version="3.0.0"><emitter type="directional"><vector name="direction" x="0" y="0" z="1"/>
                <rgb name="irradiance" value="1"/></emitter>
                <shape type="lens"><float name="radius1" value="{}"/><float name="radius2" value="{}"/>
                <float name="thickness" value="{thickness}"/><float name="aperture" value="{pupil}"/>
                <bsdf type="dielectric"><float name="int_ior" value="{index}"/><float name="ext_ior" value="1"/></bsdf></shape>
                <shape type="disk"><transform name="to_world"><scale value="0.02"/><rotate x="1" angle="180"/>
                <translate z="{}"/></transform>{BLACK}</shape></scene>"#,
                radii[0],
                radii[1],
                thickness + back
            ));
            let photons = 20_000;
            let traced = lab.trace::<1>(photons, seed(1175), 0, Classes::ALL);
            let blur = 4.0 * pupil.powi(3);
            let through = traced.photons.iter().filter(|photon| photon.class == PathClass::Caustic).count() as f64;
            let sharp = traced
                .photons
                .iter()
                .zip(&traced.positions)
                .filter(|(photon, p)| {
                    photon.class == PathClass::Caustic && f64::from(p[0]).hypot(f64::from(p[1])) < blur
                })
                .count() as f64;
            println!("{radii:?} {pupil}: back focus {back}, {sharp} of {through}");
            // What is reflected twice inside goes elsewhere: (n - 1)^4 / (n + 1)^4, below half a per cent.
            assert!(
                through > 1000.0 && sharp > 0.99 * through,
                "{radii:?}: {sharp} of {through} within {blur} of the focus"
            );
        }
    }
}

/// A lens is closed and loses nothing: glass in a black room, all flux is accounted for and none is booked in the glass.
#[test]
fn a_lens_neither_leaks_nor_absorbs() {
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="0.1" y="0.2" z="-1.5"/></emitter>
        <shape type="lens" id="lens"><float name="radius1" value="1.5"/><float name="radius2" value="-0.9"/>
        <float name="thickness" value="1"/><float name="aperture" value="0.8"/>
        <bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>
        <shape type="sphere"><float name="radius" value="4"/><boolean name="flip_normals" value="true"/>{BLACK}</shape></scene>"#
    ));
    let ledger = lab.trace::<1>(300_000, seed(1180), 0, Classes::NONE).ledger;
    let (total, emitted) = (ledger.total(), ledger.emitted[0]);
    assert_eq!(ledger.surfaces[0].absorbed[0], 0.0);
    assert_eq!(total.escaped[0], 0.0);
    assert!(ledger.surfaces[0].incident[0] > 0.1 * emitted, "light meets it");
    assert!((total.accounted()[0] / emitted - 1.0).abs() < 1e-9);
    assert!(((total.absorbed[0] + total.cut_off[0]) / emitted - 1.0).abs() < 1e-9);
}

/// A closed mesh of 1280 triangles with albedo 0.9, smooth or not, keeps all light; its area tends to the sphere's by the
/// square of the edge.
#[test]
fn a_mesh_room_is_closed() {
    let room = |halvings: u32, smooth: bool| {
        let face = if smooth { "false" } else { "true" };
        Lab::beside(
            "room.obj",
            &icosphere(halvings, smooth),
            &format!(
                r#"<emitter type="point"><point name="position" x="0.3" y="0.1" z="-0.2"/></emitter>
                <shape type="obj"><string name="filename" value="room.obj"/><boolean name="flip_normals" value="true"/>
                <boolean name="face_normals" value="{face}"/>
                <bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf></shape>"#
            ),
        )
    };
    for smooth in [false, true] {
        let ledger = room(3, smooth).trace::<1>(200_000, seed(1185), 0, Classes::NONE).ledger;
        let total = ledger.total();
        assert_eq!(total.escaped[0], 0.0);
        assert!((total.accounted()[0] / ledger.emitted[0] - 1.0).abs() < 1e-9);
        assert!(ledger.surfaces[0].incident[0] > 9.0 * ledger.emitted[0], "light meets the wall ten times");
    }
    let missing = |halvings: u32| 1.0 - room(halvings, true).world.area_of(0) / (4.0 * PI);
    let errors = [2, 3, 4, 5].map(missing);
    assert!(errors[3] > 0.0 && errors[3] < 1e-3, "{errors:?}");
    assert!(errors.windows(2).all(|pair| (3.8..4.2).contains(&(pair[0] / pair[1]))), "{errors:?}");
}
