//! How far a point of a scene of flat faces is from the nearest edge.

use glam::DVec3;
use photonlab_scene::{Surface, World};

/// The edges of all flat four-sided faces: free edges, creases and where boxes stand on a floor.
pub(super) struct FaceEdges {
    /// Ends in metres.
    edges: Vec<[DVec3; 2]>,
}

impl FaceEdges {
    /// Other surfaces than four-sided faces have no edge here.
    pub(super) fn of(world: &World) -> Self {
        let faces = world.primitives.iter().filter_map(|primitive| match primitive.surface {
            Surface::Parallelogram(face) => Some(face),
            _ => None,
        });
        let edges = faces.flat_map(|face| {
            let corner = |a: f64, b: f64| face.centre + a * face.edge_u + b * face.edge_v;
            let around = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            [0, 1, 2, 3].map(|i| [around[i], around[(i + 1) % 4]])
        });
        Self { edges: edges.collect() }
    }

    /// Metres to the nearest of them.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        self.edges.iter().map(|&ends| to_segment(point, ends)).fold(f64::INFINITY, f64::min)
    }
}

fn to_segment(point: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let along = end - start;
    let share = ((point - start).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (point - start - share * along).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beside_beyond_and_on_a_segment() {
        let ends = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0)];
        for (point, distance) in
            [([1.0, 3.0, 4.0], 5.0), ([-3.0, 0.0, 4.0], 5.0), ([5.0, 4.0, 0.0], 5.0), ([2.0; 3], 8f64.sqrt())]
        {
            assert!((to_segment(DVec3::from(point), ends) - distance).abs() < 1e-12);
        }
    }
}
