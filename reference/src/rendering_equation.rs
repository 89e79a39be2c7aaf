//! Three readings of the paper's equation 1, on a diffuse transmitter, and what it leaves of a radiance in a medium.
//!
//! Eq. 1 of Zhdanov and Krimmel multiplies the integral of `BSDF L (n . v')` over all `4 pi` directions by `1 / pi`.
//! A thin diffuser that reflects `rho` and transmits `tau`, lit by irradiance `E_front` and `E_back`, has on its front
//! the radiance `(rho E_front + tau E_back) / pi`: both shares of the flux leave as Lambertian exitance. Then
//!
//! - with a BSDF in 1/sr (`rho / pi`, `tau / pi`) the extra `1 / pi` makes eq. 1 read `pi` times too low;
//! - with luminance factors (relative to a perfect diffuser: `rho`, `tau`) and `|n . v'|` it is right;
//! - with `n . v'` taken with its sign, light from behind counts as negative: `(rho E_front - tau E_back) / pi`.
//!
//! Between point and observer eq. 1 has the medium's transmittance and no term for light that the medium scatters into the
//! line: of a slab it shows [`transmittance`] times what is behind, whatever its albedo.

use std::f64::consts::PI;

use crate::out_of_range::{OutOfRange, require};

/// The share of a radiance that a slab of this optical thickness leaves on a line at this cosine from its normal, in
/// `(0, 1]`, by eq. 1: `exp(-thickness / cosine)` (Bouguer's law).
pub fn transmittance(thickness: f64, cosine: f64) -> f64 {
    (-thickness / cosine).exp()
}

/// How the symbols of eq. 1 are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EquationReading {
    /// Luminance factor and absolute cosine: the right answer.
    LuminanceFactor,
    /// BSDF in 1/sr and absolute cosine: `pi` times too low.
    PerSteradian,
    /// Luminance factor and signed cosine: transmitted light is subtracted.
    SignedCosine,
}

/// A thin sheet that scatters diffusely to both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmitter {
    reflectance: f64,
    transmittance: f64,
}

impl DiffuseTransmitter {
    /// A sheet with these shares of the incident flux, both at least 0 and together at most 1.
    pub fn new(reflectance: f64, transmittance: f64) -> Result<Self, OutOfRange> {
        require(reflectance >= 0.0, "reflectance", reflectance, "at least 0")?;
        require(transmittance >= 0.0, "transmittance", transmittance, "at least 0")?;
        let sum = reflectance + transmittance;
        require(sum <= 1.0, "reflectance plus transmittance", sum, "at most 1")?;
        Ok(DiffuseTransmitter { reflectance, transmittance })
    }

    /// The true radiance of the front side, in W/(m^2 sr) or cd/m^2, for irradiance on front and back in W/m^2 or lx.
    pub fn radiance(&self, front: f64, back: f64) -> f64 {
        (self.reflectance * front + self.transmittance * back) / PI
    }

    /// What eq. 1 gives for the front side when its symbols are read in this way.
    pub fn read(&self, reading: EquationReading, front: f64, back: f64) -> f64 {
        match reading {
            EquationReading::LuminanceFactor => self.radiance(front, back),
            EquationReading::PerSteradian => self.radiance(front, back) / PI,
            EquationReading::SignedCosine => self.radiance(front, -back),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::Gauss;

    /// Incident radiance over the sphere, bright from above, dimmer from below; depends on z alone.
    fn incident(z: f64) -> f64 {
        if z > 0.0 { 3.0 + 2.0 * z * z } else { 1.0 - z }
    }

    #[test]
    fn each_reading_is_the_integral_it_names() {
        let sheet = DiffuseTransmitter::new(0.5, 0.3).expect("valid");
        let rule = Gauss::new(8);
        let front = rule.integrate(0.0, 1.0, |z| 2.0 * PI * z * incident(z));
        let back = rule.integrate(-1.0, 0.0, |z| -2.0 * PI * z * incident(z));
        for reading in [EquationReading::LuminanceFactor, EquationReading::PerSteradian, EquationReading::SignedCosine]
        {
            let eq1 = |z: f64| {
                let factor = if z > 0.0 { sheet.reflectance } else { sheet.transmittance };
                let (bsdf, cosine) = match reading {
                    EquationReading::LuminanceFactor => (factor, z.abs()),
                    EquationReading::PerSteradian => (factor / PI, z.abs()),
                    EquationReading::SignedCosine => (factor, z),
                };
                2.0 * bsdf * incident(z) * cosine
            };
            let integral = rule.integrate(-1.0, 0.0, eq1) + rule.integrate(0.0, 1.0, eq1);
            let got = sheet.read(reading, front, back);
            assert!((got - integral).abs() < 1e-12, "{reading:?}: {got} {integral}");
        }
    }

    #[test]
    fn energy_leaves_as_it_came() {
        let sheet = DiffuseTransmitter::new(0.6, 0.4).expect("valid");
        let leaving = PI * (sheet.radiance(7.0, 2.0) + sheet.radiance(2.0, 7.0));
        assert!((leaving - 9.0).abs() < 1e-12);
        assert!(DiffuseTransmitter::new(0.7, 0.4).is_err());
        assert!(DiffuseTransmitter::new(f64::NAN, 0.4).is_err());
    }
}
