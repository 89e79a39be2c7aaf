//! What a scene does not need cannot change its readings.

use photonlab_measure::Replicates;
use photonlab_readout::{Method, Outcome};
use photonlab_tests::{Family, LAMP_OVER_FLOOR, Lab, scene_text, seed, settings};

const PASSES: u64 = 24;

/// A glass plate over a black floor: light comes through glass, and nothing sends it on in all directions.
const GLASS_OVER_FLOOR: &str = r#"<scene version="3.0.0">
  <shape type="rectangle" id="floor"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <sensor type="irradiancemeter" id="E"/></shape>
  <shape type="cube" id="plate"><transform name="to_world"><scale x="3" y="3" z="0.1"/><translate z="0.5"/></transform>
    <bsdf type="dielectric"/></shape>
  <emitter type="point"><point name="position" x="0" y="0" z="1.5"/><rgb name="intensity" value="1"/></emitter>
</scene>"#;

/// A floor and a wall under a lamp: each lights the other.
const FLOOR_AND_WALL: &str = r#"<scene version="3.0.0">
  <shape type="rectangle" id="floor"><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
    <sensor type="irradiancemeter" id="E"/></shape>
  <shape type="rectangle" id="wall"><transform name="to_world"><rotate y="1" angle="90"/><translate x="-1" z="1"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf></shape>
  <emitter type="point"><point name="position" x="0" y="0" z="1.5"/><rgb name="intensity" value="1"/></emitter>
</scene>"#;

fn read<const C: usize>(lab: &Lab, method: Method, seed: u64) -> Outcome<C> {
    lab.measure::<C>(settings(method, seed), 100_000 * PASSES, PASSES, 256 * PASSES)
}

/// The first channel of every reading.
fn readings<const C: usize>(outcome: Outcome<C>) -> Vec<Replicates> {
    outcome.cells.into_iter().map(|cell| cell.value[0]).collect()
}

fn welch(family: &mut Family, what: &str, plain: &[Replicates], more: &[Replicates]) {
    assert_eq!(plain.len(), more.len());
    for (cell, (plain, more)) in plain.iter().zip(more).enumerate() {
        let test = photonlab_measure::welch_test(plain, more).expect("readings");
        let detail = format!("{:?} as needed, {:?} with more", plain.mean(), more.mean());
        family.compare(format!("{what}, cell {cell}"), test.p_value, detail);
        let noise = plain.std_error().unwrap_or(0.0) / plain.mean().unwrap_or(1.0);
        assert!(noise < 0.03, "{what}, cell {cell}: it says something: {noise}");
    }
}

#[test]
fn with_everything_switched_on_readings_stay() {
    let mut family = Family::new("needs, everything switched on");
    let cube = scene_text("cube.xml");
    for (name, xml, unneeded) in [
        ("direct light alone", LAMP_OVER_FLOOR, &["caustic map", "surface map", "volume map", "bounces"][..]),
        ("CUBE", &cube, &["caustic map", "volume map", "dispersion"]),
        ("floor and wall", FLOOR_AND_WALL, &["caustic map", "volume map", "dispersion"]),
        ("glass over a floor", GLASS_OVER_FLOOR, &["surface map", "volume map", "dispersion"]),
    ] {
        let (plain, more) = (Lab::new(xml), Lab::new(xml).with_everything());
        for need in unneeded {
            assert!(plain.left_out().contains(need), "{name}: {need} is left out: {:?}", plain.left_out());
        }
        for (method, number) in [(Method::FinalGather { radius: None }, 1), (Method::Radius { radius: None }, 2)] {
            let what = format!("{name}, {}", method.name());
            let of_plain = readings(read::<1>(&plain, method, seed(7000 + number)));
            let of_more = readings(read::<1>(&more, method, seed(7100 + number)));
            welch(&mut family, &what, &of_plain, &of_more);
            let of_three = readings(read::<3>(&more, method, seed(7200 + number)));
            welch(&mut family, &format!("{what}, three channels"), &of_plain, &of_three);
        }
    }
    family.decide();
}
