//! `speed-accuracy`: error against time of every method in scenes with known answers, and a peer's beside them.

use photonlab_measure::{Group, Record, Verdict};
use photonlab_photometry::Response;
use photonlab_planner::{Balance, Candidate};
use photonlab_readout::{ErrorOver, Outcome, Session};
use photonlab_reference::catalogue::{ALL, Case};
use photonlab_sampling::PassOptics;
use serde::Deserialize;

use crate::{
    by_channels,
    command::Options,
    ladder::Ladder,
    planned::candidates,
    reproduce::{
        case_reading::put_down,
        context::{Context, Findings},
        hindsight::largest_error,
        known_scenes::{chosen, lit_meters},
        lab::Lab,
        peers::mitsuba,
        speeds::{Found, SceneSpeeds, figures, judge, words},
        table::Table,
    },
};

/// Confidence of the half-widths that are charted.
const BARS: f64 = 0.95;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Scenes of each entry of the catalogue, those of the least hashes.
    of_entry: usize,
    seeds: u64,
    /// CPU seconds of a run from which on no longer one is tried, by this program or a peer.
    ladder_seconds: f64,
    /// Fewer seeds say little of 95 %.
    fewest_seeds: u64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let folder = context.folder("scenes")?;
    let mut found = Findings { seeds: (p.seed..p.seed + p.seeds).collect(), ..Findings::default() };
    let mut scenes = Vec::new();
    for (number, (name, case)) in ALL.iter().flat_map(|entry| chosen(entry, p.of_entry)).enumerate() {
        say!("       {name}");
        let path = folder.join(format!("{number}.xml"));
        put_down(&case, &path)?;
        let lab = Lab::open(&path)?;
        scenes.extend(by_channels!(lab.needs.channels, speeds((&lab, &path), (&name, &case), &p))?);
    }
    found.rows = scenes.iter().flat_map(SceneSpeeds::rows).collect();
    found.figures = figures(&scenes);
    let mut table = Table::new(judge(&scenes, None));
    judge(&scenes, Some(&mut table));
    let intervals = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| (Verdict::Holds, words(&scenes, intervals)));
    let (verdict, reason) = match (p.seeds < p.fewest_seeds, verdict) {
        (true, _) => (Verdict::NotMeasured, words(&scenes, intervals)),
        (false, Verdict::Holds) => (verdict, reason),
        // What is known narrowly enough and misses refutes the expectation.
        (false, Verdict::NotCertifiable) => (Verdict::DoesNotHold, format!("{}. {reason}", words(&scenes, intervals))),
        (false, _) => (verdict, format!("{}. {reason}", words(&scenes, intervals))),
    };
    let title = "all scenes".into();
    found.groups.push(Group { title, summary: words(&scenes, intervals), comparisons: comparisons.len() });
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// One scene by every method; `None` if it has no meter that light reaches.
fn speeds<const C: usize>(
    (lab, path): (&Lab, &std::path::Path),
    (name, case): (&str, &Case),
    p: &Parameters,
) -> anyhow::Result<Option<SceneSpeeds>> {
    let optics = PassOptics::<C>::new(&lab.world, Response::Radiometric)?;
    let (cells, truths) = lit_meters(lab, case, optics.results())?;
    if cells.is_empty() {
        return Ok(None);
    }
    let options = Options::usual();
    let settings = options.settings(&lab.world.scene).map_err(|failure| anyhow::anyhow!("{failure}"))?;
    let (world, needs, error_over) = (&lab.world, &lab.needs, ErrorOver::Worst);
    let session = Session { world, optics: &optics, needs, settings, confidence: BARS, error_over };
    let entrants = candidates(&options, &session, &cells).map_err(|failure| anyhow::anyhow!("{failure}"))?;
    let keep = |outcome: Outcome<C>| Found {
        error: largest_error(&outcome, &truths),
        half_width: outcome.error(error_over, BARS).unwrap_or(f64::INFINITY),
    };
    let climb = |&entrant: &Candidate| {
        Ladder::climb(
            &session,
            &cells,
            entrant,
            p.seed..p.seed + p.seeds,
            &|rung| rung.seconds > p.ladder_seconds,
            &keep,
        )
    };
    let ladders = entrants.iter().filter(|entrant| entrant.balance == Balance::Even).map(climb).collect();
    let peer = mitsuba((path, lab), (&cells, &truths), (p.ladder_seconds, p.seeds));
    Ok(Some(SceneSpeeds { name: name.into(), ladders, peer }))
}
