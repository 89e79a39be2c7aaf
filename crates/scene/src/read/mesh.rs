//! Meshes from files: `obj` and `ply`.

use std::collections::HashMap;
use std::fs::File;
use std::io::BufReader;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use crate::{Geometry, Mesh, Smooth};

use super::element::Element;
use super::error::{Fault, SceneError};
use super::names::quote;
use super::number::Range;
use super::obj::read_obj;
use super::object::Object;
use super::picture::beside;
use super::ply::read_ply;
use super::scene::Builder;

/// Largest file of a mesh, bytes.
const LARGEST_FILE: u64 = 1 << 32;
/// Square of the distance between a corner's unit normal and its face's up to which they are the same: six digits.
const SAME: f64 = 1e-10;

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
    let made = read.normals.is_none();
    let (mesh, dropped, turned) = placed(read, &to_world, !face_normals).map_err(about)?;
    if dropped > 0 {
        builder.note(&format!("{name}: {dropped} faces without area are left out"));
    }
    if turned > 0 {
        builder.note(&format!(
            "{name}: {turned} faces are turned around, for their front sides are where their normals say"
        ));
    }
    if made && mesh.smooth.is_some() {
        builder.note(&format!(
            "{name}: it has no normals, so smooth ones are made as by Mitsuba; face_normals keeps its faces flat"
        ));
    }
    Ok(Geometry::Mesh(Arc::new(mesh)))
}

fn open(element: &Element, name: &str) -> Result<BufReader<File>, Fault> {
    let path = beside(element, name);
    if !path.is_file() {
        return Err(Fault::new(crate::absent::absent(&path), "name a file, relative to the scene's"));
    }
    let unreadable = |error: std::io::Error| Fault::new(format!("cannot be read: {error}"), "give a readable file");
    let file = File::open(&path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.len() > LARGEST_FILE {
        return Err(Fault::new(format!("has more than {LARGEST_FILE} bytes"), "give a smaller mesh"));
    }
    Ok(BufReader::new(file))
}

/// The mesh in world units; how many faces were left out because they have no area; and how many were turned around. Where a
/// file has normals and they count, they tell the front side.
fn placed(read: Faces, to_world: &DAffine3, corners_count: bool) -> Result<(Mesh, usize, usize), Fault> {
    let Faces { vertices, faces, normals } = read;
    let vertices: Vec<DVec3> = vertices.into_iter().map(|vertex| to_world.transform_point3(vertex)).collect();
    for number in vertices.iter().flat_map(|vertex| vertex.to_array()) {
        Range::COORDINATE.check(number)?;
    }
    if let Some(wrong) = faces.iter().flatten().find(|&&index| index as usize >= vertices.len()) {
        let what = format!("has a face with corner {wrong} of {}", vertices.len());
        return Err(Fault::new(what, "export it again"));
    }
    let to_normals = to_world.matrix3.inverse().transpose();
    let (mut kept, mut turned) = (Vec::with_capacity(faces.len()), 0);
    let mut smooth = Directions::default();
    for (number, &[a, b, c]) in faces.iter().enumerate() {
        let [p, q, r] = [a, b, c].map(|index| vertices[index as usize]);
        let across = (q - p).cross(r - p);
        // Relative to its longest side, so that small meshes are not taken for nothing.
        let longest = (q - p).length_squared().max((r - p).length_squared()).max((r - q).length_squared());
        if across.length() <= 1e-12 * longest || longest == 0.0 {
            continue;
        }
        let Some(normals) = normals.as_ref().filter(|_| corners_count) else {
            kept.push([a, b, c]);
            continue;
        };
        let across = across.normalize();
        let own = normals[number].map(|normal| (to_normals * normal).try_normalize());
        let [Some(i), Some(j), Some(k)] = own else {
            return Err(Fault::new("has a normal that is zero or no number", "export it again, or set face_normals"));
        };
        let against = (i + j + k).dot(across) < 0.0;
        let (face, own) = if against { ([a, c, b], [i, k, j]) } else { ([a, b, c], [i, j, k]) };
        turned += usize::from(against);
        kept.push(face);
        smooth.add(own, if against { -across } else { across });
    }
    if kept.is_empty() {
        return Err(Fault::new("has no face with an area", "give a mesh of at least one"));
    }
    let dropped = faces.len() - kept.len();
    if corners_count && normals.is_none() {
        smooth = averaged(&vertices, &kept);
    }
    let smooth = smooth.bent.then_some(smooth.smooth);
    Ok((Mesh { vertices, faces: kept, smooth }, dropped, turned))
}

/// Normals of corners, equal ones kept once.
#[derive(Default)]
struct Directions {
    smooth: Smooth,
    numbers: HashMap<[u32; 3], u32>,
    /// True if any of them differs from its face's.
    bent: bool,
}

impl Directions {
    fn add(&mut self, own: [DVec3; 3], face: DVec3) {
        self.bent |= own.iter().any(|normal| (*normal - face).length_squared() > SAME);
        let corners = own.map(|normal| {
            let normal = normal.as_vec3().to_array();
            *self.numbers.entry(normal.map(f32::to_bits)).or_insert_with(|| {
                self.smooth.normals.push(normal);
                self.smooth.normals.len() as u32 - 1
            })
        });
        self.smooth.corners.push(corners);
    }
}

/// What Mitsuba makes where a file has no normals: the mean over the faces of a corner, by their angles there (Thürmer and
/// Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998).
fn averaged(vertices: &[DVec3], faces: &[[u32; 3]]) -> Directions {
    let mut sums = vec![DVec3::ZERO; vertices.len()];
    let corners = |face: &[u32; 3]| face.map(|index| vertices[index as usize]);
    let across = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).normalize();
    for face in faces {
        let at = corners(face);
        for corner in 0..3 {
            let [here, next, last] = [0, 1, 2].map(|step| at[(corner + step) % 3]);
            sums[face[corner] as usize] += (next - here).angle_between(last - here) * across(at);
        }
    }
    let mut directions = Directions::default();
    for face in faces {
        let normal = across(corners(face));
        directions.add(face.map(|index| sums[index as usize].try_normalize().unwrap_or(normal)), normal);
    }
    directions
}
