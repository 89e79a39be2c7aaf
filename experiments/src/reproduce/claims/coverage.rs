//! `coverage`: how often error bars hold, over every scene with a known answer.

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Group, Point, Record, Row, Series, SeriesKind, Verdict, student_t_quantile,
};
use photonlab_readout::{Aids, Cell, CellResult, Direct, Method, Outcome, Settings, Target, Wanted};
use photonlab_reference::catalogue::{ALL, Case, Entry};
use photonlab_sampling::leak;
use photonlab_trace::Limits;
use serde::Deserialize;

use crate::{
    by_channels,
    certificate::{doubt, nothing, objections},
    chosen::{DEFAULT_ESTIMATOR, usual_gather_rays},
    reproduce::{
        case_reading::put_down,
        context::{Context, Findings},
        covered::{Covered, LEVELS, Made, Run, Truth, USUAL, truths},
        far::{self, Far},
        fnv::fnv1a,
        lab::Lab,
        table::row,
    },
};

/// Confidence of each comparison.
const CONFIDENCE: f64 = 0.99;
/// Points by which noise alone may miss its nominal coverage, and by which whole intervals may fall short of it.
const NOISE: f64 = 0.02;
const SHORT: f64 = 0.01;
/// Most of the median half-width over the RMS error.
const WIDEST: f64 = 3.0;

const METHODS: [(&str, Way); 8] = [
    ("final gather", Way::plain(Method::FinalGather { radius: None })),
    ("irradiance cache", Way { cache: true, ..Way::plain(Method::FinalGather { radius: None }) }),
    ("found radius", Way::plain(Method::Radius { radius: None })),
    ("named radius", Way { named: true, ..Way::plain(Method::Radius { radius: None }) }),
    ("k nearest", Way::plain(Method::Nearest { k: None })),
    ("adaptive", Way::plain(Method::Adaptive)),
    ("path tracing", Way::plain(Method::Path)),
    ("photons counted", Way::plain(Method::Bins)),
];

/// How a scene is read.
#[derive(Clone, Copy)]
struct Way {
    method: Method,
    cache: bool,
    /// Within the radius that an earlier run has found, named as a user would.
    named: bool,
}

impl Way {
    const fn plain(method: Method) -> Self {
        Self { method, cache: false, named: false }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Every so many-th scene is read, by the hash of its name.
    one_in: u64,
    seeds: u64,
    photons: u64,
    points: u64,
    /// Widest half-width of a coverage at 95 % that still says something.
    precision: f64,
}

/// What one method did over the scenes of one part.
#[derive(Default)]
struct Part {
    covered: Covered,
    scenes: usize,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let folder = context.folder("scenes")?;
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    // By method, then tuned-on and set-aside.
    let mut parts: Vec<[Part; 2]> = METHODS.iter().map(|_| Default::default()).collect();
    let cases = ALL.iter().flat_map(|entry| (entry.cases)().into_iter().map(move |case| (entry, case)));
    for (number, (entry, case)) in cases.enumerate() {
        let hash = fnv1a(&format!("{} {}", entry.id, case.name));
        if !(hash >> 1).is_multiple_of(p.one_in) {
            continue;
        }
        say!("       {} {}", entry.id, case.name);
        let path = folder.join(format!("{number}.xml"));
        put_down(&case, &path)?;
        let lab = Lab::open(&path)?;
        let first = p.seed + 1000 * (number as u64 + 1);
        for (&(name, way), parts) in METHODS.iter().zip(&mut parts) {
            let (runs, truths) = by_channels!(lab.needs.channels, read(&lab, &case, way, &p, first))?;
            if truths.is_empty() {
                continue;
            }
            found.rows.push(scene_row(entry, &case, name, hash & 1 == 1, &runs, &truths));
            let part = &mut parts[(hash & 1) as usize];
            part.covered.add(&runs, &truths);
            part.scenes += 1;
        }
    }
    for ((name, _), parts) in METHODS.iter().zip(&parts) {
        for (part, which) in parts.iter().zip(["tuned-on", "set-aside"]) {
            let comparisons = compare(name, which, part);
            found.groups.push(group(name, which, part, comparisons.len()));
            found.comparisons.extend(comparisons);
        }
    }
    let far = far::measure(p.seed, p.seeds, p.photons, p.points, LEVELS[USUAL])?;
    let comparisons = far.comparisons(CONFIDENCE);
    found.groups.push(far_group(&far, comparisons.len()));
    found.comparisons.extend(comparisons);
    found.rows.extend(far.rows.iter().cloned());
    found.figures = vec![
        figure("noise", "Noise alone", &parts, |c| &c.noise),
        figure("whole", "Whole intervals of certified readings", &parts, |c| &c.whole),
    ];
    let (verdict, reason) = conclude(&p, &parts, &far, &found.comparisons);
    Ok(context.record(found, verdict, reason))
}

/// Every meter that a method reads, by every seed, as the command would judge it; and the answers.
fn read<const C: usize>(
    lab: &Lab,
    case: &Case,
    Way { mut method, cache, named }: Way,
    p: &Parameters,
    first: u64,
) -> anyhow::Result<(Vec<Run>, Vec<Truth>)> {
    let counts = method == Method::Bins;
    let readable = |cell: &Cell| match cell.target {
        Target::Leaving { .. } => counts,
        Target::Along(_) | Target::Distant { .. } => !counts,
        _ => true,
    };
    let cells: Vec<Cell> = Cell::of_meters(&lab.world.scene).into_iter().filter(readable).collect();
    let settings = |method: Method, seed: u64| Settings {
        method,
        direct: Direct::Sampled,
        estimator: DEFAULT_ESTIMATOR,
        gather_rays: usual_gather_rays(cache),
        aids: Aids { cache, ..Aids::default() },
        draws: method.usual_draws(),
        seed,
        limits: Limits { max_segments: lab.world.scene.max_depth, ..Limits::default() },
    };
    let wanted = Wanted { photons: Some(p.photons), samples: (!counts).then_some(p.points), ..Wanted::default() };
    let (mut runs, mut answers) = (Vec::new(), Vec::new());
    if cells.is_empty() {
        return Ok((runs, answers));
    }
    if named {
        let earlier = lab.read::<C>(&cells, settings(method, first + p.seeds), &wanted, LEVELS[USUAL])?;
        let Some(radius) = earlier.radius.filter(|radius| *radius > 0.0) else { return Ok((runs, answers)) };
        method = Method::Radius { radius: Some(radius) };
    }
    let is_doubted = doubt(&lab.world, &lab.needs, leak(&lab.world), &settings(method, first)).is_some();
    for seed in first..first + p.seeds {
        let outcome = lab.read::<C>(&cells, settings(method, seed), &wanted, LEVELS[USUAL])?;
        let channels = 0..outcome.results;
        answers = truths(lab, case, &cells, outcome.results)?;
        let made = outcome.cells.iter().flat_map(|cell| channels.clone().map(|c| make(cell, c, &outcome, is_doubted)));
        runs.push(made.collect());
    }
    Ok((runs, answers))
}

fn make<const C: usize>(
    result: &CellResult<C>,
    channel: usize,
    outcome: &Outcome<C>,
    is_doubted: bool,
) -> Option<Made> {
    if nothing(result, channel, outcome.lamp_flux[channel] > 0.0).is_some() {
        return None;
    }
    let value = &result.value[channel];
    let degrees = value.degrees_of_freedom();
    let t = if degrees > 0.0 { student_t_quantile(LEVELS[USUAL], degrees) } else { 0.0 };
    Some(Made {
        value: value.mean()?,
        error: value.std_error()?,
        degrees,
        half_widths: LEVELS.map(|level| result.half_width(channel, level).unwrap_or(f64::INFINITY)),
        certified: !is_doubted && objections(result, channel, t).is_empty(),
    })
}

fn compare(name: &str, which: &str, part: &Part) -> Vec<Comparison> {
    let covered = &part.covered;
    let mut comparisons = Vec::new();
    for (level, nominal) in LEVELS.into_iter().enumerate() {
        let percent = 100.0 * nominal;
        let expected = Expected::within(nominal, NOISE, "passes are independent");
        let label = format!("{name}, {which}: {percent} % intervals of the noise alone hold the estimator's mean");
        comparisons.push(Comparison::judge(label, "1", expected, covered.noise[level].interval(CONFIDENCE)));
        let expected =
            Expected { value: nominal, low: nominal - SHORT, high: 1.0, source: "the interval's own promise".into() };
        let label = format!("{name}, {which}: {percent} % intervals of certified readings hold the answer");
        comparisons.push(Comparison::judge(label, "1", expected, covered.whole[level].interval(CONFIDENCE)));
    }
    comparisons
}

fn group(name: &str, which: &str, part: &Part, comparisons: usize) -> Group {
    let covered = &part.covered;
    let ratio = covered.median_ratio().map_or("unknown".into(), |ratio| format!("{ratio:.2}"));
    let summary = format!(
        "{} scenes; {:.1} % of {} readings certified; median half-width at 95 % over the RMS error {ratio}",
        part.scenes,
        100.0 * covered.certified_share(),
        covered.readings
    );
    Group { title: format!("{name}, {which} scenes"), summary, comparisons }
}

fn figure(
    id: &str,
    title: &str,
    parts: &[[Part; 2]],
    of: fn(&Covered) -> &[photonlab_measure::Replicates; LEVELS.len()],
) -> FigureData {
    let point = |part: &Part, level: usize, aside: f64| {
        let interval = of(&part.covered)[level].interval(CONFIDENCE)?;
        Some(Point::measured(level as f64 + 1.0 + aside, interval.scaled(100.0)))
    };
    let mut series: Vec<Series> = METHODS
        .iter()
        .zip(parts)
        .enumerate()
        .map(|(number, ((name, _), parts))| Series {
            label: (*name).into(),
            kind: SeriesKind::Measured,
            points: (0..LEVELS.len())
                .filter_map(|level| point(&parts[1], level, 0.1 * (number as f64 - 3.5)))
                .collect(),
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    let nominal = LEVELS.iter().enumerate().map(|(level, nominal)| Point::new(level as f64 + 1.0, 100.0 * nominal));
    series.push(Series { label: "nominal".into(), kind: SeriesKind::Predicted, points: nominal.collect() });
    FigureData {
        id: id.into(),
        title: format!("{title}: how often they hold"),
        caption: "Set-aside scenes; bars: 99 % intervals, each run one replicate.".into(),
        x: Axis::named("confidence of the interval", ["50 %", "90 %", "95 %", "99 %"]),
        y: Axis::linear("share that holds, %"),
        series,
    }
}

fn scene_row(entry: &Entry, case: &Case, method: &str, set_aside: bool, runs: &[Run], truths: &[Truth]) -> Row {
    let mut covered = Covered::default();
    covered.add(runs, truths);
    let share = |of: &photonlab_measure::Replicates| of.mean().map(|share| (1e4 * share).round() / 1e4);
    row([
        ("scene", format!("{} {}", entry.id, case.name).into()),
        ("method", method.into()),
        ("set_aside", set_aside.into()),
        ("readings", truths.len().into()),
        ("certified", covered.certified_share().into()),
        ("noise_95", share(&covered.noise[USUAL]).into()),
        ("whole_95", share(&covered.whole[USUAL]).into()),
        ("width_over_error", covered.median_ratio().into()),
    ])
}

fn far_group(far: &Far, comparisons: usize) -> Group {
    let words =
        far::METHODS.iter().enumerate().map(|(i, (name, _))| format!("{name} {:.1} %", 100.0 * far.certified(i)));
    let summary = format!("certified: {}", words.collect::<Vec<_>>().join(", "));
    Group { title: "More than two radii from edges, shadows and folds".into(), summary, comparisons }
}

fn conclude(p: &Parameters, parts: &[[Part; 2]], far: &Far, comparisons: &[Comparison]) -> (Verdict, String) {
    let wide = |part: &Part| {
        let of = &part.covered;
        [&of.noise[USUAL], &of.whole[USUAL]]
            .into_iter()
            .any(|share| share.interval(CONFIDENCE).is_none_or(|interval| interval.half_width() > p.precision))
    };
    let words = METHODS.iter().zip(parts).map(|((name, _), parts)| {
        let of = &parts[1].covered;
        let percent = |share: &photonlab_measure::Replicates| 100.0 * share.mean().unwrap_or(0.0);
        format!(
            "{name} {:.1} % and {:.1} % ({:.0} % certified, {:.1} times the error)",
            percent(&of.noise[USUAL]),
            percent(&of.whole[USUAL]),
            100.0 * of.certified_share(),
            of.median_ratio().unwrap_or(f64::NAN)
        )
    });
    let reason = format!(
        "over the set-aside scenes 95 % intervals of the noise alone hold the estimator's mean, and whole ones of certified readings \
         the answer, in: {}; more than two radii from edges, shadows and folds, as the closed forms know them, of single readings of all \
         light from the map {}",
        words.collect::<Vec<_>>().join("; "),
        far_group(far, 0).summary
    );
    if parts.iter().any(|parts| wide(&parts[1])) {
        return (
            Verdict::NotMeasured,
            format!("{reason}; the intervals of these shares are wider than the definition asks"),
        );
    }
    let narrow = parts.iter().all(|parts| parts[1].covered.median_ratio().is_none_or(|ratio| ratio <= WIDEST));
    let aside = comparisons.iter().filter(|c| !c.label.contains("tuned-on"));
    let holds = aside.clone().all(|c| c.holds != Some(false)) && narrow;
    (if holds { Verdict::Holds } else { Verdict::DoesNotHold }, reason)
}
