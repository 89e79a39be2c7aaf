//! What makes two scenes the same for a photon map.

use photonlab_scene::Scene;
use xxhash_rust::xxh3::xxh3_128;

/// A hash of everything in a scene but its sensors and films: two scenes with the same identity have the same photons.
pub fn scene_identity(scene: &Scene) -> u128 {
    // The debug form of plain numbers is exact (shortest round trip), and covers every field that is ever added.
    let shapes: Vec<_> =
        scene.shapes.iter().map(|s| (&s.geometry, s.flip_normals, &s.bsdf, &s.radiance, s.boundary)).collect();
    xxh3_128(format!("{shapes:?} {:?} {:?} {:?}", scene.emitters, scene.media, scene.max_depth).as_bytes())
}
