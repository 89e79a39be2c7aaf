//! The integrating sphere (catalogue D1): transport and estimator together, with no geometric bias at all.

use photonlab_photometry::{Colour, PathClass};
use photonlab_readout::Method;
use photonlab_reference::integrating_sphere::IntegratingSphere;
use photonlab_tests::{Family, Lab, seed, settings};
use photonlab_trace::Classes;

const OFF_CENTRE: [f64; 3] = [0.3, -0.4, 0.35];
/// What a reading may differ by, whatever its error bar says.
const TOLERANCE: f64 = 0.003;
/// Reflectances and photons: paths of random length give the wall's irradiance a relative error of
/// `rho^1.5 / sqrt(photons)`, here at most 0.066 %, so that a right program misses the tolerance once in 10^5 sets of seeds.
const COUNTS: [(f64, u64); 4] = [(0.5, 300_000), (0.8, 1_200_000), (0.95, 2_000_000), (0.98, 2_200_000)];

fn sphere<const C: usize>(source: [f64; 3], reflectance: [f64; C]) -> (IntegratingSphere<C>, Lab) {
    let scene = IntegratingSphere::new(1.0, source, Colour::splat(1000.0), Colour(reflectance)).expect("in range");
    let lab = Lab::new(&scene.xml());
    (scene, lab)
}

/// Reads the wall's mean irradiance by final gather and compares every channel with the truth.
fn judge<const C: usize>(family: &mut Family, source: [f64; 3], reflectance: [f64; C], photons: u64, seed: u64) {
    let (scene, lab) = sphere(source, reflectance);
    let outcome = lab.measure::<C>(settings(Method::FinalGather { radius: None }, seed), photons, 64, 1 << 20);
    let cell = &outcome.cells[0];
    for channel in 0..C {
        let what = format!("rho {} from {source:?}", reflectance[channel]);
        let (truth, read) = (scene.mean_irradiance()[channel], cell.value[channel].mean().unwrap_or(f64::NAN));
        family.reading(&what, cell, channel, truth);
        let relative = read / truth - 1.0;
        assert!(relative.abs() <= TOLERANCE, "{what}: expected {truth}, read {read} ({:+.3} %)", 100.0 * relative);
    }
}

/// Total irradiance `Phi / (4 pi R^2 (1 - rho))`, wherever the lamp is.
#[test]
fn the_walls_irradiance_is_the_sum_of_all_bounces() {
    let mut family = Family::new("integrating sphere");
    for source in [[0.0; 3], OFF_CENTRE] {
        for (i, (rho, photons)) in COUNTS.into_iter().enumerate() {
            judge(&mut family, source, [rho], photons, seed(310 + i as u32));
        }
    }
    family.decide();
}

/// Roulette follows the strongest channel, so the weaker ones ride along with less flux and must not be biased.
#[test]
fn every_channel_of_a_coloured_sphere_has_its_own_sum() {
    let mut family = Family::new("integrating sphere, colour");
    for source in [[0.0; 3], OFF_CENTRE] {
        judge(&mut family, source, [0.8, 0.4, 0.2], 1_000_000, seed(314));
    }
    family.decide();
}

/// How many photons arrived after each number of reflections, from the segments of the stored paths.
fn arrivals<const C: usize>(lab: &Lab, photons: u64, seed: u64) -> Vec<u64> {
    let traced = lab.trace::<C>(photons, seed, 0, Classes::ALL);
    let mut arrivals = Vec::new();
    for photon in &traced.photons {
        let bounce = usize::from(photon.segments) - 1;
        arrivals.resize(arrivals.len().max(bounce + 1), 0);
        arrivals[bounce] += 1;
        let expected = if bounce == 0 { PathClass::Direct } else { PathClass::Indirect };
        assert_eq!(photon.class, expected, "after {bounce} reflections");
    }
    arrivals
}

/// A path that survives each wall with probability rho has n reflections with probability `rho^n (1 - rho)`. The cells are
/// laid out by the law alone, up to where it expects five photons: a path that ends too early must find cells it misses.
fn judge_lengths(family: &mut Family, what: &str, arrivals: &[u64], survival: f64) {
    let photons = arrivals[0] as f64;
    let last = ((5.0 / photons).ln() / survival.ln()).floor() as usize;
    let arrived = |n: usize| arrivals.get(n).copied().unwrap_or(0);
    let mut ended: Vec<u64> = (0..last).map(|n| arrived(n) - arrived(n + 1)).collect();
    let mut expected: Vec<f64> = (0..last).map(|n| photons * survival.powi(n as i32) * (1.0 - survival)).collect();
    ended.push(arrived(last));
    expected.push(photons * survival.powi(last as i32));
    family.counts(what, &ended, &expected);
}

#[test]
fn each_bounce_has_rho_times_the_photons_of_the_one_before() {
    let mut family = Family::new("integrating sphere, bounces");
    for (i, rho) in [0.5, 0.8, 0.95, 0.98, 0.99].into_iter().enumerate() {
        let (_, lab) = sphere(OFF_CENTRE, [rho]);
        let arrivals = arrivals::<1>(&lab, 40_000, seed(320 + i as u32));
        judge_lengths(&mut family, &format!("rho {rho}"), &arrivals, rho);
    }
    family.decide();
}

/// Survival is that of the strongest channel; each channel's flux after n bounces is `(rho / strongest)^n` of the start.
#[test]
fn in_colour_the_photons_follow_the_strongest_channel_and_carry_the_others() {
    let mut family = Family::new("integrating sphere, bounces in colour");
    for (i, reflectance) in [[0.8, 0.4, 0.2], [0.3, 0.6, 0.9]].into_iter().enumerate() {
        let (_, lab) = sphere(OFF_CENTRE, reflectance);
        let strongest = reflectance.into_iter().fold(0.0, f64::max);
        let arrivals = arrivals::<3>(&lab, 40_000, seed(330 + i as u32));
        judge_lengths(&mut family, &format!("{reflectance:?}"), &arrivals, strongest);
        let traced = lab.trace::<3>(1000, seed(330), 1, Classes::ALL);
        for photon in &traced.photons {
            let bounces = i32::from(photon.segments) - 1;
            for (flux, rho) in photon.flux().0.into_iter().zip(reflectance) {
                let expected = (rho / strongest).powi(bounces);
                assert!((flux - expected).abs() <= 1e-6 * expected + 1e-30, "after {bounces}: {flux}, not {expected}");
            }
        }
    }
    family.decide();
}
