//! Counts: k, fewer than k, photons in heaps, and intervals made of few.

use photonlab_gather::{AreaModel, Bandwidth, Tests};
use photonlab_measure::{Axis, binomial_interval};
use photonlab_reference::{
    atlas::{Counts, Intervals, clusters_by_nearest, starved_from},
    nearest_law::{self, Counted},
};

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{density, facing_up, map, nearest, reach_of_nearest, read, square},
};
use crate::reproduce::field::Field;

/// The quantile of a normal interval that should cover 95 %.
const NORMAL_95: f64 = 1.959_963_984_540_054;

/// All k photons over the area whose radius the k-th one sets.
pub(super) fn all_k(_: &Part) -> anyhow::Result<Mode> {
    let law = |k: f64, counted| nearest_law::uniform(k as u32, counted).mean;
    const LAW: &str = "Gamma law of the k-th distance (catalogue A2)";
    Ok(Mode {
        id: "all-k",
        title: "All k photons counted: k / (k - 1)",
        x: Axis::log("k, photons"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: false,
        curves: vec![
            Curve::off("k photons", LAW, move |k| law(k, Counted::All)),
            Curve::on("k - 1 photons", LAW, move |k| law(k, Counted::AllButLast)),
        ],
        trial: each(|k, stream, scratch| {
            let map = map(square(k, reach_of_nearest(k), stream))?;
            let value = read(&map, &facing_up([0.0; 3]), nearest(k), &Tests::default(), scratch);
            Ok([value * k / (k - 1.0), value])
        }),
    })
}

/// Fewest photons whose furthest one's disc is divided by: readings over fewer have no fourth moment.
const FEWEST: usize = 5;

/// Fewer than k photons within the largest radius.
pub(super) fn starved(part: &Part) -> anyhow::Result<Mode> {
    let k = part.photons;
    Ok(Mode {
        id: "fewer-than-k",
        title: "Fewer than k photons within reach",
        x: Axis::log("photons expected within the largest radius"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("over the furthest photon's disc", "capped queries (catalogue A6), from five on", move |mu| {
                starved_from(k as u32, mu, FEWEST as u32)
            }),
            Curve::on("over the whole disc", "capped queries (catalogue A6)", move |mu| {
                nearest_law::capped(k as u32, mu, Counted::AllButLast)
            }),
        ],
        trial: each(move |mu, stream, scratch| {
            let (map, at) = (map(square(mu, 1.01, stream))?, facing_up([0.0; 3]));
            let capped = Bandwidth::Nearest { k: k as usize, max_radius: 1.0 };
            let estimate = map.gather(&at, capped, AreaModel::Disc, &Tests::default(), scratch);
            let (value, found) = (estimate.irradiance[0], estimate.photons);
            // A full search found k - 1 within the k-th; a starved one all that are there.
            let over_furthest = if estimate.radius < 1.0 {
                value * k / (k - 1.0)
            } else if found >= FEWEST {
                let n = found as f64;
                read(&map, &at, nearest(n), &Tests::default(), scratch) * n / (n - 1.0)
            } else {
                value
            };
            Ok([over_furthest, value])
        }),
    })
}

/// Photons that lie in heaps on one spot.
pub(super) fn coincident(part: &Part) -> anyhow::Result<Mode> {
    let k = part.photons;
    Ok(Mode {
        id: "coincident-photons",
        title: "Coincident photons",
        x: Axis::linear("photons on each spot"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: false,
        curves: vec![
            Curve::off("k nearest", "heaps by a Gamma law", move |m| clusters_by_nearest(k as u32, m as u32).mean),
            Curve::on("fixed radius", "sum over a disc", |_| 1.0),
        ],
        trial: each(move |m, stream, scratch| {
            let spots = square(k / m, reach_of_nearest(k / m).max(1.01), stream).positions;
            let mut field = Field::default();
            for _ in 0..m as usize {
                for &spot in &spots {
                    field.push(spot.map(f64::from), [0.0, 0.0, 1.0], 1.0 / density(k));
                }
            }
            let (map, at) = (map(field)?, facing_up([0.0; 3]));
            Ok([nearest(k), Bandwidth::Radius(1.0)].map(|search| read(&map, &at, search, &Tests::default(), scratch)))
        }),
    })
}

/// Intervals at 95 % made of a few photons.
pub(super) fn small_counts(part: &Part) -> anyhow::Result<Mode> {
    let all = part.photons as u64;
    let coverage = move |mean, intervals| Counts { photons: all, mean }.coverage(intervals);
    const LAW: &str = "sum over the binomial law";
    Ok(Mode {
        id: "small-counts",
        title: "Intervals made of few photons",
        x: Axis::log("photons expected in the disc"),
        y: Axis::linear("share of 95 % intervals that hold the truth"),
        truth: Some(("what they say", Box::new(|_| 0.95))),
        between: true,
        curves: vec![
            Curve::off("n +- 1.96 root n", LAW, move |mu| coverage(mu, Intervals::RootOfCount(NORMAL_95))),
            Curve::on("Clopper and Pearson", LAW, move |mu| coverage(mu, Intervals::ClopperPearson(0.95))),
        ],
        trial: each(move |mu, stream, scratch| {
            // A square of 4 m^2 with all photons; the disc takes its share of the area.
            let share = mu / all as f64;
            let radius = (4.0 * share / std::f64::consts::PI).sqrt();
            let mut field = Field::default();
            for _ in 0..all {
                let [u, v] = stream.next2();
                field.push([2.0 * u - 1.0, 2.0 * v - 1.0, 0.0], [0.0, 0.0, 1.0], 1.0);
            }
            let (map, at) = (map(field)?, facing_up([0.0; 3]));
            let ball = Bandwidth::Radius(radius);
            let estimate = map.gather(&at, ball, AreaModel::Disc, &Tests::default(), scratch);
            let found = estimate.photons as f64;
            let root = (found - mu).abs() <= NORMAL_95 * found.sqrt();
            let exact = binomial_interval(estimate.photons as u64, all, 0.95).contains(share);
            Ok([root, exact].map(|holds| f64::from(u8::from(holds))))
        }),
    })
}
