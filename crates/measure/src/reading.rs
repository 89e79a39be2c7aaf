//! What a meter says: one sensor, cell and channel.

use photonlab_photometry::{Quantity, Unit};
use serde::{Deserialize, Serialize};

use crate::finite::{NotFinite, finite_if_some};
use crate::{Replicates, student_t_quantile};

/// Where and what a reading reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The sensor's id in the scene file.
    pub sensor: String,
    /// What is measured; the unit follows from it.
    pub quantity: Quantity,
    /// Column and row; [0, 0] is at (u, v) = (0, 0), columns along u.
    pub cell: [u32; 2],
    /// `Y`, or `R`, `G`, `B`.
    pub channel: String,
}

/// One reading, exactly as an item of `readings` in `measure.schema.json`; what does not apply is null.
///
/// Values, errors and ends are in `unit`. A failure is a row, not a gap: see [`Reading::nothing`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// The sensor's id in the scene file.
    pub sensor: String,
    /// What is measured.
    pub quantity: Quantity,
    /// The unit of every number here but `photons_used` and `radius`.
    pub unit: Unit,
    /// Column and row.
    pub cell: [u32; 2],
    /// `Y`, or `R`, `G`, `B`.
    pub channel: String,
    /// The mean over the cell; null if nothing was found, which is not zero.
    pub value: Option<f64>,
    /// Standard error from independent replicates; null below two.
    pub std_error: Option<f64>,
    /// Bound on the estimator's bias; null if none is known.
    pub bias_bound: Option<f64>,
    /// value - (t std_error + bias_bound).
    pub low: Option<f64>,
    /// value + (t std_error + bias_bound).
    pub high: Option<f64>,
    /// True if the interval is claimed to hold: both a standard error and a bias bound are known.
    pub certified: bool,
    /// Why it is not certified, or what failed.
    pub why: Option<String>,
    /// Photons (or samples) behind the value.
    pub photons_used: Option<f64>,
    /// Radius of the area averaged over, in metres.
    pub radius: Option<f64>,
}

impl Reading {
    /// A reading with low, high = value -/+ (`t` std_error + bias_bound).
    ///
    /// `t` is the two-sided quantile of the wanted confidence ([`student_t_quantile`]). Without a standard error there
    /// is no interval. Without a bias bound the interval is of the noise alone. In both cases the reading is not
    /// certified and says why.
    pub fn new(
        place: Place,
        value: f64,
        std_error: Option<f64>,
        t: f64,
        bias_bound: Option<f64>,
    ) -> Result<Self, NotFinite> {
        let half = std_error.map(|s| t * s + bias_bound.unwrap_or(0.0));
        let why = match (std_error, bias_bound) {
            (Some(_), Some(_)) => None,
            (None, _) => Some("no standard error: fewer than two independent replicates"),
            (Some(_), None) => Some("no bound on the bias is known: the interval is of the noise alone"),
        };
        let reading = Reading {
            value: Some(value),
            std_error,
            bias_bound,
            low: half.map(|h| value - h),
            high: half.map(|h| value + h),
            certified: why.is_none(),
            why: why.map(str::to_owned),
            ..Reading::nothing(place, "")
        };
        reading.check("reading")?;
        Ok(reading)
    }

    /// A reading from the mean of independent replicates, by Student's t; without replicates, [`Reading::nothing`].
    ///
    /// # Panics
    ///
    /// If `confidence` is outside (0, 1).
    pub fn from_replicates(
        place: Place,
        replicates: &Replicates,
        confidence: f64,
        bias_bound: Option<f64>,
    ) -> Result<Self, NotFinite> {
        let Some(value) = replicates.mean() else {
            return Ok(Reading::nothing(place, "no replicate was completed"));
        };
        let std_error = replicates.std_error();
        let t = match std_error {
            Some(_) => student_t_quantile(confidence, replicates.degrees_of_freedom()),
            None => 0.0,
        };
        Reading::new(place, value, std_error, t, bias_bound)
    }

    /// Nothing was found, or the reading failed: no value, not certified, and the reason.
    pub fn nothing(place: Place, why: impl Into<String>) -> Self {
        Reading {
            unit: place.quantity.unit(),
            sensor: place.sensor,
            quantity: place.quantity,
            cell: place.cell,
            channel: place.channel,
            value: None,
            std_error: None,
            bias_bound: None,
            low: None,
            high: None,
            certified: false,
            why: Some(why.into()),
            photons_used: None,
            radius: None,
        }
    }

    /// Adds what the value rests on: photons or samples, and the radius averaged over, in metres.
    pub fn with_support(mut self, photons_used: f64, radius: Option<f64>) -> Result<Self, NotFinite> {
        self.photons_used = Some(photons_used);
        self.radius = radius;
        self.check("reading")?;
        Ok(self)
    }

    /// Withdraws the certificate and says why; an earlier reason is kept in front.
    pub fn not_certified(mut self, why: &str) -> Self {
        self.certified = false;
        self.why = Some(match self.why {
            Some(earlier) => format!("{earlier}; {why}"),
            None => why.to_owned(),
        });
        self
    }

    /// Half the interval's length, in `unit`.
    pub fn half_width(&self) -> Option<f64> {
        Some(0.5 * (self.high? - self.low?))
    }

    /// Half the interval's length over |value|: what `--target-error` asks for. `None` for a value of zero.
    pub fn relative_half_width(&self) -> Option<f64> {
        let value = self.value.filter(|&v| v != 0.0)?;
        Some(self.half_width()? / value.abs())
    }

    pub(crate) fn check(&self, at: &str) -> Result<(), NotFinite> {
        let numbers = [
            ("value", self.value),
            ("std_error", self.std_error),
            ("bias_bound", self.bias_bound),
            ("low", self.low),
            ("high", self.high),
            ("photons_used", self.photons_used),
            ("radius", self.radius),
        ];
        numbers.into_iter().try_for_each(|(name, x)| finite_if_some(at, name, x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place() -> Place {
        Place { sensor: "floor".into(), quantity: Quantity::Illuminance, cell: [1, 2], channel: "Y".into() }
    }

    #[test]
    fn the_interval_is_noise_plus_bias() {
        let r = Reading::new(place(), 100.0, Some(2.0), 2.5, Some(1.0)).unwrap();
        assert_eq!((r.low, r.high, r.certified, r.why.as_deref()), (Some(94.0), Some(106.0), true, None));
        assert_eq!(r.unit, Unit::Lux);
        assert_eq!(r.relative_half_width(), Some(0.06));
    }

    #[test]
    fn what_is_unknown_is_not_certified() {
        let no_bias = Reading::new(place(), 100.0, Some(2.0), 2.0, None).unwrap();
        assert_eq!((no_bias.low, no_bias.certified), (Some(96.0), false));
        let single: Replicates = [3.0].into_iter().collect();
        let no_error = Reading::from_replicates(place(), &single, 0.95, Some(0.0)).unwrap();
        assert_eq!((no_error.value, no_error.low, no_error.certified), (Some(3.0), None, false));
        let none = Reading::from_replicates(place(), &Replicates::new(), 0.95, None).unwrap();
        assert_eq!((none.value, none.relative_half_width(), none.certified), (None, None, false));
    }

    #[test]
    fn reasons_add_up() {
        let r = Reading::nothing(place(), "no photon within the radius").not_certified("time ran out");
        assert_eq!(r.why.as_deref(), Some("no photon within the radius; time ran out"));
    }

    #[test]
    fn a_nan_is_refused_by_name() {
        let nan = Reading::new(place(), f64::NAN, None, 0.0, None).unwrap_err();
        assert_eq!(nan.field, "reading.value");
        let support = Reading::nothing(place(), "dark").with_support(f64::INFINITY, None).unwrap_err();
        assert_eq!(support.field, "reading.photons_used");
    }
}
