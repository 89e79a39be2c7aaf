//! What a gather returns.

use photonlab_photometry::Colour;

/// A density estimate at a point: irradiance in W/m^2 or lx.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<const C: usize> {
    /// Flux over area. Zero when nothing was found, which is not "dark": see `photons`.
    pub irradiance: Colour<C>,
    /// Estimate of the kernel's bias in `irradiance`, leading order, from a second ball around the same point: the bias
    /// of a disc grows with its radius squared, so two radii tell it (after Hachisuka et al., "A progressive error
    /// estimation framework for photon density estimation", 2010, who use derivatives). Its mean is the bias where the
    /// irradiance is smooth. Where the surface in the balls was asked for, and was not all of their discs, it is a bound: a slope then
    /// makes a bias that grows with the radius itself. Where it was not, near edges and other surfaces, it means nothing.
    pub bias: Colour<C>,
    /// Photons that the estimate rests on.
    pub photons: usize,
    /// Radius of the ball, metres.
    pub radius: f64,
    /// True if the surface in the balls was asked for, was not all of their discs, lies open to light, and is enough more in the larger
    /// ball to tell the bias: the estimate needs no other remedy for the edge that it is near.
    pub remedied: bool,
}

impl<const C: usize> Estimate<C> {
    /// Nothing found within a radius.
    pub fn nothing(radius: f64) -> Self {
        Self { irradiance: Colour::ZERO, bias: Colour::ZERO, photons: 0, radius, remedied: false }
    }
}
