//! Error and time of strategies against the rays they spend, over one scene's cells.

use photonlab_measure::{
    Axis, FigureData, Interval, LogLogFit, Point, Replicates, Row, Series, SeriesKind, fit_log_log,
};
use photonlab_readout::{Cell, Wanted};

use super::{
    context::Findings,
    cpu_clock::{CPU_SECONDS, CpuClock, microseconds},
    lab::Lab,
    strategy::Strategy,
};

/// Confidence of every interval here.
pub(super) const CONFIDENCE: f64 = 0.99;

/// Cells whose truth is known.
pub(super) struct Bench<const C: usize> {
    /// Its name in rows.
    pub(super) id: &'static str,
    pub(super) lab: Lab,
    pub(super) cells: Vec<Cell>,
    /// What each cell reads without error, and what its error is taken relative to; `None` leaves a cell out.
    pub(super) truth: Vec<Option<([f64; C], f64)>>,
    /// Mean square relative error of that truth itself, where it was measured: independent of any reading's, it is taken off theirs.
    pub(super) noise_of_truth: f64,
    /// Cells whose mean error is told apart; may be none.
    pub(super) border: Vec<usize>,
}

/// Error and time of one setting over its seeds.
pub(super) struct Measured {
    /// Rays or paths per cell.
    pub(super) rays: f64,
    /// Mean over the seeds of the mean square relative error of the cells.
    square: Replicates,
    /// Mean relative error of the border's cells, sign included.
    pub(super) border: Replicates,
    seconds: Replicates,
    /// True if any cell of any seed read a map.
    pub(super) reads_map: bool,
}

impl Measured {
    /// Root of the mean square, with the interval of the mean square carried through the root.
    pub(super) fn rms(&self) -> Option<Interval> {
        let square = self.square.interval(CONFIDENCE)?;
        let root = |x: f64| x.max(0.0).sqrt();
        Some(Interval { value: root(square.value), low: root(square.low), high: root(square.high), ..square })
    }

    /// CPU seconds for all cells, mean over the seeds.
    pub(super) fn seconds(&self) -> f64 {
        self.seconds.mean().unwrap_or(0.0)
    }
}

/// A strategy at rising counts of rays.
pub(super) struct Curve {
    pub(super) title: String,
    pub(super) points: Vec<Measured>,
}

impl<const C: usize> Bench<C> {
    /// Path tracing first, then final gather with each count of photons.
    pub(super) fn curves(
        &self,
        points: &[u64],
        photons: &[u64],
        seeds: std::ops::Range<u64>,
        found: &mut Findings,
    ) -> anyhow::Result<Vec<Curve>> {
        let path = Curve {
            title: Strategy::PATH.title.into(),
            points: self.points(Strategy::PATH, None, points, &seeds, found)?,
        };
        let mut curves = vec![path];
        for &photons in photons {
            let title = format!("final gather, {photons} photons");
            let points = self.points(Strategy::FINAL_GATHER, Some(photons), points, &seeds, found)?;
            curves.push(Curve { title, points });
        }
        Ok(curves)
    }

    /// A strategy at rising counts of photons, each with as many rays or paths per cell.
    pub(super) fn curve(
        &self,
        strategy: Strategy,
        counts: &[(Option<u64>, u64)],
        seeds: &std::ops::Range<u64>,
        found: &mut Findings,
    ) -> anyhow::Result<Curve> {
        let mut points = Vec::new();
        for &(photons, rays) in counts {
            points.extend(self.points(strategy, photons, &[rays], seeds, found)?);
        }
        Ok(Curve { title: strategy.title.into(), points })
    }

    fn points(
        &self,
        strategy: Strategy,
        photons: Option<u64>,
        points: &[u64],
        seeds: &std::ops::Range<u64>,
        found: &mut Findings,
    ) -> anyhow::Result<Vec<Measured>> {
        let mut one = |points: u64| -> anyhow::Result<Measured> {
            let none = Replicates::new;
            let mut measured =
                Measured { rays: points as f64, square: none(), border: none(), seconds: none(), reads_map: false };
            for seed in seeds.clone() {
                let clock = CpuClock::start();
                let wanted = Wanted { photons, samples: Some(points), ..Wanted::default() };
                let outcome = self.lab.read::<C>(&self.cells, strategy.settings(seed), &wanted, CONFIDENCE)?;
                let spent = clock.seconds();
                let square = self.mean_square_error(&outcome);
                measured.square.push(square);
                measured.border.push(self.border_error(&outcome));
                measured.seconds.push(spent);
                measured.reads_map |= outcome.cells.iter().any(|cell| cell.asked_photons);
                found.rows.push(row(self.id, &strategy, photons, points, seed, square.max(0.0).sqrt(), spent));
            }
            Ok(measured)
        };
        points.iter().map(|&points| one(points)).collect()
    }

    fn border_error(&self, outcome: &photonlab_readout::Outcome<C>) -> f64 {
        let of_cell = |&number: &usize| {
            let (truth, _) = self.truth[number]?;
            let read: f64 = outcome.cells[number].value.iter().map(|value| value.mean().unwrap_or(0.0)).sum();
            Some(read / truth.iter().sum::<f64>() - 1.0)
        };
        let errors: Vec<f64> = self.border.iter().filter_map(of_cell).collect();
        errors.iter().sum::<f64>() / errors.len().max(1) as f64
    }

    fn mean_square_error(&self, outcome: &photonlab_readout::Outcome<C>) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (cell, truth) in outcome.cells.iter().zip(&self.truth) {
            let Some((truth, scale)) = truth else { continue };
            for c in 0..C {
                sum += ((cell.value[c].mean().unwrap_or(0.0) - truth[c]) / scale).powi(2);
                count += 1.0;
            }
        }
        sum / count - self.noise_of_truth
    }
}

/// RMS error of the first curve against its rays.
pub(super) fn path_law(curves: &[Curve]) -> anyhow::Result<LogLogFit> {
    law(&curves[0], |m| m.rays)
}

fn law(curve: &Curve, place: impl Fn(&Measured) -> f64) -> anyhow::Result<LogLogFit> {
    let x: Vec<f64> = curve.points.iter().map(place).collect();
    let y: Vec<f64> = curve.points.iter().map(|m| m.square.mean().unwrap_or(0.0).sqrt()).collect();
    Ok(fit_log_log(&x, &y)?)
}

/// Paths at the error of a final-gather setting, over its rays; the interval is that of the setting's error.
pub(super) fn paths_per_ray(law: &LogLogFit, gather: &Measured) -> Option<Interval> {
    let rms = gather.rms()?;
    let paths = |error: f64| law.solve(error, CONFIDENCE).map(|paths| paths.value / gather.rays);
    Some(Interval { value: paths(rms.value)?, low: paths(rms.high)?, high: paths(rms.low)?, confidence: CONFIDENCE })
}

/// Time of the last curve's last point, photons included, over that of path tracing (the first curve) at its error; the interval
/// is that of the error, not of the line through path tracing's points.
pub(super) fn time_ratio(curves: &[Curve]) -> Option<Interval> {
    let law = law(&curves[0], Measured::seconds).ok()?;
    let last = curves.last()?.points.last()?;
    let rms = last.rms()?;
    // The line's own interval is not used: one that is narrow enough at any confidence has a crossing.
    let ratio = |error: f64| law.solve(error, 0.5).map(|seconds| last.seconds() / seconds.value);
    Some(Interval { value: ratio(rms.value)?, low: ratio(rms.low)?, high: ratio(rms.high)?, confidence: CONFIDENCE })
}

/// RMS error of a setting over that of path tracing after as many CPU seconds; the interval is that of the setting's error, not of
/// the line through path tracing's points.
pub(super) fn error_ratio(paths: &Curve, setting: &Measured) -> Option<Interval> {
    let law = law(paths, Measured::seconds).ok()?;
    Some(setting.rms()?.scaled(1.0 / law.predict(setting.seconds(), 0.5).value))
}

/// RMS error of a setting over that of a curve after as many CPU seconds, between whose points it is taken on the straight line of both
/// logarithms; the interval is that of the setting's error. `None` where the curve does not reach to that time.
pub(super) fn error_over(curve: &Curve, setting: &Measured) -> Option<Interval> {
    let now = setting.seconds();
    let pair = curve.points.windows(2).find(|pair| pair[0].seconds() <= now && now <= pair[1].seconds())?;
    let [(t0, e0), (t1, e1)] = [&pair[0], &pair[1]].map(|m| (m.seconds(), m.square.mean().unwrap_or(0.0).sqrt()));
    let share = (now / t0).ln() / (t1 / t0).ln();
    Some(setting.rms()?.scaled(1.0 / (e0 * (e1 / e0).powf(share))))
}

/// The curves over what `place` says.
pub(super) fn chart<'c>(
    id: &str,
    title: &str,
    x: &str,
    seeds: u64,
    curves: impl IntoIterator<Item = &'c Curve>,
    place: impl Fn(&Measured) -> f64,
) -> FigureData {
    let series = curves.into_iter().map(|curve| {
        let points = curve.points.iter().filter_map(|m| Some(Point::measured(place(m), m.rms()?.scaled(100.0))));
        Series { label: curve.title.clone(), kind: SeriesKind::Measured, points: points.collect() }
    });
    FigureData {
        id: id.into(),
        title: title.into(),
        caption: format!("{seeds} seeds a point; bars: 99 % intervals. {CPU_SECONDS}."),
        x: Axis::log(x),
        y: Axis::log("RMS error, %"),
        series: series.collect(),
    }
}

fn row(scene: &str, strategy: &Strategy, photons: Option<u64>, points: u64, seed: u64, rms: f64, seconds: f64) -> Row {
    let mut row = Row::new();
    row.insert("scene".into(), scene.into());
    row.insert("strategy".into(), strategy.id.into());
    row.insert("photons".into(), photons.into());
    row.insert("points".into(), points.into());
    row.insert("seed".into(), seed.into());
    row.insert("rms".into(), rms.into());
    row.insert("cpu_seconds".into(), microseconds(seconds).into());
    row
}
