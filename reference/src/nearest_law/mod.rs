//! The k-nearest estimate: what `k` photons over `pi r_k^2` read, exactly.
//!
//! In a Poisson field the expected number of photons within the distance of the k-th nearest, `A(r_k)`, is a Gamma(k)
//! variable whatever the surface and its density (the mapping theorem; Kingman, "Poisson Processes", 1993). In uniform
//! flux `A = lambda pi r^2`, and everything follows from the moments of `1 / Gamma(k)` ([`uniform`], [`uniform_finite`],
//! [`capped`]); near edges and in curved fields from one integral ([`in_field`] and the laws built on it).
//!
//! All results are relative to the true irradiance at the query. (Catalogue entries A2, A4, A6, A7, B3, B5, B7.)

mod capped;
mod field;
mod uniform;

pub use capped::{capped, starved_by_furthest};
pub use field::{corner, crease, half_plane, in_field, quadratic, strip_centre, thin_wall};
pub use uniform::{AreaUsed, uniform, uniform_finite};

/// How many of the k photons found are counted in the estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// All `k`: the naive estimate, `k / (k - 1)` too high in uniform flux.
    All,
    /// The `k - 1` inside; the k-th only sets the radius. Unbiased in uniform flux.
    AllButLast,
}

impl Counted {
    /// The number counted out of `k`.
    fn of(self, k: u32) -> f64 {
        match self {
            Counted::All => f64::from(k),
            Counted::AllButLast => f64::from(k) - 1.0,
        }
    }
}

/// Mean and variance of an estimate, relative to the true irradiance and to its square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeMoments {
    /// Mean; 1 is unbiased.
    pub mean: f64,
    /// Variance about the mean; infinite where it does not exist.
    pub variance: f64,
}

impl RelativeMoments {
    /// Mean squared error: variance plus squared bias.
    pub fn mean_squared_error(&self) -> f64 {
        self.variance + (self.mean - 1.0).powi(2)
    }
}
