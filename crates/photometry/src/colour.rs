//! One value per channel: flux, radiance, reflectance.

use std::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};

/// Channels of a scene with data by wavelength: enough that a pass sees a smooth spectrum well (its error falls as this to
/// the power -1.5), few enough that a photon stays small.
pub const WAVELENGTHS: usize = 16;

/// Which channels a scene carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Channels {
    /// One channel, `Y`: every colour of the scene is grey.
    Grey,
    /// Three channels, `R` `G` `B`.
    Rgb,
    /// Wavelengths drawn anew for each pass, whose sum is one result, `Y`: the scene has data by wavelength.
    Spectral,
}

impl Channels {
    /// The channels' names in the order in which every list of channels is written.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Channels::Grey | Channels::Spectral => &["Y"],
            Channels::Rgb => &["R", "G", "B"],
        }
    }
}

/// `C` channels of one quantity in double precision; its unit is that of the quantity it holds.
///
/// `C` is 1 for grey scenes, 3 for RGB and [`WAVELENGTHS`] for spectra, chosen once per scene, so that a grey scene pays for
/// one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour<const C: usize>(pub [f64; C]);

impl<const C: usize> Colour<C> {
    /// Zero in every channel.
    pub const ZERO: Self = Colour([0.0; C]);
    /// One in every channel.
    pub const ONE: Self = Colour([1.0; C]);

    /// The same value in every channel.
    pub fn splat(value: f64) -> Self {
        Colour([value; C])
    }

    /// The first `C` channels of an RGB triple, of more the last again; a grey scene's triples are equal in all channels.
    pub fn from_rgb(rgb: [f64; 3]) -> Self {
        Colour(std::array::from_fn(|c| rgb[c.min(2)]))
    }

    /// Single precision, as stored in a photon.
    pub fn to_f32(self) -> [f32; C] {
        self.0.map(|x| x as f32)
    }

    /// From a photon's single precision.
    pub fn from_f32(values: [f32; C]) -> Self {
        Colour(values.map(f64::from))
    }

    /// The largest channel.
    pub fn max(self) -> f64 {
        self.0.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The mean over the channels.
    pub fn mean(self) -> f64 {
        self.0.into_iter().sum::<f64>() / C as f64
    }

    /// True if every channel is exactly zero.
    pub fn is_zero(self) -> bool {
        self.0.into_iter().all(|x| x == 0.0)
    }

    /// True if every channel is finite.
    pub fn is_finite(self) -> bool {
        self.0.into_iter().all(f64::is_finite)
    }

    /// Applies a function to each channel.
    pub fn map(self, f: impl FnMut(f64) -> f64) -> Self {
        Colour(self.0.map(f))
    }
}

impl<const C: usize> Default for Colour<C> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const C: usize> Index<usize> for Colour<C> {
    type Output = f64;
    fn index(&self, channel: usize) -> &f64 {
        &self.0[channel]
    }
}

impl<const C: usize> IndexMut<usize> for Colour<C> {
    fn index_mut(&mut self, channel: usize) -> &mut f64 {
        &mut self.0[channel]
    }
}

impl<const C: usize> Add for Colour<C> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Colour(std::array::from_fn(|c| self.0[c] + other.0[c]))
    }
}

impl<const C: usize> AddAssign for Colour<C> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const C: usize> Sub for Colour<C> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Colour(std::array::from_fn(|c| self.0[c] - other.0[c]))
    }
}

impl<const C: usize> Neg for Colour<C> {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl<const C: usize> Mul for Colour<C> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Colour(std::array::from_fn(|c| self.0[c] * other.0[c]))
    }
}

impl<const C: usize> Mul<f64> for Colour<C> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.map(|x| x * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_per_channel() {
        let a = Colour([1.0, 2.0, 3.0]);
        let b = Colour([2.0, 0.5, 4.0]);
        assert_eq!((a * b).0, [2.0, 1.0, 12.0]);
        assert_eq!((a + b - b).0, a.0);
        assert_eq!((a * 2.0).max(), 6.0);
        assert_eq!(Colour::<1>::from_rgb([0.25, 0.5, 0.75]).0, [0.25]);
    }
}
