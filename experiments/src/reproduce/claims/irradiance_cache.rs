//! `irradiance-cache`: final gather at few places, told of all between, against the photon map at equal time.

use photonlab_measure::{Comparison, Expected, Interval, Record, Verdict};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    controlled::cornell_box,
    cube_face::cube_face,
    ray_curves::{Bench, CONFIDENCE, Curve, Measured, chart, error_over},
    strategy::Strategy,
};

/// Pixels across and down the Cornell box's picture.
const SIZE: u32 = 32;
/// The mean along the edges is expected within this, and the direct view's beyond that.
const EDGE: [f64; 2] = [0.02, 0.1];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Photons, and points per pixel, with the cache.
    cached: Vec<(u64, u64)>,
    /// The same of final gather without.
    gathered: Vec<(u64, u64)>,
    /// Paths per pixel.
    paths: Vec<u64>,
    /// Photons, and points per pixel, where the map is read at the point.
    viewed: Vec<(u64, u64)>,
    /// Paths per pixel of the Cornell box's control.
    control_points: u64,
    /// Largest relative half-width of the deciding ratios.
    precision: f64,
}

/// What one scene showed.
struct Shown {
    scene: &'static str,
    cached: Curve,
    others: Vec<Curve>,
}

/// The paper's direct view stands first among the others.
const VIEWED: usize = 0;

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let control_seed = p.seed + 1_000_000;
    let seeds = p.seed..p.seed + p.replicates;
    let mut found = Findings { seeds: seeds.chain([control_seed]).collect(), ..Findings::default() };
    let cube = show("CUBE", &cube_face()?, &p, &mut found)?;
    let cornell_box = show("the Cornell box", &cornell_box(SIZE, control_seed, p.control_points)?, &p, &mut found)?;
    for shown in [&cube, &cornell_box] {
        shown.judge(p.replicates, &mut found);
    }
    cube.judge_edges(&mut found);
    let (verdict, reason) = conclude(&cube, &cornell_box, p.precision);
    Ok(context.record(found, verdict, reason))
}

fn show<const C: usize>(
    scene: &'static str,
    bench: &Bench<C>,
    p: &Parameters,
    found: &mut Findings,
) -> anyhow::Result<Shown> {
    let seeds = p.seed..p.seed + p.replicates;
    let with_photons = |counts: &[(u64, u64)]| -> Vec<(Option<u64>, u64)> {
        counts.iter().map(|&(photons, points)| (Some(photons), points)).collect()
    };
    let paths: Vec<_> = p.paths.iter().map(|&points| (None, points)).collect();
    let [cached, gathered, viewed] = [&p.cached, &p.gathered, &p.viewed].map(|counts| with_photons(counts));
    let mut curve = |strategy, counts: &[_]| bench.curve(strategy, counts, &seeds, found);
    Ok(Shown {
        scene,
        cached: curve(Strategy::CACHED, &cached)?,
        others: vec![
            curve(Strategy::NEAREST_DIRECT_VIEW, &viewed)?,
            curve(Strategy::PROGRESSIVE, &viewed)?,
            curve(Strategy::FINAL_GATHER, &gathered)?,
            curve(Strategy::PATH, &paths)?,
        ],
    })
}

impl Shown {
    /// The cache's setting that is judged: the middle one.
    fn judged(&self) -> &Measured {
        &self.cached.points[self.cached.points.len() / 2]
    }

    fn ratio(&self, other: usize) -> Option<Interval> {
        error_over(&self.others[other], self.judged())
    }

    fn judge(&self, replicates: u64, found: &mut Findings) {
        for (number, other) in self.others.iter().enumerate() {
            let expected = Expected { value: 0.5, low: 0.0, high: 1.0, source: "the definition's bound".into() };
            let label = format!("{}: error with the cache over that of {}, equal CPU time", self.scene, other.title);
            let ratio = self.ratio(number);
            if number == VIEWED || ratio.is_some() {
                found.comparisons.push(Comparison::judge(label, "1", expected, ratio));
            }
        }
        let id =
            format!("{}-error-against-time", self.scene.trim_start_matches("the ").replace(' ', "-").to_lowercase());
        let title = format!("{}: error of the irradiance cache and of others", self.scene);
        let curves = std::iter::once(&self.cached).chain(&self.others);
        found.figures.push(chart(&id, &title, "CPU seconds", replicates, curves, Measured::seconds));
    }

    fn edge(curve: &Curve) -> Option<Interval> {
        curve.points.get(curve.points.len() / 2)?.border.interval(CONFIDENCE)
    }

    fn judge_edges(&self, found: &mut Findings) {
        let [within, beyond] = EDGE;
        let expected = Expected::within(0.0, within, "the definition's bound");
        let label = format!("{}: mean error along the edges, with the cache", self.scene);
        found.comparisons.push(Comparison::judge(label, "1", expected, Self::edge(&self.cached)));
        let source = "the definition's bound: discs reach over edges".into();
        let expected = Expected { value: -0.3, low: -1.0, high: -beyond, source };
        let label = format!("{}: mean error along the edges, direct view", self.scene);
        found.comparisons.push(Comparison::judge(label, "1", expected, Self::edge(&self.others[VIEWED])));
    }
}

fn conclude(cube: &Shown, cornell_box: &Shown, precision: f64) -> (Verdict, String) {
    let narrow = |shown: &Shown| shown.ratio(VIEWED).filter(|ratio| ratio.half_width() <= precision * ratio.value);
    let (Some(a), Some(b)) = (narrow(cube), narrow(cornell_box)) else {
        let reason =
            "the intervals are wider than the definition asks, or the direct view's times do not surround the cache's";
        return (Verdict::NotMeasured, reason.into());
    };
    let (Some(edge), Some(viewed)) = (Shown::edge(&cube.cached), Shown::edge(&cube.others[VIEWED])) else {
        return (Verdict::NotMeasured, "the mean along the edges could not be measured".into());
    };
    let against = |shown: &Shown, other: usize| {
        shown.ratio(other).map_or("an unknown share".into(), |ratio| format!("{:.2} times", ratio.value))
    };
    let each = |other: usize| format!("{} and {}", against(cube, other), against(cornell_box, other));
    let reason = format!(
        "after as many CPU seconds the cache's error is {:.3} times ({:.3} to {:.3}) that of the direct view in CUBE and {:.2} ({:.2} to {:.2}) \
         in the Cornell box; {} that of the progressive map with direct light sampled, {} that of final gather without a cache, {} that of path \
         tracing. Along CUBE's edges it is off by {:+.2} % ({:+.2} to {:+.2}), the direct view by {:+.0} %",
        a.value,
        a.low,
        a.high,
        b.value,
        b.low,
        b.high,
        each(1),
        each(2),
        each(3),
        100.0 * edge.value,
        100.0 * edge.low,
        100.0 * edge.high,
        100.0 * viewed.value
    );
    let small = edge.low > -EDGE[0] && edge.high < EDGE[0];
    (if a.high < 1.0 && b.high < 1.0 && small { Verdict::Holds } else { Verdict::DoesNotHold }, reason)
}
