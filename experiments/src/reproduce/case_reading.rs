//! A scene with known answers, read by every way there is, and then each meter by the way that suits it.

use std::{
    path::Path,
    time::{Duration, Instant},
};

use photonlab_gather::Estimator;
use photonlab_measure::{Interval, normal_quantile, student_t_quantile};
use photonlab_readout::{Aids, Cell, CellResult, Direct, Method, Settings, Target, Wanted};
use photonlab_reference::catalogue::Case;
use photonlab_scene::Emitter;
use photonlab_trace::Limits;
use serde::Deserialize;

use super::lab::Lab;

/// Confidence of every interval.
pub(super) const CONFIDENCE: f64 = 0.9999;

/// Confidence at which a first reading's spread is believed.
const LIKELY: f64 = 0.9;

/// A run goes on until its half-width is this share of the wanted one: what is wanted goes by the answer, and the run by its own value.
const MARGIN: f64 = 0.99;

/// Photons counted, or points of a meter from which rays were followed, or photons sent for these to gather, below which a reading is not judged.
const FEWEST: f64 = 1000.0;

/// How scenes are read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Rule {
    pub(super) seed: u64,
    /// Wall time for a first reading of one scene by one way.
    pilot_seconds: f64,
    /// Wall time per meter for the reading that counts, shared by all meters of a scene that are read by one way.
    seconds: f64,
    /// The same for all of those together that would need more than [`Rule::most_paths`].
    seconds_beyond: f64,
    /// Paths beyond which a reading may stay wider than wanted.
    pub(super) most_paths: f64,
    /// Wanted half-width over the value.
    pub(super) precision: f64,
    /// The same where flux is read.
    pub(super) flux_precision: f64,
}

/// Writes the scene and what it names to files.
pub(super) fn put_down(case: &Case, path: &Path) -> anyhow::Result<()> {
    std::fs::write(path, &case.xml)?;
    for (name, text) in &case.files {
        std::fs::write(path.with_file_name(name), text)?;
    }
    Ok(())
}

/// A way to read a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    Counting,
    FinalGather,
    PathTracing,
}

impl Way {
    pub(super) const ALL: [Way; 3] = [Way::Counting, Way::FinalGather, Way::PathTracing];

    pub(super) fn words(self) -> &'static str {
        match self {
            Way::Counting => "photons counted",
            Way::FinalGather => "final gather",
            Way::PathTracing => "path tracing",
        }
    }

    fn method(self) -> Method {
        match self {
            Way::Counting => Method::Bins,
            Way::FinalGather => Method::FinalGather { radius: None },
            Way::PathTracing => Method::Path,
        }
    }

    /// Photons are counted where they land, so only surfaces count them. Paths from a meter through mirrors and glass never
    /// meet a lamp without extent, and would read as if they were black.
    fn can_read(self, lab: &Lab, cell: &Cell) -> bool {
        match self {
            Way::Counting => matches!(cell.target, Target::Patch { .. }),
            Way::FinalGather => true,
            Way::PathTracing => {
                let without_extent = |emitter: &Emitter| !matches!(emitter, Emitter::Environment { .. });
                !(lab.needs.caustic && lab.world.scene.emitters.iter().any(without_extent))
            }
        }
    }
}

/// One meter, read in one way.
#[derive(Clone)]
pub(super) struct Attempt {
    pub(super) way: Way,
    /// One per channel; `None` where too little was found.
    pub(super) measured: Vec<Option<Interval>>,
    /// Paths from lamps, and from this meter.
    pub(super) paths: u64,
    /// Widest half-width over the value that this spread would have after many passes, by what was found however little that
    /// is; infinite if that is nothing, or if the bound on the bias alone is beyond what is wanted, which more of the same
    /// does not mend.
    promise: f64,
    /// Wall time of the run, which read other meters too.
    seconds: f64,
}

impl Attempt {
    /// The widest half-width over the value, by channel; infinite if a channel was not read.
    pub(super) fn width(&self) -> f64 {
        widest(&self.measured)
    }

    /// Paths after which the half-width would be `precision` times the value.
    pub(super) fn paths_to(&self, precision: f64) -> f64 {
        self.paths as f64 * (self.promise / precision).powi(2)
    }

    fn seconds_to(&self, precision: f64) -> f64 {
        self.seconds * (self.promise / precision).max(1.0).powi(2)
    }
}

/// All that was read of one meter.
pub(super) struct MeterReadings {
    pub(super) cell: Cell,
    pub(super) precision: f64,
    /// By the way that suits it.
    pub(super) reading: Attempt,
    /// First readings by the other ways.
    pub(super) others: Vec<Attempt>,
}

/// Reads every meter of a scene. First each way reads all it can for a short time. The way whose half-width promises the
/// wanted one soonest then reads the meter with other random numbers until it is that narrow, or its time is over. Neither
/// the choice nor the time looks at the answer.
pub(super) fn read<const C: usize>(lab: &Lab, rule: &Rule, seed: u64) -> anyhow::Result<Vec<MeterReadings>> {
    let cells = Cell::of_meters(&lab.world.scene);
    let precisions: Vec<f64> = cells.iter().map(|cell| rule.precision_of(cell)).collect();
    let finest = |of: &[usize]| of.iter().map(|&i| precisions[i]).fold(f64::INFINITY, f64::min);
    let mut attempts: Vec<Vec<Attempt>> = vec![Vec::new(); cells.len()];
    for way in Way::ALL {
        let readable: Vec<usize> = (0..cells.len()).filter(|&i| way.can_read(lab, &cells[i])).collect();
        let end = (finest(&readable), rule.pilot_seconds);
        for (i, attempt) in attempt::<C>(lab, &cells, &readable, way, seed, end)? {
            attempts[i].push(attempt);
        }
    }
    let mut readings: Vec<MeterReadings> = Vec::with_capacity(cells.len());
    for ((cell, mut attempts), &precision) in cells.iter().zip(attempts).zip(&precisions) {
        let soonest = |a: &&Attempt, b: &&Attempt| a.seconds_to(precision).total_cmp(&b.seconds_to(precision));
        let chosen = attempts.iter().min_by(soonest).expect("final gather reads every meter").way;
        let place = attempts.iter().position(|attempt| attempt.way == chosen).expect("it is one of them");
        let reading = attempts.remove(place);
        readings.push(MeterReadings { cell: cell.clone(), precision, reading, others: attempts });
    }
    // Meters that found nothing yet are read apart: they would keep the others from an end.
    for (way, found) in Way::ALL.into_iter().flat_map(|way| [(way, true), (way, false)]) {
        let is_due = |i: &usize| {
            let r = &readings[*i];
            r.reading.way == way && r.reading.width() > r.precision && r.reading.promise.is_finite() == found
        };
        let due: Vec<usize> = (0..cells.len()).filter(is_due).collect();
        let within_reach = |i: &&usize| readings[**i].reading.paths_to(precisions[**i]) <= rule.most_paths;
        let seconds = match due.iter().filter(within_reach).count() {
            0 => rule.seconds_beyond,
            meters => rule.seconds * meters as f64,
        };
        let end = (finest(&due), seconds);
        for (i, attempt) in attempt::<C>(lab, &cells, &due, way, seed + 1, end)? {
            readings[i].reading = attempt;
        }
    }
    Ok(readings)
}

impl Rule {
    fn precision_of(&self, cell: &Cell) -> f64 {
        if matches!(cell.target, Target::Patch { flux: true, .. }) { self.flux_precision } else { self.precision }
    }
}

/// Reads some of the cells in one way until all of them are narrow enough, or the seconds are over.
fn attempt<const C: usize>(
    lab: &Lab,
    cells: &[Cell],
    which: &[usize],
    way: Way,
    seed: u64,
    (precision, seconds): (f64, f64),
) -> anyhow::Result<Vec<(usize, Attempt)>> {
    if which.is_empty() {
        return Ok(Vec::new());
    }
    let settings = Settings {
        method: way.method(),
        direct: Direct::Sampled,
        estimator: Estimator::default(),
        gather_rays: 1,
        aids: Aids::default(),
        draws: way.method().usual_draws(),
        seed,
        limits: Limits { max_segments: lab.world.scene.max_depth, ..Limits::default() },
    };
    let wanted = Wanted {
        target_error: Some(MARGIN * precision),
        time_limit: Some(Duration::from_secs_f64(seconds)),
        ..Wanted::default()
    };
    let start = Instant::now();
    let read: Vec<Cell> = which.iter().map(|&i| cells[i].clone()).collect();
    let outcome = lab.read::<C>(&read, settings, &wanted, CONFIDENCE)?;
    let seconds = start.elapsed().as_secs_f64();
    let of_meter = |result: &CellResult<C>| {
        let found: Vec<_> = (0..outcome.results).map(|channel| interval(result, channel)).collect();
        let promised: Vec<_> = (0..outcome.results).map(|channel| promised(result, channel)).collect();
        let biased = (0..outcome.results).any(|channel| {
            let value = result.value[channel].mean().unwrap_or(0.0);
            result.lasting_bias_within(channel, 0.0) > precision * value.abs()
        });
        // Few counts have no normal mean, and few points may all see the same: a reading that rests on them is not judged,
        // whatever its spread says.
        let rests_on = match way {
            Way::Counting => result.photons,
            Way::FinalGather if outcome.photons > 0 => outcome.samples.min(outcome.photons) as f64,
            Way::FinalGather | Way::PathTracing => outcome.samples as f64,
        };
        let rests_on_few = rests_on < FEWEST;
        Attempt {
            way,
            promise: if biased { f64::INFINITY } else { widest(&promised) },
            measured: if rests_on_few { vec![None; found.len()] } else { found },
            paths: outcome.photons + outcome.samples,
            seconds,
        }
    };
    Ok(which.iter().copied().zip(outcome.cells.iter().map(of_meter)).collect())
}

/// The widest half-width over the value; infinite if a channel found nothing.
fn widest(channels: &[Option<Interval>]) -> f64 {
    let width = |m: &Option<Interval>| m.map_or(f64::INFINITY, |m| m.half_width() / m.value.abs());
    // A channel that is dark and known to be has no width.
    channels.iter().map(width).filter(|width| !width.is_nan()).fold(0.0, f64::max)
}

/// The reading with noise and bias bound; what found nothing has none.
fn interval<const C: usize>(result: &CellResult<C>, channel: usize) -> Option<Interval> {
    let value = result.value[channel].mean()?;
    let half = result.half_width(channel, CONFIDENCE)?;
    (!result.found_nothing()).then(|| Interval::around(value, half, CONFIDENCE))
}

/// The same with the half-width that this spread would have after many passes. The spread of few passes may be small by
/// chance, so it is taken at its most within [`LIKELY`], by what Student's t is over a normal quantile there.
fn promised<const C: usize>(result: &CellResult<C>, channel: usize) -> Option<Interval> {
    let value = result.value[channel].mean()?;
    let error = result.value[channel].std_error()?;
    let degrees = result.value[channel].degrees_of_freedom();
    let spread = error * student_t_quantile(LIKELY, degrees) / normal_quantile(0.5 + 0.5 * LIKELY);
    let half = normal_quantile(0.5 + 0.5 * CONFIDENCE) * spread + result.lasting_bias_within(channel, 0.0);
    (!result.found_nothing()).then(|| Interval::around(value, half, CONFIDENCE))
}
