//! The extensions `paraboloid` and `lens`.

use glam::DVec3;
use photonlab_scene::{Geometry, Ray, Scene, Surface, World};

use super::scene;

const TURNED: &str =
    "<transform name='to_world'><scale value='2'/><rotate y='1' angle='90'/><translate x='1'/></transform>";

fn hits(scene: Scene, ray: Ray) -> Vec<(f64, DVec3)> {
    let world = World::new(scene);
    let (mut ray, mut from, mut found) = (ray, None, Vec::new());
    let mut flown = 0.0;
    while let Some(hit) = world.cast(&ray, from, f64::INFINITY) {
        flown += hit.distance;
        found.push((flown, hit.point.normal));
        (ray, from) = (Ray::new(hit.point.position, ray.direction), Some(hit.point.primitive));
    }
    found
}

#[test]
fn a_paraboloid_opens_towards_its_focus() {
    let scene = scene(&format!(
        "<shape type='paraboloid'><float name='focal_length' value='0.5'/><float name='aperture' value='1'/>{TURNED}</shape>"
    ));
    let Geometry::Paraboloid { frame, focal_length, rim } = scene.shapes[0].geometry else { panic!("no paraboloid") };
    assert_eq!((focal_length, rim), (1.0, 2.0));
    assert!((frame.origin - DVec3::X).length() < 1e-12 && (frame.axes.z_axis - DVec3::X).length() < 1e-12);
    // A ray along the axis, one metre from it, meets x = 1 + r^2 / (4 f), whose normal there halves the way to the focus.
    let found = hits(scene, Ray::new(DVec3::new(9.0, 0.0, 1.0), DVec3::NEG_X));
    assert_eq!(found.len(), 1);
    assert!((found[0].0 - (8.0 - 0.25)).abs() < 1e-12);
    let to_focus = (DVec3::new(2.0, 0.0, 0.0) - DVec3::new(1.25, 0.0, 1.0)).normalize();
    assert!((found[0].1 - (DVec3::X + to_focus).normalize()).length() < 1e-12);
}

#[test]
fn a_lens_is_a_closed_body_with_its_normals_outside() {
    let scene = scene(&format!(
        "<shape type='lens'><float name='radius1' value='2'/><float name='radius2' value='0'/><float name='thickness' \
         value='0.5'/><float name='aperture' value='1'/>{TURNED}</shape>"
    ));
    let sag = 4.0 - 12f64.sqrt();
    let axial = hits(scene.clone(), Ray::new(DVec3::new(-3.0, 0.0, 0.0), DVec3::X));
    assert_eq!(axial.len(), 2);
    assert!((axial[0].0 - 4.0).abs() < 1e-12 && (axial[0].1 + DVec3::X).length() < 1e-12);
    assert!((axial[1].0 - 5.0).abs() < 1e-12 && (axial[1].1 - DVec3::X).length() < 1e-12);
    // Through the rim, between the edge of the bulging face and the flat one.
    let x = 1.0 + 0.5 * (sag + 1.0);
    let across = hits(scene.clone(), Ray::new(DVec3::new(x, -5.0, 0.0), DVec3::Y));
    assert_eq!(across.len(), 2);
    assert!((across[0].0 - 3.0).abs() < 1e-12 && (across[0].1 + DVec3::Y).length() < 1e-12);
    assert!((across[1].0 - 7.0).abs() < 1e-12 && (across[1].1 - DVec3::Y).length() < 1e-12);
    let world = World::new(scene);
    let area: f64 = world.primitives.iter().map(|p| p.surface.area()).sum();
    let cap = 2.0 * std::f64::consts::PI * 4.0 * sag;
    let rest = std::f64::consts::PI * (4.0 + 4.0 * (1.0 - sag));
    assert!((area - cap - rest).abs() < 1e-12, "{area} {cap} {rest}");
    assert!(matches!(world.primitives[2].surface, Surface::Tube(_)));
}
