//! The axes that a figure's numbers ask for.

use photonlab_measure::{FigureData, Point, SeriesKind};

use crate::FigureError;
use crate::scale::Scale;

/// A logarithmic axis follows an interval's low end down to the smallest value over this, then cuts it.
const DEEPEST: f64 = 30.0;

fn points(figure: &FigureData) -> impl Iterator<Item = &Point> {
    figure.series.iter().flat_map(|series| &series.points)
}

/// Refuses a figure that cannot be drawn.
pub(crate) fn check(figure: &FigureData) -> Result<(), FigureError> {
    let id = || figure.id.clone();
    if !figure.y.names.is_empty() {
        return Err(FigureError::NamesUpright { figure: id() });
    }
    for series in &figure.series {
        for p in &series.points {
            let all = [Some(p.x), Some(p.y), p.low, p.high];
            if let Some(value) = all.into_iter().flatten().find(|v| !v.is_finite()) {
                return Err(FigureError::NotFinite { figure: id(), series: series.label.clone(), value });
            }
            if figure.x.log && p.x <= 0.0 {
                return Err(FigureError::NotOnLogAxis { figure: id(), series: series.label.clone(), x: p.x });
            }
            let names = figure.x.names.len();
            if names > 0 && !(0.5..=names as f64 + 0.5).contains(&p.x) {
                return Err(FigureError::NoSuchName { figure: id(), series: series.label.clone(), x: p.x, names });
            }
        }
    }
    match points(figure).next() {
        Some(_) => Ok(()),
        None => Err(FigureError::Empty { figure: id() }),
    }
}

/// The x axis over all points.
pub(crate) fn horizontal(figure: &FigureData) -> Scale {
    if !figure.x.names.is_empty() {
        return Scale::named(&figure.x.names);
    }
    let values: Vec<f64> = points(figure).map(|p| p.x).collect();
    if figure.x.log { Scale::logarithmic(&values, 8) } else { Scale::linear(&values, 7) }
}

/// The y axis over all points and their intervals.
pub(crate) fn vertical(figure: &FigureData) -> Result<Scale, FigureError> {
    let mut values: Vec<f64> = points(figure).flat_map(|p| [Some(p.y), p.high]).flatten().collect();
    let lows = points(figure).filter_map(|p| p.low);
    if !figure.y.log {
        values.extend(lows);
        return Ok(Scale::linear(&values, 6));
    }
    values.retain(|&v| v > 0.0);
    let Some(smallest) = values.iter().copied().reduce(f64::min) else {
        return Err(FigureError::NothingAboveZero { figure: figure.id.clone() });
    };
    values.extend(lows.map(|low| low.max(smallest / if low > 0.0 { DEEPEST } else { 2.0 })));
    Ok(Scale::logarithmic(&values, 7))
}

/// How many measured points have a value or an interval that the axis cuts.
pub(crate) fn cut_points(figure: &FigureData, y: &Scale) -> usize {
    let measured = figure.series.iter().filter(|s| s.kind == SeriesKind::Measured);
    measured.flat_map(|s| &s.points).filter(|p| y.cuts(p.low.unwrap_or(p.y).min(p.y))).count()
}
