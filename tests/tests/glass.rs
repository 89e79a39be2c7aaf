//! Clear glass: light that cannot leave a block, and the light that a slab and a ball let through (catalogue E1, E2).

use photonlab_photometry::PathClass;
use photonlab_reference::ball_lens::BallLens;
use photonlab_sampling::Sought;
use photonlab_tests::{Family, Lab, seed};
use photonlab_trace::{Classes, Job, Limits};

/// A lamp inside a glass cube [-1, 1]^3.
fn block(index: f64, lamp: [f64; 3]) -> Lab {
    let [x, y, z] = lamp;
    Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="point"><point name="position" x="{x}" y="{y}" z="{z}"/>
        <rgb name="intensity" value="1"/></emitter>
        <shape type="cube" id="block"><bsdf type="dielectric"><float name="int_ior" value="{index}"/>
        <float name="ext_ior" value="1"/></bsdf></shape></scene>"#
    ))
}

/// Reflection at the faces of a cube keeps the size of each component of a direction, so a direction can leave by the
/// faces across an axis if its component there exceeds the critical cosine `c = sqrt(1 - 1/n^2)`, and will, since Fresnel
/// lets some through at every visit. Below n = sqrt 2 times any index here `c > 1/sqrt 2`: no direction has two such
/// components, each pair of faces drains the share `1 - c` of all directions, and `1 - 3 (1 - c)` is trapped for ever.
/// Directions within 1e-7 of critical are still inside after 1000 events, far below what is tested.
fn trapped_share(index: f64) -> f64 {
    1.0 - 3.0 * (1.0 - (1.0 - 1.0 / (index * index)).sqrt())
}

#[test]
fn a_lamp_in_a_glass_block_ends_and_its_trapped_light_is_booked_as_cut_off() {
    let mut family = Family::new("trapped light");
    let photons = 20_000;
    for (i, (index, lamp)) in
        [(1.5, [0.0; 3]), (1.5, [0.7, -0.2, 0.4]), (1.8, [0.1, 0.3, -0.6])].into_iter().enumerate()
    {
        let ledger = block(index, lamp).trace::<1>(photons, seed(500 + i as u32), 0, Classes::NONE).ledger;
        let total = ledger.total();
        family.proportion(format!("n = {index}, {lamp:?}"), ledger.trapped_paths, photons, trapped_share(index));
        let share = total.cut_off[0] / ledger.emitted[0];
        let counted = ledger.trapped_paths as f64 / photons as f64;
        assert!((share - counted).abs() < 1e-12, "flux cut off {share}, paths cut off {counted}");
        let all = (total.cut_off[0] + total.escaped[0]) / ledger.emitted[0];
        assert!(
            (all - 1.0).abs() < 1e-12,
            "glass absorbs nothing and adds nothing: {all} of the flux is accounted for"
        );
    }
    family.decide();
}

/// E1 at normal incidence: both faces and all reflections between them let `(1 - R) / (1 + R)` through, 0.923077 for
/// n = 1.5; the first transmission alone would be 0.9216, seven standard errors away.
#[test]
fn a_slab_lets_through_what_all_its_reflections_together_do() {
    let mut family = Family::new("slab");
    let photons = 1_500_000;
    for index in [1.5f64, 2.0] {
        let lab = Lab::new(&format!(
            r#"<scene version="3.0.0"><emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/>
            <rgb name="irradiance" value="1"/></emitter>
            <shape type="cube" id="slab"><transform name="to_world"><scale x="1" y="1" z="0.1"/><translate z="1"/></transform>
            <bsdf type="dielectric"><float name="int_ior" value="{index}"/><float name="ext_ior" value="1"/></bsdf></shape>
            <shape type="rectangle" id="floor"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>
            </scene>"#
        ));
        let traced = lab.trace::<1>(photons, seed(510), 0, Classes::ALL);
        let landed = traced.photons.iter().filter(|photon| photon.class == PathClass::Caustic).count() as u64;
        assert_eq!(landed, traced.photons.len() as u64, "no photon reaches the floor beside the slab");
        let reflected = ((index - 1.0) / (index + 1.0)).powi(2);
        family.proportion(format!("n = {index}"), landed, photons, (1.0 - reflected) / (1.0 + reflected));
        let flux = traced.ledger.surfaces[1].incident[0] / traced.ledger.emitted[0];
        let share = landed as f64 / photons as f64;
        assert!(
            (flux - share).abs() < 1e-9,
            "flux {flux} of the emitted, photons {share}: glass changes no photon's flux"
        );
    }
    family.decide();
}

/// E2: flux within circles on the floor by counting photons, no density estimate in between.
#[test]
fn a_ball_lens_sends_its_flux_where_the_ray_map_says() {
    let mut family = Family::new("ball lens, transport");
    let (lens, photons) = (BallLens::BENCHMARK, 1_500_000);
    // A black floor: nothing returns to the ball.
    let job = Job { seed: seed(520), pass: 0, limits: Limits::default(), keep: Classes::ALL };
    let traced = Lab::new(&lens.xml(0.0, 0.6, 8)).trace_for::<1>(Sought::AsEmitted, photons, job);
    let emitted = traced.ledger.emitted[0];
    for radius in [0.1, 0.25, 0.36, 0.4, 0.8] {
        let inside = traced.positions.iter().filter(|p| f64::from(p[0]).hypot(f64::from(p[1])) <= radius);
        let share = lens.flux_within(radius) / emitted;
        family.proportion(format!("within {radius}"), inside.count() as u64, photons, share);
    }
    family.decide();
}
