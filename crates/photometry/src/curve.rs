//! A quantity by wavelength.

/// Values at rising wavelengths, linear between them and zero beyond, as Mitsuba's spectra are.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    nm: Vec<f64>,
    values: Vec<f64>,
}

/// Why a list is no curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// A curve has a width.
    #[error("a spectrum needs at least two wavelengths")]
    TooShort,
    /// Wavelengths must rise.
    #[error("{after} nm comes after {before} nm")]
    OutOfOrder {
        /// A wavelength, nm.
        before: f64,
        /// The one that follows it, nm.
        after: f64,
    },
    /// Wavelengths are finite and above zero.
    #[error("{0} nm is no wavelength")]
    NoWavelength(f64),
}

impl Curve {
    /// From pairs of a wavelength in nanometres and a value, by rising wavelength.
    pub fn new(points: &[(f64, f64)]) -> Result<Self, CurveError> {
        if points.len() < 2 {
            return Err(CurveError::TooShort);
        }
        for &(nm, _) in points {
            if !(nm.is_finite() && nm > 0.0) {
                return Err(CurveError::NoWavelength(nm));
            }
        }
        for pair in points.windows(2) {
            if pair[1].0 <= pair[0].0 {
                return Err(CurveError::OutOfOrder { before: pair[0].0, after: pair[1].0 });
            }
        }
        Ok(Self { nm: points.iter().map(|p| p.0).collect(), values: points.iter().map(|p| p.1).collect() })
    }

    /// Value at a wavelength in nanometres.
    pub fn at(&self, nm: f64) -> f64 {
        let [first, last] = self.range();
        if !(first..=last).contains(&nm) {
            return 0.0;
        }
        let after = self.nm.partition_point(|&x| x <= nm).min(self.nm.len() - 1);
        let (a, b) = (self.nm[after - 1], self.nm[after]);
        let share = (nm - a) / (b - a);
        self.values[after - 1] * (1.0 - share) + self.values[after] * share
    }

    /// Every value times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { nm: self.nm.clone(), values: self.values.iter().map(|value| value * factor).collect() }
    }

    /// First and last wavelength, nanometres.
    pub fn range(&self) -> [f64; 2] {
        [self.nm[0], self.nm[self.nm.len() - 1]]
    }

    /// The wavelengths at which it bends, nanometres.
    pub fn wavelengths(&self) -> &[f64] {
        &self.nm
    }

    /// The values there.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_linear_within_and_zero_beyond() {
        let curve = Curve::new(&[(400.0, 1.0), (500.0, 3.0), (510.0, 0.5)]).unwrap();
        for (nm, value) in [(399.9, 0.0), (400.0, 1.0), (450.0, 2.0), (500.0, 3.0), (505.0, 1.75), (510.0, 0.5)] {
            assert!((curve.at(nm) - value).abs() < 1e-12, "{nm}");
        }
        assert_eq!(curve.at(510.1), 0.0);
    }

    #[test]
    fn wavelengths_out_of_order_are_refused() {
        let wrong = |points: &[(f64, f64)]| Curve::new(points).unwrap_err();
        assert_eq!(wrong(&[(500.0, 1.0), (400.0, 1.0)]), CurveError::OutOfOrder { before: 500.0, after: 400.0 });
        assert_eq!(wrong(&[(500.0, 1.0), (500.0, 1.0)]), CurveError::OutOfOrder { before: 500.0, after: 500.0 });
        assert_eq!(wrong(&[(500.0, 1.0)]), CurveError::TooShort);
        assert!(matches!(wrong(&[(f64::NAN, 1.0), (500.0, 1.0)]), CurveError::NoWavelength(_)));
    }
}
