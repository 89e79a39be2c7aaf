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
    /// Points per cell and pass unless asked otherwise.
    usual_samples: u64,
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
            // The first passes are the larger ones: those done so far are then shared as their own total would be.
            Share::Total { total, passes } => total / passes + u64::from(pass < total % passes),
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
            usual_samples: samples_per_cell,
        }
    }

    /// As many photons and points per cell in each pass, or as few as a session's demands allow, until something ends the run.
    pub fn of_passes(photons: u64, samples: u64, ends: Ends, demands: &Demands) -> Self {
        let photons = if demands.fewest_photons > 0 { photons.clamp(demands.fewest_photons, LARGEST_PASS) } else { 0 };
        let samples = samples.clamp(1, demands.most_samples);
        Self {
            ends,
            photons: Share::Each(photons),
            samples: Share::Each(samples),
            fewest_photons: demands.fewest_photons,
            usual_samples: samples,
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

    /// A short pass, whatever was asked for, smaller by a factor than the usual one; and how many times as long a pass of
    /// this schedule takes at most.
    pub fn pilot(&self, by: u64) -> (Self, f64) {
        let short = |share: Share, usual: u64, fewest: u64| match share.of_pass(0) {
            0 => (Share::Each(0), 0.0),
            count => {
                let few = (count.min(usual) / by).max(fewest);
                (Share::Each(few), count as f64 / few as f64)
            }
        };
        let (photons, longer) = short(self.photons, PHOTONS_PER_PASS, self.fewest_photons);
        let (samples, denser) = short(self.samples, self.usual_samples, 1);
        (Self { photons, samples, ..*self }, longer.max(denser))
    }

    /// Passes short enough for a time limit: counts that were asked for are spread over so many times more of them, those
    /// of a run that only the clock or its error ends are divided. Where one count allows fewer passes than that, it ends
    /// the run before the other is met.
    pub fn shortened(&self, by: u64) -> Self {
        let Some(passes) = self.ends.passes else { return self.divided(by) };
        let room = |share: Share, fewest: u64| match share.of_pass(0) {
            0 => u64::MAX,
            count => count / fewest.max(1),
        };
        let more = by.min(room(self.photons, self.fewest_photons)).min(room(self.samples, 1)).max(1);
        let spread = |share: Share, fewest: u64| match share {
            Share::Total { total, passes } if more == by || total / passes < 2 * more * fewest.max(1) => {
                Share::Total { total, passes: passes * more }
            }
            share => Share::Each((share.of_pass(0) / by).max(fewest.min(share.of_pass(0)))),
        };
        Self {
            ends: Ends { passes: Some(passes * more), ..self.ends },
            photons: spread(self.photons, self.fewest_photons),
            samples: spread(self.samples, 1),
            ..*self
        }
    }

    /// The same passes with all counts that were not asked for divided.
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
    fn passes_done_are_shared_as_their_own_total_would_be() {
        let of = |total: u64, passes: u64| {
            let wanted = Wanted { photons: Some(total), passes: Some(passes), ..Wanted::default() };
            Schedule::new(&wanted, 6, &DEMANDS)
        };
        let whole = of(1_000_003, 17);
        for done in 1..17 {
            let counts: Vec<u64> = (0..done).map(|pass| whole.photons(pass)).collect();
            let again = of(counts.iter().sum(), done);
            assert_eq!((0..done).map(|pass| again.photons(pass)).collect::<Vec<_>>(), counts);
        }
    }

    #[test]
    fn a_clock_cuts_passes_and_keeps_totals() {
        let limit = Some(Duration::from_secs(2));
        let wanted = Wanted { photons: Some(1_000_003), passes: Some(2), time_limit: limit, ..Wanted::default() };
        let short = Schedule::new(&wanted, 6, &DEMANDS).shortened(100);
        let passes = short.ends.passes.unwrap();
        assert_eq!(passes, 200);
        assert_eq!((0..passes).map(|pass| short.photons(pass)).sum::<u64>(), 1_000_003);
        let few = Wanted { samples: Some(6), ..wanted };
        let short = Schedule::new(&few, 6, &DEMANDS).shortened(100);
        assert_eq!(short.ends.passes, Some(6), "no pass without a point");
        assert_eq!((short.samples(5), short.photons(5)), (1, 5000), "the points end the run");
        let (pilot, longer) = Schedule::new(&wanted, 6, &DEMANDS).pilot(64);
        assert!(pilot.photons(0) <= PHOTONS_PER_PASS / 64 && longer >= 500_000.0 / 1024.0);
    }

    #[test]
    fn a_target_alone_has_no_count() {
        let wanted = Wanted { target_error: Some(0.01), ..Wanted::default() };
        assert_eq!(Schedule::new(&wanted, 1, &DEMANDS).ends.passes, None);
        assert_eq!(Schedule::new(&Wanted::default(), 1, &DEMANDS).ends.passes, Some(16));
    }
}
