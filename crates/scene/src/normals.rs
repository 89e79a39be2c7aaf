//! The two normals of a surface.

use glam::DVec3;

/// The normals of one side of a surface: of where it is, and of the smooth surface that it stands for.
///
/// The first decides on which side a direction is, the second how light is scattered. Seen from the eye a surface then
/// scatters by f |cos to the second|. Photons, which are flux per area of the surface itself, must carry factors for the
/// two directions to agree (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 5.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normals {
    /// Of the surface itself, unit.
    pub geometric: DVec3,
    /// Of the smooth surface, unit.
    pub shading: DVec3,
}

impl Normals {
    /// Of a surface that is what it looks like.
    pub fn flat(normal: DVec3) -> Self {
        Self { geometric: normal, shading: normal }
    }

    /// Of the other side.
    pub fn turned(&self) -> Self {
        Self { geometric: -self.geometric, shading: -self.shading }
    }

    /// Cosine of a direction to the shading normal; zero beyond the horizon of either normal: nothing is scattered there.
    #[inline]
    pub fn cosine(&self, direction: DVec3) -> f64 {
        let cosine = direction.dot(self.shading);
        if cosine > 0.0 && direction.dot(self.geometric) > 0.0 { cosine } else { 0.0 }
    }

    /// [`Normals::cosine`] over the cosine to the geometric normal: exactly one on a flat surface.
    #[inline]
    pub fn tilt(&self, direction: DVec3) -> f64 {
        match self.cosine(direction) {
            0.0 => 0.0,
            cosine => cosine / direction.dot(self.geometric),
        }
    }
}
