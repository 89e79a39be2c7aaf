//! A quantity that may depend on wavelength, as a scene states it.

use std::sync::Arc;

use crate::{Curve, daylight, rgb_spectrum::spectrum_of_rgb};

/// Reflectance, emission or another optical quantity; its unit is that of the parameter it stands for, per nanometre where it
/// is an emission in a scene with wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    /// The same at every wavelength.
    Uniform(f64),
    /// Linear sRGB.
    Rgb([f64; 3]),
    /// By wavelength.
    Curve(Arc<Curve>),
}

impl Spectrum {
    /// Zero.
    pub const BLACK: Self = Spectrum::Uniform(0.0);

    /// As three channels; `None` for a curve.
    pub fn rgb(&self) -> Option<[f64; 3]> {
        match self {
            Spectrum::Uniform(value) => Some([*value; 3]),
            Spectrum::Rgb(rgb) => Some(*rgb),
            Spectrum::Curve(_) => None,
        }
    }

    /// True if three channels would be equal.
    pub fn is_grey(&self) -> bool {
        self.rgb().is_some_and(|rgb| rgb[0] == rgb[1] && rgb[1] == rgb[2])
    }

    /// True if it is given by wavelength.
    pub fn is_curve(&self) -> bool {
        matches!(self, Spectrum::Curve(_))
    }

    /// True if it is zero everywhere.
    pub fn is_black(&self) -> bool {
        match self {
            Spectrum::Uniform(value) => *value == 0.0,
            Spectrum::Rgb(rgb) => *rgb == [0.0; 3],
            Spectrum::Curve(curve) => curve.values().iter().all(|&value| value == 0.0),
        }
    }

    /// Every value times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Spectrum::Uniform(value) => Spectrum::Uniform(value * factor),
            Spectrum::Rgb(rgb) => Spectrum::Rgb(rgb.map(|value| value * factor)),
            Spectrum::Curve(curve) => Spectrum::Curve(Arc::new(curve.scaled(factor))),
        }
    }

    /// The largest value.
    pub fn max(&self) -> f64 {
        let of = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        match self {
            Spectrum::Uniform(value) => *value,
            Spectrum::Rgb(rgb) => of(rgb),
            Spectrum::Curve(curve) => of(curve.values()),
        }
    }

    /// The largest value of the sum of two.
    pub fn max_of_sum(&self, other: &Self) -> f64 {
        if let (Some(a), Some(b)) = (self.rgb(), other.rgb()) {
            return (0..3).map(|c| a[c] + b[c]).fold(f64::NEG_INFINITY, f64::max);
        }
        let bends = |spectrum: &Self| match spectrum {
            Spectrum::Curve(curve) => curve.wavelengths().to_vec(),
            // The curves of RGB colours bend every 10 nm.
            _ => (36..=83).map(|ten| 10.0 * f64::from(ten)).collect(),
        };
        let wavelengths = [bends(self), bends(other)].concat();
        wavelengths.into_iter().map(|nm| self.at(nm) + other.at(nm)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Value at a wavelength in nanometres of a quantity that is a share or a coefficient.
    pub fn at(&self, nm: f64) -> f64 {
        match self {
            Spectrum::Uniform(value) => *value,
            Spectrum::Rgb(rgb) if rgb[0] == rgb[1] && rgb[1] == rgb[2] => rgb[0],
            Spectrum::Rgb(rgb) => spectrum_of_rgb(*rgb, nm),
            Spectrum::Curve(curve) => curve.at(nm),
        }
    }

    /// Value at a wavelength in nanometres of an emission: an RGB colour is that of light seen beside daylight D65.
    pub fn emission_at(&self, nm: f64) -> f64 {
        match self {
            Spectrum::Rgb(rgb) => spectrum_of_rgb(*rgb, nm) * daylight(nm),
            _ => self.at(nm),
        }
    }
}
