//! How fast density estimates converge: mean squared errors at a finite number of photons, exactly.
//!
//! `N` independent photons fall on a torus of 1 m by 1 m, each with the flux `1 / N`, so that the mean irradiance is 1. A disc of
//! radius `r` that holds the share `q` of all light counts a binomial number of them: the variance of the estimate is
//! `q (1 - q) / (N (pi r^2)^2)`, not a leading order of it. At a smooth point the squared bias goes as `r^4` and the variance as
//! `1 / (N r^2)`, so that the least error goes as `N^(-2/3)` ([`cosine_torus`], [`progressive`]); over an image with an edge the
//! squared bias goes as `r` and the least error as `N^(-1/3)` ([`half_lit_torus`]). (Catalogue entries H1, H2, H3 and H5.)

pub mod cosine_torus;
pub mod gathered_sphere;
pub mod half_lit_torus;
mod least;
pub mod progressive;

/// An estimate's error, in units of the mean irradiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// Mean less truth.
    pub bias: f64,
    /// About the mean.
    pub variance: f64,
}

impl Error {
    /// Variance plus squared bias.
    pub fn mean_squared(&self) -> f64 {
        self.variance + self.bias * self.bias
    }
}
