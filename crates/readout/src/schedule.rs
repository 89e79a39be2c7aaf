//! How many passes, photons and samples, and when to stop.

use std::time::Duration;

/// Passes unless asked otherwise: enough for an error bar whose own error is small (Student t with 15 degrees).
const PASSES: u64 = 16;
/// Passes are so many times more and shorter where each draws wavelengths of its own.
const FINER: u64 = 4;
/// Photons per pass unless asked otherwise.
const PHOTONS_PER_PASS: u64 = 1 << 16;
/// Photons in a pass at most, which bounds memory; more photons mean more passes.
const LARGEST_PASS: u64 = 1 << 19;
/// Gather rays or paths per pass, shared by all cells, unless asked otherwise.
const RAYS_PER_PASS: u64 = 1 << 17;
/// Points per cell and pass unless asked otherwise, at least.
const FEWEST_SAMPLES: u64 = 4;

/// What the caller asks for; `None` leaves it to the defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Emitted paths in all.
    pub photons: Option<u64>,
    /// Passes in all.
    pub passes: Option<u64>,
    /// Points per cell in all.
    pub samples: Option<u64>,
    /// Largest relative half-width of the interval.
    pub target_error: Option<f64>,
    /// Wall time.
    pub time_limit: Option<Duration>,
}

/// What a session asks of its schedule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Demands {
    /// Rays per point.
    pub gather_rays: u32,
    /// Photons that a pass cannot do without; zero if the method needs none in this scene.
    pub fewest_photons: u64,
    /// Points per cell and pass beyond which a reading gains nothing.
    pub most_samples: u64,
    /// True if every pass draws wavelengths of its own, of which many passes see more.
    pub draws_wavelengths: bool,
}

/// When a run ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Passes at most; `None` if only the error or the clock ends the run.
    pub passes: Option<u64>,
    /// Largest relative half-width of the interval.
    pub target_error: Option<f64>,
    /// Wall time.
    pub time_limit: Option<Duration>,
}

/// Counts per pass and the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// When the run ends.
    pub ends: Ends,
    photons: Share,
    samples: Share,
    /// Photons that a pass cannot do without.
    fewest_photons: u64,
}

/// A count divided over passes: a total to be met exactly, or the same in each pass.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Share {
    Total { total: u64, passes: u64 },
    Each(u64),
}

impl Share {
    fn of_pass(self, pass: u64) -> u64 {
        match self {
            Share::Each(count) => count,
            Share::Total { total, passes } => {
                let up_to = |p: u64| (u128::from(total) * u128::from(p) / u128::from(passes)) as u64;
                up_to(pass + 1) - up_to(pass)
            }
        }
    }
}

impl Schedule {
    /// Resolves what was asked for.
    pub fn new(wanted: &Wanted, cells: usize, demands: &Demands) -> Self {
        let uses_photons = demands.fewest_photons > 0;
        let photons = wanted.photons.filter(|_| uses_photons);
        let counted = photons.is_some() || wanted.samples.is_some() || wanted.passes.is_some();
        let open = wanted.target_error.is_some() || wanted.time_limit.is_some();
        let finer = if demands.draws_wavelengths { FINER } else { 1 };
        let rays_per_cell = RAYS_PER_PASS / finer / (cells.max(1) as u64 * u64::from(demands.gather_rays));
        let samples_per_cell = rays_per_cell.clamp(FEWEST_SAMPLES.min(demands.most_samples), demands.most_samples);
        let passes = (counted || !open).then(|| {
            let asked = wanted.passes.unwrap_or_else(|| {
                // Where the error or the clock may end the run early, passes stay short.
                let largest = if open { PHOTONS_PER_PASS } else { LARGEST_PASS };
                let for_photons = photons.map_or(0, |n| n.div_ceil(largest));
                let for_samples = wanted.samples.filter(|_| open).map_or(0, |n| n.div_ceil(samples_per_cell));
                (PASSES * finer)
                    .max(for_photons)
                    .max(for_samples)
                    .min(photons.map_or(u64::MAX, |n| n / demands.fewest_photons.max(1)))
            });
            asked.min(wanted.samples.unwrap_or(u64::MAX)).max(1)
        });
        let share = |total: Option<u64>, each: u64| match (total, passes) {
            (Some(total), Some(passes)) => Share::Total { total, passes },
            _ => Share::Each(each),
        };
        Self {
            ends: Ends { passes, target_error: wanted.target_error, time_limit: wanted.time_limit },
            photons: if uses_photons {
                share(photons, (PHOTONS_PER_PASS / finer).max(demands.fewest_photons))
            } else {
                Share::Each(0)
            },
            samples: share(wanted.samples, samples_per_cell),
            fewest_photons: demands.fewest_photons,
        }
    }

    /// Emitted paths in a pass.
    pub fn photons(&self, pass: u64) -> u64 {
        self.photons.of_pass(pass)
    }

    /// Points per cell in a pass.
    pub fn samples(&self, pass: u64) -> u64 {
        self.samples.of_pass(pass)
    }

    /// A pass smaller by a factor, whatever was asked for: a pilot.
    pub fn pilot(&self, by: u64) -> Self {
        let each = |share: Share, fewest: u64| match share.of_pass(0) {
            0 => Share::Each(0),
            count => Share::Each((count / by).max(fewest)),
        };
        Self { photons: each(self.photons, self.fewest_photons), samples: each(self.samples, 1), ..*self }
    }

    /// The same with all counts per pass divided: a pilot, or passes short enough for a time limit.
    pub fn divided(&self, by: u64) -> Self {
        let smaller = |share: Share, fewest: u64| match share {
            Share::Each(count) if count > 0 => Share::Each((count / by).max(fewest)),
            other => other,
        };
        Self { photons: smaller(self.photons, self.fewest_photons), samples: smaller(self.samples, 1), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEMANDS: Demands =
        Demands { gather_rays: 1, fewest_photons: 2, most_samples: 1 << 13, draws_wavelengths: false };

    #[test]
    fn totals_are_met_exactly() {
        for (photons, samples) in [(1_000_003, 17), (16, 1), (100, 1000), (40_000_000, 5)] {
            let wanted = Wanted { photons: Some(photons), samples: Some(samples), ..Wanted::default() };
            let schedule = Schedule::new(&wanted, 6, &DEMANDS);
            let passes = schedule.ends.passes.unwrap();
            assert_eq!((0..passes).map(|p| schedule.photons(p)).sum::<u64>(), photons);
            assert_eq!((0..passes).map(|p| schedule.samples(p)).sum::<u64>(), samples);
            assert!(
                (0..passes)
                    .all(|p| schedule.samples(p) > 0 && schedule.photons(p) <= LARGEST_PASS.max(photons / passes + 1))
            );
        }
    }

    #[test]
    fn a_target_alone_has_no_count() {
        let wanted = Wanted { target_error: Some(0.01), ..Wanted::default() };
        assert_eq!(Schedule::new(&wanted, 1, &DEMANDS).ends.passes, None);
        assert_eq!(Schedule::new(&Wanted::default(), 1, &DEMANDS).ends.passes, Some(16));
    }
}
