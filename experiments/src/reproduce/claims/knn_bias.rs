//! `knn-bias`: what k over pi r_k^2 reads in uniform light.

use photonlab_gather::{AreaModel, Bandwidth, GatherPoint, PhotonMap, Scratch, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Point, Record, Replicates, Row, Series, SeriesKind, Verdict, sidak_level,
};
use photonlab_reference::nearest_law::{Counted, uniform};
use rayon::prelude::*;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    field::{Field, stream},
};

/// Photons per square metre.
const DENSITY: f64 = 1000.0;
/// The family-wise confidence of the whole table.
const FAMILY: f64 = 0.99;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    k: Vec<usize>,
    /// A mean known worse than this (relative half-width) says nothing.
    precision: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let parameters: Parameters = context.parameters()?;
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, 2 * parameters.k.len());
    let mut found = Findings { seeds: vec![parameters.seed], ..Findings::default() };
    let (mut naive_points, mut corrected_points, mut law_points) = (vec![], vec![], vec![]);
    let mut wide = false;
    for &k in &parameters.k {
        let corrected = estimates(&parameters, k)?;
        let ratio = k as f64 / (k as f64 - 1.0);
        let naive: Replicates = corrected.iter().map(|value| value * ratio).collect();
        let corrected: Replicates = corrected.into_iter().collect();
        for (name, counted, values, points) in [
            ("k / (pi r_k^2)", Counted::All, &naive, &mut naive_points),
            ("(k - 1) / (pi r_k^2)", Counted::AllButLast, &corrected, &mut corrected_points),
        ] {
            let law = uniform(k as u32, counted);
            let measured = values.interval(confidence);
            wide |= values.half_width(confidence).is_none_or(|half| half > parameters.precision);
            let expected =
                Expected::exact(law.mean, "Gamma law of the k-th distance in a Poisson field (catalogue A2)");
            found.comparisons.push(Comparison::judge(format!("{name}, k = {k}"), "1", expected, measured));
            if let Some(m) = measured {
                points.push(Point::measured(k as f64, m));
            }
            found.rows.push(row(k, name, values, law.mean));
        }
        law_points.push(Point::new(k as f64, uniform(k as u32, Counted::All).mean));
    }
    let unbiased = Series { label: "truth".into(), kind: SeriesKind::Reference, points: ends(&law_points, 1.0) };
    found.figures.push(FigureData {
        id: "mean".into(),
        title: "Mean of the k-nearest estimate in uniform light".into(),
        caption: format!(
            "{} independent Poisson fields per k; bars: {:.4} % intervals (Sidak over the table).",
            parameters.replicates,
            100.0 * confidence
        ),
        x: Axis::log("k, photons"),
        y: Axis::linear("mean estimate over truth"),
        series: vec![
            Series { label: "k over pi r_k^2, measured".into(), kind: SeriesKind::Measured, points: naive_points },
            Series { label: "k / (k - 1)".into(), kind: SeriesKind::Predicted, points: law_points },
            Series {
                label: "k - 1 over pi r_k^2, measured".into(),
                kind: SeriesKind::Measured,
                points: corrected_points,
            },
            unbiased,
        ],
    });
    let all_hold = found.comparisons.iter().all(|comparison| comparison.holds == Some(true));
    let (verdict, reason) = if wide {
        (Verdict::NotMeasured, "the intervals are wider than the definition asks")
    } else if all_hold {
        (
            Verdict::DoesNotHold,
            "as the paper words it the estimate is k / (k - 1) too high; with k - 1 photons it is unbiased",
        )
    } else {
        (Verdict::NotCertifiable, "the measured means do not follow the k-nearest law")
    };
    Ok(context.record(found, verdict, reason))
}

/// One (k - 1) / (pi r_k^2) estimate in the middle of each of many independent Poisson fields of irradiance 1.
fn estimates(parameters: &Parameters, k: usize) -> anyhow::Result<Vec<f64>> {
    // A square that holds the k nearest with room to spare: the k-th lies beyond half of it never in practice.
    let half = 2.5 * (k as f64 / (std::f64::consts::PI * DENSITY)).sqrt() + 4.0 / DENSITY.sqrt();
    let at = GatherPoint { position: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    (0..parameters.replicates)
        .into_par_iter()
        .map_init(Scratch::default, |scratch, replicate| {
            let mut stream = stream(parameters.seed, (k as u64) << 32 | replicate);
            let field = Field::uniform(DENSITY, [-half; 2], [half; 2], &mut stream);
            let map = PhotonMap::build(field.positions, field.photons, SplitRule::Median)?;
            let bandwidth = Bandwidth::Nearest { k, max_radius: f64::INFINITY };
            Ok(map.gather(&at, bandwidth, AreaModel::Disc, &Tests::default(), scratch).irradiance[0])
        })
        .collect()
}

fn row(k: usize, estimator: &str, values: &Replicates, law: f64) -> Row {
    let mut row = Row::new();
    row.insert("k".into(), k.into());
    row.insert("estimator".into(), estimator.into());
    row.insert("replicates".into(), values.len().into());
    row.insert("mean".into(), values.mean().into());
    row.insert("std_error".into(), values.std_error().into());
    row.insert("law".into(), law.into());
    row
}

fn ends(points: &[Point], y: f64) -> Vec<Point> {
    let line = |p: &Point| Point::new(p.x, y);
    points.first().into_iter().chain(points.last()).map(line).collect()
}
