//! The error of the direct view of CUBE, from the independent solution: no photons needed.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::{cube_field::CubeField, cube_law::fixed_radius, picture::Region};

/// Nodes from an edge to one radius, where the bias is, and from there to the middle of the face.
const BESIDE: usize = 8;
const BEYOND: usize = 10;

/// Mean over a region of a face of the squared error with all photons within `radius` metres over pi r^2, relative to the region's squared
/// mean, where `photons` independent paths were emitted.
pub(super) fn mean_square(field: &CubeField, region: Region, photons: f64, radius: f64) -> f64 {
    let nodes = match region {
        Region::Whole => {
            let reach = radius / field.cube().half_edge();
            let beside = (0..BESIDE).map(|i| (1.0 - reach * middle(i, BESIDE), reach / BESIDE as f64));
            beside.chain(graded(1.0 - reach)).collect()
        }
        Region::FromEdges(least) => graded(1.0 - least / field.cube().half_edge()),
    };
    let flux = 4.0 * PI * field.cube().intensity() / photons;
    let of_node = |&(u, along): &(f64, f64)| {
        let mut sums = [0.0; 3];
        // The face is the same across its diagonal.
        for &(v, across) in nodes.iter().filter(|(v, _)| *v <= u) {
            let weight = along * across * if v < u { 2.0 } else { 1.0 };
            let own = field.illuminance(u, v);
            let read = own * fixed_radius(field, [u, v], radius);
            // Poisson's variance of a sum of equal fluxes.
            let square = (read - own).powi(2) + flux * read / (PI * radius * radius);
            sums = [sums[0] + weight, sums[1] + weight * own, sums[2] + weight * square];
        }
        sums
    };
    let parts: Vec<[f64; 3]> = nodes.par_iter().map(of_node).collect();
    let [weight, own, square] = [0, 1, 2].map(|i| parts.iter().map(|part| part[i]).sum::<f64>());
    square * weight / (own * own)
}

/// Half-edges from the face's centre and weights, from 0 to `end`, closer towards it.
fn graded(end: f64) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let s = middle(i, BEYOND);
        (end * (1.0 - s * s), end * 2.0 * s / BEYOND as f64)
    };
    (0..BEYOND).map(node).collect()
}

fn middle(i: usize, count: usize) -> f64 {
    (i as f64 + 0.5) / count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges alone: c r per length of edge (catalogue H5, c = 0.06810535) times the squared light there, in the limit of many photons.
    #[test]
    fn small_discs_leave_the_bias_of_the_edges() {
        let field = CubeField::new();
        let (h, radius) = (field.cube().half_edge(), 0.01);
        let steps = 1000;
        let squares = (0..steps).map(|i| field.illuminance(1.0, middle(i, steps)).powi(2));
        let edge = squares.sum::<f64>() / steps as f64 / field.cube().mean_irradiance().powi(2);
        let expected = 0.068_105_35 * radius * 8.0 * h * edge / (4.0 * h * h);
        let found = mean_square(&field, Region::Whole, 1e30, radius);
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
    }
}
