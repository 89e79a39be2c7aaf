//! Meshes from files, whole and broken.

use glam::DVec3;
use photonlab_scene::{Geometry, Mesh, Ray, Scene, SurfacePoint, World, read::read_scene};

const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n";

/// The scene of one mesh in a file of this name and content, with more in its element.
fn read(name: &str, content: &[u8], inside: &str) -> Result<Scene, String> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), content).expect("written");
    let kind = name.split('.').next_back().expect("an ending");
    let xml = format!(
        "<scene version='3.0.0'>\n<shape type='{kind}'><string name='filename' value='{name}'/>{inside}</shape></scene>"
    );
    let path = folder.path().join("main.xml");
    std::fs::write(&path, xml).expect("written");
    read_scene(&path, &[]).map_err(|error| error.to_string())
}

fn mesh(scene: &Scene) -> &Mesh {
    let Geometry::Mesh(mesh) = &scene.shapes[0].geometry else { panic!("{:?}", scene.shapes[0].geometry) };
    mesh
}

fn front(scene: Scene) -> DVec3 {
    let world = World::new(scene);
    let SurfacePoint { normal, .. } = world.point_in_cell(0, [0, 0], [1, 1], [0.2, 0.2, 0.5]);
    normal
}

/// A binary PLY of the same square, big or little endian.
fn binary(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for [x, y] in [[0f32, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]] {
        for number in [x, y, 0.0] {
            bytes.extend(if big { number.to_be_bytes() } else { number.to_le_bytes() });
        }
        bytes.push(200);
    }
    bytes.push(4);
    for index in 0..4i32 {
        bytes.extend(if big { index.to_be_bytes() } else { index.to_le_bytes() });
    }
    bytes
}

#[test]
fn every_format_gives_the_same_square() {
    let ascii = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty double x\nproperty double y\n\
        property double z\nelement face 2\nproperty list uchar uint vertex_index\nend_header\n\
        0 0 0\n2 0 0\n2 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
    let files: [(&str, Vec<u8>); 4] =
        [("a.obj", SQUARE.into()), ("a.ply", ascii.into()), ("little.ply", binary(false)), ("big.ply", binary(true))];
    for (name, content) in files {
        let scene = read(name, &content, "").unwrap_or_else(|error| panic!("{error}"));
        assert!(scene.notes.is_empty(), "{:?}", scene.notes);
        assert_eq!(mesh(&scene).faces.len(), 2, "{name}");
        let world = World::new(scene);
        assert!((world.area_of(0) - 2.0).abs() < 1e-12, "{name}");
        assert_eq!(world.bounds(), (DVec3::ZERO, DVec3::new(2.0, 1.0, 0.0)));
    }
}

/// The order of the corners tells the front, unless the file has normals; `flip_normals` turns it.
#[test]
fn the_front_is_where_normals_point() {
    let down = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1 4//1\n";
    let turn = "<transform name='to_world'><rotate x='1' angle='90'/></transform>";
    let mirror = "<transform name='to_world'><scale x='-1' y='1' z='1'/></transform>";
    let flip = "<boolean name='flip_normals' value='true'/>";
    let face = "<boolean name='face_normals' value='true'/>";
    for (content, inside, expected) in [
        (SQUARE, "", DVec3::Z),
        (SQUARE, flip, DVec3::NEG_Z),
        (SQUARE, turn, DVec3::NEG_Y),
        (SQUARE, mirror, DVec3::NEG_Z),
        (down, "", DVec3::NEG_Z),
        (down, face, DVec3::Z),
        (down, mirror, DVec3::NEG_Z),
    ] {
        let normal = front(read("a.obj", content.as_bytes(), inside).unwrap_or_else(|error| panic!("{error}")));
        assert!((normal - expected).length() < 1e-12, "{content} {inside}: {normal}");
    }
}

#[test]
fn what_is_left_out_is_said() {
    let thin = format!("{SQUARE}f 1 2 2\n");
    let notes = read("a.obj", thin.as_bytes(), "").unwrap().notes;
    assert!(notes.iter().any(|note| note.contains("1 faces without area")), "{notes:?}");
    let bent = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";
    let notes = read("a.obj", bent.as_bytes(), "").unwrap().notes;
    assert!(notes.iter().any(|note| note.contains("it has no normals")), "{notes:?}");
    let down = "v 0 0 0\nv 2 0 0\nv 2 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";
    let notes = read("a.obj", down.as_bytes(), "").unwrap().notes;
    assert!(notes.iter().any(|note| note.contains("1 faces are turned around")), "{notes:?}");
    let flat = read("a.obj", bent.as_bytes(), "<boolean name='face_normals' value='true'/>").unwrap();
    assert!(flat.notes.is_empty(), "{:?}", flat.notes);
}

/// Where Mitsuba 3.9.1 says that the surface faces, with its own normals and with those that it makes.
#[test]
fn smooth_normals_are_mitsubas() {
    let bent = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n";
    let own = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 -1\nvn 0.3 0 -1\nvn 0 0.2 -1\nf 1//1 2//2 3//3\n";
    let mirror = "<transform name='to_world'><scale x='-1' y='1' z='1'/></transform>";
    let flip = "<boolean name='flip_normals' value='true'/>";
    let face = "<boolean name='face_normals' value='true'/>";
    let made = DVec3::new(0.0, -0.305102, 0.95232);
    let given = DVec3::new(0.0873349, 0.0596064, -0.994394);
    for (content, inside, [x, y], expected) in [
        (bent, "", [0.3, 0.6], made),
        (bent, flip, [0.3, 0.6], -made),
        (bent, mirror, [-0.3, 0.6], -made),
        (bent, face, [0.3, 0.6], DVec3::Z),
        (own, "", [0.6, 0.3], given),
        (own, mirror, [-0.6, 0.3], given * DVec3::new(-1.0, 1.0, 1.0)),
        (own, face, [0.6, 0.3], DVec3::Z),
    ] {
        let world = World::new(read("a.obj", content.as_bytes(), inside).unwrap_or_else(|error| panic!("{error}")));
        let ray = Ray::new(DVec3::new(x, y, 2.0), DVec3::NEG_Z);
        let point = world.cast(&ray, None, f64::INFINITY).expect("it is there").point;
        assert!((point.shading - expected).length() < 2e-6, "{inside}: {} for {expected}", point.shading);
        assert!(point.shading.dot(point.normal) > 0.0);
    }
}

/// Groups part no corners, seams of a texture do, and corners can be counted from the end: the normals that Mitsuba 3.9.1
/// makes (it reads no negative numbers).
#[test]
fn corners_are_told_apart_as_by_mitsuba() {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\n";
    let grouped =
        format!("# a roof\nmtllib none.mtl\no roof\n{corners}g one\nusemtl red\nf 1 2 3 # and\ng two\ns 1\nf 1 3 4\n");
    let from_the_end = format!("{corners}f -4 -3 -2\nf -4 -2 -1\n");
    let seam = format!("{corners}vt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.5\nf 1/1 2/2 3/3\nf 1/4 3/3 4/1\n");
    let (shared, parted) = ([0.37, -0.37, 0.852], [0.0, 0.0, 1.0]);
    for (content, first) in [(grouped, shared), (from_the_end, shared), (seam, parted)] {
        let scene = read("a.obj", content.as_bytes(), "").unwrap_or_else(|error| panic!("{error}"));
        let smooth = mesh(&scene).smooth.as_ref().expect("smooth normals are made");
        let of = |face: usize, corner: usize| smooth.normals[smooth.corners[face][corner] as usize];
        let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-3);
        assert!(near(of(0, 0), first), "{content}: {:?}", of(0, 0));
        assert!(near(of(0, 2), shared), "{content}: {:?}", of(0, 2));
    }
}

#[test]
fn broken_meshes_are_refused() {
    let header = |vertices: &str, faces: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
             element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let three = "0 0 0\n1 0 0\n0 1 0\n";
    for (name, content, fragment) in [
        ("a.obj", String::new(), "no face with an area"),
        ("a.obj", "v 0 0\nf 1 1 1\n".into(), "no valid OBJ file"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n".into(), "no valid OBJ file"),
        ("a.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".into(), "out of range"),
        ("a.obj", "v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".into(), "out of range"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".into(), "no face with an area"),
        ("a.obj", format!("{SQUARE}vn 0 0 0\nf 1//1 2//1 3//1\n").replace("f 1 2 3 4\n", ""), "a normal that is zero"),
        ("a.obj", format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\n"), "normals in line 7, and one without in line 5"),
        ("a.obj", SQUARE.replace("f 1 2 3 4", "f 1//1 2//1 3//1"), "a face with normals in line 5, but no normals"),
        ("a.obj", format!("{SQUARE}f 1 2\n"), "a face with fewer than three corners in line 6"),
        ("a.ply", "solid".into(), "no valid PLY file"),
        ("a.ply", header("3", "1") + three, "no valid PLY file"),
        ("a.ply", header("3", "1000000000000") + three + "3 0 1 2\n", "no valid PLY file"),
        ("a.ply", header("99999999999999999999999", "1") + three, "no valid PLY file"),
        ("a.ply", header("3", "1") + three + "3 0 1 7\n", "a face with fewer than three corners"),
        ("a.ply", header("3", "1") + three + "3 0 1 -1\n", "a face with fewer than three corners"),
        ("a.ply", header("3", "1") + three + "2 0 1\n", "a face with fewer than three corners"),
        ("a.ply", header("3", "0") + three, "no face with an area"),
    ] {
        let error = read(name, content.as_bytes(), "").expect_err(&content);
        assert!(error.contains(fragment) && error.contains("main.xml:2: string:"), "{content}\n{error}");
    }
}
