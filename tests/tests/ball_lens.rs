//! The caustic of a ball lens by final gather, from emission to image.

use std::f64::consts::PI;

use photonlab_readout::Method;
use photonlab_reference::{ball_lens::BallLens, catalogue::ALL};
use photonlab_tests::{Family, Lab, seed, settings};

const CELLS: usize = 128;
const HALF_WIDTH: f64 = 0.6;
const FLOOR_REFLECTANCE: f64 = 0.01;

/// Share of a pixel within a circle around the axis, by 16 x 16 points.
fn share_within(radius: f64, pixel: usize) -> f64 {
    let side = 2.0 * HALF_WIDTH / CELLS as f64;
    let at = |cell: usize, step: usize| -HALF_WIDTH + (cell as f64 + (step as f64 + 0.5) / 16.0) * side;
    let inside = (0..256).filter(|i| at(pixel % CELLS, i % 16).hypot(at(pixel / CELLS, i / 16)) <= radius);
    inside.count() as f64 / 256.0
}

/// The flux within 0.4 of the axis, the fold of the caustic included, to 0.3 %. The error of the photon count is 0.075 %;
/// what the floor sends back by way of the ball is bounded by the reference.
#[test]
fn the_caustics_flux_is_right_to_three_thousandths() {
    let (lens, radius) = (BallLens::BENCHMARK, 0.4);
    let lab = Lab::new(&lens.xml(FLOOR_REFLECTANCE, HALF_WIDTH, CELLS));
    let outcome = lab.render::<1>(settings(Method::FinalGather { radius: None }, seed(900)), 8_000_000, 32, 256);
    let area = (2.0 * HALF_WIDTH / CELLS as f64).powi(2);
    let flux: f64 = outcome
        .cells
        .iter()
        .enumerate()
        .map(|(i, pixel)| {
            let irradiance = pixel.value[0].mean().expect("a pass") * PI / FLOOR_REFLECTANCE;
            irradiance * area * share_within(radius, i)
        })
        .sum();
    let truth = lens.flux_within(radius);
    let returned = lens.floor_return_bound(radius, FLOOR_REFLECTANCE);
    println!("flux within {radius}: expected {truth:.6} (up to +{returned:.6}), read {flux:.6}, {:?}", outcome.radius);
    let tolerance = 0.003 * truth;
    assert!(flux >= truth - tolerance && flux <= truth + returned + tolerance, "expected {truth}, read {flux}");
}

/// Final gather counts the caustic in a meter's cell, so that neither an edge nor the fold costs it anything: discs before and
/// behind the focus read their flux, and nothing of it is in doubt.
#[test]
fn a_meter_in_the_caustic_counts_its_photons() {
    let mut family = Family::new("ball lens, flux on discs");
    let entry = ALL.iter().find(|entry| entry.id == "E2").expect("the ball lens in parallel light");
    for (number, case) in (entry.cases)().iter().enumerate() {
        let method = Method::FinalGather { radius: None };
        let outcome = Lab::new(&case.xml).measure::<1>(settings(method, seed(910 + number as u32)), 400_000, 16, 16);
        for (cell, answer) in outcome.cells.iter().zip(&case.expected) {
            let (read, truth) = (cell.value[0].mean().expect("a pass"), answer.value[0]);
            let known = read.clamp(truth - answer.uncertainty, truth + answer.uncertainty);
            family.reading(&case.name, cell, 0, known);
            assert_eq!(cell.lasting_bias_within(0, 3.0), 0.0, "{}: photons counted are not blurred", case.name);
        }
    }
    family.decide();
}
