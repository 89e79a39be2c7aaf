//! The photon record: what leaves transport and enters the map.

use serde::{Deserialize, Serialize};

use crate::{Colour, PackedDirection};

/// How a photon came to where it was stored: the kind of its path from the lamp.
///
/// In Heckbert's notation L is the lamp, S a specular and D a diffuse interaction; the last D is where it is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[repr(u8)]
pub enum PathClass {
    /// L D: straight from the lamp.
    Direct = 0,
    /// L S+ D: by specular interactions alone.
    Caustic = 1,
    /// L .. D .. D: with a diffuse interaction on the way.
    Indirect = 2,
}

impl PathClass {
    /// Every class, in the order of their numbers.
    pub const ALL: [PathClass; 3] = [PathClass::Direct, PathClass::Caustic, PathClass::Indirect];

    /// The class's name in ledgers and files.
    pub fn name(self) -> &'static str {
        match self {
            PathClass::Direct => "direct",
            PathClass::Caustic => "caustic",
            PathClass::Indirect => "indirect",
        }
    }
}

/// A portion of flux where it met a diffuse surface, recorded as it arrived, before absorption.
///
/// The position is the search key and lives in the tree beside the record. 16 bytes in a grey scene, 24 in RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon<const C: usize> {
    /// Flux in W or lm per channel, never radiance.
    pub flux: [f32; C],
    /// The direction in which it travelled (towards the surface).
    pub direction: PackedDirection,
    /// The surface's normal on the side where it arrived.
    pub normal: PackedDirection,
    /// The kind of its path.
    pub class: PathClass,
    /// Path segments from the lamp to here, index-matched crossings not counted; saturates at 65535.
    pub segments: u16,
}

impl<const C: usize> Photon<C> {
    /// The flux in double precision.
    pub fn flux(&self) -> Colour<C> {
        Colour::from_f32(self.flux)
    }
}

/// A portion of flux where it met the matter of a medium that scatters, recorded as it arrived, before absorption.
///
/// The position is the search key and lives in the tree beside the record. 16 bytes in a grey scene, 24 in RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumePhoton<const C: usize> {
    /// Flux in W or lm per channel. The flux that collides in a volume is the extinction coefficient times the fluence rate,
    /// integrated over it.
    pub flux: [f32; C],
    /// The direction in which it travelled.
    pub direction: PackedDirection,
    /// The medium: an index into those of the scene.
    pub medium: u32,
    /// The kind of its path; the collision stands where a surface photon has its last D.
    pub class: PathClass,
    /// Path segments from the lamp to here, index-matched crossings not counted; saturates at 65535.
    pub segments: u16,
}

impl<const C: usize> VolumePhoton<C> {
    /// The flux in double precision.
    pub fn flux(&self) -> Colour<C> {
        Colour::from_f32(self.flux)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_as_documented() {
        assert_eq!(std::mem::size_of::<Photon<1>>(), 16);
        assert_eq!(std::mem::size_of::<Photon<3>>(), 24);
        assert_eq!(std::mem::size_of::<VolumePhoton<1>>(), 16);
        assert_eq!(std::mem::size_of::<VolumePhoton<3>>(), 24);
    }
}
