//! Sensors beside the pinhole and the meters on surfaces: a thin lens, and meters far away.

use std::f64::consts::PI;

use photonlab_readout::Method;
use photonlab_tests::{Family, Lab, seed, settings};

const LAMP: &str = r#"<emitter type="area"><rgb name="radiance" value="3"/></emitter>"#;

/// A strip of light, half-width w, out of focus: from the middle of the image a share of the lens sees it, the part of the
/// unit disc within |x| < t of its middle line, with t = w / (R |1 - D / F|), D the strip's distance and F that in focus. Before
/// and behind the plane in focus.
#[test]
fn a_strip_out_of_focus_is_seen_from_a_part_of_the_lens() {
    let mut family = Family::new("thin lens");
    for (number, (distance, focus, half_width)) in
        [(5.0, 2.0, 0.1), (1.0, 4.0, 0.1), (3.0, 3.5, 0.02)].into_iter().enumerate()
    {
        let radius: f64 = 0.2;
        let lab = Lab::new(&format!(
            r#"<scene version="3.0.0"><sensor type="thinlens"><float name="fov" value="0.0001"/>
            <float name="aperture_radius" value="{radius}"/><float name="focus_distance" value="{focus}"/>
            <film type="hdrfilm"><integer name="width" value="1"/><integer name="height" value="1"/></film></sensor>
            <shape type="rectangle"><transform name="to_world"><scale x="{half_width}" y="5"/><rotate y="1" angle="180"/>
            <translate z="{distance}"/></transform>{LAMP}</shape></scene>"#
        ));
        let outcome = lab.render::<1>(settings(Method::Path, seed(320 + number as u32)), 0, 32, 1 << 16);
        let defocus: f64 = 1.0 - distance / focus;
        let t: f64 = half_width / (radius * defocus.abs());
        assert!(t < 1.0, "the lens sees past the strip");
        let share = 2.0 / PI * (t * (1.0 - t * t).sqrt() + t.asin());
        family.reading(format!("strip at {distance} m, focus at {focus} m"), &outcome.cells[0], 0, 3.0 * share);
    }
    family.decide();
}

/// A lamp of 2 x 1 m below a distant meter that looks down at 60 degrees from the vertical. Over the cross-section of the
/// bounding sphere the mean is its projected area over that circle's; over a target of which it covers a part the mean is
/// that part of its radiance; at a point on it, its radiance. A black screen above the target hides it, wherever the screen stands.
#[test]
fn distant_meters_average_over_their_targets() {
    let mut family = Family::new("distant meters");
    let direction = r#"<vector name="direction" x="0" y="0.8660254037844386" z="-0.5"/>"#;
    let target = r#"<shape name="target" type="rectangle"><transform name="to_world"><scale x="0.5" y="0.5"/>
        <translate x="0.63"/></transform></shape>"#;
    let lamp = format!(
        r#"<shape type="rectangle"><transform name="to_world"><scale x="1" y="0.5"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>{LAMP}</shape>"#
    );
    let screen = r#"<shape type="rectangle"><transform name="to_world"><scale x="0.37" y="0.5"/>
        <translate y="-34.64101615137755" z="20"/></transform></shape>"#;
    for (number, (target, others, expected)) in [
        ("", "", 3.0 * 2.0 * 0.5 / (PI * 1.25)),
        (target, "", 3.0 * 0.87),
        (r#"<point name="target" x="0.9" y="0.4" z="0"/>"#, "", 3.0),
        (r#"<shape name="target" type="rectangle"><transform name="to_world"><scale x="1" y="0.5"/></transform></shape>"#, screen, 3.0 * 0.63),
    ]
    .into_iter()
    .enumerate()
    {
        let lab = Lab::new(&format!(
            r#"<scene version="3.0.0">{lamp}{others}<sensor type="distant">{direction}{target}</sensor></scene>"#
        ));
        let outcome = lab.measure::<1>(settings(Method::Path, seed(330 + number as u32)), 0, 32, 1 << 15);
        let read = outcome.cells[0].value[0].mean().expect("a pass");
        if outcome.cells[0].value[0].std_error() == Some(0.0) {
            assert!((read / expected - 1.0).abs() < 1e-12, "target {number}: {read} {expected}");
        } else {
            family.reading(format!("target {number}"), &outcome.cells[0], 0, expected);
        }
    }
    family.decide();
}
