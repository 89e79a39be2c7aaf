//! A rectangular lamp above a floor: an image of irradiance against the closed form, pixel by pixel.

use std::{f64::consts::PI, time::Instant};

use photonlab_readout::{Direct, Method, Settings};
use photonlab_reference::square_lamp::RectangularLamp;
use photonlab_tests::{Family, Lab, seed, settings};

const FLOOR_REFLECTANCE: f64 = 0.5;
const HALF_WIDTH: f64 = 1.5;

/// Root of the mean squared error over the mean, of irradiance read as pi L / rho, pixel by pixel against the cell's mean.
fn relative_rmse(lamp: &RectangularLamp, cells: usize, passes: u64, spp: u64, seed: u64) -> f64 {
    rmse_by(settings(Method::FinalGather { radius: None }, seed), 16_000, lamp, cells, passes, spp)
}

fn rmse_by(settings: Settings, photons: u64, lamp: &RectangularLamp, cells: usize, passes: u64, spp: u64) -> f64 {
    let lab = Lab::new(&lamp.xml(FLOOR_REFLECTANCE, HALF_WIDTH, cells));
    let outcome = lab.render::<1>(settings, photons, passes, spp);
    let side = 2.0 * HALF_WIDTH / cells as f64;
    let (mut squares, mut sum) = (0.0, 0.0);
    for (i, pixel) in outcome.cells.iter().enumerate() {
        // Row 0 on top is +y; seen from above, +x is to the right.
        let (column, row) = ((i % cells) as f64, (i / cells) as f64);
        let (x, y) = (-HALF_WIDTH + column * side, HALF_WIDTH - (row + 1.0) * side);
        let truth = lamp.mean_irradiance([x, y], [x + side, y + side]);
        let read = pixel.value[0].mean().expect("a pass") * PI / FLOOR_REFLECTANCE;
        squares += (read - truth).powi(2);
        sum += truth;
    }
    let count = (cells * cells) as f64;
    (squares / count).sqrt() / (sum / count)
}

/// At most 0.1 % RMSE in a few seconds. Two passes of 256 points each: an embedded lattice gains more from a longer pass than
/// from another one.
#[test]
fn an_image_of_the_square_lamp_is_right_to_a_thousandth() {
    let start = Instant::now();
    let error = relative_rmse(&RectangularLamp::SQUARE, 128, 2, 512, seed(800));
    println!(
        "128 x 128 pixels, 512 points each: RMSE {:.4} % in {:.1} s",
        100.0 * error,
        start.elapsed().as_secs_f64()
    );
    assert!(error <= 0.001, "RMSE {:.4} %, at most 0.1 % wanted", 100.0 * error);
}

/// An oblong lamp tells x from y, which the square one cannot.
#[test]
fn an_image_is_not_turned() {
    let lamp = RectangularLamp::new([1.6, 0.4], 0.8, 5.0).expect("in range");
    let error = relative_rmse(&lamp, 32, 2, 1024, seed(801));
    assert!(error <= 0.001, "RMSE {:.4} %, at most 0.1 % wanted", 100.0 * error);
    let turned = RectangularLamp::new([0.4, 1.6], 0.8, 5.0).expect("in range");
    let apart = turned.irradiance(0.0, 0.8) / lamp.irradiance(0.0, 0.8);
    assert!(apart > 1.5, "the two lamps differ enough to be told apart: {apart}");
}

/// Photons alone, whose radius nobody names: no more error than with the best of five radii, and so with radii that pixels find for
/// themselves, since bias is taken off of both. Half of the best radius has half as much error again.
#[test]
fn the_radius_that_a_run_finds_is_as_good_as_the_best() {
    let error = |method: Method| {
        let settings = Settings { direct: Direct::Photons, ..settings(method, seed(802)) };
        rmse_by(settings, 400_000, &RectangularLamp::SQUARE, 64, 8, 8)
    };
    let fixed = [0.05, 0.1, 0.15, 0.2, 0.3].map(|radius| error(Method::Radius { radius: Some(radius) }));
    let best = fixed.into_iter().fold(f64::INFINITY, f64::min);
    let found = [Method::Radius { radius: None }, Method::Adaptive].map(error);
    println!("fixed radii {fixed:.4?}, found {found:.4?}");
    assert!(found.iter().all(|&error| error <= best), "{found:?}, the best of fixed radii {best}");
    assert!(fixed[0] > 1.5 * best, "radii matter: {fixed:?}");
}

/// A lamp that pokes through a wall lights a room by the part that is inside, to the last millimetre: a shadow ray that ends a thousandth
/// short of the lamp would see it through the wall, and read 0.5 % too much here.
#[test]
fn a_lamp_through_a_wall_lights_by_what_is_inside() {
    let mut family = Family::new("lamp through a wall");
    let inside = RectangularLamp::new([0.7, 1.0], 1.0, 10.0).expect("in range");
    let meter = |id: &str, x: f64| {
        format!(
            r#"<shape type="rectangle"><transform name="to_world"><scale value="0.1"/><translate x="{x}"/></transform>
            <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><sensor type="irradiancemeter" id="{id}"/></shape>"#
        )
    };
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0">{}{}
        <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/><translate z="1"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate y="1" angle="-90"/><translate x="0.2"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape></scene>"#,
        meter("far", -3.0),
        meter("near", -1.0)
    ));
    let outcome = lab.measure::<1>(settings(Method::Path, seed(803)), 0, 16, 1 << 17);
    for (cell, x) in outcome.cells.iter().zip([-3.0, -1.0]) {
        // The part inside has its middle at x = -0.15.
        let truth = inside.mean_irradiance([x + 0.05, -0.1], [x + 0.25, 0.1]);
        let half = cell.half_width(0, 0.99).expect("light");
        assert!(half < 0.002 * truth, "it says something: {half} of {truth}");
        family.reading(format!("meter at {x} m"), cell, 0, truth);
    }
    family.decide();
}
