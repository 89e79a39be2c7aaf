//! What loses no light is invisible where all light is even (catalogue G1): seen by rays from the eye, and shone through by
//! photons.

use std::f64::consts::PI;

use photonlab_readout::Method;
use photonlab_tests::{Family, Lab, seed, settings};

/// Coatings that lose nothing.
const LOSSLESS: [(&str, &str); 9] = [
    ("mirror", "<bsdf type='conductor'/>"),
    ("glass", "<bsdf type='dielectric'/>"),
    ("thin plate", "<bsdf type='thindielectric'/>"),
    (
        "half a mask",
        "<bsdf type='mask'><float name='opacity' value='0.3'/><bsdf type='twosided'><bsdf type='conductor'/></bsdf></bsdf>",
    ),
    ("white", "<bsdf type='diffuse'><float name='reflectance' value='1'/></bsdf>"),
    (
        "transmitter",
        "<bsdf type='diffusetransmitter'><rgb name='reflectance' value='0.7 0.2 0.5'/><rgb name='transmittance' value='0.3 0.8 0.5'/></bsdf>",
    ),
    ("plastic", "<bsdf type='plastic'><float name='diffuse_reflectance' value='1'/></bsdf>"),
    (
        "nonlinear plastic",
        "<bsdf type='plastic'><float name='diffuse_reflectance' value='1'/><boolean name='nonlinear' value='true'/></bsdf>",
    ),
    ("null", "<bsdf type='null'/>"),
];

/// A ball in light of radiance 1 from everywhere, seen head-on and near its rim, over a plane that only measures.
fn furnace(coating: &str) -> Lab {
    Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="constant"/>
        <shape type="sphere"><float name="radius" value="0.5"/>{coating}</shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.4"/><translate z="-0.7"/></transform>
            <bsdf type="null"/><sensor type="irradiancemeter" id="below"/></shape>
        <sensor type="radiancemeter" id="middle"><point name="origin" x="0" y="0" z="3"/><vector name="direction" x="0" y="0" z="-1"/></sensor>
        <sensor type="radiancemeter" id="rim"><point name="origin" x="0.45" y="0" z="3"/><vector name="direction" x="0" y="0" z="-1"/></sensor>
        </scene>"#
    ))
}

/// Rays from the eye, with rounding alone allowed where nothing is random.
#[test]
fn lossless_coatings_are_invisible_to_the_eye() {
    let mut family = Family::new("white furnace, eye");
    for (name, coating) in LOSSLESS {
        let lab = furnace(coating);
        let outcome = lab.measure::<3>(settings(Method::Path, seed(700)), 1, 24, 20_000);
        for (cell, (place, expected)) in outcome.cells.iter().zip([("below", PI), ("middle", 1.0), ("rim", 1.0)]) {
            let spread = cell.value[1].std_error().unwrap_or(f64::NAN);
            if spread < 1e-12 {
                let value = cell.value[1].mean().unwrap_or(f64::NAN);
                assert!((value / expected - 1.0).abs() < 1e-9, "{name}, {place}: {value} without spread");
                family.compare(format!("{name}, {place}"), 1.0, "no spread");
            } else {
                family.mean(format!("{name}, {place}"), &cell.value[1], expected);
            }
        }
    }
    family.decide();
}

/// Photons from all around through or off the ball onto the plane below it, counted there.
#[test]
fn lossless_coatings_take_nothing_from_photons() {
    let mut family = Family::new("white furnace, photons");
    for (name, coating) in LOSSLESS {
        let outcome = furnace(coating).measure::<3>(settings(Method::Bins, seed(710)), 1_500_000, 24, 24);
        family.mean(name, &outcome.cells[0].value[1], PI);
    }
    family.decide();
}
