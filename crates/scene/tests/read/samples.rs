//! The scenes that the project is judged by load as they are.

use std::path::PathBuf;

use glam::DVec3;
use photonlab_photometry::{Channels, Spectrum};
use photonlab_scene::read::read_scene;
use photonlab_scene::{Bsdf, Camera, Emitter, Film, Geometry, Meter, Receiver, Scene};

const NAMES: [&str; 6] = ["ball-lens", "ball-lens-lamp", "cornell-box", "cube", "integrating-sphere", "square-lamp"];

fn sample(name: &str, defines: &[(String, String)]) -> Scene {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../../experiments/scenes/{name}.xml"));
    read_scene(&path, defines).unwrap_or_else(|error| panic!("{error}"))
}

fn camera(scene: &Scene) -> &Camera {
    match &scene.sensors[0].receiver {
        Receiver::Camera(camera) => camera,
        Receiver::Meter(meter) => panic!("{meter:?} is no camera"),
    }
}

#[test]
fn every_sample_loads() {
    for name in NAMES {
        let scene = sample(name, &[]);
        assert!(scene.has_light() && !scene.sensors.is_empty(), "{name}");
        assert_eq!(scene.max_depth, None, "{name}");
        assert_eq!(scene.notes.len(), 2, "{name}: {:?}", scene.notes);
    }
}

#[test]
fn the_cornell_lamp_hangs_below_the_ceiling_and_shines_down() {
    let scene = sample("cornell-box", &[]);
    assert_eq!(scene.channels(), Channels::Rgb);
    assert_eq!(scene.shapes.len(), 8);
    let lamp = scene.shapes.iter().find(|shape| shape.id == "lamp").expect("a lamp");
    assert_eq!(lamp.radiance, Some(Spectrum::Rgb([18.387, 13.9873, 6.75357])));
    assert_eq!(lamp.bsdf, Bsdf::Diffuse { reflectance: Spectrum::Rgb([0.0; 3]) });
    let Geometry::Rectangle { to_world } = &lamp.geometry else { panic!("{:?}", lamp.geometry) };
    assert_eq!(to_world.translation, DVec3::new(0.0, 0.99, 0.01));
    assert_eq!(to_world.transform_vector3(DVec3::X), DVec3::new(0.23, 0.0, 0.0));
    assert_eq!(to_world.transform_vector3(DVec3::Y), DVec3::new(0.0, 0.0, 0.19));
    // Turned by a right angle, the normal points exactly down.
    assert_eq!(to_world.transform_vector3(DVec3::Z), DVec3::NEG_Y);
    let large = scene.shapes.iter().find(|shape| shape.id == "large-box").expect("a box");
    let Geometry::Cube { to_world } = &large.geometry else { panic!("{:?}", large.geometry) };
    assert_eq!(to_world.matrix3.z_axis, DVec3::new(0.0939491, 0.0, 0.28491));
    assert_eq!(to_world.translation, DVec3::new(-0.33, -0.4, -0.28));
}

#[test]
fn cameras_see_the_stated_field() {
    let scene = sample("ball-lens", &[]);
    let view = camera(&scene);
    assert_eq!(scene.sensors[0].film, Film { width: 128, height: 128 });
    assert!((view.tan_half_width - 1.5).abs() < 1e-8, "{}", view.tan_half_width);
    assert_eq!(view.tan_half_height, view.tan_half_width);
    assert_eq!((view.near_clip, view.far_clip), (0.0001, 100.0));
    // Looking down from 0.4 with +y up: +x, to the left of the image, is -x of the world.
    assert_eq!(view.to_world.translation, DVec3::new(0.0, 0.0, 0.4));
    assert_eq!(view.to_world.matrix3.z_axis, DVec3::NEG_Z);
    assert_eq!(view.to_world.matrix3.y_axis, DVec3::Y);
    assert_eq!(view.to_world.matrix3.x_axis, DVec3::NEG_X);
    let square = sample("square-lamp", &[]);
    let reach = camera(&square).tan_half_width * 0.95;
    assert!((reach - 1.5).abs() < 1e-7, "{reach}");
}

#[test]
fn the_cubes_meters_look_where_they_should() {
    let scene = sample("cube", &[]);
    assert_eq!(scene.channels(), Channels::Grey);
    assert!(scene.shapes[0].flip_normals);
    let [Emitter::Point { id, position, intensity, .. }] = &scene.emitters[..] else { panic!("{:?}", scene.emitters) };
    assert_eq!((id.as_str(), *position, intensity.rgb()), ("emitter-0", DVec3::ZERO, Some([50000.0; 3])));
    let targets = [
        ("A-face-centre", DVec3::new(5.0, 0.0, 0.0)),
        ("B", DVec3::new(5.0, 2.5, 0.0)),
        ("C", DVec3::new(5.0, 2.5, 2.5)),
        ("D-edge-middle", DVec3::new(5.0, 4.99, 0.0)),
        ("E", DVec3::new(5.0, 4.99, 2.5)),
        ("F-corner", DVec3::new(5.0, 4.99, 4.99)),
    ];
    assert_eq!(scene.sensors.len(), targets.len());
    for (sensor, (id, target)) in scene.sensors.iter().zip(targets) {
        assert_eq!((sensor.id.as_str(), sensor.film), (id, Film { width: 1, height: 1 }));
        let Receiver::Meter(Meter::Radiancemeter { origin, direction }) = &sensor.receiver else { panic!("{id}") };
        assert_eq!(*origin, DVec3::ZERO);
        assert!((*direction - target.normalize()).length() < 1e-15, "{id}: {direction}");
        assert!((direction.length() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_define_replaces_the_default() {
    let reflectance = |scene: &Scene| match &scene.shapes[0].bsdf {
        Bsdf::Diffuse { reflectance } => reflectance.rgb(),
        other => panic!("{other:?}"),
    };
    assert_eq!(reflectance(&sample("integrating-sphere", &[])), Some([0.8; 3]));
    let half = sample("integrating-sphere", &[("rho".to_owned(), "0.5".to_owned())]);
    assert_eq!(reflectance(&half), Some([0.5; 3]));
    let Receiver::Meter(meter) = &half.sensors[1].receiver else { panic!("{:?}", half.sensors[1]) };
    assert_eq!(*meter, Meter::Irradiancemeter { shape: 0 });
    assert_eq!(half.sensors[1].id, "wall-irradiance");
}
