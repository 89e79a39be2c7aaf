//! PLY files.

use std::fs::File;
use std::io::BufReader;

use glam::DVec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, Property, PropertyAccess, PropertyAccessResult};

use super::error::Fault;
use super::mesh::Faces;

/// A corner; what it has besides a place and a normal is left out.
struct Vertex {
    position: DVec3,
    normal: DVec3,
}

/// A polygon's corners.
struct Polygon(Vec<i64>);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { position: DVec3::NAN, normal: DVec3::NAN }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let value = match property {
            Property::Float(value) => f64::from(value),
            Property::Double(value) => value,
            Property::Int(value) => f64::from(value),
            Property::Short(value) => f64::from(value),
            _ => return PropertyAccessResult::Set,
        };
        match name {
            "x" => self.position.x = value,
            "y" => self.position.y = value,
            "z" => self.position.z = value,
            "nx" => self.normal.x = value,
            "ny" => self.normal.y = value,
            "nz" => self.normal.z = value,
            _ => {}
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Polygon {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if name == "vertex_indices" || name == "vertex_index" {
            self.0 = match property {
                Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
                Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
                Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
                Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
                Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
                Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
                _ => Vec::new(),
            };
        }
        PropertyAccessResult::Set
    }
}

/// What the parser says to people, without what it says to its makers.
fn in_one_line(error: &str) -> String {
    let words = error.split("\n\tError:").next().unwrap_or(error);
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Reads a mesh, text or binary; polygons are cut into fans.
pub(super) fn read_ply(file: BufReader<File>) -> Result<Faces, Fault> {
    let broken =
        |error: String| Fault::new(format!("is no valid PLY file: {}", in_one_line(&error)), "export it again");
    let mut reader = Reader::new(file);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(|e| broken(e.to_string()))?;
    let (mut vertices, mut polygons) = (Vec::new(), Vec::new());
    for element in header.elements.values() {
        match element.name.as_str() {
            "vertex" => vertices = read::<Vertex>(&mut reader, element, &header).map_err(broken)?,
            "face" => polygons = read::<Polygon>(&mut reader, element, &header).map_err(broken)?,
            _ => drop(read::<DefaultElement>(&mut reader, element, &header).map_err(broken)?),
        }
    }
    let mut faces = Vec::with_capacity(polygons.len());
    for Polygon(corners) in polygons {
        let known = |&corner: &i64| u32::try_from(corner).ok().filter(|&index| (index as usize) < vertices.len());
        let corners: Option<Vec<u32>> = corners.iter().map(known).collect();
        let corners = corners.filter(|corners| corners.len() >= 3);
        let corners = corners.ok_or_else(|| {
            Fault::new("has a face with fewer than three corners, or one that does not exist", "export it again")
        })?;
        faces.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
    }
    let properties = header.elements.get("vertex").map(|element| &element.properties);
    let has_normals = properties.is_some_and(|known| ["nx", "ny", "nz"].iter().all(|&name| known.contains_key(name)));
    let normals = has_normals.then(|| faces.iter().map(|f| f.map(|index| vertices[index as usize].normal)).collect());
    Ok(Faces { vertices: vertices.into_iter().map(|vertex| vertex.position).collect(), faces, normals })
}

fn read<E: PropertyAccess>(
    reader: &mut Reader<BufReader<File>>,
    element: &ply_rs_bw::ply::ElementDef,
    header: &ply_rs_bw::ply::Header,
) -> Result<Vec<E>, String> {
    Parser::<E>::new().read_payload_for_element(reader, element, header).map_err(|error| error.to_string())
}
