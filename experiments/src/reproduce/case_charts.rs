//! Figures of readings of scenes with known answers.

use photonlab_measure::{Axis, FigureData, Interval, Point, Series, SeriesKind};
use photonlab_reference::catalogue::Entry;

use super::case_reading::{Rule, Way};

/// One point for each reading, by the way in which it was made.
pub(super) struct CaseCharts {
    deviations: Vec<Series>,
    widths: Vec<Series>,
}

impl CaseCharts {
    pub(super) fn new() -> Self {
        let empty = |way: Way| Series { label: way.words().into(), kind: SeriesKind::Measured, points: Vec::new() };
        Self { deviations: Way::ALL.map(empty).into(), widths: Way::ALL.map(empty).into() }
    }

    /// A reading of what is `truth`, at `along` on the axis of entries.
    pub(super) fn add(&mut self, way: Way, along: f64, measured: Interval, truth: f64, precision: f64) {
        let half = measured.half_width();
        let way = Way::ALL.iter().position(|&one| one == way).expect("one of all ways");
        // A reading by a formula has no width to speak of.
        if half > 1e-6 * precision * truth {
            let apart = |x: f64| (x - truth) / half;
            let shown = Interval {
                value: apart(measured.value),
                low: apart(measured.low),
                high: apart(measured.high),
                ..measured
            };
            self.deviations[way].points.push(Point::measured(along, shown));
            self.widths[way].points.push(Point::new(along, half / (precision * truth)));
        }
    }

    pub(super) fn figures(self, entries: &[&Entry], rule: &Rule) -> Vec<FigureData> {
        let filled = |series: Vec<Series>| series.into_iter().filter(|series| !series.points.is_empty()).collect();
        let x = Axis::named("entry", entries.iter().map(|entry| entry.id));
        let wanted = Series {
            label: "wanted".into(),
            kind: SeriesKind::Predicted,
            points: [0.5, entries.len() as f64 + 0.5].map(|along| Point::new(along, 1.0)).into(),
        };
        let deviations = FigureData {
            id: "deviations".into(),
            title: "Readings of scenes with known answers".into(),
            caption: "Each point is one meter, read by the way that suits it; bars: 99.99 % intervals with bias bounds, each one \
                      unit to either side. Every bar should cross zero, or miss it by no more than its answer is uncertain."
                .into(),
            x: x.clone(),
            y: Axis::linear("measured less expected, over the half-width"),
            series: filled(self.deviations),
        };
        let mut series: Vec<Series> = filled(self.widths);
        series.push(wanted);
        let widths = FigureData {
            id: "widths".into(),
            title: "How well scenes with known answers are read".into(),
            caption: format!(
                "Half-width of each 99.99 % interval over the wanted one, which is {} % of the answer, {} % of a flux.",
                100.0 * rule.precision,
                100.0 * rule.flux_precision
            ),
            x,
            y: Axis::log("half-width over the wanted one"),
            series,
        };
        vec![deviations, widths]
    }
}
