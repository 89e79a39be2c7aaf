//! What fills the space between surfaces.

use photonlab_photometry::Spectrum;

/// A homogeneous medium that absorbs and scatters light.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// The `id` of the file, or `medium-N`.
    pub id: String,
    /// Extinction coefficient, 1/m.
    pub sigma_t: Spectrum,
    /// Share of what is extinguished that is scattered, in [0, 1].
    pub albedo: Spectrum,
    /// How it is scattered.
    pub phase: Phase,
}

impl Medium {
    /// True if any light is scattered, not only absorbed.
    pub fn scatters(&self) -> bool {
        !self.sigma_t.is_black() && !self.albedo.is_black()
    }
}

/// The distribution of the angle by which a medium scatters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// Evenly in all directions.
    Isotropic,
    /// Henyey and Greenstein's of a mean cosine in (-1, 1), positive forwards.
    HenyeyGreenstein(f64),
}

/// Where a shape parts media: what is on either side, `None` for nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Boundary {
    /// On the back of the normal; index into [`Scene::media`](crate::Scene::media).
    pub interior: Option<u32>,
    /// On the side of the normal.
    pub exterior: Option<u32>,
}
