//! Light in participating media: what no medium loses, what reaches a point through one, and what it sends back.

use std::f64::consts::PI;

use photonlab_measure::welch_test;
use photonlab_photometry::Response;
use photonlab_readout::{Method, Settings};
use photonlab_reference::medium::slab;
use photonlab_tests::{Family, Lab, seed, settings};
use photonlab_trace::{Classes, Limits};

const GATHER: Method = Method::FinalGather { radius: None };

/// A ball of a medium in light of radiance 1 from everywhere, with a meter below and rays through it.
fn furnace(boundary: &str, medium: &str) -> Lab {
    Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="constant"/>
        <shape type="sphere"><float name="radius" value="0.5"/>{boundary}
            <medium type="homogeneous" name="interior">{medium}</medium></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.4"/><translate z="-0.7"/></transform>
            <bsdf type="null"/><sensor type="irradiancemeter" id="below"/></shape>
        <sensor type="radiancemeter" id="middle"><point name="origin" x="0" y="0" z="3"/><vector name="direction" x="0" y="0" z="-1"/></sensor>
        </scene>"#
    ))
}

/// What loses no light is invisible where all light is even, whatever it does to directions, and whichever surface bounds it.
#[test]
fn a_lossless_medium_is_invisible_in_even_light() {
    let mut family = Family::new("white furnace, media");
    let hg = |g: f64| format!(r#"<phase type="hg"><float name="g" value="{g}"/></phase>"#);
    for (name, boundary, phase) in [
        ("even", r#"<bsdf type="null"/>"#, String::new()),
        ("forwards, coloured", r#"<bsdf type="null"/>"#, hg(0.8)),
        ("backwards, in glass", r#"<bsdf type="dielectric"/>"#, hg(-0.4)),
    ] {
        let extinction = r#"<rgb name="sigma_t" value="1 3 6"/><float name="albedo" value="1"/>"#;
        let lab = furnace(boundary, &format!("{extinction}{phase}"));
        let by_rays = lab.measure::<3>(settings(Method::Path, seed(970)), 1, 24, 8_000);
        let by_photons =
            lab.measure_as::<3>(Response::Radiometric, settings(Method::Bins, seed(971)), 400_000, 24, 1 << 10);
        for channel in [0, 2] {
            family.mean(format!("{name}, below"), &by_rays.cells[0].value[channel], PI);
            family.mean(format!("{name}, through"), &by_rays.cells[1].value[channel], 1.0);
            family.mean(format!("{name}, counted"), &by_photons.cells[0].value[channel], PI);
        }
    }
    family.decide();
}

/// A slab of a coloured medium between a lamp at infinity and a meter: what arrives unscattered is `exp(-sigma d)` and nothing
/// else, as the medium only absorbs; by rays it is exact, by photons it is counted. (Beer and Lambert; catalogue F1.)
#[test]
fn absorption_is_exponential_in_each_channel() {
    let mut family = Family::new("absorbing slab");
    let sigma = [0.2, 1.0, 3.0];
    let lab = Lab::new(
        r#"<scene version="3.0.0">
        <emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/></emitter>
        <shape type="cube"><transform name="to_world"><scale x="3" y="3" z="0.5"/></transform><bsdf type="null"/>
            <medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.2 1 3"/><float name="albedo" value="0"/></medium></shape>
        <shape type="rectangle"><transform name="to_world"><translate z="-1"/></transform>
            <bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf><sensor type="irradiancemeter"/></shape></scene>"#,
    );
    let by_rays = lab.measure::<3>(settings(GATHER, seed(972)), 1000, 16, 256);
    let by_photons =
        lab.measure_as::<3>(Response::Radiometric, settings(Method::Bins, seed(973)), 200_000, 16, 1 << 10);
    for (channel, sigma) in sigma.into_iter().enumerate() {
        let expected = f64::exp(-sigma);
        let read = by_rays.cells[0].value[channel].mean().unwrap_or(f64::NAN);
        assert!((read / expected - 1.0).abs() < 1e-9, "{sigma}: {read} for {expected}");
        family.mean(format!("counted, {sigma}/m"), &by_photons.cells[0].value[channel], expected);
    }
    family.decide();
}

/// A closed room full of coloured haze that scatters forwards, around a point lamp, with what else is given.
fn hazy_room(wall: &str, more: &str) -> Lab {
    Lab::new(&format!(
        r#"<scene version="3.0.0">
        <medium type="homogeneous" id="haze"><rgb name="sigma_t" value="0.4 0.8 1.6"/><float name="albedo" value="0.9"/>
            <phase type="hg"><float name="g" value="0.5"/></phase></medium>
        <emitter type="point"><point name="position" x="0.3" y="-0.2" z="0.4"/><ref name="medium" id="haze"/></emitter>
        <shape type="cube"><boolean name="flip_normals" value="true"/><ref name="exterior" id="haze"/>
            <bsdf type="diffuse"><float name="reflectance" value="0.6"/></bsdf>{wall}</shape>{more}</scene>"#
    ))
}

/// In a closed room full of haze every watt is absorbed by walls or by the haze; by rays, by maps and by counting the walls
/// read the same, which is what the photons left there; and a line of sight past the lamp shows the same by paths and by maps.
#[test]
fn every_method_reads_the_same_in_a_hazy_room() {
    let mut family = Family::new("hazy room");
    let lab = hazy_room(r#"<sensor type="irradiancemeter"/>"#, "");
    let counted = lab.measure::<3>(settings(Method::Bins, seed(974)), 800_000, 32, 1 << 10);
    for (name, method) in [("by paths", Method::Path), ("gathered", GATHER)] {
        let read = lab.measure::<3>(settings(method, seed(975)), 400_000, 32, 1 << 16);
        for channel in [0, 2] {
            let [read, walls] = [&read, &counted].map(|outcome| &outcome.cells[0].value[channel]);
            let test = welch_test(read, walls).expect("two sets of passes");
            family.compare(format!("{name}, channel {channel}"), test.p_value, format!("{test:?}"));
        }
    }
    let along = r#"<point name="origin" x="-0.5" y="0.2" z="0"/><vector name="direction" x="1" y="0.1" z="0.1"/>"#;
    let eye = hazy_room("", &format!(r#"<sensor type="radiancemeter">{along}<ref name="medium" id="haze"/></sensor>"#));
    let by_paths = eye.measure::<3>(settings(Method::Path, seed(977)), 0, 32, 1 << 16);
    let gathered = eye.measure::<3>(settings(GATHER, seed(978)), 400_000, 32, 1 << 16);
    for channel in [0, 2] {
        let [by_paths, gathered] = [&by_paths, &gathered].map(|outcome| &outcome.cells[0].value[channel]);
        let test = welch_test(by_paths, gathered).expect("two sets of passes");
        family.compare(format!("line of sight, channel {channel}"), test.p_value, format!("{test:?}"));
    }
    let ledger = lab.trace::<3>(100_000, seed(976), 0, Classes::NONE).ledger;
    let total = ledger.total();
    assert_eq!(total.escaped[0], 0.0, "the room is closed");
    let walls: f64 = ledger.surfaces.iter().map(|surface| surface.absorbed[0]).sum();
    assert!(walls < 0.95 * total.absorbed[0], "the haze takes its part");
    assert!((total.accounted()[0] / ledger.emitted[0] - 1.0).abs() < 1e-9);
    family.decide();
}

/// A slab that scatters forwards and absorbs, in light of radiance 1 from above: what it lets through, and what it sends back
/// straight up and at 60 degrees (catalogue F7). Scattering the wrong way or absorbing nothing cannot give these.
#[test]
fn a_forward_scattering_slab_parts_light_as_it_should() {
    let mut family = Family::new("forward slab");
    let wanted = "diffuse, thickness 1, albedo 0.9, g 0.75";
    let case = slab::cases().into_iter().find(|case| case.name == wanted).expect("a case of the catalogue");
    let lab = Lab::new(&case.xml);
    for (name, method) in [("by paths", Method::Path), ("gathered", GATHER)] {
        let read = lab.measure::<1>(settings(method, seed(979)), 100_000, 24, 1 << 15);
        for (cell, expected) in read.cells.iter().zip(&case.expected) {
            family.reading(format!("{name}, {}", expected.sensor), cell, 0, expected.value[0]);
        }
    }
    family.decide();
}

/// What a lamp two centimetres above a block of fog sends into a horizontal line of sight 8 cm below it, scattered once, against
/// quadrature over the line and the lamp. Mitsuba 3.9.1 reads 0.724 here, a third too little.
#[test]
fn a_lamp_just_above_fog_is_scattered_once() {
    const LAMP: f64 = 0.98;
    const HALF: f64 = 0.96;
    const EYE: f64 = 0.9;
    let mut family = Family::new("lamp above fog");
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0">
        <shape type="cube"><transform name="to_world"><scale value="{HALF}"/></transform><bsdf type="null"/>
            <medium type="homogeneous" name="interior"><float name="sigma_t" value="1"/><float name="albedo" value="0.9"/></medium></shape>
        <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><scale value="0.5"/><translate y="{LAMP}"/></transform>
            <bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf><emitter type="area"><float name="radiance" value="8"/></emitter></shape>
        <sensor type="radiancemeter"><point name="origin" x="0" y="{EYE}" z="3"/><vector name="direction" x="0" y="0" z="-1"/></sensor>
        </scene>"#
    ));
    let (steps, side) = (400, 160);
    let middle = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let mut expected = 0.0;
    for step in 0..steps {
        let z = HALF * (2.0 * middle(step, steps) - 1.0);
        let mut arriving = 0.0;
        for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
            let (x, along, up) = (middle(i, side) - 0.5, middle(j, side) - 0.5 - z, LAMP - EYE);
            let squared = x * x + along * along + up * up;
            let cosine = up / squared.sqrt();
            arriving += 8.0 * cosine / squared * f64::exp(-(HALF - EYE) / cosine) / (side * side) as f64;
        }
        expected += 0.9 * arriving / (4.0 * PI) * f64::exp(z - HALF) * 2.0 * HALF / steps as f64;
    }
    let once = Limits { max_segments: Some(2), ..Limits::default() };
    for (name, method) in [("by paths", Method::Path), ("gathered", GATHER)] {
        let settings = Settings { limits: once, ..settings(method, seed(1960)) };
        let read = lab.measure::<1>(settings, 20_000, 24, 1 << 14);
        family.mean(name, &read.cells[0].value[0], expected);
    }
    family.decide();
}
