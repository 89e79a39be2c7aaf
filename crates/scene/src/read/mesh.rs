//! Meshes from files: `obj` and `ply`.

use std::fs::File;
use std::io::BufReader;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use crate::{Geometry, Mesh};

use super::element::Element;
use super::error::{Fault, SceneError};
use super::names::quote;
use super::number::Range;
use super::object::Object;
use super::picture::beside;
use super::ply::read_ply;
use super::scene::Builder;

/// Largest file of a mesh, bytes.
const LARGEST_FILE: u64 = 1 << 32;
/// Cosine between a corner's own normal and its face's below which shading by the corner's would look different.
const FLAT: f64 = 0.999;

/// Corners, faces and, where the file has them, a normal for each corner of each face.
pub(super) struct Faces {
    pub(super) vertices: Vec<DVec3>,
    pub(super) faces: Vec<[u32; 3]>,
    pub(super) normals: Option<Vec<[DVec3; 3]>>,
}

/// Reads the file that the object names and puts its mesh into the world.
pub(super) fn mesh(object: &mut Object, builder: &mut Builder) -> Result<Geometry, SceneError> {
    let file = object.take("filename", &["string"])?;
    let face_normals = object.boolean("face_normals")?.unwrap_or(false);
    object.boolean("flip_tex_coords")?;
    let to_world = object.transform()?.unwrap_or(DAffine3::IDENTITY);
    let element = object.element;
    let file =
        file.ok_or_else(|| element.error(format!("{} has no filename", object.plugin), "name a file of a mesh"))?;
    let name = file.required("value");
    let about = |fault: Fault| file.error(format!("{} {}", quote(name), fault.what), fault.mend);
    let reader = open(file, name).map_err(about)?;
    let read = if object.plugin == "obj" { read_obj(reader) } else { read_ply(reader) }.map_err(about)?;
    let (mesh, dropped, smooth) = placed(read, &to_world, !face_normals).map_err(about)?;
    if dropped > 0 {
        builder.note(&format!("{name}: {dropped} faces without area are left out"));
    }
    if smooth {
        builder.note(&format!(
            "{name}: normals between the corners are not interpolated yet: faces are flat, as with face_normals"
        ));
    }
    Ok(Geometry::Mesh(Arc::new(mesh)))
}

fn open(element: &Element, name: &str) -> Result<BufReader<File>, Fault> {
    let path = beside(element, name);
    if !path.is_file() {
        return Err(Fault::new("is not there", "name a file, relative to the scene's"));
    }
    let unreadable = |error: std::io::Error| Fault::new(format!("cannot be read: {error}"), "give a readable file");
    let file = File::open(&path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.len() > LARGEST_FILE {
        return Err(Fault::new(format!("has more than {LARGEST_FILE} bytes"), "give a smaller mesh"));
    }
    Ok(BufReader::new(file))
}

fn read_obj(mut reader: BufReader<File>) -> Result<Faces, Fault> {
    let options =
        tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..Default::default() };
    // Materials are given in the scene.
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut reader, &options, no_materials)
        .map_err(|error| Fault::new(format!("is no valid OBJ file: {error}"), "export it again"))?;
    let has_normals = models.iter().all(|model| !model.mesh.normal_indices.is_empty());
    let mut all = Faces { vertices: Vec::new(), faces: Vec::new(), normals: has_normals.then(Vec::new) };
    for mesh in models.into_iter().map(|model| model.mesh) {
        let first = all.vertices.len() as u32;
        let triple = |list: &[f64], index: u32| DVec3::from_slice(&list[3 * index as usize..][..3]);
        all.vertices.extend((0..mesh.positions.len() as u32 / 3).map(|index| triple(&mesh.positions, index)));
        all.faces.extend(mesh.indices.as_chunks().0.iter().map(|face: &[u32; 3]| face.map(|index| first + index)));
        if let Some(normals) = &mut all.normals {
            let corners = |face: &[u32; 3]| face.map(|index| triple(&mesh.normals, index));
            normals.extend(mesh.normal_indices.as_chunks().0.iter().map(corners));
        }
    }
    Ok(all)
}

/// The mesh in world units; how many faces were left out because they have no area; and whether corners have normals of their
/// own that differ from their faces'. Where a file has normals, they tell the front side.
fn placed(read: Faces, to_world: &DAffine3, corners_count: bool) -> Result<(Mesh, usize, bool), Fault> {
    let Faces { vertices, faces, normals } = read;
    let vertices: Vec<DVec3> = vertices.into_iter().map(|vertex| to_world.transform_point3(vertex)).collect();
    for number in vertices.iter().flat_map(|vertex| vertex.to_array()) {
        Range::COORDINATE.check(number)?;
    }
    if let Some(wrong) = faces.iter().flatten().find(|&&index| index as usize >= vertices.len()) {
        let what = format!("has a face with corner {wrong} of {}", vertices.len());
        return Err(Fault::new(what, "export it again"));
    }
    let turned = to_world.matrix3.inverse().transpose();
    let (mut kept, mut smooth) = (Vec::with_capacity(faces.len()), normals.is_none() && corners_count);
    for (number, &[a, b, c]) in faces.iter().enumerate() {
        let [p, q, r] = [a, b, c].map(|index| vertices[index as usize]);
        let across = (q - p).cross(r - p);
        // Relative to its longest side, so that small meshes are not taken for nothing.
        let longest = (q - p).length_squared().max((r - p).length_squared()).max((r - q).length_squared());
        if across.length() <= 1e-12 * longest || longest == 0.0 {
            continue;
        }
        let mut face = [a, b, c];
        if let Some(normals) = normals.as_ref().filter(|_| corners_count) {
            let across = across.normalize();
            let own = normals[number].map(|normal| (turned * normal).normalize_or_zero());
            if own.iter().sum::<DVec3>().dot(across) < 0.0 {
                face = [a, c, b];
            }
            smooth |= own.iter().any(|normal| normal.dot(across).abs() < FLAT);
        }
        kept.push(face);
    }
    if kept.is_empty() {
        return Err(Fault::new("has no face with an area", "give a mesh of at least one"));
    }
    let dropped = faces.len() - kept.len();
    let mesh = Mesh { vertices, faces: kept };
    // Without normals in the file Mitsuba makes some, which differ from the faces' wherever neighbours bend.
    let smooth = smooth && (normals.is_some() || mesh.bends());
    Ok((mesh, dropped, smooth))
}
