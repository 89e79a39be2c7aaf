//! Refractive indices.

use std::sync::Arc;

use photonlab_photometry::Curve;

/// A refractive index, which may depend on the wavelength.
#[derive(Clone, Debug, PartialEq)]
pub enum Index {
    /// The same at every wavelength.
    Constant(f64),
    /// `n = a + b / l^2`, with l in micrometres (Cauchy).
    Cauchy([f64; 2]),
    /// `n^2 = 1 + sum b l^2 / (l^2 - c)`, with l in micrometres (Sellmeier): three b, then three c in square micrometres.
    Sellmeier([f64; 6]),
    /// A table, linear between its wavelengths.
    Table(Arc<Curve>),
}

impl Index {
    /// The index at a wavelength in nanometres.
    pub fn at(&self, nm: f64) -> f64 {
        let l2 = (1e-3 * nm).powi(2);
        match self {
            Index::Constant(index) => *index,
            Index::Cauchy([a, b]) => a + b / l2,
            Index::Sellmeier([b1, b2, b3, c1, c2, c3]) => {
                let term = |b: f64, c: f64| b * l2 / (l2 - c);
                (1.0 + term(*b1, *c1) + term(*b2, *c2) + term(*b3, *c3)).sqrt()
            }
            Index::Table(curve) => curve.at(nm),
        }
    }

    /// True if it is known, and an index, from one wavelength (nm) to another.
    pub fn holds_over(&self, band: [f64; 2]) -> bool {
        let known = match self {
            Index::Table(curve) => curve.range()[0] <= band[0] && band[1] <= curve.range()[1],
            _ => true,
        };
        // A pole between the ends shows as an index below one, or none, near it.
        let steps = (0..=1000).map(|i| band[0] + (band[1] - band[0]) * f64::from(i) / 1000.0);
        known && steps.into_iter().all(|nm| (1.0..=100.0).contains(&self.at(nm)))
    }

    /// True if it depends on the wavelength.
    pub fn disperses(&self) -> bool {
        !matches!(self, Index::Constant(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// N-BK7 at the d line has 1.5168 (the glass maker's data sheet).
    #[test]
    fn formulae_give_known_indices() {
        let bk7 = Index::Sellmeier([1.03961212, 0.231792344, 1.01046945, 0.00600069867, 0.0200179144, 103.560653]);
        assert!((bk7.at(587.5618) - 1.5168).abs() < 1e-5);
        assert!((Index::Cauchy([1.5046, 0.0042]).at(500.0) - 1.5214).abs() < 1e-12);
    }
}
