//! What light does: coatings, lamps, cameras and meters.

use glam::DVec3;
use photonlab_photometry::Spectrum;
use photonlab_scene::{
    Bsdf, Camera, Dielectric, Emitter, Film, Index, Meter, Microfacets, Pattern, Receiver, Roughness,
};

use super::scene;

fn bsdf(xml: &str) -> Bsdf {
    scene(&format!("<shape type='sphere'>{xml}</shape>")).shapes.remove(0).bsdf
}

const WHITE: Spectrum = Spectrum::Uniform(1.0);

fn diffuse(reflectance: f64) -> Bsdf {
    Bsdf::Diffuse { reflectance: Spectrum::Uniform(reflectance) }
}

#[test]
fn colours_have_many_spellings() {
    for (xml, expected) in [
        ("<rgb name='reflectance' value='0.25'/>", Spectrum::Rgb([0.25; 3])),
        ("<rgb name='reflectance' value='0.1, 0.2,0.3'/>", Spectrum::Rgb([0.1, 0.2, 0.3])),
        ("<rgb name='reflectance' value=' 0.1 0.2  0.3 '/>", Spectrum::Rgb([0.1, 0.2, 0.3])),
        ("<spectrum name='reflectance' value='0.25'/>", Spectrum::Uniform(0.25)),
        ("<float name='reflectance' value='0.25'/>", Spectrum::Uniform(0.25)),
        ("<float name='reflectance' value='2.5e-1'/>", Spectrum::Uniform(0.25)),
        ("", Spectrum::Uniform(0.5)),
    ] {
        let found = bsdf(&format!("<bsdf type='diffuse'>{xml}</bsdf>"));
        assert_eq!(found, Bsdf::Diffuse { reflectance: expected }, "{xml}");
    }
}

#[test]
fn a_shape_without_coating_is_grey_or_black() {
    assert_eq!(bsdf(""), diffuse(0.5));
    assert_eq!(bsdf("<emitter type='area'/>"), diffuse(0.0));
}

#[test]
fn dielectrics_take_numbers_and_names() {
    let smooth = |interior_index, exterior_index, [reflected, transmitted]: [Spectrum; 2]| {
        Bsdf::Dielectric(Dielectric {
            interior_index: Index::Constant(interior_index),
            exterior_index: Index::Constant(exterior_index),
            specular: [reflected, transmitted],
            roughness: None,
        })
    };
    assert_eq!(bsdf("<bsdf type='dielectric'/>"), smooth(1.5046, 1.000277, [WHITE; 2]));
    let named = "<string name='int_ior' value='Diamond'/><string name='ext_ior' value='carbon dioxide'/>";
    assert_eq!(bsdf(&format!("<bsdf type='dielectric'>{named}</bsdf>")), smooth(2.419, 1.00045, [WHITE; 2]));
    let numbers = "<float name='int_ior' value='1'/><integer name='ext_ior' value='2'/>
        <rgb name='specular_reflectance' value='1 1 1'/><rgb name='specular_transmittance' value='1 0.5 0'/>";
    let tinted = smooth(1.0, 2.0, [[1.0; 3], [1.0, 0.5, 0.0]].map(Spectrum::Rgb));
    assert_eq!(bsdf(&format!("<bsdf type='dielectric'>{numbers}</bsdf>")), tinted);
}

#[test]
fn microfacets_are_beckmanns_unless_the_file_says_otherwise() {
    let roughness = |xml: &str| match bsdf(&format!("<bsdf type='roughdielectric'>{xml}</bsdf>")) {
        Bsdf::Dielectric(glass) => glass.roughness.unwrap(),
        other => panic!("{other:?}"),
    };
    assert_eq!(roughness(""), Roughness { facets: Microfacets::Beckmann, alpha: 0.1 });
    let ggx = "<string name='distribution' value='ggx'/><float name='alpha' value='0.3'/>
        <boolean name='sample_visible' value='false'/>";
    assert_eq!(roughness(ggx), Roughness { facets: Microfacets::Ggx, alpha: 0.3 });
}

#[test]
fn a_conductor_of_no_metal_is_a_mirror() {
    for xml in ["", "<string name='material' value='none'/>"] {
        assert_eq!(bsdf(&format!("<bsdf type='conductor'>{xml}</bsdf>")), Bsdf::Mirror { reflectance: WHITE });
    }
    let dim = "<bsdf type='conductor'><rgb name='specular_reflectance' value='0.9 0.8 0.7'/></bsdf>";
    assert_eq!(bsdf(dim), Bsdf::Mirror { reflectance: Spectrum::Rgb([0.9, 0.8, 0.7]) });
}

#[test]
fn metals_have_names_and_numbers() {
    let metal = |xml: &str| match bsdf(&format!("<bsdf type='conductor'>{xml}</bsdf>")) {
        Bsdf::Conductor(metal) => [metal.eta, metal.k].map(|part| part.rgb().expect("no curve")),
        other => panic!("{other:?}"),
    };
    assert_eq!(metal("<float name='eta' value='0.2'/>"), [[0.2; 3], [1.0; 3]]);
    assert_eq!(metal("<rgb name='k' value='1 2 3'/>"), [[0.0; 3], [1.0, 2.0, 3.0]]);
    let gold = metal("<string name='material' value='au'/>");
    assert!(gold[0][2] > gold[0][0] && gold[1][0] > gold[1][2], "gold reflects red better than blue: {gold:?}");
}

#[test]
fn plates_coats_masks_and_transmitters() {
    let thin = Bsdf::ThinDielectric { relative_index: 1.5, specular: [WHITE; 2] };
    let air = "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>";
    assert_eq!(bsdf(&format!("<bsdf type='thindielectric'>{air}</bsdf>")), thin);
    let plastic = |nonlinear| Bsdf::Plastic {
        reflectance: Spectrum::Uniform(0.5),
        specular_reflectance: WHITE,
        relative_index: 1.5,
        nonlinear,
    };
    assert_eq!(bsdf(&format!("<bsdf type='plastic'>{air}</bsdf>")), plastic(false));
    let nonlinear = "<boolean name='nonlinear' value='true'/>";
    assert_eq!(bsdf(&format!("<bsdf type='plastic'>{air}{nonlinear}</bsdf>")), plastic(true));
    let mask = |opacity| Bsdf::Mask { opacity, surface: Box::new(diffuse(0.5)) };
    assert_eq!(bsdf("<bsdf type='mask'><bsdf type='diffuse'/></bsdf>"), mask(0.5));
    let third = "<bsdf type='mask'><float name='opacity' value='0.3'/><bsdf type='diffuse'/></bsdf>";
    assert_eq!(bsdf(third), mask(0.3));
    let paper = "<bsdf type='diffusetransmitter'><float name='reflectance' value='0.6'/>
        <float name='transmittance' value='0.4'/></bsdf>";
    assert_eq!(
        bsdf(paper),
        Bsdf::Transmitter { reflectance: Spectrum::Uniform(0.6), transmittance: Spectrum::Uniform(0.4) }
    );
    assert_eq!(bsdf("<bsdf type='null'/>"), Bsdf::Null);
}

#[test]
fn masks_in_masks_multiply_and_take_grey_colours() {
    let mask = |opacity| Bsdf::Mask { opacity, surface: Box::new(diffuse(0.5)) };
    let of = |opacity: &str, inside: &str| bsdf(&format!("<bsdf type='mask'>{opacity}{inside}</bsdf>"));
    let matte = "<bsdf type='diffuse'/>";
    assert_eq!(of("<rgb name='opacity' value='0.3'/>", matte), mask(0.3));
    assert_eq!(of("<spectrum name='opacity' value='0.3'/>", matte), mask(0.3));
    let inner = format!("<bsdf type='mask'>{matte}</bsdf>");
    assert_eq!(of("<float name='opacity' value='0.5'/>", &inner), mask(0.25));
    assert_eq!(of("", "<bsdf type='null'/>"), Bsdf::Null);
}

#[test]
fn a_roughness_by_direction_may_be_the_same_in_both() {
    let metal = |alpha: &str| bsdf(&format!("<bsdf type='roughconductor'>{alpha}</bsdf>"));
    let both = "<float name='alpha_u' value='0.3'/><float name='alpha_v' value='0.3'/>";
    assert_eq!(metal(both), metal("<float name='alpha' value='0.3'/>"));
}

#[test]
fn twosided_shows_a_front_on_each_side() {
    let grey = |value: f64| format!("<bsdf type='diffuse'><float name='reflectance' value='{value}'/></bsdf>");
    let two = |front: f64, back: f64| Bsdf::TwoSided { front: Box::new(diffuse(front)), back: Box::new(diffuse(back)) };
    assert_eq!(bsdf(&format!("<bsdf type='twosided'>{}</bsdf>", grey(0.1))), two(0.1, 0.1));
    assert_eq!(bsdf(&format!("<bsdf type='twosided'>{}{}</bsdf>", grey(0.1), grey(0.2))), two(0.1, 0.2));
    // Checked against Mitsuba 3.9.1: a twosided inside shows its front.
    let inner = format!("<bsdf type='twosided'>{}{}</bsdf>", grey(0.2), grey(0.3));
    assert_eq!(bsdf(&format!("<bsdf type='twosided'>{}{inner}</bsdf>", grey(0.1))), two(0.1, 0.2));
}

#[test]
fn a_ref_stands_for_an_earlier_bsdf() {
    let scene = scene(
        "<bsdf type='diffuse' id='a'><float name='reflectance' value='0.1'/></bsdf>
         <bsdf type='twosided' id='b'><ref id='a'/></bsdf>
         <shape type='cube'><ref id='a'/></shape>
         <shape type='cube'><ref name='bsdf' id='b'/></shape>
         <shape type='cube'><bsdf type='conductor' id='c'/></shape>
         <shape type='cube'><ref id='c'/></shape>",
    );
    let both = Bsdf::TwoSided { front: Box::new(diffuse(0.1)), back: Box::new(diffuse(0.1)) };
    let mirror = Bsdf::Mirror { reflectance: WHITE };
    let found: Vec<Bsdf> = scene.shapes.into_iter().map(|shape| shape.bsdf).collect();
    assert_eq!(found, [diffuse(0.1), both, mirror.clone(), mirror]);
}

#[test]
fn a_ref_may_stand_before_what_it_names() {
    let scene = scene(
        "<shape type='cube'><ref id='both'/><ref name='interior' id='fog'/></shape>
         <bsdf type='twosided' id='both'><ref id='white'/></bsdf>
         <bsdf type='diffuse' id='white'><float name='reflectance' value='0.9'/></bsdf>
         <medium type='homogeneous' id='fog'/>
         <shape type='cube'><ref name='exterior' id='fog'/></shape>",
    );
    let both = Bsdf::TwoSided { front: Box::new(diffuse(0.9)), back: Box::new(diffuse(0.9)) };
    assert_eq!(scene.shapes[0].bsdf, both);
    assert_eq!(scene.media.len(), 1, "read once");
    assert_eq!(scene.shapes[0].boundary.map(|sides| (sides.interior, sides.exterior)), Some((Some(0), None)));
    assert_eq!(scene.shapes[1].boundary.map(|sides| (sides.interior, sides.exterior)), Some((None, Some(0))));
}

#[test]
fn lamps_have_positions_directions_and_strengths() {
    let scene = scene(
        "<emitter type='point' id='p'><transform name='to_world'><scale value='2'/><translate x='1'/></transform>
           <float name='intensity' value='3'/></emitter>
         <emitter type='directional'><transform name='to_world'><rotate x='1' angle='180'/></transform></emitter>
         <emitter type='directional'><vector name='direction' value='3 0 -4'/>
           <spectrum name='irradiance' value='0'/></emitter>
         <shape type='rectangle'><emitter type='area'><rgb name='radiance' value='1 2 3'/></emitter></shape>",
    );
    let directional = |number: usize, direction, irradiance| Emitter::Directional {
        id: format!("emitter-{number}"),
        direction,
        irradiance: Spectrum::Uniform(irradiance),
    };
    assert_eq!(
        scene.emitters[0],
        Emitter::Point {
            id: "p".to_owned(),
            position: DVec3::X,
            intensity: Spectrum::Uniform(3.0),
            pattern: Pattern::Isotropic,
            medium: None
        }
    );
    assert_eq!(scene.emitters[1], directional(1, DVec3::NEG_Z, 1.0));
    assert_eq!(scene.emitters[2], directional(2, DVec3::new(0.6, 0.0, -0.8), 0.0));
    assert_eq!(scene.shapes[0].radiance, Some(Spectrum::Rgb([1.0, 2.0, 3.0])));
}

#[test]
fn directions_of_any_length_are_directions() {
    for length in ["e-300", "e-9", "e100", "e300"] {
        let direction = format!("<vector name='direction' value='3{length} 0 -4{length}'/>");
        let scene = scene(&format!("<emitter type='directional'>{direction}</emitter>"));
        let Emitter::Directional { direction, .. } = &scene.emitters[0] else { panic!("{length}") };
        assert!((*direction - DVec3::new(0.6, 0.0, -0.8)).length() < 1e-15, "{length}: {direction}");
    }
}

fn camera(inside: &str, width: u32, height: u32) -> Camera {
    let body = format!(
        "<sensor type='perspective'>{inside}<film type='hdrfilm'><integer name='width' value='{width}'/>
         <integer name='height' value='{height}'/></film></sensor>"
    );
    match scene(&body).sensors.remove(0).receiver {
        Receiver::Camera(camera) => camera,
        Receiver::Meter(meter) => panic!("{meter:?}"),
    }
}

/// The fields of view along x that Mitsuba 3.9.1 prints.
#[test]
fn fields_of_view_are_mitsubas() {
    for (inside, width, height, degrees) in [
        ("", 768, 576, 38.1848),
        ("", 300, 100, 44.6327),
        ("<string name='focal_length' value='50mm'/>", 768, 576, 38.1848),
        ("<string name='focal_length' value='50'/>", 768, 576, 38.1848),
        ("<string name='focal_length' value='50 mm'/>", 768, 576, 38.1848),
        ("<float name='fov' value='60'/>", 300, 100, 60.0),
        ("<float name='fov' value='60'/><string name='fov_axis' value='x'/>", 300, 100, 60.0),
        ("<float name='fov' value='60'/><string name='fov_axis' value='larger'/>", 300, 100, 60.0),
        ("<float name='fov' value='60'/><string name='fov_axis' value='smaller'/>", 300, 100, 120.0),
        ("<float name='fov' value='60'/><string name='fov_axis' value='y'/>", 300, 100, 120.0),
        ("<float name='fov' value='60'/><string name='fov_axis' value='diagonal'/>", 300, 100, 57.421),
        ("<float name='fov' value='60'/><string name='fov_axis' value='smaller'/>", 100, 300, 60.0),
    ] {
        let camera = camera(inside, width, height);
        let found = 2.0 * camera.tan_half_width.atan().to_degrees();
        assert!((found - degrees).abs() < 1e-4, "{inside}: {found}");
        let aspect = f64::from(width) / f64::from(height);
        assert!((camera.tan_half_width / camera.tan_half_height / aspect - 1.0).abs() < 1e-15);
    }
}

/// Mitsuba 3.9.1 looks through these pixels' corners in these directions.
#[test]
fn a_crop_is_a_part_of_the_film() {
    let crop = "<sensor type='perspective'><float name='fov' value='40'/>
        <float name='principal_point_offset_x' value='0.2'/><float name='principal_point_offset_y' value='-0.15'/>
        <film type='hdrfilm'><integer name='width' value='60'/><integer name='height' value='40'/>
        <integer name='crop_width' value='24'/><integer name='crop_height' value='20'/>
        <integer name='crop_offset_x' value='10'/><integer name='crop_offset_y' value='15'/></film></sensor>";
    let sensor = scene(crop).sensors.remove(0);
    let Receiver::Camera(camera) = sensor.receiver else { panic!("a camera") };
    assert_eq!(sensor.film, Film { width: 24, height: 20 });
    let along = |axis: usize, place: f64| {
        let tangent = [camera.tan_half_width, camera.tan_half_height][axis];
        (1.0 - 2.0 * (place + camera.principal_point_offset[axis])) * tangent
    };
    for (place, [x, y]) in [(0.0, [0.097059, 0.133456]), (0.5, [-0.048529, 0.012132]), (1.0, [-0.194117, -0.109191])] {
        assert!((along(0, place) - x).abs() < 1e-6 && (along(1, place) - y).abs() < 1e-6, "{place}");
    }
}

#[test]
fn cameras_have_mitsubas_defaults() {
    let plain = camera("", 10, 10);
    assert_eq!((plain.near_clip, plain.far_clip, plain.principal_point_offset), (0.01, 10000.0, [0.0; 2]));
    let shifted = camera(
        "<float name='principal_point_offset_y' value='-0.25'/><float name='shutter_open' value='0'/>
         <transform name='to_world'><scale x='-1'/></transform>",
        10,
        10,
    );
    assert_eq!(shifted.principal_point_offset, [0.0, -0.25]);
    assert_eq!(shifted.to_world.matrix3.x_axis, DVec3::NEG_X);
}

#[test]
fn radiancemeters_look_along_z_or_a_direction() {
    let meter = |inside: &str| match scene(&format!("<sensor type='radiancemeter'>{inside}</sensor>")).sensors.remove(0)
    {
        photonlab_scene::Sensor { receiver: Receiver::Meter(Meter::Radiancemeter { origin, direction }), .. } => {
            (origin, direction)
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(meter(""), (DVec3::ZERO, DVec3::Z));
    let stated = "<point name='origin' value='1 2 3'/><vector name='direction' x='0' y='-9' z='0'/>";
    assert_eq!(meter(stated), (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Y));
    let moved = "<transform name='to_world'><scale value='7'/><rotate y='1' angle='90'/><translate z='1'/></transform>";
    assert_eq!(meter(moved), (DVec3::Z, DVec3::X));
}

/// Mitsuba 3.9.1 focuses on the far clipping plane unless told otherwise, and a pinhole takes no notice of a focus.
#[test]
fn lenses_have_mitsubas_defaults() {
    let lens = |inside: &str| {
        let radius = "<float name='aperture_radius' value='0.2'/>";
        let scene = scene(&format!("<sensor type='thinlens'>{radius}{inside}</sensor>"));
        let Receiver::Camera(camera) = &scene.sensors[0].receiver else { panic!("no camera") };
        camera.lens.expect("a lens")
    };
    for (inside, focus_distance) in [
        ("", 10000.0),
        ("<float name='far_clip' value='50'/>", 50.0),
        ("<float name='far_clip' value='50'/><float name='focus_distance' value='3'/>", 3.0),
    ] {
        assert_eq!(lens(inside), photonlab_scene::Lens { aperture_radius: 0.2, focus_distance });
    }
    let pinhole = scene("<sensor type='perspective'><float name='focus_distance' value='3'/></sensor>");
    assert!(pinhole.notes[0].starts_with("focus_distance has no effect"), "{:?}", pinhole.notes);
}

#[test]
fn distant_meters_have_targets() {
    use photonlab_scene::{Bsdf, DistantTarget, Meter};
    for (inside, direction, target) in [
        ("", DVec3::Z, DistantTarget::Whole),
        ("<vector name='direction' value='0 -2 0'/>", DVec3::NEG_Y, DistantTarget::Whole),
        (
            "<transform name='to_world'><rotate x='1' angle='180'/></transform><point name='target' value='1 2 3'/>",
            DVec3::NEG_Z,
            DistantTarget::Point(DVec3::new(1.0, 2.0, 3.0)),
        ),
        ("<shape name='target' type='sphere'/>", DVec3::Z, DistantTarget::Shape(1)),
    ] {
        let scene = scene(&format!("<shape type='cube'/><sensor type='distant'>{inside}</sensor><shape type='cube'/>"));
        let Receiver::Meter(Meter::Distant { direction: along, target: found }) = &scene.sensors[0].receiver else {
            panic!("no distant meter")
        };
        assert!((*along - direction).length() < 1e-12);
        assert_eq!(*found, target);
        assert!(target != DistantTarget::Shape(1) || scene.shapes[1].bsdf == Bsdf::Null);
    }
}
