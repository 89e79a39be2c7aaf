//! What to do: the method and its settings.

use photonlab_final_gather::EyeLimits;
use photonlab_gather::Estimator;
use photonlab_sampling::{EmissionPlan, Lamps, PlanError, Sought};
use photonlab_trace::{Classes, Limits};

/// How light at a diffuse point is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// From the map at the point: the k nearest photons.
    Nearest {
        /// Photons, at least 2; `None` takes it from the photons of two passes and lets it shrink from pass to pass.
        k: Option<usize>,
    },
    /// From the map at the point: all photons in a ball.
    Radius {
        /// Metres, read plainly; `None` takes it from the photons of two passes, lets it shrink from pass to pass, and takes the told bias off
        /// as far as earlier passes have shown that it stands above its noise.
        radius: Option<f64>,
    },
    /// From the map at the point: all photons in a ball whose radius each cell finds for itself, from the bias and noise of
    /// earlier passes; the told bias is taken off likewise.
    Adaptive,
    /// By looking around once and gathering where the rays land.
    FinalGather {
        /// Metres; `None` as for [`Method::Radius`].
        radius: Option<f64>,
    },
    /// Path tracing without a map: the control.
    Path,
    /// Photons counted in the receivers' cells, without a map.
    Bins,
}

impl Method {
    /// True if the map is read at the point itself.
    pub fn is_direct_view(&self) -> bool {
        match self {
            Method::Nearest { .. } | Method::Radius { .. } | Method::Adaptive => true,
            Method::FinalGather { .. } | Method::Path | Method::Bins => false,
        }
    }

    /// True if the radius, or the number of photons, is chosen by a look at the photons of two passes.
    pub fn is_tuned(&self) -> bool {
        matches!(self, Method::Radius { radius: None } | Method::Nearest { k: None } | Method::Adaptive)
    }

    /// How photons are drawn if nobody says: evenly, but for the k nearest. The flux of k - 1 over the area of the k-th one's ball is right
    /// where photons are independent; of evenly spread ones that ball ends halfway between two, and reads up to 1/(2 k) too little.
    pub fn usual_draws(&self) -> Draws {
        match self {
            Method::Nearest { .. } => Draws::Independent,
            _ => Draws::Spread,
        }
    }

    /// The method's name on the command line and in results.
    pub fn name(&self) -> &'static str {
        match self {
            Method::Nearest { .. } => "nearest",
            Method::Radius { .. } => "radius",
            Method::Adaptive => "adaptive",
            Method::FinalGather { .. } => "final-gather",
            Method::Path => "path",
            Method::Bins => "bins",
        }
    }
}

/// Where direct light comes from when the map is read at the point itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Direct {
    /// From the lamps, by sampling.
    #[default]
    Sampled,
    /// From the map, with all other light: the paper's direct view.
    Photons,
}

/// Everything that decides the bits of a reading besides the scene and the counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How light is found.
    pub method: Method,
    /// Where direct light comes from (map methods alone).
    pub direct: Direct,
    /// How gathered photons are weighed and what their flux is divided by (map methods alone; final gather uses its kernel
    /// and divides by the disc).
    pub estimator: Estimator,
    /// Rays per gather point; of a cache, per site and pass.
    pub gather_rays: u32,
    /// What makes final gather's rays fewer, better or cheaper.
    pub aids: Aids,
    /// How photons are drawn.
    pub draws: Draws,
    /// The run's seed.
    pub seed: u64,
    /// Longest path in segments (as Mitsuba's `max_depth`) and longest specular run.
    pub limits: Limits,
}

/// What makes final gather's rays fewer, better or cheaper. Guided rays go to the same mean; a cache errs by a bias that is told, precomputed irradiance by one
/// that is told in part (see [`Precomputed`](photonlab_gather::Precomputed)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Aids {
    /// Final gather looks around at few places alone and tells of all between: the paper's irradiance map.
    pub cache: bool,
    /// Photons near a point guide its rays to where the light comes from.
    pub guide: bool,
    /// The map is read at places of its own once a pass, and rays take what is known where they land.
    pub precompute: bool,
}

/// How the photons of one pass leave their lamps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Draws {
    /// Evenly spread, by scrambled Sobol points (see [`EmissionPlan::spread`]): less noise wherever light arrives by few scatterings.
    Spread,
    /// Each by itself, as the laws of photon maps presume.
    Independent,
}

impl Settings {
    /// The photons of a pass that finds the light that is sought.
    pub(crate) fn plan<const C: usize>(
        &self,
        lamps: &Lamps<C>,
        photons: u64,
        sought: Sought,
        pass: u32,
    ) -> Result<EmissionPlan<C>, PlanError> {
        let plan = EmissionPlan::new(lamps, photons, sought)?;
        Ok(match self.draws {
            Draws::Spread => plan.spread(self.seed, pass),
            Draws::Independent => plan,
        })
    }

    /// When a ray that looks for light gives up.
    pub(crate) fn eye_limits(&self) -> EyeLimits {
        EyeLimits { max_segments: self.limits.max_segments, max_specular: self.limits.max_specular }
    }

    /// Final-gather rays of each sample.
    pub(crate) fn rays_per_sample(&self) -> u32 {
        if self.aids.cache { 1 } else { self.gather_rays }
    }

    /// Classes of photon that the method reads.
    pub fn classes(&self) -> Classes {
        match (self.method, self.direct) {
            (Method::Path | Method::Bins, _) => Classes::NONE,
            (Method::FinalGather { .. }, _) | (_, Direct::Photons) => Classes::ALL,
            (_, Direct::Sampled) => Classes { direct: false, ..Classes::ALL },
        }
    }
}
