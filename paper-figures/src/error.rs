//! What cannot be drawn, and why.

use std::path::PathBuf;

/// Why a figure cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FigureError {
    /// There is no point in any series.
    #[error("figure {figure}: no points to draw")]
    Empty {
        /// The figure's id.
        figure: String,
    },
    /// A coordinate is NaN or infinite.
    #[error("figure {figure}: series {series:?} has a coordinate that is {value}")]
    NotFinite {
        /// The figure's id.
        figure: String,
        /// The series' label.
        series: String,
        /// The coordinate.
        value: f64,
    },
    /// A point's x is zero or below on a logarithmic axis.
    #[error("figure {figure}: series {series:?} has x = {x} on a logarithmic axis")]
    NotOnLogAxis {
        /// The figure's id.
        figure: String,
        /// The series' label.
        series: String,
        /// The x.
        x: f64,
    },
    /// A point's place belongs to none of the x axis' names.
    #[error("figure {figure}: series {series:?} has a point at x = {x}, but the axis has {names} names")]
    NoSuchName {
        /// The figure's id.
        figure: String,
        /// The series' label.
        series: String,
        /// The x.
        x: f64,
        /// How many names the axis has.
        names: usize,
    },
    /// Names stand along the horizontal axis only.
    #[error("figure {figure}: the vertical axis has names; only the horizontal one can")]
    NamesUpright {
        /// The figure's id.
        figure: String,
    },
    /// No value or interval end is above zero on a logarithmic y axis.
    #[error("figure {figure}: nothing above zero on a logarithmic y axis")]
    NothingAboveZero {
        /// The figure's id.
        figure: String,
    },
}

/// Why a report cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A figure cannot be drawn.
    #[error("claim {claim}: {source}")]
    Figure {
        /// The record's claim.
        claim: String,
        /// Why.
        source: FigureError,
    },
    /// Two records are of one claim.
    #[error("two records are of the claim {claim}")]
    Twice {
        /// The claim.
        claim: String,
    },
    /// The bytes of a picture were not passed in: a missing picture is an error, not a gap.
    #[error("claim {claim}: the picture {path} is missing")]
    MissingImage {
        /// The record's claim.
        claim: String,
        /// The picture's path in the record.
        path: String,
    },
    /// A picture is neither PNG nor JPEG.
    #[error("claim {claim}: the picture {path} is neither PNG nor JPEG")]
    UnknownImage {
        /// The record's claim.
        claim: String,
        /// The picture's path in the record.
        path: String,
    },
    /// A picture's file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The page's template failed.
    #[error("the report's template: {0}")]
    Template(#[from] minijinja::Error),
}
