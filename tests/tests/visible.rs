//! What a point sees: light does not leak past walls, and area is found by rays.

use glam::DVec3;
use photonlab_final_gather::{surface_inside, surface_seen};
use photonlab_gather::{AreaModel, Estimator, Kernel};
use photonlab_readout::{Direct, Method};
use photonlab_scene::Neighbourhood;
use photonlab_tests::{Family, Lab, seed, settings};

/// Where each is known exactly, the area found by rays is that, within what its points leave open.
#[test]
fn area_by_rays_is_the_area() {
    let room = Lab::new(
        r#"<scene version="3.0.0"><emitter type="point"/><shape type="cube"><boolean name="flip_normals" value="true"/></shape>
        <shape type="sphere"><point name="center" x="0" y="0" z="0.2"/><float name="radius" value="0.3"/></shape></scene>"#,
    );
    let (floor, n) = (DVec3::new(0.1, -0.8, -1.0), DVec3::Z);
    let primitive = (0..6).find(|&p| room.world.point_on(p, floor).normal.dot(n) > 0.99).expect("a floor");
    for (at, radius) in [(floor, 0.1), (floor, 0.3), (floor, 0.5), (DVec3::new(0.9, -0.9, -1.0), 0.25)] {
        let around = Neighbourhood { position: at, primitive, normal: n, radius, least_cosine: 0.5 };
        let exact = surface_inside(&room.world, &around, Kernel::Disc, |_, _| true).map_or(1.0, |inside| inside.area);
        let seen = surface_seen(&room.world, &around, Kernel::Disc, |_, _| true).area;
        assert!((seen / exact - 1.0).abs() < 0.03, "{at} {radius}: {seen}, exactly {exact}");
    }
    // Of a sphere a ball cuts as much as of a plane (Archimedes).
    let top = DVec3::new(0.0, 0.3 * 0.6, 0.2 + 0.3 * 0.8);
    let around = |radius| Neighbourhood {
        position: top,
        primitive: 6,
        normal: DVec3::new(0.0, 0.6, 0.8),
        radius,
        least_cosine: 0.5,
    };
    for radius in [0.05, 0.15, 0.25] {
        let seen = surface_seen(&room.world, &around(radius), Kernel::Disc, |primitive, _| primitive == 6).area;
        assert!((seen - 1.0).abs() < 0.03, "{radius}: {seen}");
    }
}

/// A thin wall on a floor shades one side of it: nothing of the other side's light is read there, and on the lit side, where half of the
/// floor in the ball is beyond the wall, the light is whole. With the disc, or the area in the ball, it leaks.
#[test]
fn light_does_not_leak_past_a_wall_on_a_floor() {
    let mut family = Family::new("wall on a floor, seen");
    let meter = |name: &str, x: f64| {
        format!(
            r#"<sensor type="radiancemeter" id="{name}"><transform name="to_world">
            <lookat origin="{x} 0 0.5" target="{x} 0 0" up="0 1 0"/></transform></sensor>"#
        )
    };
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0"><emitter type="directional"><vector name="direction" x="-1" y="0" z="-1"/></emitter>
        <shape type="rectangle"><transform name="to_world"><scale value="2"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="0.5" y="2"/><rotate y="1" angle="90"/>
        <translate z="0.5"/></transform><bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>
        {}{}</scene>"#,
        meter("lit", 0.05),
        meter("dark", -0.05)
    ));
    let lit = 0.5 * 0.5f64.sqrt() / std::f64::consts::PI;
    for (number, method) in
        [Method::Radius { radius: Some(0.2) }, Method::Nearest { k: Some(300) }].into_iter().enumerate()
    {
        let mut how = settings(method, seed(1800 + number as u32));
        how.direct = Direct::Photons;
        let mut read = |area| {
            how.estimator = Estimator::new(Kernel::Disc, area);
            let outcome = lab.measure::<1>(how, 1_600_000, 16, 16);
            [0, 1].map(|meter| outcome.cells[meter].value[0].mean().unwrap_or(f64::NAN) / lit)
        };
        let [disc, clipped] = [AreaModel::Disc, AreaModel::Clipped].map(&mut read);
        assert!(disc[1] > 0.2 && clipped[1] > 0.2, "it leaks: {disc:?} {clipped:?}");
        assert!(disc[0] < 0.8 && clipped[0] < 0.8, "it lacks: {disc:?} {clipped:?}");
        let [seen, leak] = read(AreaModel::Visible);
        assert!((seen - 1.0).abs() < 0.03, "{seen}");
        if let Method::Radius { .. } = method {
            assert_eq!(leak, 0.0);
        }
        how.estimator = Estimator::new(Kernel::Disc, AreaModel::Visible);
        let outcome = lab.measure::<1>(how, 1_600_000, 16, 16);
        family.reading(format!("{method:?}"), &outcome.cells[0], 0, lit);
    }
    family.decide();
}
