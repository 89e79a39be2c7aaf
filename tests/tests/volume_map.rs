//! The volume map: what collides in media, and what is read of it at points and along rays.

use std::f64::consts::PI;

use photonlab_gather::{Scattered, VolumeMap};
use photonlab_kdtree::SplitRule;
use photonlab_measure::{Replicates, welch_test};
use photonlab_photometry::{Colour, Palette};
use photonlab_readout::{MapFile, MapHeader, Method, scene_identity, trace_pass};
use photonlab_reference::medium::infinite::{self, InfiniteMedium};
use photonlab_sampling::{Optics, Sought};
use photonlab_tests::{Family, Lab, seed, settings};
use photonlab_trace::Classes;

const GATHER: Method = Method::FinalGather { radius: None };

/// Mean of a function of the distance to the origin over a ball around a point farther from it than the ball's radius.
fn mean_over_ball(distance: f64, radius: f64, of: impl Fn(f64) -> f64) -> f64 {
    let steps = 400;
    let shell = |i: i32| {
        let s = distance - radius + 2.0 * radius * (f64::from(i) + 0.5) / f64::from(steps);
        let cosine = (s * s + distance * distance - radius * radius) / (2.0 * s * distance);
        2.0 * PI * s * s * (1.0 - cosine) * of(s)
    };
    let sum: f64 = (0..steps).map(shell).sum();
    sum * 2.0 * radius / f64::from(steps) / (4.0 / 3.0 * PI * radius.powi(3))
}

/// Around a point lamp in an endless medium the flux that collides in a ball, over its volume and the extinction coefficient, is
/// the mean fluence rate there (catalogue F3).
#[test]
fn balls_hold_the_fluence_of_an_endless_medium() {
    let mut family = Family::new("fluence in balls");
    let medium = InfiniteMedium::new(0.9).expect("valid");
    let (extinction, radius) = (2.0, 0.2);
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><medium type="homogeneous" id="fog"><float name="sigma_t" value="{extinction}"/>
            <float name="albedo" value="0.9"/></medium>
        <shape type="sphere"><float name="radius" value="10"/><bsdf type="null"/><ref name="interior" id="fog"/></shape>
        <emitter type="point"><float name="intensity" value="{}"/><ref name="medium" id="fog"/></emitter></scene>"#,
        0.25 / PI
    ));
    let places = [0.3, 0.6, 1.1];
    let mut read = [Replicates::new(); 3];
    for pass in 0..24 {
        let traced = lab.trace::<1>(20_000, seed(980), pass, Classes::ALL).volume;
        let map = VolumeMap::build(traced.positions, traced.photons, SplitRule::Median).expect("finite");
        for (place, read) in places.into_iter().zip(&mut read) {
            // All of a photon's flux.
            let all = |_: &_| Some(Scattered { share: Colour::ONE, resolved: true });
            read.push(map.at([0.0, place as f32, 0.0], radius, all).radiance[0] / extinction);
        }
    }
    for (place, read) in places.into_iter().zip(&read) {
        // In free paths, of which a square metre holds the square of the extinction coefficient.
        let fluence = |r: f64| extinction * extinction * medium.fluence(extinction * r);
        family.mean(format!("{place} m"), read, mean_over_ball(place, radius, fluence));
    }
    family.decide();
}

/// Lines of sight that pass a point lamp in an endless medium show its radiance by every method, within the interval that each
/// gives (catalogue F3). Paths have finite errors there although the lamp has no extent.
#[test]
fn rays_past_a_lamp_in_an_endless_medium_show_its_radiance() {
    let mut family = Family::new("rays past a lamp in fog");
    let case = infinite::cases().into_iter().find(|case| case.name == "albedo 0.9").expect("a case of the catalogue");
    let lab = Lab::new(&case.xml);
    for (name, method, spp) in [
        ("by paths", Method::Path, 1 << 16),
        ("gathered", GATHER, 1 << 16),
        ("from the map, radius", Method::Radius { radius: None }, 1 << 10),
        ("from the map, nearest", Method::Nearest { k: Some(50) }, 1 << 10),
    ] {
        let read = lab.measure::<1>(settings(method, seed(981)), 400_000, 32, spp);
        for (cell, expected) in read.cells.iter().zip(&case.expected) {
            family.reading(format!("{name}, {}", expected.sensor), cell, 0, expected.value[0]);
        }
    }
    family.decide();
}

/// Parallel light that a glass ball focuses into haze: no ray from an eye finds it, the map of photons in the haze does. The wall
/// reads by final gather what counted photons say, and a line of sight through the focus shows the same by final gather,
/// which reads caustic photons alone along it, and by the map of all light.
#[test]
fn light_focused_into_haze_is_read_from_the_map() {
    let mut family = Family::new("focus in haze");
    let scene = |wall: &str, more: &str| {
        Lab::new(&format!(
            r#"<scene version="3.0.0"><medium type="homogeneous" id="haze"><float name="sigma_t" value="0.5"/>
                <float name="albedo" value="0.8"/></medium>
            <emitter type="spot"><transform name="to_world"><lookat origin="0, 0, 2" target="0, 0, 0" up="0, 1, 0"/></transform>
                <float name="intensity" value="10"/><float name="cutoff_angle" value="20"/><ref name="medium" id="haze"/></emitter>
            <shape type="sphere"><float name="radius" value="0.5"/><ref name="exterior" id="haze"/>
                <bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>
            <shape type="cube"><transform name="to_world"><scale value="3"/></transform><boolean name="flip_normals" value="true"/>
                <ref name="exterior" id="haze"/><bsdf type="diffuse"><float name="reflectance" value="0.3"/></bsdf>{wall}</shape>
            {more}</scene>"#
        ))
    };
    let wall = scene(r#"<sensor type="irradiancemeter"/>"#, "");
    let counted = wall.measure::<1>(settings(Method::Bins, seed(982)), 400_000, 32, 1 << 10);
    let gathered = wall.measure::<1>(settings(GATHER, seed(983)), 400_000, 32, 1 << 15);
    let test = welch_test(&gathered.cells[0].value[0], &counted.cells[0].value[0]).expect("two sets of passes");
    family.compare("walls", test.p_value, format!("{test:?}"));
    let across = r#"<sensor type="radiancemeter"><point name="origin" x="-2" y="0.1" z="-1"/><vector name="direction" x="1" y="0" z="0"/>
        <ref name="medium" id="haze"/></sensor>"#;
    let eye = scene("", across);
    let radius = Some(0.1);
    let gathered = eye.measure::<1>(settings(Method::FinalGather { radius }, seed(984)), 400_000, 32, 1 << 14);
    let from_map = eye.measure::<1>(settings(Method::Radius { radius }, seed(985)), 400_000, 32, 1 << 12);
    let test = welch_test(&gathered.cells[0].value[0], &from_map.cells[0].value[0]).expect("two sets of passes");
    family.compare("line of sight", test.p_value, format!("{test:?}"));
    family.decide();
}

/// A map file keeps photons in media to the bit.
#[test]
fn photons_in_media_survive_a_file() {
    let lab = Lab::new(
        r#"<scene version="3.0.0"><emitter type="constant"/><shape type="sphere"><bsdf type="null"/>
            <medium type="homogeneous" name="interior"><rgb name="albedo" value="0.9 0.5 0.1"/></medium></shape></scene>"#,
    );
    let optics = Optics::<3>::new(&lab.world, Palette::Channels);
    let settings = settings(GATHER, seed(986));
    let pass =
        trace_pass(&lab.world, &optics, &settings, (Sought::All, Classes::ALL), 0, 1000).expect("light that escapes");
    assert!(!pass.volume.photons.is_empty() && pass.volume.photons.len() == pass.volume.positions.len());
    let identity = scene_identity(&lab.world.scene);
    let header = MapHeader { channels: 3, identity, seed: 0, classes: Classes::ALL, limits: settings.limits };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("photons.map");
    let file = MapFile { header, passes: vec![pass] };
    file.save(&path).expect("written");
    let read = MapFile::<3>::load(&path).expect("read");
    assert_eq!(read.passes[0].volume, file.passes[0].volume);
    assert_eq!(read.passes[0].photons, file.passes[0].photons);
}
