//! The figures of trees stopped in several ways.

use photonlab_measure::{Axis, FigureData, Point, Series, SeriesKind};

use super::{
    search::Cost,
    stopped::{Parameters, Stopped, Trees},
    table::Table,
};

impl Stopped {
    /// Work of a query over the leaf size, by either way to stop.
    pub(super) fn cost_chart(&self, p: &Parameters, table: &Table) -> FigureData {
        let series = |label: &str, all: &[Trees], of: fn(&Cost) -> f64| {
            let point =
                |trees: &Trees| Some(Point::measured(trees.leaf().mean()?, trees.cost(of).interval(table.confidence)?));
            Series { label: label.into(), kind: SeriesKind::Measured, points: all.iter().filter_map(point).collect() }
        };
        let id = self.set.title().to_lowercase().replace(' ', "-");
        FigureData {
            id: format!("cost-{id}"),
            title: format!("Work of a query against the mean leaf size, {}", self.set.title()),
            caption: format!(
                "{} nearest among {} photons; Ec from {} to {} areas of the node, fixed limits from {} to {} photons. {} replicates of \
                 {} queries; {}.",
                p.k,
                p.photons,
                p.units[0],
                p.units[p.units.len() - 1],
                p.limits[0],
                p.limits[p.limits.len() - 1],
                p.replicates,
                p.queries,
                table.intervals()
            ),
            x: Axis::log("mean photons a leaf"),
            y: Axis::log("nodes opened or photons tested by a query"),
            series: vec![
                series("photons, stopped by Ec", &self.by_unit, |cost| cost.tested),
                series("photons, fixed limit", &self.by_limit, |cost| cost.tested),
                series("nodes, stopped by Ec", &self.by_unit, |cost| cost.nodes),
                series("nodes, fixed limit", &self.by_limit, |cost| cost.nodes),
            ],
        }
    }
}

pub(super) fn leaf_chart(p: &Parameters, sets: &[Stopped], table: &Table) -> FigureData {
    let mut series: Vec<Series> = sets
        .iter()
        .map(|stopped| {
            let units = p.units.iter().zip(&stopped.by_unit).filter(|&(&unit, _)| unit > 0.0);
            let point =
                |(&unit, trees): (&f64, &Trees)| Some(Point::measured(unit, trees.leaf().interval(table.confidence)?));
            let label = stopped.set.title().into();
            Series { label, kind: SeriesKind::Measured, points: units.filter_map(point).collect() }
        })
        .collect();
    for (label, factor) in [("e photons", 1.0), ("2 e photons", 2.0), ("3 e photons", 3.0)] {
        let points = p.units.iter().filter(|&&unit| unit > 0.0).map(|&unit| Point::new(unit, factor * unit)).collect();
        series.push(Series { label: label.into(), kind: SeriesKind::Reference, points });
    }
    FigureData {
        id: "leaf-size".into(),
        title: "Mean leaf size against the cost of an empty node".into(),
        caption: format!(
            "Ec = e S, S the surface area of the node at hand; {} photons, {} replicates; {}.",
            p.photons,
            p.replicates,
            table.intervals()
        ),
        x: Axis::log("e, cost of an empty node in areas of the node"),
        y: Axis::log("mean photons a leaf"),
        series,
    }
}

pub(super) fn scale_chart(p: &Parameters, sets: &[Stopped], table: &Table) -> FigureData {
    let series = sets.iter().take(2).zip([0.97, 1.03]).flat_map(|(stopped, aside)| {
        [("Ec constant", &stopped.constant), ("Ec in areas", &stopped.scaled)].map(|(name, all)| {
            let point = move |(&scale, trees): (&f64, &Trees)| {
                Some(Point::measured(aside * scale, trees.leaf().interval(table.confidence)?))
            };
            let points = p.scales.iter().zip(all).filter_map(point).collect();
            Series { label: format!("{}, {name}", stopped.set.title()), kind: SeriesKind::Measured, points }
        })
    });
    FigureData {
        id: "scale".into(),
        title: "Mean leaf size against the unit of length".into(),
        caption: format!(
            "The same photons, all coordinates times the scale; marks of one scale stand side by side. Even sets are halved, so leaf sizes \
             go by octaves. The constant is chosen for leaves of about {} at scale 1. {} photons, {} \
             replicates; {}.",
            p.constant_leaf,
            p.photons,
            p.replicates,
            table.intervals()
        ),
        x: Axis::log("scale"),
        y: Axis::log("mean photons a leaf"),
        series: series.collect(),
    }
}
