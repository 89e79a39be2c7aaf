//! What one look at a point found.

use photonlab_photometry::{Colour, Palette};

/// One sample of the light at a point: irradiance in W/m^2 or lx, and what is known of its bias.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Light<const C: usize> {
    /// Its mean over samples is the irradiance (up to `bias`).
    pub irradiance: Colour<C>,
    /// Its mean over samples estimates the kernel's bias in `irradiance`.
    pub bias: Colour<C>,
    /// Variance of the mean over channels of a density estimate at the point itself, were its photons alike and independent:
    /// what one photon more or less changes. Zero where none was made.
    pub noise: f64,
    /// The same of `bias`.
    pub noise_of_bias: f64,
    /// The part of `irradiance` that was gathered with a ball reaching over an edge or onto another surface, where
    /// `bias` says nothing.
    pub unresolved: Colour<C>,
    /// Photons gathered.
    pub photons: f64,
    /// Times that a map was read. Where none was, no photon was asked for: all light came by rays to lamps.
    pub reads: f64,
    /// Times that the map was read at the point itself with a ball reaching over an edge or onto another surface.
    pub astray: f64,
    /// Times that it was read so at an edge with a remedy, where `bias` bounds the bias and does not estimate it.
    pub remedied: f64,
    /// Rays from diffuse points that met a lamp behind specular surfaces, by chance.
    pub glints: f64,
}

impl<const C: usize> Light<C> {
    /// Adds another contribution.
    pub fn add(&mut self, other: &Self) {
        self.irradiance += other.irradiance;
        self.bias += other.bias;
        self.noise += other.noise;
        self.noise_of_bias += other.noise_of_bias;
        self.unresolved += other.unresolved;
        self.photons += other.photons;
        self.reads += other.reads;
        self.glints += other.glints;
        self.astray += other.astray;
        self.remedied += other.remedied;
    }

    /// Weights flux quantities; the photons that were looked at stay.
    pub fn weighted(&self, weight: Colour<C>) -> Self {
        Self {
            irradiance: self.irradiance * weight,
            bias: self.bias * weight,
            noise: self.noise * weight.max() * weight.max(),
            noise_of_bias: self.noise_of_bias * weight.max() * weight.max(),
            unresolved: self.unresolved * weight,
            photons: self.photons,
            reads: self.reads,
            glints: self.glints,
            astray: self.astray,
            remedied: self.remedied,
        }
    }

    /// The results of what the channels carry.
    pub fn developed(&self, palette: &Palette<C>) -> Self {
        Self {
            irradiance: palette.develop(self.irradiance),
            bias: palette.develop(self.bias),
            noise: self.noise,
            noise_of_bias: self.noise_of_bias,
            unresolved: palette.develop(self.unresolved),
            photons: self.photons,
            reads: self.reads,
            glints: self.glints,
            astray: self.astray,
            remedied: self.remedied,
        }
    }

    /// Divides everything by a number of samples.
    pub fn over(&self, samples: f64) -> Self {
        Self {
            photons: self.photons / samples,
            reads: self.reads / samples,
            astray: self.astray / samples,
            remedied: self.remedied / samples,
            glints: self.glints / samples,
            noise: self.noise / samples,
            noise_of_bias: self.noise_of_bias / samples,
            ..self.weighted(Colour::splat(1.0 / samples))
        }
    }
}
