//! Lamps in lumens in a scene whose emissions are per nanometre.

use photonlab_photometry::{Channels, PEAK_EFFICACY, Spectrum, VISIBLE, sensitivity};

use crate::{Emitter, Pattern, Scene};

/// Weights of linear sRGB in luminance (IEC 61966-2-1).
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Gives luminaires without a spectrum of their own, in a scene by wavelength, that of an emission of their colour, and leaves
/// them their lumens.
pub(super) fn keep_lumens(scene: &mut Scene) {
    if scene.channels() != Channels::Spectral {
        return;
    }
    for emitter in &mut scene.emitters {
        if let Emitter::Point { intensity, pattern: Pattern::Table { .. }, .. } = emitter
            && let Some(rgb) = intensity.rgb()
        {
            let stated: f64 = rgb.iter().zip(LUMINANCE).map(|(value, weight)| value * weight).sum();
            let lumens = lumens(intensity);
            if lumens > 0.0 {
                *intensity = intensity.scaled(stated / lumens);
            }
        }
    }
}

/// Luminous equivalent of an emission per nanometre: 683 lm/W times the integral by V, by Simpson's rule between the bends of
/// both, exact for curves.
pub(super) fn lumens(emission: &Spectrum) -> f64 {
    let mut bends: Vec<f64> = (VISIBLE[0] as u32..=VISIBLE[1] as u32).map(f64::from).collect();
    if let Spectrum::Curve(curve) = emission {
        bends.extend(curve.wavelengths().iter().filter(|nm| (VISIBLE[0]..VISIBLE[1]).contains(*nm)));
        bends.sort_by(f64::total_cmp);
    }
    let at = |nm: f64| emission.emission_at(nm) * sensitivity(nm);
    let piece = |[a, b]: [f64; 2]| (b - a) / 6.0 * (at(a) + 4.0 * at(0.5 * (a + b)) + at(b));
    PEAK_EFFICACY * bends.windows(2).map(|pair| piece([pair[0], pair[1]])).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use photonlab_photometry::Curve;

    use super::*;

    /// An equal-energy spectrum's 106.857 (CIE 15), and a triangle of half a nanometre around 555.5 nm.
    #[test]
    fn lumens_of_known_spectra() {
        assert!((lumens(&Spectrum::Uniform(1.0)) / (683.0 * 106.857) - 1.0).abs() < 1e-5);
        let line = Curve::new(&[(555.25, 0.0), (555.5, 4.0), (555.75, 0.0)]).expect("a curve");
        let expected = 683.0 * sensitivity(555.5);
        assert!((lumens(&Spectrum::Curve(Arc::new(line))) / expected - 1.0).abs() < 1e-9);
    }
}
