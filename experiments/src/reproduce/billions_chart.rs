//! Error against photons, with its laws drawn on to the error that is asked for.

use photonlab_measure::{Axis, FigureData, Point, Series, SeriesKind};

use super::{photon_law::Trend, table::Table};

/// Steps along a law.
const STEPS: i32 = 12;

/// One scene's errors.
pub(super) struct Line<'t> {
    pub(super) title: &'static str,
    pub(super) trend: &'t Trend,
}

/// The scenes' errors with the laws fitted to them, CUBE's predicted ones (photons, mean square) and the target.
pub(super) fn chart(lines: &[Line<'_>], law: &[(f64, f64)], target: f64, table: &Table) -> anyhow::Result<FigureData> {
    let mut series = Vec::new();
    let (mut fewest, mut most) = (f64::INFINITY, 0.0f64);
    for line in lines {
        let rms = line.trend.rms(table.confidence);
        let points = rms.iter().map(|&(photons, rms)| Point::measured(photons, rms.scaled(100.0)));
        series.push(Series { label: line.title.into(), kind: SeriesKind::Measured, points: points.collect() });
        let (Ok(fit), Some(&(first, _)), Some(&(last, _))) = (line.trend.law(), rms.first(), rms.last()) else {
            continue;
        };
        let end = fit.solve(target, 0.1).map_or(last, |at| at.value.max(last));
        let at = |step: i32| first * (end / first).powf(f64::from(step) / f64::from(STEPS));
        let points = (0..=STEPS).map(|step| Point::new(at(step), 100.0 * fit.predict(at(step), 0.5).value)).collect();
        let label = format!("{}, fitted: N^{:.3}", line.title, fit.slope);
        series.push(Series { label, kind: SeriesKind::Predicted, points });
        (fewest, most) = (fewest.min(first), most.max(end));
    }
    let points = law.iter().map(|&(photons, square)| Point::new(photons, 100.0 * square.sqrt())).collect();
    series.push(Series { label: "CUBE, radiosity solution".into(), kind: SeriesKind::Predicted, points });
    let level = [fewest, most].map(|photons| Point::new(photons, 100.0 * target)).to_vec();
    series.push(Series { label: format!("{} %", 100.0 * target), kind: SeriesKind::Reference, points: level });
    let part = lines.first().map_or("", |line| line.trend.region.title());
    Ok(FigureData {
        id: part.replace(' ', "-"),
        title: format!("The direct view's error, {part}"),
        caption: format!(
            "All light from photons within a radius fixed in advance for each number of them, read at points of the picture; relative to the \
             picture's mean. Where a line goes on beyond the marks it is an extrapolation. {} replicates; {}.",
            lines.first().map_or(0, |line| line.trend.replicates()),
            table.intervals()
        ),
        x: Axis::log("photons"),
        y: Axis::log("RMS error, %"),
        series,
    })
}
