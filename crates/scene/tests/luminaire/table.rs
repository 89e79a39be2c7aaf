//! Tables: what lies between their angles, and their integrals against closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use photonlab_scene::luminaire::{IntensityTable, Symmetry};

use super::samples::rotational;

/// Multiples of a step in degrees.
fn steps(count: usize, step: f64) -> Vec<f64> {
    (0..=count).map(|i| i as f64 * step).collect()
}

#[test]
fn even_light_is_4_pi_of_its_intensity() {
    for gamma in [vec![0.0, 180.0], steps(36, 5.0), steps(1800, 0.1), vec![0.0, 0.001, 17.0, 179.9999, 180.0]] {
        let table = rotational(&gamma, &vec![1000.0; gamma.len()]);
        assert!((table.flux() / (4000.0 * PI) - 1.0).abs() < 1e-13, "{}", table.flux());
    }
    let planes = steps(23, 15.0);
    let table = IntensityTable::new(Symmetry::None, &planes, &steps(18, 5.0), &[1000.0; 24 * 19]).expect("a table");
    assert!((table.flux() / (2000.0 * PI) - 1.0).abs() < 1e-13, "half of it with 0 to 90 degrees alone");
}

/// (1 - v) x + v x may round to more than x: choices by the brightest would exceed their bound.
#[test]
fn no_intensity_exceeds_the_brightest() {
    let mut rounded_up = 0;
    for i in 0..200 {
        let x = 30.886801709122555 + 0.37 * f64::from(i);
        let table = rotational(&[0.0, 45.0, 90.0], &[x, x, 0.5 * x]);
        for step in 0..200 {
            let gamma = 0.226 * f64::from(step);
            let v = gamma / 45.0;
            rounded_up += usize::from((1.0 - v) * x + v * x > x);
            assert!(table.intensity(13.7, gamma) <= table.brightest(), "{x} at {gamma}");
        }
    }
    assert!(rounded_up > 100, "the test meets what it is about: {rounded_up}");
}

/// In steps of h the cosine's broken line integrates to 2 pi ((1 - cos h) / (h tan h) + 1 - sin h / h): the hat function of
/// an inner angle weighs its sine by 2 (1 - cos h) / h, that of nadir is 1 - sin h / h, and the sines of all twice the angles
/// add up to 1 / tan h.
#[test]
fn a_cosine_in_steps_has_its_closed_form() {
    for count in [1, 2, 9, 18, 90, 900] {
        let step = 90.0 / count as f64;
        let gamma = steps(count, step);
        let cosines: Vec<f64> = gamma.iter().map(|g| 500.0 * g.to_radians().cos().max(0.0)).collect();
        let h = step.to_radians();
        let inner = if count > 1 { (1.0 - h.cos()) / (h * h.tan()) } else { 0.0 };
        let closed = 500.0 * TAU * (inner + 1.0 - h.sin() / h);
        let flux = rotational(&gamma, &cosines).flux();
        assert!((flux / closed - 1.0).abs() < 1e-11, "{count}: {flux} {closed}");
        // The chords lie below the arc, by h^2 / 12 of it.
        let deficit = 1.0 - flux / (500.0 * PI);
        assert!(deficit > 0.0 && deficit < h * h / 9.0, "{count}: {deficit}");
    }
}

/// From gamma = 0 to a quarter turn: the integral of gamma sin gamma is 1.
#[test]
fn a_ramp_has_its_closed_form() {
    let rising = rotational(&[0.0, 90.0], &[0.0, 100.0]);
    assert!((rising.flux() / (TAU * 100.0 / FRAC_PI_2) - 1.0).abs() < 1e-14);
    let falling = rotational(&[90.0, 180.0], &[100.0, 0.0]);
    assert!((falling.flux() / (TAU * 100.0 / FRAC_PI_2) - 1.0).abs() < 1e-14);
}

/// A plane twice as bright as the others adds half its neighbours' width each way.
#[test]
fn planes_share_the_turn() {
    let planes = [0.0, 40.0, 60.0, 300.0];
    let mut intensity = [[100.0; 2]; 4];
    intensity[1] = [200.0; 2];
    let table = IntensityTable::new(Symmetry::None, &planes, &[0.0, 180.0], intensity.as_flattened()).expect("a table");
    let expected = 4.0 * PI * 100.0 * (1.0 + 0.5 * 60.0 / 360.0);
    assert!((table.flux() / expected - 1.0).abs() < 1e-14);
}

#[test]
fn between_the_angles_it_is_bilinear() {
    let intensity = [[0.0, 10.0, 20.0], [100.0, 110.0, 120.0]];
    let table = IntensityTable::new(Symmetry::None, &[0.0, 180.0], &[10.0, 20.0, 60.0], intensity.as_flattened());
    let table = table.expect("a table");
    for (c, gamma, expected) in [
        (0.0, 10.0, 0.0),
        (180.0, 60.0, 120.0),
        (90.0, 15.0, 55.0),
        (270.0, 40.0, 65.0),
        (-90.0, 40.0, 65.0),
        (765.0, 20.0, 35.0),
        (90.0, 9.999, 0.0),
        (90.0, 60.001, 0.0),
    ] {
        let found = table.intensity(c, gamma);
        assert!((found - expected).abs() < 1e-9, "{c}, {gamma}: {found}");
    }
    assert_eq!(table.brightest(), 120.0);
}

#[test]
fn nadir_is_minus_z_and_c_runs_from_x_to_y() {
    // One value for each of six directions along the axes.
    let intensity = [[1.0, 10.0, 2.0], [1.0, 20.0, 2.0], [1.0, 30.0, 2.0], [1.0, 40.0, 2.0]];
    let planes = [0.0, 90.0, 180.0, 270.0];
    let table = IntensityTable::new(Symmetry::None, &planes, &[0.0, 90.0, 180.0], intensity.as_flattened());
    let table = table.expect("a table");
    for (direction, expected) in [
        (DVec3::NEG_Z, 1.0),
        (DVec3::Z, 2.0),
        (DVec3::X, 10.0),
        (DVec3::Y, 20.0),
        (DVec3::NEG_X, 30.0),
        (DVec3::NEG_Y, 40.0),
        (DVec3::new(0.6, 0.0, -0.8), 1.0 + 9.0 * 0.6f64.asin() / FRAC_PI_2),
    ] {
        assert!((table.intensity_along(direction) - expected).abs() < 1e-12, "{direction}");
    }
}

#[test]
fn the_debug_form_is_short_and_tells_tables_apart() {
    let one = rotational(&[0.0, 90.0], &[1.0, 2.0]);
    let other = rotational(&[0.0, 90.0], &[1.0, 2.0000000000000004]);
    assert_eq!(format!("{one:?}"), format!("{:?}", one.clone()));
    assert_ne!(format!("{one:?}"), format!("{other:?}"));
    assert!(format!("{one:?}").len() < 80);
}

#[test]
fn what_is_no_table_is_refused() {
    let new = |c: &[f64], gamma: &[f64], intensity: &[f64]| IntensityTable::new(Symmetry::None, c, gamma, intensity);
    let turn = [0.0, 180.0];
    for (result, fragment) in [
        (new(&turn, &[0.0], &[1.0; 2]), "no range of vertical angles"),
        (new(&turn, &[0.0, 200.0], &[1.0; 4]), "no range of vertical angles"),
        (new(&turn, &[-1.0, 90.0], &[1.0; 4]), "no range of vertical angles"),
        (new(&turn, &[90.0, 0.0], &[1.0; 4]), "do not rise"),
        (new(&turn, &[0.0, f64::NAN], &[1.0; 4]), "do not rise"),
        (new(&[180.0, 0.0], &[0.0, 90.0], &[1.0; 4]), "do not rise"),
        (new(&turn, &[0.0, 1e-5], &[1.0; 4]), "do not rise"),
        (new(&turn, &[0.0, 90.0], &[1.0; 3]), "3 intensities for 2 x 2 angles"),
        (new(&turn, &[0.0, 90.0], &[1.0, 1.0, -1.0, 1.0]), "an intensity of -1 cd"),
        (new(&turn, &[0.0, 90.0], &[1.0, 1.0, f64::NAN, 1.0]), "an intensity of NaN cd"),
        (new(&turn, &[0.0, 90.0], &[1.0, 1.0, f64::INFINITY, 1.0]), "an intensity of inf cd"),
        (new(&turn, &[0.0, 90.0], &[0.0; 4]), "emits nothing"),
        (new(&turn, &[0.0, 90.0], &[1e-320; 4]), "emits nothing"),
        (new(&[], &[0.0, 90.0], &[]), "no horizontal angles"),
    ] {
        let error = result.expect_err(fragment).to_string();
        assert!(error.contains(fragment) && error.contains("; "), "{error}");
    }
}
