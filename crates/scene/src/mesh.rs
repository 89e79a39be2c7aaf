//! Meshes: faces that share corners.

use std::collections::HashMap;

use glam::DVec3;

use crate::triangle::Triangle;

/// Cosine of the angle between two neighbouring faces above which they count as one surface: 18 degrees.
pub(crate) const SAME_SURFACE: f64 = 0.95;

/// Triangles in world units.
#[derive(Clone, PartialEq)]
pub struct Mesh {
    /// Corners, metres.
    pub vertices: Vec<DVec3>,
    /// Indices of each face's corners; the front side is that from which they run counter-clockwise.
    pub faces: Vec<[u32; 3]>,
    /// The smooth surface that it stands for; `None` if it is what it looks like.
    pub smooth: Option<Smooth>,
}

/// Normals of the smooth surface that a mesh stands for, interpolated between its corners.
#[derive(Clone, Default, PartialEq)]
pub struct Smooth {
    /// Unit vectors, on the front sides of their faces.
    pub normals: Vec<[f32; 3]>,
    /// Indices of the normals of each face's corners.
    pub corners: Vec<[u32; 3]>,
}

impl std::fmt::Debug for Mesh {
    /// With a hash in place of the numbers: the debug form stands for the mesh's identity.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let vertices = self.vertices.iter().flat_map(|v| v.to_array()).flat_map(f64::to_le_bytes);
        let faces = self.faces.iter().flatten().flat_map(|index| index.to_le_bytes());
        let normals = self.smooth.iter().flat_map(|s| s.normals.iter().flatten()).flat_map(|x| x.to_le_bytes());
        let corners = self.smooth.iter().flat_map(|s| s.corners.iter().flatten()).flat_map(|i| i.to_le_bytes());
        let bytes: Vec<u8> = vertices.chain(faces).chain(normals).chain(corners).collect();
        let hash = xxhash_rust::xxh3::xxh3_128(&bytes);
        write!(f, "Mesh {{ {} faces, {hash:x} }}", self.faces.len())
    }
}

impl Mesh {
    /// Unit normal of the smooth surface at a point of a face, on the side of the face's own normal; that itself without one.
    pub(crate) fn shading_normal(&self, face: usize, triangle: &Triangle, position: DVec3, flipped: bool) -> DVec3 {
        let Some(smooth) = &self.smooth else { return triangle.normal };
        let weights = triangle.weights(position).to_array();
        let corners = smooth.corners[face].map(|index| DVec3::from(smooth.normals[index as usize].map(f64::from)));
        let sum: DVec3 = corners.into_iter().zip(weights).map(|(normal, weight)| weight * normal).sum();
        (if flipped { -sum } else { sum }).try_normalize().unwrap_or(triangle.normal)
    }

    /// Its faces, their front sides turned around if asked.
    pub(crate) fn triangles(&self, flipped: bool) -> Vec<Triangle> {
        let side = if flipped { -1.0 } else { 1.0 };
        let corners = |face: &[u32; 3]| face.map(|index| self.vertices[index as usize]);
        let normal = |[a, b, c]: [DVec3; 3]| side * (b - a).cross(c - a).normalize();
        let mut triangles: Vec<Triangle> = self
            .faces
            .iter()
            .map(|face| Triangle { corners: corners(face), normal: normal(corners(face)), edges: [true; 3] })
            .collect();
        for (one, other) in shared_sides(&triangles) {
            if triangles[one.0].normal.dot(triangles[other.0].normal) >= SAME_SURFACE {
                triangles[one.0].edges[one.1] = false;
                triangles[other.0].edges[other.1] = false;
            }
        }
        triangles
    }
}

/// A face and one of its sides.
type Side = (usize, usize);

/// Pairs of sides at one place, whatever numbers their corners have: exporters give a corner several numbers where its
/// colour or direction jumps. A side of three or more faces is in no pair, as the surface branches there.
fn shared_sides(triangles: &[Triangle]) -> Vec<(Side, Side)> {
    let key = |v: DVec3| (v + 0.0).to_array().map(f64::to_bits);
    let mut sides: HashMap<[[u64; 3]; 2], Vec<Side>> = HashMap::with_capacity(triangles.len() * 3 / 2);
    for (number, triangle) in triangles.iter().enumerate() {
        for side in 0..3 {
            let mut ends = [key(triangle.corners[side]), key(triangle.corners[(side + 1) % 3])];
            ends.sort_unstable();
            sides.entry(ends).or_default().push((number, side));
        }
    }
    let mut pairs: Vec<_> = sides
        .into_values()
        .filter_map(|at| if let [one, other] = at[..] { Some((one, other)) } else { None })
        .collect();
    pairs.sort_unstable();
    pairs
}
