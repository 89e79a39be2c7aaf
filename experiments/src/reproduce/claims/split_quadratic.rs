//! `split-quadratic`: how the build's time grows if N is counted for every plane, and if planes are swept.

use photonlab_kdtree::{DEFAULT_LEAF_LIMIT, EmptyCost, SplitRule};
use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict,
    fit_log_log, sidak_level,
};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    cpu_clock::CPU_SECONDS,
    photon_set::PhotonSet,
    split_rules::{PAPER, bare_tree, build_seconds},
    table::row,
};

const FAMILY: f64 = 0.99;
const SETS: [PhotonSet; 2] = [PhotonSet::CornellBox, PhotonSet::Volume];
/// The paper's cost by a look at every photon for every plane.
const COUNTED: SplitRule = SplitRule::Enumeration { empty_cost: EmptyCost::NodeAreas(0.0) };

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Photons for counting, ascending.
    counted: Vec<usize>,
    /// Photons for the sweep, ascending.
    swept: Vec<usize>,
    /// A build is repeated for at least this long, for the clock is coarse.
    least_seconds: f64,
    /// A slope known worse than this says nothing.
    precision: f64,
}

/// Seconds of one way to build, by size and replicate.
struct Builds {
    set: PhotonSet,
    name: &'static str,
    photons: Vec<usize>,
    seconds: Vec<Vec<f64>>,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, 2 * SETS.len());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    // One thread, so that none books time while it waits for another.
    let lone = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let (mut builds, mut alike, mut compared) = (Vec::new(), 0, 0);
    for set in SETS {
        let (counted, swept, equal) = lone.install(|| measure(set, &p))?;
        alike += equal;
        compared += p.replicates as usize * p.counted.len();
        builds.extend([counted, swept]);
    }
    for own in &builds {
        found.comparisons.push(own.compare(confidence));
        found.rows.extend(own.rows());
    }
    found.comparisons.push(same_trees(compared, alike));
    found.figures.push(chart(&p, &builds));
    let (verdict, reason) = conclude(&p, &builds, &found.comparisons, confidence);
    Ok(context.record(found, verdict, reason))
}

/// Both ways on the same photons in turn; also how many trees are alike.
fn measure(set: PhotonSet, p: &Parameters) -> anyhow::Result<(Builds, Builds, usize)> {
    let most = p.counted.iter().chain(&p.swept).copied().max().unwrap_or(0);
    let new =
        |name, photons: &[usize]| Builds { set, name, photons: photons.into(), seconds: vec![vec![]; photons.len()] };
    let (mut counted, mut swept, mut alike) = (new("counted for every plane", &p.counted), new("swept", &p.swept), 0);
    for replicate in 0..p.replicates {
        let points = set.draw(most, p.seed, replicate)?;
        for (builds, rule) in [(&mut counted, COUNTED), (&mut swept, PAPER)] {
            for (&photons, seconds) in builds.photons.iter().zip(&mut builds.seconds) {
                seconds.push(build_seconds(&points[..photons], rule, DEFAULT_LEAF_LIMIT, p.least_seconds)?);
            }
        }
        for &photons in &p.counted {
            let tree = |rule| bare_tree(&points[..photons], rule, DEFAULT_LEAF_LIMIT);
            alike += usize::from(tree(COUNTED)? == tree(PAPER)?);
        }
    }
    Ok((counted, swept, alike))
}

impl Builds {
    fn counts(&self) -> bool {
        self.name.starts_with("counted")
    }

    /// Slope in the photons; the interval is that of the replicates' own slopes.
    fn slope(&self, confidence: f64) -> Option<Interval> {
        let photons: Vec<f64> = self.photons.iter().map(|&n| n as f64).collect();
        let one = |replicate: usize| {
            let seconds: Vec<f64> = self.seconds.iter().map(|times| times[replicate]).collect();
            Some(fit_log_log(&photons, &seconds).ok()?.slope)
        };
        (0..self.seconds[0].len()).map(one).collect::<Option<Replicates>>()?.interval(confidence)
    }

    fn compare(&self, confidence: f64) -> Comparison {
        let expected = if self.counts() {
            Expected::within(2.0, 0.2, "n planes an axis times n photons, and as much again below the root")
        } else {
            let slope = n_log_n_slope(&self.photons);
            let source = "n log n over these photons; caches may make it steeper".into();
            Expected { value: slope, low: slope - 0.1, high: 1.5, source }
        };
        let label = format!("{}, {}: slope of the build's CPU time in photons", self.set.title(), self.name);
        Comparison::judge(label, "1", expected, self.slope(confidence))
    }

    fn means(&self) -> impl Iterator<Item = (usize, Replicates)> {
        self.photons.iter().zip(&self.seconds).map(|(&n, seconds)| (n, seconds.iter().copied().collect()))
    }

    fn rows(&self) -> Vec<photonlab_measure::Row> {
        let one = |(photons, seconds): (usize, Replicates)| {
            row([
                ("set", self.set.title().into()),
                ("build", self.name.into()),
                ("photons", photons.into()),
                ("replicates", seconds.len().into()),
                ("cpu_seconds", seconds.mean().into()),
                ("cpu_seconds_std_error", seconds.std_error().into()),
            ])
        };
        self.means().map(one).collect()
    }
}

fn n_log_n_slope(photons: &[usize]) -> f64 {
    let n: Vec<f64> = photons.iter().map(|&n| n as f64).collect();
    let law: Vec<f64> = n.iter().map(|n| n * n.ln()).collect();
    fit_log_log(&n, &law).map_or(1.1, |fit| fit.slope)
}

fn same_trees(compared: usize, alike: usize) -> Comparison {
    let exact = |x: usize| Interval { value: x as f64, low: x as f64, high: x as f64, confidence: FAMILY };
    let expected = Expected::exact(compared as f64, "the same minimum of the same cost");
    Comparison::judge("trees equal in every bit, counted and swept", "1", expected, Some(exact(alike)))
        .with_note("an exact count, without sampling error")
}

fn conclude(p: &Parameters, builds: &[Builds], comparisons: &[Comparison], confidence: f64) -> (Verdict, String) {
    let slopes: Option<Vec<Interval>> = builds.iter().map(|own| own.slope(confidence)).collect();
    let Some(slopes) = slopes.filter(|slopes| slopes.iter().all(|slope| slope.half_width() <= p.precision)) else {
        return (Verdict::NotMeasured, "the slopes' intervals are wider than the definition asks".into());
    };
    let words = builds.iter().zip(&slopes).map(|(own, slope)| {
        format!("{}, {}: {:.2} ({:.2} to {:.2})", own.set.title(), own.name, slope.value, slope.low, slope.high)
    });
    let last = p.counted.len() - 1;
    let seconds = |own: &Builds| own.means().nth(last).and_then(|(_, seconds)| seconds.mean()).unwrap_or(f64::NAN);
    let reason = format!(
        "log-log slopes of CPU time in photons: {}; {} photons of the {} take {:.2} s by counting. Every tree is the same, so \
         the square is a matter of how N is counted, not of the cost",
        words.collect::<Vec<_>>().join("; "),
        p.counted[last],
        builds[0].set.title(),
        seconds(&builds[0])
    );
    let quadratic =
        builds.iter().zip(&slopes).filter(|(own, _)| own.counts()).all(|(_, s)| s.low >= 1.8 && s.high <= 2.2);
    let swept = builds.iter().zip(&slopes).filter(|(own, _)| !own.counts()).all(|(_, s)| s.high < 1.5);
    let verdict = match quadratic && swept && comparisons.iter().all(|c| c.holds == Some(true)) {
        true => Verdict::HoldsWithinLimits,
        false => Verdict::NotCertifiable,
    };
    (verdict, reason)
}

fn chart(p: &Parameters, builds: &[Builds]) -> FigureData {
    let mut series: Vec<Series> = builds
        .iter()
        .map(|own| {
            // Beside one another, for both sets take the same time.
            let aside = if own.set == SETS[0] { 0.95 } else { 1.05 };
            let point =
                |(n, seconds): (usize, Replicates)| Some(Point::measured(aside * n as f64, seconds.interval(0.99)?));
            let label = format!("{}, {}", own.set.title(), own.name);
            Series { label, kind: SeriesKind::Measured, points: own.means().filter_map(point).collect() }
        })
        .collect();
    for (own, label, law) in
        [(&builds[0], "n^2", (|n: f64| n * n) as fn(f64) -> f64), (&builds[1], "n log n", |n: f64| n * n.ln())]
    {
        let Some((last, seconds)) = own.means().last() else { continue };
        let scale = seconds.mean().unwrap_or(f64::NAN) / law(last as f64);
        let points = own.photons.iter().map(|&n| Point::new(n as f64, scale * law(n as f64))).collect();
        series.push(Series { label: format!("{label}, through the last mark"), kind: SeriesKind::Predicted, points });
    }
    FigureData {
        id: "build".into(),
        title: "Time to build the paper's tree, counting and sweeping".into(),
        caption: format!(
            "{} replicates with photons of their own, both ways in turn on one thread; bars: 99 % intervals; marks of one size stand side by side. {CPU_SECONDS}.",
            p.replicates
        ),
        x: Axis::log("photons"),
        y: Axis::log("CPU seconds"),
        series,
    }
}
