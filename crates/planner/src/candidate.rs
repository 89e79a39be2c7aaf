//! A method with its settings, as it enters.

use photonlab_readout::{Demands, Ends, Method, Schedule, Session, Settings};

/// Photons and rays of the shortest pass: a millisecond or two.
const PHOTONS: f64 = 1024.0;
const RAYS: f64 = 2048.0;

/// Points of each cell in the shortest pass, of a few cells, of many and of very many: few points of a pixel tell little of what many, evenly
/// spread over it, would find (the Cornell box, 128 x 128: two points a pass have a fifth of the variance of one).
const POINTS: [(usize, f64); 3] = [(1 << 8, 1.0), (1 << 16, 4.0), (usize::MAX, 2.0)];

/// A way to read a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The method and all that decides its bits.
    pub settings: Settings,
    /// How photons and rays share a pass.
    pub balance: Balance,
}

/// What there is more of in a pass. The noise of final gather is a / photons + b / rays + c / (photons rays) (Ershov and Voloboy), so that neither
/// alone brings it down; the best share follows from the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Balance {
    /// Four times as many photons to a ray as evenly.
    Photons,
    /// Two rays to a photon.
    Even,
    /// A quarter of the photons to a ray.
    Rays,
}

/// When a candidate enters the race.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Heat {
    /// At once.
    First,
    /// If another that reads the map at the point itself is still in the race: noise and bias of all of these are much alike.
    IfKinIsLeft,
    /// If the best of the others needs long: it chooses places in the whole scene before its first pass.
    IfTimeIsLeft,
}

impl Balance {
    /// Factors of photons and of rays, whose product is one.
    fn factors(self) -> [f64; 2] {
        match self {
            Balance::Photons => [2.0, 0.5],
            Balance::Even => [1.0, 1.0],
            Balance::Rays => [0.5, 2.0],
        }
    }
}

impl Candidate {
    /// The candidates of several settings, none of which another makes superfluous. Where final gather reads no map, rays to lamps find all
    /// light there is, and nothing else is needed.
    pub fn of<const C: usize>(settings: &[Settings], session: &Session<'_, C>) -> Vec<Candidate> {
        let with = |settings: Settings| Session { settings, ..*session };
        let gathers = |settings: &&Settings| matches!(settings.method, Method::FinalGather { .. });
        let needs_no_map = |settings: &&Settings| with(**settings).demands().fewest_photons == 0;
        if let Some(&alone) = settings.iter().filter(gathers).find(needs_no_map) {
            return vec![Candidate { settings: alone, balance: Balance::Even }];
        }
        let gathers_without_cache = settings.iter().any(|it| gathers(&it) && !it.aids.cache);
        let balances = |settings: &Settings| -> &[Balance] {
            let is_superfluous = gathers_without_cache && !with(*settings).reads_reflected();
            match settings.method {
                Method::FinalGather { .. } if settings.aids.cache && is_superfluous => &[],
                Method::FinalGather { .. } if settings.aids.cache => &[Balance::Even],
                Method::FinalGather { .. } => &[Balance::Even, Balance::Photons, Balance::Rays],
                Method::Radius { .. } | Method::Adaptive => &[Balance::Photons, Balance::Even],
                Method::Nearest { .. } | Method::Path | Method::Bins => &[Balance::Even],
            }
        };
        let of = |settings: &Settings| {
            let settings = *settings;
            balances(&settings).iter().map(move |&balance| Candidate { settings, balance })
        };
        let mut candidates: Vec<Candidate> = settings.iter().flat_map(of).collect();
        candidates.sort_by_key(Candidate::rank);
        candidates
    }

    /// Who enters first: what is the soonest most often, and costs little to try.
    fn rank(&self) -> u32 {
        match (self.settings.method, self.balance) {
            (Method::FinalGather { .. }, Balance::Even) => u32::from(self.settings.aids.cache) * 6,
            (Method::Bins, _) => 1,
            (Method::Path, _) => 2,
            (Method::FinalGather { .. }, _) => 3,
            (Method::Radius { .. }, _) => 4,
            (Method::Adaptive | Method::Nearest { .. }, _) => 5,
        }
    }

    /// The method, and what it has more of.
    pub fn title(&self) -> String {
        let mut title = match self.settings.method {
            Method::Radius { radius: None } => "progressive".to_string(),
            method => method.name().into(),
        };
        for (text, given) in [(" --cache", self.settings.aids.cache), (" --guided", self.settings.aids.guide)] {
            title.push_str(if given { text } else { "" });
        }
        title.push_str(match self.balance {
            Balance::Photons => ", more photons",
            Balance::Even => "",
            Balance::Rays => ", more rays",
        });
        title
    }

    /// When it enters.
    pub(crate) fn heat(&self) -> Heat {
        match self.settings.method {
            Method::FinalGather { .. } if self.settings.aids.cache => Heat::IfTimeIsLeft,
            Method::FinalGather { .. } | Method::Path | Method::Bins | Method::Radius { .. } => Heat::First,
            Method::Adaptive | Method::Nearest { .. } => Heat::IfKinIsLeft,
        }
    }

    /// Passes that are so many times as long as the shortest.
    pub fn schedule(&self, cells: usize, demands: &Demands, scale: f64, ends: Ends) -> Schedule {
        let [more_photons, more_rays] = self.balance.factors();
        let rays_of_point = cells.max(1) as f64 * f64::from(demands.gather_rays);
        let points = POINTS.iter().find(|(most, _)| cells <= *most).map_or(1.0, |(_, points)| *points);
        let rays = scale * RAYS.max(points * rays_of_point);
        let samples = (rays * more_rays / rays_of_point).clamp(1.0, demands.most_samples as f64).round();
        let photons = (rays * PHOTONS / RAYS * more_photons).max(1.0).round();
        Schedule::of_passes(photons as u64, samples as u64, ends, demands)
    }
}
