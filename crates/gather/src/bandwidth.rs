//! How far to gather, how to weigh, what to divide by, and which photons count.

use crate::{CHECK, Kernel};

/// Which photons an estimate uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bandwidth {
    /// The `k` nearest that pass the tests; the k-th only sets the radius.
    Nearest {
        /// Photons, at least 2.
        k: usize,
        /// Never farther than this, metres; may be infinite.
        max_radius: f64,
    },
    /// All in a closed ball.
    Radius(f64),
}

/// The area that gathered flux is divided by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum AreaModel {
    /// pi r^2, the part of a flat surface inside the ball.
    #[default]
    Disc,
    /// 4 pi r^2, the paper's words taken literally; a quarter of the truth on any flat surface.
    Sphere,
    /// The surface that is inside the ball, weighed by the kernel: even light is read right up to edges and into corners,
    /// and a slope is read with a bias of its own size over the radius.
    Clipped,
    /// The same with the slope across it fitted and taken out (Walter, Hubbard, Shirley and Greenberg, "Global illumination
    /// using local linear density estimation", 1997; Jones, "Simple boundary correction for kernel density estimation",
    /// 1993): light that changes evenly is read right too, with more noise.
    Linear,
    /// pi r^2, and photons far from the tangent plane do not count (Jensen, "Realistic image synthesis using photon mapping", 2001, section
    /// 7.2.1, compresses the sphere to an ellipsoid): those whose height is over a tenth of their distance.
    Flattened,
    /// The surface that is inside the ball and that the point sees, found by rays, and photons that it sees: light does not leak through
    /// walls, and meshes of any kind and number have their area. It takes hundreds of rays for each estimate.
    Visible,
}

/// Height over the tangent plane, over the distance, up to which photons count with [`AreaModel::Flattened`].
const FLAT: f32 = 0.1;

impl AreaModel {
    /// True if it depends on the surface around the point.
    pub(crate) fn asks(self) -> bool {
        matches!(self, AreaModel::Clipped | AreaModel::Linear | AreaModel::Visible)
    }

    /// True if only photons count that the point sees.
    pub(crate) fn hides(self) -> bool {
        self == AreaModel::Visible
    }

    /// How far off the tangent plane photons may lie, over their distance.
    pub(crate) fn flatness(self) -> Option<f32> {
        (self == AreaModel::Flattened).then_some(FLAT)
    }

    /// By what factor the bias grows with a radius `factor` times as large, in leading order, where the surface does not fill the disc.
    pub(crate) fn growth_of_bias(self, factor: f64) -> f64 {
        match self {
            AreaModel::Clipped | AreaModel::Visible => factor,
            AreaModel::Disc | AreaModel::Sphere | AreaModel::Flattened | AreaModel::Linear => factor * factor,
        }
    }

    /// The variance of a fixed radius' bias over that of its value. The bias is the difference between a ball and one of four times its
    /// area, of which the smaller holds a quarter, over what the growth of the bias leaves of it.
    pub fn noise_of_bias(self, remedied: bool) -> f64 {
        let growth = if remedied { self.growth_of_bias(CHECK) } else { CHECK * CHECK };
        (1.0 - 1.0 / (CHECK * CHECK)) / (growth - 1.0).powi(2)
    }

    /// The area in square metres for a squared radius.
    pub fn area(self, radius_squared: f64) -> f64 {
        let disc = std::f64::consts::PI * radius_squared;
        match self {
            // What clips the disc is part of each photon's weight.
            AreaModel::Sphere => 4.0 * disc,
            _ => disc,
        }
    }
}

/// What makes an irradiance of the photons in the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Estimator {
    /// The weight of each photon.
    pub kernel: Kernel,
    /// What their flux is divided by.
    pub area: AreaModel,
    /// True if a wider ball tells the bias, which costs more than the value itself; else [`Estimate::bias`](crate::Estimate::bias) is
    /// zero.
    pub tells_bias: bool,
}

impl Estimator {
    /// One that tells its bias.
    pub const fn new(kernel: Kernel, area: AreaModel) -> Self {
        Self { kernel, area, tells_bias: true }
    }
}

impl From<AreaModel> for Estimator {
    /// With the disc for a kernel, as the paper has it.
    fn from(area: AreaModel) -> Self {
        Self::new(Kernel::Disc, area)
    }
}

impl Default for Estimator {
    fn default() -> Self {
        Self::from(AreaModel::default())
    }
}

/// Which photons in the ball count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tests {
    /// Only photons on surfaces whose normal (on the photon's side) is within 60 degrees of the point's. Wide enough
    /// for curved surfaces of any radius above the gather radius, narrow enough to part the faces of a corner.
    pub normal: bool,
    /// Only photons that travelled towards the point's side of the surface.
    pub side: bool,
    /// Only photons whose path has at most this many segments.
    pub max_segments: Option<u32>,
}

impl Default for Tests {
    fn default() -> Self {
        Self { normal: true, side: true, max_segments: None }
    }
}
