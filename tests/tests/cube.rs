//! CUBE: final gather against the radiosity solution at the published benchmark's points.

use photonlab_readout::Method;
use photonlab_reference::cube::Cube;
use photonlab_tests::{Family, Lab, seed, settings};

/// Six meters; those of the published edge and corner points a little inside.
const METERS: [[f64; 2]; 6] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.998, 0.0], [0.998, 0.5], [0.998, 0.998]];
const FINAL_GATHER: Method = Method::FinalGather { radius: None };

fn truths() -> [f64; 6] {
    let solution = Cube::BENCHMARK.solve();
    METERS.map(|[u, v]| solution.luminance(u, v))
}

#[test]
fn all_six_meters_hold_the_truth_in_their_intervals() {
    let mut family = Family::new("cube, six meters");
    let lab = Lab::new(&Cube::BENCHMARK.xml(&METERS));
    let outcome = lab.measure::<1>(settings(FINAL_GATHER, seed(700)), 4_000_000, 64, 1 << 18);
    for ((meter, cell), truth) in METERS.iter().zip(&outcome.cells).zip(truths()) {
        family.reading(format!("{meter:?}"), cell, 0, truth);
    }
    family.decide();
}

/// Intervals of 99 % hold the truth at least 97 times in 100, over 100 seeds and all meters, where the error bars are an
/// order of magnitude wider. Readings of one seed share their photons, so the 600 are worth some hundreds: with 99 % each,
/// 18 misses would be six standard deviations away.
#[test]
fn intervals_of_99_percent_hold_in_at_least_97_of_100() {
    let lab = Lab::new(&Cube::BENCHMARK.xml(&METERS));
    let truths = truths();
    let (mut inside, mut all) = (0, 0);
    for number in 0..100 {
        let outcome = lab.measure::<1>(settings(FINAL_GATHER, seed(10_000 + number)), 20_000, 16, 1 << 10);
        for (cell, truth) in outcome.cells.iter().zip(truths) {
            let half = cell.half_width(0, 0.99).expect("sixteen passes");
            inside += u32::from((cell.value[0].mean().expect("light") - truth).abs() <= half);
            all += 1;
        }
    }
    println!("{inside} of {all} intervals of 99 % hold the truth");
    assert!(f64::from(inside) >= 0.97 * f64::from(all), "{inside} of {all} intervals of 99 % hold the truth");
}

/// The mean luminance over the faces is 2000/3 cd/m^2 by energy alone.
#[test]
fn the_mean_over_the_faces_is_that_of_the_energy_balance() {
    let mut family = Family::new("cube, mean");
    let meter = r#"<sensor type="irradiancemeter" id="mean"><film type="hdrfilm"><integer name="width" value="1"/>
        <integer name="height" value="1"/><rfilter type="box"/></film></sensor></shape>"#;
    let lab = Lab::new(&Cube::BENCHMARK.xml(&[]).replace("</shape>", meter));
    let outcome = lab.measure::<1>(settings(FINAL_GATHER, seed(702)), 2_400_000, 32, 1 << 19);
    let truth = Cube::BENCHMARK.mean_irradiance();
    assert!((truth * Cube::BENCHMARK.reflectance() / std::f64::consts::PI - 2000.0 / 3.0).abs() < 1e-9);
    family.reading("all faces", &outcome.cells[0], 0, truth);
    // Paths of random length: rho^1.5 / sqrt(photons) = 0.035 %, so the tolerance is six standard errors.
    let read = outcome.cells[0].value[0].mean().expect("light");
    assert!((read / truth - 1.0).abs() <= 0.002, "expected {truth}, read {read}");
    family.decide();
}
