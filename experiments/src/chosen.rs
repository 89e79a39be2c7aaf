//! The method that the options ask for; an option that it does not use is an error.

use std::time::Duration;

use photonlab_gather::{AreaModel, Estimator, Kernel};
use photonlab_photometry::UnitSystem;
use photonlab_readout::{Aids, Direct, Draws, Method, Settings, Wanted};
use photonlab_scene::Scene;
use photonlab_trace::Limits;

use crate::{
    Failure,
    command::{AreaName, DeviceName, DirectName, DrawsName, KernelName, MethodName, Options, UnitsName},
};

/// Reads even light right up to edges and into corners, where the disc reads down to a quarter; what a slope leaves is in the error
/// bar, and no reading is below zero, as a linear fit's may be. In the open it is the disc.
pub(crate) const DEFAULT_ESTIMATOR: Estimator = Estimator::new(Kernel::Disc, AreaModel::Clipped);

impl Options {
    /// The settings for a scene; `auto` is the first method, in a fixed order, that uses every option given.
    pub(crate) fn settings(&self, scene: &Scene) -> Result<Settings, Failure> {
        self.refuse_what_is_not_built()?;
        self.settings_of(self.method_name()?, scene)
    }

    /// The settings of every method that uses every option given, final gather with a cache and without where nobody has decided that.
    pub(crate) fn all_settings(&self, scene: &Scene) -> Result<Vec<Settings>, Failure> {
        use MethodName::{Adaptive, Bins, FinalGather, Nearest, Path, Progressive};
        self.refuse_what_is_not_built()?;
        let first = self.settings(scene)?;
        let others =
            [FinalGather, Progressive, Adaptive, Nearest, Bins, Path].into_iter().filter(|&name| self.fits(name));
        let mut all: Vec<Settings> = others.filter_map(|name| self.settings_of(name, scene).ok()).collect();
        if !all.contains(&first) {
            all.insert(0, first);
        }
        let cached = Options { cache: true, ..self.clone() };
        if cached.fits(FinalGather) {
            all.extend(cached.settings_of(FinalGather, scene).ok().filter(|settings| !all.contains(settings)));
        }
        Ok(all)
    }

    /// True if `auto` is to find the method that reaches a wanted error soonest: counts and saved photons leave nothing to choose.
    pub(crate) fn is_planned(&self) -> bool {
        let counts = [self.photons, self.passes, self.spp];
        self.method == MethodName::Auto
            && self.target_error.is_some()
            && self.map.is_none()
            && counts.iter().all(Option::is_none)
    }

    fn settings_of(&self, name: MethodName, scene: &Scene) -> Result<Settings, Failure> {
        for (option, given, users) in self.uses() {
            if given && !users.contains(&name) {
                let users: Vec<_> = users.iter().map(|user| user.text()).collect();
                return Err(Failure::usage(format!(
                    "--{option} is not used by the method {}; leave it out, or choose --method {}",
                    name.text(),
                    users.join(" or ")
                )));
            }
        }
        if self.k.is_some_and(|k| k < 2) {
            return Err(Failure::usage("--k must be at least 2: the k-th photon only sets the radius"));
        }
        let method = match name {
            MethodName::Nearest => Method::Nearest { k: self.k.map(|k| usize::try_from(k).unwrap_or(usize::MAX)) },
            // Without a radius of the user's own, that method is the progressive one: tuned, and shrinking from pass to pass.
            MethodName::Radius | MethodName::Progressive => Method::Radius { radius: self.radius },
            MethodName::Adaptive => Method::Adaptive,
            MethodName::Path => Method::Path,
            MethodName::Bins => Method::Bins,
            _ => Method::FinalGather { radius: self.radius },
        };
        let direct = match self.direct {
            Some(DirectName::Photons) => Direct::Photons,
            Some(DirectName::Sampled) | None => Direct::Sampled,
        };
        let area = match self.area {
            Some(AreaName::Sphere) => AreaModel::Sphere,
            Some(AreaName::Clipped) => AreaModel::Clipped,
            Some(AreaName::Linear) => AreaModel::Linear,
            Some(AreaName::Flattened) => AreaModel::Flattened,
            Some(AreaName::Visible) => AreaModel::Visible,
            Some(AreaName::Disc) => AreaModel::Disc,
            None => DEFAULT_ESTIMATOR.area,
        };
        let kernel = match self.kernel {
            Some(KernelName::Disc) => Kernel::Disc,
            Some(KernelName::Cone) => Kernel::Cone,
            Some(KernelName::Epanechnikov) => Kernel::Epanechnikov,
            Some(KernelName::Biweight) => Kernel::Biweight,
            Some(KernelName::Gaussian) => Kernel::Gaussian,
            None => DEFAULT_ESTIMATOR.kernel,
        };
        if self.cache && self.guided {
            return Err(Failure::usage(
                "--guided guides rays of each point and --cache sends none there; give one of them",
            ));
        }
        if self.cache && !scene.media.is_empty() {
            return Err(Failure::usage("--cache is not built yet for scenes with media; leave it out"));
        }
        if self.cache && self.time_limit.is_some() {
            return Err(Failure::usage(
                "--cache is not built yet together with --time-limit; give --target-error or counts",
            ));
        }
        Ok(Settings {
            method,
            direct,
            estimator: Estimator::new(kernel, area),
            gather_rays: self.gather_rays.unwrap_or(usual_gather_rays(self.cache)),
            aids: Aids { cache: self.cache, guide: self.guided, precompute: false },
            draws: self.draws(method),
            seed: self.seed,
            limits: Limits {
                max_segments: self.max_depth.or(scene.max_depth),
                max_specular: self.max_specular.unwrap_or(Limits::default().max_specular),
            },
        })
    }

    /// How photons leave their lamps.
    fn draws(&self, method: Method) -> Draws {
        match self.draws {
            Some(DrawsName::Independent) => Draws::Independent,
            Some(DrawsName::Spread) => Draws::Spread,
            None => method.usual_draws(),
        }
    }

    /// Counts and ends.
    pub(crate) fn wanted(&self) -> Wanted {
        Wanted {
            photons: self.photons,
            passes: self.passes,
            samples: self.spp,
            target_error: self.target_error,
            time_limit: self.time_limit.map(|seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)),
        }
    }

    /// The unit system of results.
    pub(crate) fn unit_system(&self) -> UnitSystem {
        match self.units {
            UnitsName::Radiometric => UnitSystem::Radiometric,
            UnitsName::Photometric => UnitSystem::Photometric,
        }
    }

    /// `auto` takes the first method, in this order, that uses every option given.
    fn method_name(&self) -> Result<MethodName, Failure> {
        if self.method != MethodName::Auto {
            return Ok(self.method);
        }
        let order = [MethodName::FinalGather, MethodName::Radius, MethodName::Nearest, MethodName::Path];
        order.into_iter().find(|&name| self.fits(name)).ok_or_else(|| {
            let given: Vec<_> =
                self.uses().iter().filter(|(_, given, _)| *given).map(|(option, ..)| format!("--{option}")).collect();
            Failure::usage(format!("no method uses all of {}; leave one out", given.join(", ")))
        })
    }

    /// True if a method uses every option given.
    fn fits(&self, name: MethodName) -> bool {
        self.uses().iter().all(|(_, given, users)| !given || users.contains(&name))
    }

    /// The options that not every method uses, whether each was given, and the methods that use it.
    fn uses(&self) -> [(&'static str, bool, &'static [MethodName]); 12] {
        use MethodName::{Adaptive, Bins, FinalGather, Nearest, Path, Progressive, Radius};
        [
            ("k", self.k.is_some(), &[Nearest]),
            ("radius", self.radius.is_some(), &[FinalGather, Radius]),
            ("kernel", self.kernel.is_some(), &[FinalGather, Radius, Nearest, Adaptive, Progressive]),
            ("area", self.area.is_some(), &[Radius, Nearest, Adaptive, Progressive]),
            ("gather-rays", self.gather_rays.is_some(), &[FinalGather]),
            ("cache", self.cache, &[FinalGather]),
            ("guided", self.guided, &[FinalGather]),
            ("direct photons", self.direct == Some(DirectName::Photons), &[Radius, Nearest, Adaptive, Progressive]),
            ("photons", self.photons.is_some(), &[FinalGather, Radius, Nearest, Adaptive, Progressive, Bins]),
            ("draws", self.draws.is_some(), &[FinalGather, Radius, Adaptive, Progressive, Bins]),
            ("spp", self.spp.is_some(), &[FinalGather, Radius, Nearest, Adaptive, Progressive, Path]),
            ("map", self.map.is_some(), &[FinalGather, Radius, Nearest, Adaptive, Progressive]),
        ]
    }

    fn refuse_what_is_not_built(&self) -> Result<(), Failure> {
        let not_built = if self.device == DeviceName::Gpu { Some("--device gpu") } else { None };
        match not_built {
            Some(what) => Err(Failure::usage(format!("{what} is not built yet; leave it out"))),
            None => Ok(()),
        }
    }
}

/// Final-gather rays per point, or per site of a cache and pass.
pub(crate) fn usual_gather_rays(cache: bool) -> u32 {
    if cache { 64 } else { 1 }
}

impl MethodName {
    fn text(self) -> &'static str {
        match self {
            MethodName::Auto => "auto",
            MethodName::Nearest => "nearest",
            MethodName::Radius => "radius",
            MethodName::Adaptive => "adaptive",
            MethodName::FinalGather => "final-gather",
            MethodName::Progressive => "progressive",
            MethodName::Bins => "bins",
            MethodName::Path => "path",
        }
    }
}
