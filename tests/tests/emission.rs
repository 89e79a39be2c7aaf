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
    count(traced.positions.iter().copied(), height)
}

/// The same of points of the unit sphere.
fn count(points: impl Iterator<Item = [f32; 3]>, height: impl Fn(f64) -> f64) -> Vec<u64> {
    let mut cells = vec![0; 128];
    for p in points {
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

/// Intensity I cos^n: 2 pi I / (n + 1) in all, the share of it beyond the cosine c is 1 - c^(n + 1).
#[test]
fn a_lamp_by_a_power_of_the_cosine_emits_by_that_power() {
    let mut family = Family::new("cosine lamp");
    for (number, n) in [1.0, 8.5].into_iter().enumerate() {
        let lamp = format!(
            "<emitter type=\"point\"><vector name=\"direction\" x=\"0\" y=\"0\" z=\"1\"/>\
             <float name=\"exponent\" value=\"{n}\"/><rgb name=\"intensity\" value=\"3\"/></emitter>"
        );
        let traced = in_black_sphere(&lamp).trace::<1>(PHOTONS, seed(310 + number as u32), 0, Classes::ALL);
        same("flux", traced.ledger.emitted[0], 3.0 * TAU / (n + 1.0));
        assert!(traced.positions.iter().all(|p| p[2] > -1e-6), "nothing goes back");
        let height = |z: f64| z.max(0.0).powf(n + 1.0);
        family.counts(format!("directions, exponent {n}"), &cells(&traced, height), &even(PHOTONS));
    }
    family.decide();
}

/// A spot falls from its beam to its cutoff linearly in the angle.
#[test]
fn a_spot_emits_by_its_falloff() {
    let mut family = Family::new("spot lamp");
    for (number, (beam, cutoff)) in [(20.0f64, 50.0f64), (5.0, 80.0)].into_iter().enumerate() {
        let lamp = format!(
            "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0 0 0\" target=\"0 0 1\" up=\"1 0 0\"/>\
             </transform><float name=\"cutoff_angle\" value=\"{cutoff}\"/><float name=\"beam_width\" value=\"{beam}\"/>\
             <rgb name=\"intensity\" value=\"3\"/></emitter>"
        );
        let (b, c) = (beam.to_radians(), cutoff.to_radians());
        // The integral of the falloff over the solid angle up to an angle, over 2 pi.
        let slope = |t: f64| (-(c - t) * t.cos() - t.sin()) / (c - b);
        let within = |t: f64| {
            if t < b { 1.0 - t.cos() } else { 1.0 - b.cos() + slope(t.min(c)) - slope(b) }
        };
        let traced = in_black_sphere(&lamp).trace::<1>(PHOTONS, seed(315 + number as u32), 0, Classes::ALL);
        same("flux", traced.ledger.emitted[0], 3.0 * TAU * within(c));
        let height = |z: f64| within(z.clamp(-1.0, 1.0).acos()) / within(c);
        family.counts(format!("directions, {beam} and {cutoff} degrees"), &cells(&traced, height), &even(PHOTONS));
    }
    family.decide();
}

/// Radiance L from everywhere: pi L on every element of a ball, under each angle in proportion to its cosine.
#[test]
fn an_even_environment_lights_a_ball_evenly() {
    let mut family = Family::new("even environment");
    let lab = Lab::new(
        r#"<scene version="3.0.0"><emitter type="constant"><rgb name="radiance" value="2"/></emitter>
        <shape type="sphere" id="ball"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>"#,
    );
    let traced = lab.trace::<1>(PHOTONS, seed(320), 0, Classes::ALL);
    let landed = traced.positions.len() as u64;
    family.counts("places", &cells(&traced, |z| 0.5 * (z + 1.0)), &even(landed));
    family.proportion("flux", landed, PHOTONS, PI * 2.0 * 4.0 * PI / traced.ledger.emitted[0]);
    let mut angles = vec![0; 32];
    for (p, photon) in traced.positions.iter().zip(&traced.photons) {
        let way = photon.direction.unpack();
        let cosine: f64 = -p.iter().zip(way).map(|(x, d)| f64::from(*x) * f64::from(d)).sum::<f64>();
        angles[((cosine * cosine * 32.0) as usize).min(31)] += 1;
    }
    family.counts("angles of arrival", &angles, &vec![landed as f64 / 32.0; 32]);
    family.decide();
}

/// The overcast sky, L (1 + 2 sin h) / 3: its irradiance on a floor, of which the elevation h brings the more the higher it is.
#[test]
fn an_overcast_sky_lights_a_floor_by_its_law() {
    let mut family = Family::new("overcast sky");
    let lab = Lab::new(
        r#"<scene version="3.0.0"><emitter type="sky"><string name="distribution" value="overcast"/>
        <rgb name="radiance" value="3"/></emitter>
        <shape type="rectangle" id="floor"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>"#,
    );
    let traced = lab.trace::<1>(PHOTONS, seed(321), 0, Classes::ALL);
    // Photons carry unequal flux where the sky's table is coarser than the sky: each is kept by its share of the most.
    let most = traced.photons.iter().map(|photon| photon.flux[0]).fold(0.0, f32::max);
    let mut random = photonlab_sampling::Stream::new(seed(322), photonlab_sampling::Purpose::Synthetic, 0, 0);
    let kept: Vec<[f32; 3]> = traced
        .photons
        .iter()
        .filter(|photon| random.next() < f64::from(photon.flux[0] / most))
        .map(|photon| photon.direction.unpack().map(|d| -d))
        .collect();
    let height = |z: f64| (0.5 * z * z + 2.0 / 3.0 * z.powi(3)) / (7.0 / 6.0);
    family.counts("directions", &count(kept.iter().copied(), height), &even(kept.len() as u64));
    // 7 pi / 9 of the zenith's radiance.
    let block = |part: &[photonlab_photometry::Photon<1>]| part.iter().map(|p| f64::from(p.flux[0])).sum::<f64>();
    let expected = 7.0 * PI / 9.0 * 3.0 * 4.0;
    let passes = (0..32).map(|pass| block(&lab.trace::<1>(4000, seed(323), pass, Classes::ALL).photons));
    family.mean("flux", &passes.collect(), expected);
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
