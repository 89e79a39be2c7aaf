//! How lamps send out photons: their flux in all, and where it goes (catalogue C1).

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use photonlab_tests::{Family, Lab, seed};
use photonlab_trace::{Classes, Traced};

const PHOTONS: u64 = 200_000;

/// A black sphere of radius 1 around whatever emits.
fn in_black_sphere(lamp: &str) -> Lab {
    Lab::new(&format!(
        r#"<scene version="3.0.0">{lamp}
        <shape type="sphere" id="wall"><boolean name="flip_normals" value="true"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>"#
    ))
}

/// How many photons landed in each of 16 x 8 cells of equal expected flux: `height` maps z to (0, 1) uniformly.
fn cells(traced: &Traced<1>, height: impl Fn(f64) -> f64) -> Vec<u64> {
    let mut cells = vec![0; 128];
    for p in &traced.positions {
        let [x, y, z] = p.map(f64::from);
        let row = ((height(z) * 16.0) as usize).min(15);
        let column = (((y.atan2(x) / TAU + 0.5) * 8.0) as usize).min(7);
        cells[row * 8 + column] += 1;
    }
    cells
}

fn even(count: u64) -> Vec<f64> {
    vec![count as f64 / 128.0; 128]
}

fn same(what: &str, got: f64, expected: f64) {
    assert!((got / expected - 1.0).abs() < 1e-12, "{what}: expected {expected}, got {got}");
}

/// Intensity I in all directions: 4 pi I in all, evenly over the sphere.
#[test]
fn a_point_lamp_of_intensity_one_emits_four_pi_evenly() {
    let mut family = Family::new("point lamp");
    let lamp = r#"<emitter type="point"><rgb name="intensity" value="3"/></emitter>"#;
    let traced = in_black_sphere(lamp).trace::<1>(PHOTONS, seed(300), 0, Classes::ALL);
    same("flux", traced.ledger.emitted[0], 3.0 * 4.0 * PI);
    family.counts("directions", &cells(&traced, |z| 0.5 * (z + 1.0)), &even(PHOTONS));
    family.decide();
}

/// Radiance L of a Lambertian face: pi L A in all, half of it within 45 degrees of the normal.
#[test]
fn a_flat_lamp_emits_by_lamberts_law_from_its_front() {
    let mut family = Family::new("area lamp");
    let lamp = r#"<shape type="rectangle"><transform name="to_world"><scale x="0.0002" y="0.0001"/></transform>
        <emitter type="area"><rgb name="radiance" value="5e6"/></emitter></shape>"#;
    let traced = in_black_sphere(lamp).trace::<1>(PHOTONS, seed(301), 0, Classes::ALL);
    same("flux", traced.ledger.emitted[0], PI * 5e6 * 4.0 * 2e-8);
    assert!(traced.positions.iter().all(|p| p[2] > 0.0), "nothing leaves the back");
    // Flux within the angle theta goes as sin^2; the wall is 5000 lamp sizes away, the cells hundreds.
    family.counts("directions", &cells(&traced, |z| z * z), &even(PHOTONS));
    let within = traced.positions.iter().filter(|p| p[2] > std::f32::consts::FRAC_1_SQRT_2).count() as u64;
    family.proportion("within 45 degrees", within, PHOTONS, 0.5);
    family.decide();
}

/// A sphere of radius a and radiance L: 4 pi^2 a^2 L in all; on a concentric wall it is even.
#[test]
fn a_spherical_lamp_lights_a_concentric_wall_evenly() {
    let mut family = Family::new("sphere lamp");
    let lamp = r#"<shape type="sphere"><float name="radius" value="0.4"/>
        <emitter type="area"><rgb name="radiance" value="2"/></emitter></shape>"#;
    let traced = in_black_sphere(lamp).trace::<1>(PHOTONS, seed(302), 0, Classes::ALL);
    same("flux", traced.ledger.emitted[0], 4.0 * PI * PI * 0.16 * 2.0);
    family.counts("places", &cells(&traced, |z| 0.5 * (z + 1.0)), &even(PHOTONS));
    family.decide();
}

/// Irradiance E across the beam: E cos on a tilted floor, evenly.
#[test]
fn parallel_light_keeps_its_irradiance() {
    let mut family = Family::new("parallel light");
    let direction = DVec3::new(0.48, 0.36, -0.8);
    let lab = Lab::new(
        r#"<scene version="3.0.0"><emitter type="directional"><vector name="direction" x="0.48" y="0.36" z="-0.8"/>
        <rgb name="irradiance" value="7"/></emitter>
        <shape type="rectangle" id="floor"><transform name="to_world"><scale x="2" y="0.5"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>
        <shape type="rectangle" id="aside"><transform name="to_world"><rotate x="1" angle="90"/><translate y="3"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>"#,
    );
    let traced = lab.trace::<1>(PHOTONS, seed(303), 0, Classes::ALL);
    let on_floor = traced.positions.iter().filter(|p| p[2] == 0.0).map(|p| p.map(f64::from));
    let mut cells = vec![0; 128];
    let mut landed = 0;
    for [x, y, _] in on_floor {
        let (column, row) = ((x / 4.0 + 0.5) * 16.0, (y + 0.5) * 8.0);
        cells[(row as usize).min(7) * 16 + (column as usize).min(15)] += 1;
        landed += 1;
    }
    family.counts("evenness", &cells, &even(landed));
    let (area, cosine) = (4.0 * 1.0, -direction.z);
    let flux = 7.0 * area * cosine;
    family.proportion("flux", landed, PHOTONS, flux / traced.ledger.emitted[0]);
    family.decide();
}
