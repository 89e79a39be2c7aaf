//! Readings at several places of uneven fields, for tables, rows and figures.

use std::f64::consts::LN_10;

use photonlab_gather::Bandwidth;
use photonlab_measure::{Interval, Point, Row, Series, SeriesKind};
use photonlab_reference::nearest_law::RelativeMoments;

use super::{
    table::row,
    trials::Trials,
    uneven::{Reading, Shape, Uneven},
};

/// A reading with its place along a figure's horizontal axis and its name in tables.
pub(super) struct Placed {
    pub(super) place: f64,
    pub(super) name: String,
    pub(super) reading: Reading,
}

impl Placed {
    /// Reads a field at every place; each has random numbers of its own.
    pub(super) fn read(
        places: &[f64],
        bandwidth: Bandwidth,
        first: Trials,
        field_and_name: impl Fn(f64) -> (Uneven, String),
    ) -> anyhow::Result<Vec<Self>> {
        let read = |(i, &place): (usize, &f64)| {
            let (field, name) = field_and_name(place);
            let trials = Trials { group: first.group + i as u64, ..first };
            Ok(Self { place, name, reading: field.read(bandwidth, &trials)? })
        };
        places.iter().enumerate().map(read).collect()
    }

    /// The relative noise with its interval.
    pub(super) fn noise(&self, confidence: f64) -> Option<Interval> {
        let square = self.reading.square.interval(confidence)?;
        let root = |x: f64| x.max(0.0).sqrt();
        Some(Interval { value: root(square.value), low: root(square.low), high: root(square.high), confidence })
    }

    /// The reading over the truth with its interval.
    pub(super) fn mean(&self, confidence: f64) -> Option<Interval> {
        self.reading.mean.interval(confidence)
    }

    pub(super) fn row(&self) -> Row {
        row([
            ("place", self.name.as_str().into()),
            ("replicates", self.reading.mean.len().into()),
            ("mean", self.reading.mean.mean().into()),
            ("mean_std_error", self.reading.mean.std_error().into()),
            ("mean_law", self.reading.law.mean.into()),
            ("relative_variance", self.reading.square.mean().into()),
            ("relative_variance_std_error", self.reading.square.std_error().into()),
            ("relative_variance_law", law_noise(self.reading.law).powi(2).into()),
        ])
    }
}

/// A place of this density on a ramp.
pub(super) fn on_ramp(density: f64, decades_per_metre: f64) -> Uneven {
    Uneven { density, shape: Shape::Ramp { slope: decades_per_metre * LN_10 } }
}

/// Readings as marks with error bars.
pub(super) fn marks(label: &str, places: &[Placed], of: impl Fn(&Placed) -> Option<Interval>) -> Series {
    let points = places.iter().filter_map(|s| Some(Point::measured(s.place, of(s)?))).collect();
    Series { label: label.into(), kind: SeriesKind::Measured, points }
}

/// What a law says all along the axis.
pub(super) fn line(
    label: &str,
    axis: &[f64],
    bandwidth: Bandwidth,
    field: impl Fn(f64) -> Uneven,
    of: impl Fn(RelativeMoments) -> f64,
) -> Series {
    let points = axis.iter().map(|&x| Point::new(x, of(field(x).law(bandwidth)))).collect();
    Series { label: label.into(), kind: SeriesKind::Predicted, points }
}

/// Relative noise of a law: standard deviation over mean.
pub(super) fn law_noise(law: RelativeMoments) -> f64 {
    law.variance.sqrt() / law.mean
}

/// Evenly many decades between the ends of `values`, which ascend.
pub(super) fn logarithmic_axis(values: &[f64]) -> Vec<f64> {
    const STEPS: i32 = 40;
    let (Some(&low), Some(&high)) = (values.first(), values.last()) else {
        return Vec::new();
    };
    (0..=STEPS).map(|i| low * (high / low).powf(f64::from(i) / f64::from(STEPS))).collect()
}

/// The smallest and the largest measured relative noise.
pub(super) fn noise_range(places: &[Placed]) -> (f64, f64) {
    let squares = places.iter().filter_map(|placed| placed.reading.square.mean());
    let (low, high) = squares.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    (low.sqrt(), high.sqrt())
}
