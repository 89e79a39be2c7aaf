//! What density estimates should read in CUBE, from the independent solution: no photons needed.

use std::f64::consts::{PI, TAU};

use photonlab_reference::nearest_law::{Counted, RelativeMoments, in_field};

use super::cube_field::CubeField;

/// Rings, and points on each, of a disc's profile.
const RINGS: usize = 160;
const ON_RING: usize = 96;

/// What all photons within `radius` metres over pi r^2 read at a point, relative to the truth there.
pub(super) fn fixed_radius(field: &CubeField, at: [f64; 2], radius: f64) -> f64 {
    Profile::new(field, at, radius).within(radius)
}

/// What the k - 1 nearest over pi r_k^2 read at a point where `paths` emitted photons carry equal flux.
pub(super) fn nearest(field: &CubeField, at: [f64; 2], k: u32, paths: u64) -> RelativeMoments {
    let flux = 4.0 * PI * field.cube().intensity() / paths as f64;
    let density = field.illuminance(at[0], at[1]) / flux;
    // A corner holds a quarter of the photons of a plane, and the k-th may lie beyond twice the mean distance.
    let profile = Profile::new(field, at, 5.0 * (f64::from(k) / (PI * density)).sqrt());
    let expected = |x: f64| x * profile.within((x / (PI * density)).sqrt());
    let kink = |uv: f64| PI * density * ((1.0 - uv) * field.cube().half_edge()).powi(2);
    in_field(k, Counted::AllButLast, expected, &[kink(at[0]), kink(at[1]), kink(at[0]) + kink(at[1])])
}

/// The mean illuminance of discs around a point, outside the face counted as dark, relative to the point's own.
struct Profile {
    reach: f64,
    /// Means within the outer radius of each ring.
    means: Vec<f64>,
}

impl Profile {
    fn new(field: &CubeField, at: [f64; 2], reach: f64) -> Self {
        let own = field.illuminance(at[0], at[1]);
        let outer = |ring: usize| reach * (ring as f64 / RINGS as f64).powi(2);
        let mut sum = 0.0;
        let means = (0..RINGS)
            .map(|ring| {
                let (inside, outside) = (outer(ring), outer(ring + 1));
                let middle = (0.5 * (inside * inside + outside * outside)).sqrt() / field.cube().half_edge();
                let on_ring = (0..ON_RING).map(|i| {
                    let phi = TAU * (i as f64 + 0.5) / ON_RING as f64;
                    field.illuminance(at[0] + middle * phi.cos(), at[1] + middle * phi.sin())
                });
                sum += on_ring.sum::<f64>() / (ON_RING as f64 * own) * (outside * outside - inside * inside);
                sum / (outside * outside)
            })
            .collect();
        Self { reach, means }
    }

    fn within(&self, radius: f64) -> f64 {
        let at = (radius / self.reach).sqrt() * RINGS as f64 - 1.0;
        if at <= 0.0 {
            return self.means[0];
        }
        let low = (at as usize).min(RINGS - 2);
        self.means[low] + (at - low as f64).min(1.0) * (self.means[low + 1] - self.means[low])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use photonlab_reference::edge_laws;

    #[test]
    fn small_discs_see_even_light() {
        let field = CubeField::new();
        let (radius, t) = (0.02, 0.5);
        let edge = fixed_radius(&field, [0.998, 0.0], radius) / edge_laws::half_plane(t) - 1.0;
        let corner = fixed_radius(&field, [0.998, 0.998], radius) / edge_laws::corner(t, t) - 1.0;
        assert!(edge.abs() < 5e-3 && corner.abs() < 5e-3);
        // Where k photons' disc is small against the distance to the edges, the k nearest read the truth.
        let middle = nearest(&field, [0.0, 0.0], 100, 1_000_000_000).mean;
        assert!((middle - 1.0).abs() < 1e-3);
    }
}
