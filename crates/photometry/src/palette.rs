//! What a channel stands for while light is followed, and how channels become results.

use crate::{Colour, PEAK_EFFICACY, SRGB_OF_XYZ, Spectrum, UnitSystem, matching, sensitivity};

/// What light counts for in a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Response {
    /// All wavelengths alike: watts.
    Radiometric,
    /// By V and 683 lm/W: lumens.
    Photometric,
    /// As three linear sRGB channels whose luminance is in photometric units.
    Image,
}

impl Response {
    /// Of readings in a system of units.
    pub fn of(units: UnitSystem) -> Self {
        match units {
            UnitSystem::Radiometric => Response::Radiometric,
            UnitSystem::Photometric => Response::Photometric,
        }
    }

    /// Results for each place.
    pub fn results(self) -> usize {
        if self == Response::Image { 3 } else { 1 }
    }

    /// The weight with which light of a wavelength (nm) is carried.
    pub fn weight(self, nm: f64) -> f64 {
        match self {
            Response::Radiometric => 1.0,
            Response::Photometric => PEAK_EFFICACY * sensitivity(nm),
            Response::Image => PEAK_EFFICACY * matching(nm).into_iter().sum::<f64>(),
        }
    }

    /// What carried light of a wavelength (nm) adds to each result.
    fn shares(self, nm: f64) -> [f64; 3] {
        let xyz = matching(nm);
        let sum: f64 = xyz.iter().sum();
        match self {
            Response::Image if sum > 0.0 => {
                SRGB_OF_XYZ.map(|row| row.iter().zip(xyz).map(|(a, b)| a * b).sum::<f64>() / sum)
            }
            _ => [1.0, 0.0, 0.0],
        }
    }
}

/// What the channels stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Palette<const C: usize> {
    /// One for a grey scene, or red, green and blue: each is a result.
    Channels,
    /// Drawn wavelengths, which share in every result.
    Wavelengths(Wavelengths<C>),
}

/// Wavelengths drawn for one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelengths<const C: usize> {
    /// Nanometres.
    pub nm: [f64; C],
    /// What emission per nanometre is multiplied by: the response over `C` times the density of the draw.
    weight: [f64; C],
    response: Response,
}

impl<const C: usize> Wavelengths<C> {
    /// From wavelengths (nm), each drawn with a density (1/nm) of its own, the densities adding up to `C` times that of
    /// the whole draw.
    pub fn new(nm: [f64; C], density: [f64; C], response: Response) -> Self {
        let weight = std::array::from_fn(|c| response.weight(nm[c]) / (C as f64 * density[c]));
        Self { nm, weight, response }
    }
}

impl<const C: usize> Palette<C> {
    /// A share or a coefficient in each channel.
    pub fn colour(&self, spectrum: &Spectrum) -> Colour<C> {
        match self {
            Palette::Channels => channels(spectrum),
            Palette::Wavelengths(drawn) => Colour(drawn.nm.map(|nm| spectrum.at(nm))),
        }
    }

    /// An emission in each channel; the channels of drawn wavelengths carry weights that make their sum the result.
    pub fn emission(&self, spectrum: &Spectrum) -> Colour<C> {
        match self {
            Palette::Channels => channels(spectrum),
            Palette::Wavelengths(drawn) => {
                Colour(std::array::from_fn(|c| spectrum.emission_at(drawn.nm[c]) * drawn.weight[c]))
            }
        }
    }

    /// The results of carried light, in the first channels; the rest is zero.
    pub fn develop(&self, carried: Colour<C>) -> Colour<C> {
        let Palette::Wavelengths(drawn) = self else { return carried };
        let mut results = Colour::ZERO;
        for (light, nm) in carried.0.into_iter().zip(drawn.nm) {
            let shares = drawn.response.shares(nm);
            (0..drawn.response.results()).for_each(|result| results[result] += light * shares[result]);
        }
        results
    }
}

/// The first `C` channels of what is no curve: a scene with curves has a palette of wavelengths.
fn channels<const C: usize>(spectrum: &Spectrum) -> Colour<C> {
    Colour::from_rgb(spectrum.rgb().expect("a scene with spectra by wavelength is read by wavelength"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mean over many even draws of 380 to 780 nm is the integral: 683 times 106.857 for an equal-energy spectrum.
    #[test]
    fn drawn_wavelengths_give_the_integral() {
        let mut sum = [0.0; 4];
        let draws = 4700;
        for i in 0..draws {
            let nm = std::array::from_fn(|c| 360.0 + 470.0 * ((c as f64 + (f64::from(i) + 0.5) / 4700.0) / 4.0));
            let palette = |response| Palette::Wavelengths(Wavelengths::<4>::new(nm, [1.0 / 470.0; 4], response));
            let read = |response| {
                let palette = palette(response);
                palette.develop(palette.emission(&Spectrum::Uniform(2.0)))
            };
            sum[0] += read(Response::Radiometric)[0] / f64::from(draws);
            sum[1] += read(Response::Photometric)[0] / f64::from(draws);
            let rgb = read(Response::Image);
            sum[2] += (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) / f64::from(draws);
        }
        assert!((sum[0] - 940.0).abs() < 1e-9);
        assert!((sum[1] / (2.0 * 683.0 * 106.857) - 1.0).abs() < 1e-5);
        assert!((sum[2] / sum[1] - 1.0).abs() < 1e-3, "luminance of the image: {} for {}", sum[2], sum[1]);
    }
}
