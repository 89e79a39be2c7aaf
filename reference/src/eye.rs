//! From watts to lumens: the eye's spectral sensitivity.
//!
//! `Phi_v = 683 lm/W int V(lambda) Phi_e(lambda) dlambda` with V of the CIE 1924 standard observer, here its table at 5 nm
//! (CIE 018:2019; the same as the 1931 observer's y), linear between the rows. 683 lm/W is the SI's constant for 540 THz,
//! near 555 nm, where V is 1. A photon that carries flux needs no energy `h c / lambda`. (Catalogue entry I1.)

/// Luminous efficacy at the peak of V, in lm/W.
pub const PEAK_EFFICACY: f64 = 683.0;

/// First and last wavelength of the table and its step, in nanometres.
const FIRST: f64 = 380.0;
const LAST: f64 = 780.0;
const STEP: f64 = 5.0;

/// V at 380, 385, ..., 780 nm.
#[rustfmt::skip]
const V: [f64; 81] = [
    0.000039, 0.000064, 0.000120, 0.000217, 0.000396, 0.000640, 0.001210, 0.002180, 0.004000, 0.007300,
    0.011600, 0.016840, 0.023000, 0.029800, 0.038000, 0.048000, 0.060000, 0.073900, 0.090980, 0.112600,
    0.139020, 0.169300, 0.208020, 0.258600, 0.323000, 0.407300, 0.503000, 0.608200, 0.710000, 0.793200,
    0.862000, 0.914850, 0.954000, 0.980300, 0.994950, 1.000000, 0.995000, 0.978600, 0.952000, 0.915400,
    0.870000, 0.816300, 0.757000, 0.694900, 0.631000, 0.566800, 0.503000, 0.441200, 0.381000, 0.321000,
    0.265000, 0.217000, 0.175000, 0.138200, 0.107000, 0.081600, 0.061000, 0.044580, 0.032000, 0.023200,
    0.017000, 0.011920, 0.008210, 0.005723, 0.004102, 0.002929, 0.002091, 0.001484, 0.001047, 0.000740,
    0.000520, 0.000361, 0.000249, 0.000172, 0.000120, 0.000085, 0.000060, 0.000042, 0.000030, 0.000021,
    0.000015,
];

/// V at this wavelength (nm), linear between rows 5 nm apart; 0 outside 380 to 780 nm.
pub fn sensitivity(wavelength: f64) -> f64 {
    if !(FIRST..=LAST).contains(&wavelength) {
        return 0.0;
    }
    let place = (wavelength - FIRST) / STEP;
    let row = (place as usize).min(V.len() - 2);
    let share = place - row as f64;
    V[row] * (1.0 - share) + V[row + 1] * share
}

/// The integral of V times a smooth spectrum over 380 to 780 nm, trapezoids with rows every `every` times 5 nm (1, 2 or 4).
///
/// Steps of 5 and 10 nm differ by 1e-5 relative for daylight and lamps without lines.
pub fn weighted(every: usize, spectrum: impl Fn(f64) -> f64) -> f64 {
    let last = V.len() - 1;
    let row = |i: usize| {
        let half = if i == 0 || i == last { 0.5 } else { 1.0 };
        half * V[i] * spectrum(FIRST + STEP * i as f64)
    };
    STEP * every as f64 * (0..=last).step_by(every).map(row).sum::<f64>()
}

/// Luminous flux (lm) of light with this spectral flux (W/nm), in steps of 5 nm.
pub fn lumens(spectral_flux: impl Fn(f64) -> f64) -> f64 {
    PEAK_EFFICACY * weighted(1, spectral_flux)
}

/// Exitance of a black body at this wavelength (nm) and temperature (K), in W/m^2 per nanometre: Planck's law.
pub fn black_body_exitance(nm: f64, temperature: f64) -> f64 {
    // 2 pi h c^2 in W m^2, with 1e45 nm^5/m^5 and 1e-9 m/nm; h c / k in nm K.
    const FIRST_CONSTANT: f64 = 3.741771852e-16 * 1e36;
    const SECOND_CONSTANT: f64 = 1.438776877e7;
    FIRST_CONSTANT / (nm.powi(5) * ((SECOND_CONSTANT / (nm * temperature)).exp() - 1.0))
}

/// Luminous efficacy of a black body: lm per watt of all its radiation, and per watt between 380 and 780 nm.
///
/// Planck's law with the SI's exact constants; total by Stefan and Boltzmann's. V in steps of 5 nm: 1e-4.
pub fn black_body_efficacy(temperature: f64) -> [f64; 2] {
    const STEFAN: f64 = 5.670374419e-8;
    let exitance = |nm: f64| black_body_exitance(nm, temperature);
    let visible = crate::quadrature::Gauss::new(16).composite(FIRST, LAST, 8, exitance);
    let lumens = lumens(exitance);
    [lumens / (STEFAN * temperature.powi(4)), lumens / visible]
}

/// Wavelength (nm) at which a black body of this temperature (K) radiates most per nanometre: Wien's displacement law.
pub fn wien_peak(temperature: f64) -> f64 {
    2.897771955e6 / temperature
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    #[test]
    fn catalogue_values() {
        // 10 nm and 5 nm trapezoids; the published integral in steps of 1 nm is 106.857.
        let [ten, five] = [2, 1].map(|every| weighted(every, |_| 1.0));
        println!("{ten} {five}");
        assert!((ten - 106.85752).abs() < 1e-3 && (five - 106.857).abs() < 1e-3, "{ten} {five}");
        assert!((PEAK_EFFICACY * ten / 400.0 - 182.45922).abs() < 2e-3);
        assert_eq!(PEAK_EFFICACY * sensitivity(555.0), 683.0);
        assert_eq!(sensitivity(379.0) + sensitivity(781.0), 0.0);
        for (kelvin, total, visible) in [
            (2000.0, 1.6058724, 95.915859),
            (2856.0, 16.446306, 156.21655),
            (4000.0, 54.712945, 191.19717),
            (6504.0, 95.367548, 195.63021),
        ] {
            let got = black_body_efficacy(kelvin);
            println!("{kelvin}: {got:?}");
            // The catalogue vouches 1e-3, for a table at 10 nm.
            assert!((got[0] / total - 1.0).abs() < 1e-3 && (got[1] / visible - 1.0).abs() < 1e-3, "{got:?}");
        }
    }

    /// V rises to its peak and falls after it, close to the two-lobe fit of Wyman, Sloan and Shirley (2013), whose largest
    /// error is some hundredths.
    #[test]
    fn the_table_is_near_an_independent_fit() {
        assert!(V[..36].windows(2).all(|w| w[0] < w[1]) && V[35..].windows(2).all(|w| w[0] > w[1]));
        let lobe = |nm: f64, peak: f64, below: f64, above: f64| {
            let x = (nm - peak) / if nm < peak { below } else { above };
            (-0.5 * x * x).exp()
        };
        for (i, v) in V.iter().enumerate() {
            let nm = FIRST + STEP * i as f64;
            let fit = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
            assert!((v - fit).abs() < 0.02, "{nm} nm: {v} {fit}");
        }
    }

    /// Planck's exitance integrates to Stefan and Boltzmann's, and peaks where Wien says.
    #[test]
    fn black_bodies_radiate_what_they_should() {
        let exitance = black_body_exitance;
        let rule = crate::quadrature::Gauss::new(16);
        let total = rule.composite(5.0, 14.5, 60, |s: f64| s.exp() * exitance(s.exp(), 4000.0));
        assert!((total / (5.670374419e-8 * 4000f64.powi(4)) - 1.0).abs() < 1e-6, "{total}");
        let peak = wien_peak(4000.0);
        assert!(exitance(peak, 4000.0) > exitance(peak * 1.001, 4000.0));
        assert!(exitance(peak, 4000.0) > exitance(peak * 0.999, 4000.0));
    }

    /// Wavelengths drawn evenly: 1 comparison at 4.5 standard errors.
    #[test]
    fn drawn_wavelengths_agree() {
        let (mut random, mut mean) = (Random::new(73), Moments::default());
        (0..100_000).for_each(|_| mean.add(400.0 * sensitivity(random.between(FIRST, LAST))));
        mean.must_agree("integral of V", weighted(1, |_| 1.0));
    }
}
