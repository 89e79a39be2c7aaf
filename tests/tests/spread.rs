//! Evenly spread photons: less noise with a fixed radius, and not for the k nearest, which presume that photons are independent.

use photonlab_readout::{Direct, Draws, Method, Settings};
use photonlab_tests::{Family, Lab, seed, settings};

/// Parallel light on a large floor, read from the map at its middle: 2 W/m^2, all of it reflected by a factor 1.
const FLOOR: &str = r#"<scene version="3.0.0"><shape type="rectangle" id="floor"><bsdf type="diffuse">
    <rgb name="reflectance" value="1"/></bsdf></shape>
    <emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/><rgb name="irradiance" value="2"/></emitter>
    <sensor type="radiancemeter" id="middle"><transform name="to_world"><lookat origin="0.03 0.02 1" target="0.03 0.02 0"
    up="0 1 0"/></transform></sensor></scene>"#;

/// Few photons a pass and many passes: one of the k nearest is one of few, and its half is seen through their noise.
const PHOTONS: u64 = 1 << 20;
const PASSES: u64 = 2048;

fn by_photons(method: Method, draws: Draws, number: u32) -> Settings {
    Settings { direct: Direct::Photons, draws, ..settings(method, seed(number)) }
}

/// The k nearest, drawn as they are if nobody says otherwise, read even light right; of evenly spread photons they read half a photon too
/// little, which no error bar tells.
#[test]
fn the_nearest_photons_read_even_light_right() {
    let lab = Lab::new(FLOOR);
    let expected = 2.0 / std::f64::consts::PI;
    let mut family = Family::new("nearest, as drawn");
    for (number, k) in [8, 12, 20].into_iter().enumerate() {
        let method = Method::Nearest { k: Some(k) };
        let read = |draws| lab.measure::<1>(by_photons(method, draws, 1760 + number as u32), PHOTONS, PASSES, PASSES);
        family.mean(format!("k = {k}"), &read(method.usual_draws()).cells[0].value[0], expected);
        let spread = read(Draws::Spread).cells[0].value[0].mean().expect("passes");
        println!("k = {k}: evenly spread photons read {spread} for {expected}");
        let low = 1.0 - 0.2 / k as f64;
        assert!(spread < low * expected, "k = {k}: {spread} for {expected}, if photons are evenly spread");
    }
    family.decide();
}

/// A ball of a hundred photons under parallel light: what the count varies by is its edge.
#[test]
fn a_fixed_radius_reads_spread_photons_with_less_noise() {
    let lab = Lab::new(FLOOR);
    let method = Method::Radius { radius: Some(0.15) };
    let noise = |draws, number| {
        let outcome = lab.measure::<1>(by_photons(method, draws, number), PHOTONS, PASSES, PASSES);
        outcome.cells[0].value[0].std_error().expect("passes")
    };
    let (spread, independent) = (noise(Draws::Spread, 1764), noise(Draws::Independent, 1765));
    assert!(spread < 0.6 * independent, "standard errors {spread} and {independent}");
}

/// A cap of directions that gets 512.002 of a pass's 4096 photons: the count hardly ever varies, and what is missing is in no spread.
#[test]
fn counts_that_agree_do_not_claim_to_be_exact() {
    let share = 512.002 / 4096.0;
    let cosine: f64 = 1.0 - 2.0 * share;
    let radius = (1.0 - cosine * cosine).sqrt() / cosine;
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="0" y="0" z="1"/><rgb name="intensity" value="1"/>
        </emitter><shape type="disk" id="cap"><transform name="to_world"><scale value="{radius}"/></transform>
        <sensor type="fluxmeter" id="flux"/></shape></scene>"#
    ));
    let method = Method::Bins;
    let cell = &lab.measure::<1>(settings(method, seed(1768)), 16 * 4096, 16, 16).cells[0];
    let (value, truth) = (cell.value[0].mean().expect("passes"), 4.0 * std::f64::consts::PI * share);
    let half = cell.half_width(0, 0.95).expect("passes");
    println!("{value} +- {half} for {truth}, standard error {:?}", cell.value[0].std_error());
    assert!((value - truth).abs() > 1e-7 * truth, "it is not met by chance");
    assert!((value - truth).abs() <= half && half < 0.01 * truth, "{value} +- {half} for {truth}");
}
