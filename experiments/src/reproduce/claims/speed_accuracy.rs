//! `speed-accuracy`: error against time of every method in scenes with known answers, and a peer's beside them.

use photonlab_measure::{Group, Record, Verdict};
use photonlab_planner::{Balance, Candidate};
use photonlab_readout::Outcome;
use photonlab_reference::catalogue::{ALL, Case};
use serde::Deserialize;

use crate::{
    by_channels,
    ladder::{Ladder, Rung},
    reproduce::{
        case_reading::put_down,
        context::{Context, Findings},
        hindsight::largest_error,
        known_scenes::{BARS, Known, chosen, with_known},
        lab::Lab,
        peers::mitsuba,
        speeds::{Found, SceneSpeeds, figures, judge, words},
        table::Table,
    },
};

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
    with_known::<C, _>(lab, case, |Known { session, cells, truths, entrants }| {
        let keep = |outcome: Outcome<C>| Found {
            error: largest_error(&outcome, truths),
            half_width: outcome.error(session.error_over, BARS).unwrap_or(f64::INFINITY),
        };
        let (seeds, is_enough) = (p.seed..p.seed + p.seeds, |rung: &Rung<Found>| rung.seconds > p.ladder_seconds);
        let climb = |&entrant: &Candidate| Ladder::climb(&session, cells, entrant, seeds.clone(), &is_enough, &keep);
        let ladders = entrants.iter().filter(|entrant| entrant.balance == Balance::Even).map(climb).collect();
        let peer = mitsuba((path, lab), (cells, truths), (p.ladder_seconds, p.seeds));
        Ok(SceneSpeeds { name: name.into(), ladders, peer })
    })
}
