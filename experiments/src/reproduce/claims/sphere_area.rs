//! `sphere-area`: gathered flux over the surface of the sphere, taken literally.

use std::f64::consts::PI;

use photonlab_gather::{AreaModel, Bandwidth, GatherPoint, PhotonMap, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_measure::{Axis, Expected, FigureData, Point, Record, Replicates, Series, SeriesKind, Verdict};
use photonlab_reference::nearest_law::AreaUsed;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    field::Field,
    table::{Table, row},
    trials::Trials,
};

/// Photons per square metre.
const DENSITY: f64 = 1000.0;
const AREAS: [(AreaModel, AreaUsed, &str); 2] =
    [(AreaModel::Sphere, AreaUsed::Sphere, "4 pi r^2"), (AreaModel::Disc, AreaUsed::Disc, "pi r^2")];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Photons in the disc: the mean for a fixed radius, k for the nearest.
    counts: Vec<usize>,
    /// Photons gathered in all for each count; more photons in the disc need fewer fields.
    gathered: u64,
    /// Fields for each count at least.
    fewest_replicates: u64,
    /// A mean known worse than this (relative half-width) says nothing.
    precision: f64,
}

#[derive(Clone, Copy)]
enum Search {
    Radius,
    Nearest,
}

impl Search {
    const ALL: [Search; 2] = [Search::Radius, Search::Nearest];

    fn name(self) -> &'static str {
        match self {
            Search::Radius => "fixed radius",
            Search::Nearest => "k nearest",
        }
    }

    /// Keeps the marks of the two searches apart in the figure.
    fn offset(self) -> f64 {
        match self {
            Search::Radius => 0.96,
            Search::Nearest => 1.04,
        }
    }

    /// The bandwidth that finds `count` photons, and half the side of a square that holds them all.
    fn bandwidth(self, count: usize) -> (Bandwidth, f64) {
        let radius = (count as f64 / (PI * DENSITY)).sqrt();
        match self {
            Search::Radius => (Bandwidth::Radius(radius), 1.01 * radius),
            Search::Nearest => {
                // The disc in the square holds the k nearest but once in 10^12 fields.
                let certain = count as f64 + 8.0 * (count as f64).sqrt() + 30.0;
                let bandwidth = Bandwidth::Nearest { k: count, max_radius: f64::INFINITY };
                (bandwidth, (certain / (PI * DENSITY)).sqrt())
            }
        }
    }
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let parameters: Parameters = context.parameters()?;
    let mut found = Findings { seeds: vec![parameters.seed], ..Findings::default() };
    let mut table = Table::new(Search::ALL.len() * AREAS.len() * parameters.counts.len());
    let mut series = Vec::new();
    let mut literal: Vec<f64> = Vec::new();
    for search in Search::ALL {
        let mut points = AREAS.map(|_| Vec::new());
        for (number, &count) in parameters.counts.iter().enumerate() {
            let group = (number * Search::ALL.len() + search as usize) as u64;
            let readings = readings(&parameters, search, count, group)?;
            for (((_, used, area), values), points) in AREAS.into_iter().zip(readings).zip(&mut points) {
                let measured = values.interval(table.confidence);
                let expected =
                    Expected::exact(used.factor(), "a plane cuts a ball of radius r in a disc (catalogue A4)");
                let label = format!("{}, {count} photons, over {area}", search.name());
                table.judge(label, expected, measured, parameters.precision);
                points.extend(measured.map(|m| Point::measured(count as f64 * search.offset(), m)));
                if used == AreaUsed::Sphere {
                    literal.extend(values.mean());
                }
                found.rows.push(row([
                    ("search", search.name().into()),
                    ("photons", count.into()),
                    ("area", area.into()),
                    ("replicates", values.len().into()),
                    ("mean", values.mean().into()),
                    ("std_error", values.std_error().into()),
                    ("law", used.factor().into()),
                ]));
            }
        }
        for ((_, _, area), points) in AREAS.into_iter().zip(points) {
            let label = format!("over {area}, {}", search.name());
            series.push(Series { label, kind: SeriesKind::Measured, points });
        }
    }
    for (label, factor) in [("truth", 1.0), ("a quarter", 0.25)] {
        let ends = [parameters.counts.first(), parameters.counts.last()];
        let points = ends.into_iter().flatten().map(|&count| Point::new(count as f64, factor)).collect();
        series.push(Series { label: label.into(), kind: SeriesKind::Predicted, points });
    }
    found.figures.push(FigureData {
        id: "reading".into(),
        title: "Uniform light read with the sphere's surface and with the disc".into(),
        caption: format!(
            "Mean over independent Poisson fields on a plane; {}. More photons narrow the spread and leave the \
             factor. (The two searches' marks are set a little apart.)",
            table.intervals()
        ),
        x: Axis::log("photons in the disc (k, or the mean count within a fixed radius)"),
        y: Axis::linear("mean reading over true irradiance"),
        series,
    });
    let (comparisons, verdict, reason) = table.conclude(|| {
        let (low, high) = literal.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &x| (l.min(x), h.max(x)));
        let most = parameters.counts.iter().max().copied().unwrap_or(0);
        let reason = format!(
            "divided by the sphere's surface the readings are {low:.4} to {high:.4} of the truth, a quarter however many photons \
             (up to {most}) are gathered; divided by the disc pi r^2 they are right"
        );
        (Verdict::DoesNotHold, reason)
    });
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// Both areas' readings in the middle of independent Poisson fields of irradiance 1.
fn readings(parameters: &Parameters, search: Search, count: usize, group: u64) -> anyhow::Result<Vec<Replicates>> {
    let (bandwidth, half) = search.bandwidth(count);
    let at = GatherPoint { position: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let replicates = (parameters.gathered / count as u64).max(parameters.fewest_replicates);
    Trials { seed: parameters.seed, group, replicates }.run(|stream, scratch| {
        let field = Field::uniform(DENSITY, [-half; 2], [half; 2], stream);
        let map = PhotonMap::build(field.positions, field.photons, SplitRule::Median)?;
        let read = |(area, _, _)| map.gather(&at, bandwidth, area, &Tests::default(), scratch).irradiance[0];
        Ok(AREAS.map(read).to_vec())
    })
}
