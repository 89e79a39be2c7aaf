//! `edge-darkening`: what gathering reads near edges, corners, creases and walls.

use std::f64::consts::PI;

use photonlab_gather::{AreaModel, Bandwidth, PhotonMap};
use photonlab_kdtree::SplitRule;
use photonlab_measure::{Axis, Expected, FigureData, Point, Record, Replicates, Row, Series, SeriesKind, Verdict};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    edges::{Filter, Place, Search},
    faces::lit,
    table::{Table, row},
    trials::Trials,
};

/// How far the faces reach, in search radii: beyond the k-th photon even in the corner of a quadrant, which must grow its
/// radius twofold.
const REACH: f64 = 4.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Photons in a full disc: k, and the mean count within the radius.
    k: usize,
    /// Distances of the profiles in search radii, ascending.
    profile: Vec<f64>,
    /// Those of them that the table judges.
    judged: Vec<f64>,
    /// A mean known worse than this (relative half-width) says nothing.
    precision: f64,
}

/// A profile: one reading per distance.
struct Curve {
    place: Place,
    search: Search,
    filter: Filter,
    readings: Vec<Replicates>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut curves = Vec::new();
    for place in Place::ALL {
        curves.extend(profiles(&p, place)?);
    }
    let mut table = Table::new(curves.len() * p.judged.len());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    for curve in &curves {
        for (&t, reading) in p.profile.iter().zip(&curve.readings) {
            let law = curve.law(&p, t);
            if p.judged.contains(&t) {
                let expected = Expected::exact(law, "edge laws (catalogue B1 to B5, B7)");
                let label = format!("{}, t = {t}", curve.name());
                table.judge(label, expected, reading.interval(table.confidence), p.precision);
            }
            found.rows.push(curve.row(t, law, reading));
        }
    }
    found.figures = Place::ALL.into_iter().map(|place| figure(&p, &table, place, &curves)).collect();
    let (comparisons, verdict, reason) = table.conclude(|| verdict(&p, &curves));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// All profiles of a place, read from the same independent fields. The search radius is 1 m.
fn profiles(p: &Parameters, place: Place) -> anyhow::Result<Vec<Curve>> {
    let (faces, density) = (place.faces(REACH), p.k as f64 / PI);
    let trials = Trials { seed: p.seed, group: place as u64, replicates: p.replicates };
    let mut readings = trials
        .run(|stream, scratch| {
            let field = lit(&faces, density, stream);
            let map = PhotonMap::build(field.positions, field.photons, SplitRule::Median)?;
            let mut values = Vec::with_capacity(place.curves().len() * p.profile.len());
            for &(search, filter) in place.curves() {
                let bandwidth = match search {
                    Search::Radius => Bandwidth::Radius(1.0),
                    Search::Nearest => Bandwidth::Nearest { k: p.k, max_radius: f64::INFINITY },
                };
                for &t in &p.profile {
                    let estimate = map.gather(&place.query(t), bandwidth, AreaModel::Disc, &filter.tests(), scratch);
                    values.push(estimate.irradiance[0]);
                }
            }
            Ok(values)
        })?
        .into_iter();
    let curve = |&(search, filter): &(Search, Filter)| {
        let readings = readings.by_ref().take(p.profile.len()).collect();
        Curve { place, search, filter, readings }
    };
    Ok(place.curves().iter().map(curve).collect())
}

impl Curve {
    fn name(&self) -> String {
        let filter = if matches!(self.place, Place::FreeEdge | Place::FreeCorner) {
            String::new()
        } else {
            format!(", {}", self.filter.name())
        };
        format!("{}, {}{filter}", self.place.name(), self.search.name())
    }

    fn law(&self, p: &Parameters, t: f64) -> f64 {
        self.place.law(self.search, self.filter, p.k as u32, t)
    }

    fn row(&self, t: f64, law: f64, reading: &Replicates) -> Row {
        row([
            ("place", self.place.name().into()),
            ("search", self.search.name().into()),
            ("test", self.filter.name().into()),
            ("t", t.into()),
            ("replicates", reading.len().into()),
            ("mean", reading.mean().into()),
            ("std_error", reading.std_error().into()),
            ("law", law.into()),
        ])
    }
}

fn verdict(p: &Parameters, curves: &[Curve]) -> (Verdict, String) {
    let curve =
        |place, search, filter| curves.iter().find(|c| c.place == place && c.search == search && c.filter == filter);
    let at_zero = |place, filter| {
        let reading = curve(place, Search::Radius, filter).and_then(|curve| curve.readings.first());
        reading.and_then(Replicates::mean).unwrap_or(f64::NAN)
    };
    // The profile's brightest place is the law's, not the one that noise favours.
    let brightest = |place| {
        let curve = curve(place, Search::Radius, Filter::All)?;
        let law = |t: f64| curve.law(p, t);
        let places = p.profile.iter().zip(&curve.readings);
        let (&t, reading) = places.max_by(|a, b| law(*a.0).total_cmp(&law(*b.0)))?;
        Some((t, 100.0 * (reading.mean()? - 1.0)))
    };
    let (crease_at, crease_most) = brightest(Place::Crease).unwrap_or((f64::NAN, f64::NAN));
    let (corner_at, corner_most) = brightest(Place::RoomCorner).unwrap_or((f64::NAN, f64::NAN));
    let reason = format!(
        "a free edge reads {:.3} and a free corner {:.3} of the light, as the paper says of empty parts of the sphere. In a room it \
         depends on the test: without one, a concave edge of equally lit faces reads {:.3} at the edge and {crease_most:+.1} %, too \
         bright, at {crease_at} radii from it, and a corner of three faces {:.3} and {corner_most:+.0} % at {corner_at} radii; with \
         a normal test edge and corner read {:.3} and {:.3}",
        at_zero(Place::FreeEdge, Filter::All),
        at_zero(Place::FreeCorner, Filter::All),
        at_zero(Place::Crease, Filter::All),
        at_zero(Place::RoomCorner, Filter::All),
        at_zero(Place::Crease, Filter::Normal),
        at_zero(Place::RoomCorner, Filter::Normal),
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn figure(p: &Parameters, table: &Table, place: Place, curves: &[Curve]) -> FigureData {
    let end = p.profile.last().copied().unwrap_or(1.0);
    let axis: Vec<f64> = (0..=60).map(|i| end * f64::from(i) / 60.0).collect();
    let mut series = Vec::new();
    for curve in curves.iter().filter(|curve| curve.place == place) {
        let name = match place {
            Place::FreeEdge | Place::FreeCorner => curve.search.name().to_string(),
            _ => format!("{}, {}", curve.search.name(), curve.filter.name()),
        };
        let marks = p.profile.iter().zip(&curve.readings);
        let marks = marks.filter_map(|(&t, reading)| Some(Point::measured(t, reading.interval(table.confidence)?)));
        series.push(Series { label: name, kind: SeriesKind::Measured, points: marks.collect() });
        let line = axis.iter().map(|&t| Point::new(t, curve.law(p, t))).collect();
        series.push(Series { label: "its law".into(), kind: SeriesKind::Predicted, points: line });
    }
    FigureData {
        id: place.id().into(),
        title: format!("Reading at a {}", place.name()),
        caption: format!(
            "All faces have equal irradiance{}. The search radius r is fixed and holds {} photons in a full disc, or is that of the \
             {} nearest in the open. {} fields; {}.",
            if place == Place::ThinWall {
                "; the query's own side is dark, and with either test nothing gets through"
            } else {
                ""
            },
            p.k,
            p.k,
            p.replicates,
            table.intervals()
        ),
        x: Axis::linear(format!("{} over the search radius r", place.distance())),
        y: Axis::linear("mean reading over the lit faces' irradiance"),
        series,
    }
}
