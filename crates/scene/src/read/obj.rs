//! OBJ files.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};

use glam::DVec3;

use super::error::Fault;
use super::mesh::Faces;

/// Reads a mesh; polygons are cut into fans.
///
/// As in Mitsuba, a corner is one where its place and its texture coordinate are: groups and materials part nothing, seams
/// of a texture do, and smooth normals are made accordingly.
pub(super) fn read_obj(reader: BufReader<File>) -> Result<Faces, Fault> {
    let lines = geometry_lines(reader)?;
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut lines.as_slice(), &options, no_materials)
        .map_err(|error| Fault::new(format!("is no valid OBJ file: {error}"), "export it again"))?;
    // Without groups there is one model, or none.
    let mesh = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    let triple = |list: &[f64], index: u32| DVec3::from_slice(&list[3 * index as usize..][..3]);
    let (mut vertices, mut faces, mut numbers) =
        (Vec::new(), Vec::with_capacity(mesh.indices.len() / 3), HashMap::new());
    for (number, face) in mesh.indices.as_chunks::<3>().0.iter().enumerate() {
        faces.push([0, 1, 2].map(|corner| {
            let texture = mesh.texcoord_indices.get(3 * number + corner).copied();
            *numbers.entry((face[corner], texture)).or_insert_with(|| {
                vertices.push(triple(&mesh.positions, face[corner]));
                vertices.len() as u32 - 1
            })
        }));
    }
    let corners = |face: &[u32; 3]| face.map(|index| triple(&mesh.normals, index));
    let normals = mesh.normal_indices.as_chunks().0;
    let normals = (!normals.is_empty()).then(|| normals.iter().map(corners).collect());
    Ok(Faces { vertices, faces, normals })
}

/// The lines of corners, normals, texture coordinates and faces: groups and materials are given in the scene. The library
/// leaves out faces of fewer than three corners and makes up normals for faces without where others have some; such files
/// are refused.
fn geometry_lines(mut reader: BufReader<File>) -> Result<Vec<u8>, Fault> {
    let unreadable = |error: std::io::Error| Fault::new(format!("cannot be read: {error}"), "give a readable file");
    let (mut kept, mut line, mut number) = (Vec::new(), Vec::new(), 0);
    let (mut with, mut without, mut has_normals) = (None, None, false);
    while reader.read_until(b'\n', &mut line).map_err(unreadable)? > 0 {
        number += 1;
        line.truncate(line.iter().position(|&byte| byte == b'#').unwrap_or(line.len()));
        let words: Vec<&[u8]> = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
        match words[..] {
            [b"v" | b"vt", ..] => {}
            [b"vn", ..] => has_normals = true,
            [b"f", ref corners @ ..] => {
                if corners.len() < 3 {
                    let what = format!("has a face with fewer than three corners in line {number}");
                    return Err(Fault::new(what, "export it again"));
                }
                let has_normal =
                    |word: &&[u8]| word.split(|&byte| byte == b'/').nth(2).is_some_and(|index| !index.is_empty());
                let side = if corners.iter().all(has_normal) { &mut with } else { &mut without };
                side.get_or_insert(number);
            }
            _ => line.clear(),
        }
        kept.append(&mut line);
        kept.push(b'\n');
    }
    match (with, without) {
        (Some(with), Some(without)) => {
            let what = format!("has a face with normals in line {with}, and one without in line {without}");
            Err(Fault::new(what, "export it with normals for all faces, or for none"))
        }
        (Some(with), None) if !has_normals => {
            Err(Fault::new(format!("has a face with normals in line {with}, but no normals"), "export it again"))
        }
        _ => Ok(kept),
    }
}
