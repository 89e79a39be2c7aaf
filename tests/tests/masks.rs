//! Masks: what lets a share of the light through unchanged.

use photonlab_measure::welch_test;
use photonlab_readout::Method;
use photonlab_tests::{Family, Lab, seed, settings};

/// A rough metal plate shows a lamp; a black mask of opacity 0.25 in the lamp's light, near the plate, takes a quarter of it.
/// Draws of the lamp and rays that meet it by chance share the work, and both see it from the plate, not from the mask.
#[test]
fn a_mask_takes_its_share_of_what_a_rough_plate_shows() {
    let mut family = Family::new("mask before a lamp");
    let read = |radiance: f64, mask: &str, number: u32| {
        let lab = Lab::new(&format!(
            r#"<scene version="3.0.0"><sensor type="radiancemeter"><point name="origin" x="-1" y="0" z="1"/>
            <vector name="direction" x="1" y="0" z="-1"/></sensor>
            <shape type="rectangle"><bsdf type="roughconductor"><float name="alpha" value="0.4"/></bsdf></shape>
            <shape type="rectangle"><transform name="to_world"><scale value="0.8"/><rotate y="1" angle="-135"/>
            <translate x="1" z="1"/></transform><emitter type="area"><rgb name="radiance" value="{radiance}"/></emitter></shape>
            {mask}</scene>"#
        ));
        lab.measure::<1>(settings(Method::Path, seed(number)), 0, 32, 1 << 18).cells.swap_remove(0)
    };
    let mask = r#"<shape type="rectangle"><transform name="to_world"><scale value="3"/><rotate y="1" angle="-135"/>
        <translate x="0.2" z="0.2"/></transform><bsdf type="mask"><float name="opacity" value="0.25"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>"#;
    let (open, masked) = (read(5.0 * 0.75, "", 420), read(5.0, mask, 421));
    let test = welch_test(&masked.value[0], &open.value[0]).expect("two sets of passes");
    let means = [&masked.value[0], &open.value[0]].map(|set| (set.mean(), set.std_error()));
    family.compare("masked, and open to three quarters of the light", test.p_value, format!("{means:?}"));
    family.decide();
}
