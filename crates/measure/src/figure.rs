//! The numbers of a figure; `paper-figures` draws them and adds nothing.

use serde::{Deserialize, Serialize};

use crate::finite::{NotFinite, finite, finite_if_some};

/// One figure: axes and series of points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FigureData {
    /// Its name within the record, fit for a file name.
    pub id: String,
    /// What it shows, as a headline.
    pub title: String,
    /// What to see in it and how it was measured.
    pub caption: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The series, in the order of the legend.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// True for a logarithmic scale.
    pub log: bool,
    /// Where the axis has names in place of numbers: the n-th stands at n, counted from 1, and no line joins them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Axis { label: label.into(), log: false, names: Vec::new() }
    }

    /// A logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Axis { label: label.into(), log: true, names: Vec::new() }
    }

    /// Names side by side: a point belongs to the n-th if its place lies within half a step of n.
    pub fn named<'a>(label: impl Into<String>, names: impl IntoIterator<Item = &'a str>) -> Self {
        Axis { label: label.into(), log: false, names: names.into_iter().map(String::from).collect() }
    }
}

/// What a series' numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SeriesKind {
    /// Measured here: drawn as markers with error bars.
    Measured,
    /// Predicted by a law: drawn as a line, with a band if it has an interval.
    Predicted,
    /// Published or computed elsewhere: drawn as a dashed line.
    Reference,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// What its numbers are.
    pub kind: SeriesKind,
    /// The points, in the order in which a line joins them.
    pub points: Vec<Point>,
}

/// A point, with its interval in y where it has one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
    /// Lower end of the interval.
    #[serde(default)]
    pub low: Option<f64>,
    /// Upper end of the interval.
    #[serde(default)]
    pub high: Option<f64>,
}

impl Point {
    /// A point without an interval.
    pub fn new(x: f64, y: f64) -> Self {
        Point { x, y, low: None, high: None }
    }

    /// A measured point with its interval.
    pub fn measured(x: f64, y: crate::Interval) -> Self {
        Point { x, y: y.value, low: Some(y.low), high: Some(y.high) }
    }
}

/// A picture that belongs to a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageEntry {
    /// What it shows.
    pub title: String,
    /// The file, relative to the record.
    pub path: String,
    /// What to see in it.
    pub caption: String,
}

impl FigureData {
    pub(crate) fn check(&self, at: &str) -> Result<(), NotFinite> {
        for (s, series) in self.series.iter().enumerate() {
            for (p, point) in series.points.iter().enumerate() {
                let at = format!("{at}.series[{s}].points[{p}]");
                finite(&at, "x", point.x)?;
                finite(&at, "y", point.y)?;
                finite_if_some(&at, "low", point.low)?;
                finite_if_some(&at, "high", point.high)?;
            }
        }
        Ok(())
    }
}
