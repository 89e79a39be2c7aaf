//! Meshes that stand for smooth surfaces: what photons bring by way of them, and what rays from the meter find.

use photonlab_measure::welch_test;
use photonlab_readout::Method;
use photonlab_tests::{Family, Lab, icosphere, seed, settings};

/// The scene in a folder with a sphere's mesh, `ball.obj`.
fn with_ball(halvings: u32, scene: &str) -> Lab {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("ball.obj"), icosphere(halvings, true)).expect("written");
    let path = folder.path().join("scene.xml");
    std::fs::write(&path, format!("<scene version=\"3.0.0\">{scene}</scene>")).expect("written");
    Lab::open(&path)
}

/// A lamp that shines up at a ball of few triangles; the meter below sees the ball alone.
fn below_a_ball(halvings: u32, coating: &str) -> Lab {
    with_ball(
        halvings,
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

/// 80 triangles, whose normals differ from the smooth ones by up to 20 degrees: without the factors of photons (Veach 1997,
/// section 5.3) the readings differ by several per cent.
#[test]
fn photons_and_paths_agree_on_smooth_meshes() {
    let mut family = Family::new("smooth meshes");
    for (number, (name, coating)) in [
        ("matte", r#"<bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf>"#),
        ("plastic", r#"<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.6"/></bsdf>"#),
        ("rough metal", r#"<bsdf type="roughconductor"><string name="material" value="none"/><float name="alpha" value="0.4"/></bsdf>"#),
        ("mirror", r#"<bsdf type="conductor"><string name="material" value="none"/></bsdf>"#),
        ("glass", r#"<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>"#),
        ("rough glass", r#"<bsdf type="roughdielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/><float name="alpha" value="0.3"/></bsdf>"#),
        ("transmitter", r#"<bsdf type="diffusetransmitter"><rgb name="reflectance" value="0.4"/><rgb name="transmittance" value="0.5"/></bsdf>"#),
    ]
    .into_iter()
    .enumerate()
    {
        let lab = below_a_ball(1, coating);
        let number = number as u32;
        let counted = lab.measure::<1>(settings(Method::Bins, seed(1100 + number)), 4_000_000, 32, 32);
        let traced = lab.measure::<1>(settings(Method::Path, seed(1110 + number)), 32, 32, 1 << 19);
        let [counted, traced] = [&counted, &traced].map(|outcome| &outcome.cells[0].value[0]);
        println!(
            "{name}: counted {:?} +- {:?}, by paths {:?} +- {:?}",
            counted.mean(), counted.std_error(), traced.mean(), traced.std_error()
        );
        let test = welch_test(counted, traced).expect("two sets of passes");
        family.compare(name, test.p_value, format!("{test:?}"));
    }
    family.decide();
}
