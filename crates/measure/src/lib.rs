//! Repeated numbers in, honest numbers out: replicates, intervals, tests, readings and records.
//!
//! Error bars come from independent replicates: the photons of one path are correlated, readings from one map are
//! too. [`Replicates`] turns replicate values into a mean with an interval, [`Reading`] is what a meter says,
//! [`Measurement`] the whole answer of `photonlab measure --json`, and [`Record`] what an experiment leaves behind.
//!
//! ```
//! use photonlab_measure::{Comparison, Expected, Replicates};
//!
//! // Eight independent maps, each with its own seed, read the same point.
//! let maps: Replicates = [0.98, 1.03, 1.01, 0.97, 1.02, 0.99, 1.00, 1.04].into_iter().collect();
//! let measured = maps.interval(0.95);
//!
//! let expected = Expected::exact(1.0, "A1: a disc on a uniform plane is unbiased");
//! let comparison = Comparison::judge("disc / truth", "1", expected, measured);
//! assert_eq!(comparison.holds, Some(true));
//! ```
#![forbid(unsafe_code)]

mod binomial;
mod chi_square;
mod comparison;
mod figure;
mod file;
mod finite;
mod group;
mod incomplete_beta;
mod interval;
mod kolmogorov;
mod largest;
mod ledger;
mod lines;
mod log_variance;
mod measurement;
mod quantile;
mod reading;
mod record;
mod replicates;
mod run;
mod sidak;
mod slope;
mod verdict;
mod welch;
mod z_test;

pub use binomial::{binomial_interval, binomial_upper_tail};
pub use chi_square::{ChiSquare, ChiSquareError, chi_square_test};
pub use comparison::{Comparison, Expected};
pub use figure::{Axis, FigureData, ImageEntry, Point, Series, SeriesKind};
pub use file::replace_file;
pub use finite::{NotFinite, json_number};
pub use group::Group;
pub use interval::Interval;
pub use kolmogorov::{KolmogorovSmirnov, KolmogorovSmirnovError, kolmogorov_smirnov_test};
pub use largest::{Uncertain, median_of_largest};
pub use ledger::{FluxBook, FluxLedger};
pub use log_variance::{log_variance_error, shrunken_variances};
pub use measurement::{Measurement, Need, Stopped};
pub use quantile::{normal_quantile, student_t_quantile};
pub use reading::{Place, Reading};
pub use record::{Record, RecordError, Row};
pub use replicates::Replicates;
pub use run::{Budget, Run};
pub use sidak::sidak_level;
pub use slope::{LogLogFit, SlopeError, fit_log_log, fit_log_log_weighted};
pub use verdict::Verdict;
pub use welch::{Welch, welch_test};
pub use z_test::z_test;
