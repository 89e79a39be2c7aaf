//! The strategies that claims compare.

use photonlab_gather::Estimator;
use photonlab_readout::{Aids, Direct, Draws, Method, Settings};
use photonlab_trace::Limits;

/// One way to read a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strategy {
    /// File name part.
    pub(super) id: &'static str,
    /// Name in figures and tables.
    pub(super) title: &'static str,
    method: Method,
    direct: Direct,
    /// Rays of each site of an irradiance cache and pass; `None` without one.
    cache: Option<u32>,
    /// What else helps its rays.
    aids: Aids,
}

const NO_AIDS: Aids = Aids { cache: false, guide: false, precompute: false };
/// Photons of the nearest-photon strategies.
const K: usize = 50;

impl Strategy {
    /// The paper's direct view of the map: the k nearest, all light from photons.
    pub(super) const NEAREST_DIRECT_VIEW: Strategy = Strategy {
        id: "nearest-direct-view",
        title: "nearest, all light from photons",
        method: Method::Nearest { k: Some(K) },
        direct: Direct::Photons,
        cache: None,
        aids: NO_AIDS,
    };
    /// The same with a fixed radius.
    pub(super) const RADIUS_DIRECT_VIEW: Strategy = Strategy {
        id: "radius-direct-view",
        title: "radius, all light from photons",
        method: Method::Radius { radius: None },
        direct: Direct::Photons,
        cache: None,
        aids: NO_AIDS,
    };
    /// Direct light sampled, the rest from the map at the point.
    pub(super) const NEAREST: Strategy = Strategy {
        id: "nearest",
        title: "nearest, direct light sampled",
        method: Method::Nearest { k: Some(K) },
        direct: Direct::Sampled,
        cache: None,
        aids: NO_AIDS,
    };
    /// Final gather.
    pub(super) const FINAL_GATHER: Strategy = Strategy {
        id: "final-gather",
        title: "final gather",
        method: Method::FinalGather { radius: None },
        direct: Direct::Sampled,
        cache: None,
        aids: NO_AIDS,
    };
    /// Path tracing.
    pub(super) const PATH: Strategy = Strategy {
        id: "path",
        title: "path tracing",
        method: Method::Path,
        direct: Direct::Sampled,
        cache: None,
        aids: NO_AIDS,
    };
    /// Final gather at few places, and told of all between.
    pub(super) const CACHED: Strategy = Strategy {
        id: "irradiance-cache",
        title: "final gather, irradiance cache",
        cache: Some(64),
        ..Self::FINAL_GATHER
    };
    /// Final gather whose rays the photons near a point guide.
    pub(super) const GUIDED: Strategy = Strategy {
        id: "guided",
        title: "final gather, guided",
        aids: Aids { guide: true, ..NO_AIDS },
        ..Self::FINAL_GATHER
    };
    /// Final gather whose map is read once a pass at places of its own.
    pub(super) const PRECOMPUTED: Strategy = Strategy {
        id: "precomputed",
        title: "final gather, precomputed irradiance",
        aids: Aids { precompute: true, ..NO_AIDS },
        ..Self::FINAL_GATHER
    };
    /// Direct light sampled, the rest from balls at the point, tuned and shrinking from pass to pass.
    pub(super) const PROGRESSIVE: Strategy = Strategy {
        id: "progressive",
        title: "progressive, direct light sampled",
        direct: Direct::Sampled,
        ..Self::RADIUS_DIRECT_VIEW
    };

    /// Every strategy, the paper's direct view first.
    pub(super) const ALL: [Strategy; 5] =
        [Self::NEAREST_DIRECT_VIEW, Self::RADIUS_DIRECT_VIEW, Self::NEAREST, Self::FINAL_GATHER, Self::PATH];

    /// The same with a radius in metres, where it gathers within one.
    pub(super) fn within(self, radius: f64) -> Strategy {
        let radius = Some(radius);
        let method = match self.method {
            Method::Radius { .. } => Method::Radius { radius },
            Method::FinalGather { .. } => Method::FinalGather { radius },
            other => other,
        };
        Strategy { method, ..self }
    }

    /// Its settings at a seed.
    pub(super) fn settings(&self, seed: u64) -> Settings {
        Settings {
            method: self.method,
            direct: self.direct,
            estimator: Estimator::default(),
            gather_rays: self.cache.unwrap_or(1),
            aids: Aids { cache: self.cache.is_some(), ..self.aids },
            draws: Draws::Independent,
            seed,
            limits: Limits::default(),
        }
    }
}
