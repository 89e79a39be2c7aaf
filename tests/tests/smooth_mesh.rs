//! Meshes that stand for smooth surfaces: what photons bring by way of them, and what rays from the meter find.

use photonlab_measure::welch_test;
use photonlab_readout::Method;
use photonlab_tests::{Family, Lab, icosphere, seed, settings};

/// A lamp that shines up at a ball of 80 triangles; the meter below sees the ball alone.
fn below_a_ball(coating: &str) -> Lab {
    Lab::beside(
        "ball.obj",
        &icosphere(1, true),
        &format!(
            r#"<shape type="rectangle"><transform name="to_world"><scale value="0.25"/><translate x="0.2" z="0.4"/></transform>
            <emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
            <shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
            <sensor type="irradiancemeter"/></shape>
            <shape type="obj"><string name="filename" value="ball.obj"/>
            <transform name="to_world"><scale x="0.5" y="0.8" z="0.4"/><translate z="1.3"/></transform>{coating}</shape>"#
        ),
    )
}

/// A flat square whose smooth normals are all turned by 20 degrees away from the lamp above; one meter above and one below it
/// see the square alone.
fn beside_a_tilted_square(coating: &str) -> Lab {
    let square = "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvn 0.34202014 0 0.93969262\nf 1//1 2//1 3//1 4//1\n";
    let black = r#"<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><sensor type="irradiancemeter"/>"#;
    Lab::beside(
        "square.obj",
        square,
        &format!(
            r#"<shape type="disk"><transform name="to_world"><scale value="0.3"/><rotate x="1" angle="180"/>
            <translate x="-0.5" z="2.5"/></transform><emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
            <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/>
            <translate x="1.2" z="1.8"/></transform>{black}</shape>
            <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><translate z="0.2"/></transform>{black}</shape>
            <shape type="obj"><string name="filename" value="square.obj"/>{coating}</shape>"#
        ),
    )
}

const MATTE: &str = r#"<bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf>"#;
const MIRROR: &str = r#"<bsdf type="conductor"><string name="material" value="none"/></bsdf>"#;
const GLASS: &str =
    r#"<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>"#;

/// Counted photons against paths at every meter that gets any light.
fn compare(family: &mut Family, name: &str, lab: &Lab, number: u32) {
    let counted = lab.measure::<1>(settings(Method::Bins, seed(1100 + number)), 8_000_000, 32, 32);
    let traced = lab.measure::<1>(settings(Method::Path, seed(1130 + number)), 32, 32, 1 << 19);
    for (meter, (counted, traced)) in counted.cells.iter().zip(&traced.cells).enumerate() {
        let [counted, traced] = [counted, traced].map(|cell| &cell.value[0]);
        if counted.mean() == Some(0.0) && traced.mean() == Some(0.0) {
            continue;
        }
        let test = welch_test(counted, traced).expect("two sets of passes");
        let share = test.difference / traced.mean().unwrap_or(f64::NAN);
        println!("{name}, meter {meter}: {share:+.4} +- {:.4}", test.std_error / traced.mean().unwrap_or(f64::NAN));
        family.compare(format!("{name}, meter {meter}"), test.p_value, format!("{test:?}"));
    }
}

/// Normals that differ from the smooth ones by 20 degrees: without the factors of photons (Veach 1997, section 5.3) readings
/// differ by up to a fifth.
#[test]
fn photons_and_paths_agree_on_tilted_squares() {
    let mut family = Family::new("tilted squares");
    let coatings = [
        ("matte", MATTE),
        ("mirror", MIRROR),
        ("glass", GLASS),
        ("plastic", r#"<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.6"/></bsdf>"#),
        (
            "rough metal",
            r#"<bsdf type="roughconductor"><string name="material" value="none"/><float name="alpha" value="0.4"/></bsdf>"#,
        ),
        (
            "rough glass",
            r#"<bsdf type="roughdielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>
            <float name="alpha" value="0.3"/></bsdf>"#,
        ),
        (
            "transmitter",
            r#"<bsdf type="diffusetransmitter"><rgb name="reflectance" value="0.4"/><rgb name="transmittance" value="0.5"/></bsdf>"#,
        ),
    ];
    for (number, (name, coating)) in (0..).zip(coatings) {
        compare(&mut family, name, &beside_a_tilted_square(coating), number);
    }
    family.decide();
}

/// The same on a body, seen from all sides and through.
#[test]
fn photons_and_paths_agree_on_a_smooth_ball() {
    let mut family = Family::new("smooth ball");
    for (number, (name, coating)) in (10..).zip([("matte", MATTE), ("mirror", MIRROR), ("glass", GLASS)]) {
        compare(&mut family, name, &below_a_ball(coating), number);
    }
    family.decide();
}
