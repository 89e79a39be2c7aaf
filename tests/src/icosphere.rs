//! Icospheres: a sphere as a mesh of nearly equal triangles.

use std::{collections::HashMap, fmt::Write};

use glam::DVec3;

/// An OBJ file of the unit sphere as an icosahedron whose edges are halved a number of times, outside in front; with the
/// sphere's own normals if `smooth`.
pub fn icosphere(halvings: u32, smooth: bool) -> String {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut points: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        points.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)].map(|p| p.normalize()));
    }
    let mut faces = icosahedron(&points);
    let mut middles = HashMap::new();
    for _ in 0..halvings {
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    points.push((points[p] + points[q]).normalize());
                    points.len() - 1
                })
            });
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let mut text = String::new();
    for kind in ["v", "vn"].into_iter().take(1 + usize::from(smooth)) {
        points.iter().for_each(|p| _ = writeln!(text, "{kind} {} {} {}", p.x, p.y, p.z));
    }
    for face in faces {
        let [a, b, c] = face.map(|i| if smooth { format!("{}//{}", i + 1, i + 1) } else { (i + 1).to_string() });
        _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}

/// The triples of neighbouring corners, anticlockwise from outside.
fn icosahedron(points: &[DVec3]) -> Vec<[usize; 3]> {
    let near = |a: usize, b: usize| (points[a] - points[b]).length() < 1.1;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    let out = (points[b] - points[a]).cross(points[c] - points[a]).dot(points[a]) > 0.0;
                    faces.push(if out { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    faces
}
