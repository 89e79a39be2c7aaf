//! Draws records as figures and as a report page; computes nothing.
//!
//! A figure's numbers come from [`FigureData`](photonlab_measure::FigureData) as they are: markers with error bars
//! are measured, lines predicted, dashed lines taken from elsewhere.
//!
//! ```
//! use photonlab_measure::{Axis, FigureData, Point, Series, SeriesKind};
//!
//! let law = [10.0, 100.0, 1000.0].map(|k: f64| Point::new(k, 1.0 / (k - 2.0).sqrt()));
//! let figure = FigureData {
//!     id: "noise".into(),
//!     title: "Noise of the k nearest".into(),
//!     caption: "One over the root of k - 2.".into(),
//!     x: Axis::log("k"),
//!     y: Axis::log("relative standard deviation"),
//!     series: vec![Series { label: "law".into(), kind: SeriesKind::Predicted, points: law.into() }],
//! };
//! assert!(photonlab_paper_figures::draw(&figure).unwrap().starts_with("<svg"));
//! ```
#![forbid(unsafe_code)]

mod axes;
mod canvas;
mod chapter;
mod chart;
mod data_uri;
mod error;
mod legend;
mod number;
mod page;
mod plot;
mod report;
mod scale;
mod style;
mod text;
mod ticks;

pub use chapter::Chapter;
pub use chart::{caption, draw};
pub use error::{FigureError, ReportError};
pub use number::{interval_text, plain_text, uncertain_text};
pub use report::{ReportEntry, report};
