//! A mode's figure.

use photonlab_measure::{FigureData, Point, Series, SeriesKind};

use super::mode::{Law, Measured};

/// Pieces of a law's line.
const PIECES: u32 = 60;

impl Measured {
    /// Every curve's readings with their law, and the truth.
    pub(super) fn figure(&self, confidence: f64) -> FigureData {
        let Self { mode, part, .. } = self;
        let mut series = Vec::new();
        for (curve, readings) in mode.curves.iter().zip(&self.readings) {
            let marks = part.sweep.iter().zip(readings);
            let marks = marks.filter_map(|(&x, read)| Some(Point::measured(x, read.interval(confidence)?)));
            series.push(Series { label: curve.label.clone(), kind: SeriesKind::Measured, points: marks.collect() });
            series.push(Series { label: "its law".into(), kind: SeriesKind::Predicted, points: self.line(&curve.law) });
        }
        if let Some((name, truth)) = &mode.truth {
            let points = self.line(truth);
            series.push(Series { label: (*name).into(), kind: SeriesKind::Reference, points });
        }
        FigureData {
            id: mode.id.into(),
            title: mode.title.into(),
            caption: format!(
                "{} {} repetitions; intervals of {:.4} % each, 99 % for all comparisons of the atlas.",
                part.statement,
                self.replicates,
                100.0 * confidence
            ),
            x: mode.x.clone(),
            y: mode.y.clone(),
            series,
        }
    }

    /// A law along the sweep, where it is finite and can be drawn.
    fn line(&self, law: &Law) -> Vec<Point> {
        let points = self.places().into_iter().map(|x| Point::new(x, law(x)));
        points.filter(|point| point.y.is_finite()).collect()
    }

    /// Where the laws are drawn: at the swept values, and between them where they hold there.
    fn places(&self) -> Vec<f64> {
        let sweep = &self.part.sweep;
        let (Some(&first), Some(&last), true) = (sweep.first(), sweep.last(), self.mode.between) else {
            return sweep.clone();
        };
        let share = |i: u32| f64::from(i) / f64::from(PIECES);
        let place = |i: u32| {
            if self.mode.x.log { first * (last / first).powf(share(i)) } else { first + (last - first) * share(i) }
        };
        (0..=PIECES).map(place).collect()
    }
}
