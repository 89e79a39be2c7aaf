//! Structure: ids, defaults, transforms, shapes, integrators, films.

use glam::{DMat3, DVec3};
use photonlab_scene::{Film, Geometry, Meter, Receiver, Shape};

use super::{read_body, scene};

fn shape(inside: &str) -> Shape {
    scene(inside).shapes.remove(0)
}

fn linear(steps: &str) -> glam::DAffine3 {
    let body = format!("<shape type='cube'><transform name='to_world'>{steps}</transform></shape>");
    match shape(&body).geometry {
        Geometry::Cube { to_world } => to_world,
        other => panic!("{other:?}"),
    }
}

#[test]
fn steps_apply_in_the_order_of_the_file() {
    let moved = linear("<scale x='2'/><rotate z='1' angle='90'/><translate x='1' y='2' z='3'/>");
    assert_eq!(moved.transform_point3(DVec3::X), DVec3::new(1.0, 4.0, 3.0));
    let other = linear("<translate value='1, 2, 3'/><rotate value='0 0 5' angle='-270'/><scale value='2'/>");
    assert_eq!(other.transform_point3(DVec3::ZERO), DVec3::new(-4.0, 2.0, 6.0));
}

#[test]
fn a_rotation_about_any_axis_is_rodrigues() {
    let turned = linear("<rotate x='1' y='1' z='1' angle='120'/>");
    assert!((turned.transform_vector3(DVec3::X) - DVec3::Y).length() < 1e-15);
    let expected = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.3f64.to_radians());
    let difference = linear("<rotate value='6 0 8' angle='0.3'/>").matrix3 - expected;
    assert!(difference.to_cols_array().iter().all(|entry| entry.abs() < 1e-15));
}

#[test]
fn a_matrix_is_written_row_by_row() {
    let full = linear("<matrix value='1 2 3 4  0 5 6 7  0 0 8 9  0 0 0 1'/>");
    assert_eq!(full.transform_point3(DVec3::ONE), DVec3::new(10.0, 18.0, 17.0));
    let three = linear("<matrix value='1,2,3, 0,5,6, 0,0,8'/>");
    assert_eq!(three.transform_point3(DVec3::ONE), DVec3::new(6.0, 11.0, 8.0));
}

#[test]
fn a_lookat_without_up_takes_mitsubas() {
    // Mitsuba 3.9.1 prints these columns for a target along +z.
    let frame = linear("<lookat origin='0 0 0' target='0 0 1'/>");
    assert_eq!(frame.matrix3, DMat3::from_cols(DVec3::NEG_Y, DVec3::X, DVec3::Z));
}

#[test]
fn a_sphere_combines_transform_centre_and_radius() {
    let Geometry::Sphere { centre, radius, to_world } = shape(
        "<shape type='sphere'><point name='center' x='1' y='0' z='0'/><float name='radius' value='0.5'/>
         <transform name='to_world'><rotate z='1' angle='90'/><scale value='4'/><translate z='1'/></transform></shape>",
    )
    .geometry
    else {
        panic!("no sphere")
    };
    assert_eq!((centre, radius), (DVec3::new(0.0, 4.0, 1.0), 2.0));
    assert_eq!(to_world, DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z));
}

#[test]
fn a_mirror_turns_a_spheres_normals_as_in_mitsuba() {
    let flip = |steps: &str, flip: &str| {
        let body = format!(
            "<shape type='sphere'><boolean name='flip_normals' value='{flip}'/>
             <transform name='to_world'>{steps}</transform></shape>"
        );
        let shape = shape(&body);
        let Geometry::Sphere { radius, to_world, .. } = shape.geometry else { panic!("no sphere") };
        assert_eq!(radius, 1.0);
        (shape.flip_normals, to_world.determinant())
    };
    assert_eq!(flip("<scale x='-1'/>", "false"), (true, -1.0));
    assert_eq!(flip("<scale x='-1'/>", "true"), (false, -1.0));
    assert_eq!(flip("<scale x='-1' y='-1'/>", "false"), (false, 1.0));
}

#[test]
fn six_digits_of_a_rotation_are_enough_for_a_sphere() {
    let Geometry::Sphere { radius, to_world, .. } = shape(
        "<shape type='sphere'><transform name='to_world'>
         <matrix value='0.286891 0 -0.0877115 0 0 0.3 0 0 0.0877115 0 0.286891 0 0 0 0 1'/></transform></shape>",
    )
    .geometry
    else {
        panic!("no sphere")
    };
    assert!((radius - 0.3).abs() < 1e-6);
    let error = to_world.transpose() * to_world - DMat3::IDENTITY;
    assert!(error.to_cols_array().iter().all(|entry| entry.abs() < 1e-15), "{error}");
}

#[test]
fn ids_are_kept_or_counted() {
    let scene = scene(
        "<shape type='cube'/><shape type='cube' id='box'><sensor type='irradiancemeter'/></shape>
         <shape type='cube'><sensor type='irradiancemeter' id='m'><film type='hdrfilm'>
         <integer name='width' value='4'/><integer name='height' value='2'/></film></sensor></shape>
         <sensor type='perspective'/>",
    );
    let shapes: Vec<&str> = scene.shapes.iter().map(|shape| shape.id.as_str()).collect();
    assert_eq!(shapes, ["shape-0", "box", "shape-2"]);
    let sensors: Vec<(&str, Film)> = scene.sensors.iter().map(|sensor| (sensor.id.as_str(), sensor.film)).collect();
    let film = |width, height| Film { width, height };
    assert_eq!(sensors, [("sensor-0", film(1, 1)), ("m", film(4, 2)), ("sensor-2", film(768, 576))]);
    let Receiver::Meter(Meter::Irradiancemeter { shape }) = scene.sensors[1].receiver else { panic!("no meter") };
    assert_eq!(shape, 2);
}

#[test]
fn defaults_work_in_the_order_of_the_file() {
    let body = "<default name='r' value='2'/><default name='long-r' value='$r.5'/><default name='r' value='9'/>
        <default name='kind' value='sphere'/>
        <shape type='$kind'><float name='radius' value='$long-r'/></shape>";
    let radius = |defines: &[(&str, &str)]| match read_body(body, defines).expect("right").shapes[0].geometry {
        Geometry::Sphere { radius, .. } => radius,
        _ => panic!("no sphere"),
    };
    assert_eq!(radius(&[]), 2.5);
    assert_eq!(radius(&[("r", "3")]), 3.5);
    assert_eq!(radius(&[("long-r", "7"), ("r", "3")]), 7.0);
    let notes = read_body(body, &[]).expect("right").notes;
    assert_eq!(notes, ["test.xml:2: default \"r\" keeps its first value \"2\""]);
    assert_eq!(read_body(body, &[("r", "3")]).expect("right").notes, [""; 0]);
}

#[test]
fn what_the_caller_gives_needs_no_default() {
    let body = "<shape type='sphere'><float name='radius' value='$r'/></shape>";
    let Geometry::Sphere { radius, .. } = read_body(body, &[("r", "3")]).expect("right").shapes[0].geometry else {
        panic!("no sphere")
    };
    assert_eq!(radius, 3.0);
    assert!(read_body(body, &[]).expect_err("unknown").to_string().contains("\"$r\" has no default before this line"));
    let unused = read_body(body, &[("r", "3"), ("q", "1")]).expect_err("unused").to_string();
    assert!(unused.contains("-D \"q\" names no default"), "{unused}");
}

#[test]
fn version_two_is_read_like_three() {
    let text = "<scene version='2.1.0'><shape type='sphere'/></scene>";
    assert_eq!(photonlab_scene::read::read_scene_str(text, "t", &[]).expect("right").shapes.len(), 1);
}

#[test]
fn cameras_can_be_told_to_see_no_lamps() {
    let hidden = scene("<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>");
    assert!(hidden.hides_lamps);
    assert_eq!(hidden.notes, ["integrator path is superseded by --method; its hide_emitters is obeyed by cameras"]);
}

#[test]
fn integrators_are_superseded_and_their_depth_obeyed() {
    let integrator = |inside: &str| scene(&format!("<integrator type='volpath'>{inside}</integrator>"));
    assert_eq!(integrator("").max_depth, None);
    assert_eq!(integrator("<integer name='max_depth' value='-1'/>").max_depth, None);
    let deep = integrator("<integer name='max_depth' value='7'/><integer name='rr_depth' value='5'/>");
    assert_eq!(deep.max_depth, Some(7));
    let note = "integrator volpath is superseded by --method; its max_depth is obeyed; not used: rr_depth";
    assert_eq!(deep.notes, [note]);
}

#[test]
fn what_a_film_asks_of_its_output_is_noted() {
    let scene = scene(
        "<sensor type='perspective'><film type='hdrfilm'><string name='pixel_format' value='rgba'/>
         <rfilter type='gaussian'/></film></sensor>",
    );
    assert_eq!(scene.notes.len(), 2);
    assert!(scene.notes[0].contains("R G B") && scene.notes[1].contains("\"gaussian\""), "{:?}", scene.notes);
}

#[test]
fn comments_instructions_and_character_references_are_fine() {
    let text = "\u{feff}<?xml version='1.0' encoding='utf-8'?>\r\n<!-- <shape> $x & -->\r\n<scene version='3.9.1'>\r\n\
        <?editor fold?><shape type='cube' id='a&amp;b'><!-- c --></shape><![CDATA[ ]]></scene><!-- end -->\n";
    let scene = photonlab_scene::read::read_scene_str(text, "t", &[]).expect("right");
    assert_eq!(scene.shapes[0].id, "a&b");
}
