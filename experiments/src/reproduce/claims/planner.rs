//! `planner`: is the method that `auto` chooses the best, does it meet the wanted error, and is its time foretold?

use photonlab_measure::{Comparison, Group, Record, Verdict};
use photonlab_planner::{Candidate, Planner};
use photonlab_readout::{Cell, Session, Settings, Silent};
use photonlab_reference::catalogue::{ALL, Case};
use serde::Deserialize;

use crate::{
    by_channels,
    certificate::is_clear_of_edges,
    ladder::{Ladder, Rung},
    reproduce::{
        case_reading::put_down,
        context::{Context, Findings},
        covered::Truth,
        cpu_clock::CpuClock,
        hindsight::{Best, contenders, largest_error, within},
        known_scenes::{Known, chosen, is_set_aside, with_known},
        lab::Lab,
        races::{Race, Run, compare, figures, words},
    },
};

/// Fewest runs by `auto` to one target, however long they are.
const FEWEST_RUNS: u64 = 10;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// Scenes of each entry of the catalogue, those of the least hashes.
    of_entry: usize,
    seeds: u64,
    /// Seeds by which fixed ways are looked at first: those that are far behind are read by no more.
    scouts: u64,
    /// CPU seconds of a fixed run from which on no longer one is tried.
    ladder_seconds: f64,
    /// CPU seconds of all runs by `auto` to one target, by which fewer are made of long ones.
    race_seconds: f64,
    /// Targets that the best method in hindsight would take longer to are left out.
    longest: f64,
    targets: Vec<f64>,
    /// Fewer seeds say nothing of 95 %.
    fewest_seeds: u64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let folder = context.folder("scenes")?;
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let mut races = Vec::new();
    for (number, (scene, case)) in ALL.iter().flat_map(|entry| chosen(entry, p.of_entry)).enumerate() {
        say!("       {scene}");
        let path = folder.join(format!("{number}.xml"));
        put_down(&case, &path)?;
        let lab = Lab::open(&path)?;
        let first = p.seed + 1000 * (number as u64 + 1);
        let of_scene = by_channels!(lab.needs.channels, races_of(&lab, &case, &p, first))?.unwrap_or_default();
        let set_aside = is_set_aside(&scene);
        of_scene.iter().for_each(|race| say!("       {}", race.words()));
        races.extend(of_scene.into_iter().map(|race| Race { scene: scene.clone(), set_aside, ..race }));
    }
    found.rows = races.iter().map(Race::row).collect();
    for (set_aside, which) in [(false, "tuned-on"), (true, "set-aside")] {
        let of: Vec<&Race> = races.iter().filter(|race| race.set_aside == set_aside).collect();
        let comparisons = compare(&of, which);
        let summary = words(&of);
        found.groups.push(Group { title: format!("{which} scenes"), summary, comparisons: comparisons.len() });
        found.comparisons.extend(comparisons);
    }
    found.figures = figures(&races);
    let (verdict, reason) = conclude(&p, &races, &found.comparisons);
    Ok(context.record(found, verdict, reason))
}

fn races_of<const C: usize>(lab: &Lab, case: &Case, p: &Parameters, first: u64) -> anyhow::Result<Option<Vec<Race>>> {
    with_known::<C, _>(lab, case, |known| race(known, p, first))
}

/// One scene to every target that the best method in hindsight reaches soon enough.
fn race<const C: usize>(known: Known<'_, C>, p: &Parameters, first: u64) -> anyhow::Result<Vec<Race>> {
    let Known { session, cells, truths, entrants } = known;
    let climb = |entrants: &[Candidate], seeds: u64| -> Vec<Ladder<f64>> {
        let keep = |outcome| largest_error(&outcome, truths);
        let least = p.targets.iter().copied().fold(f64::INFINITY, f64::min);
        let is_enough =
            |rung: &Rung<f64>| rung.seconds > p.ladder_seconds || within(rung.runs.iter().copied()) <= least;
        let one =
            |&entrant: &Candidate| Ladder::climb(&session, cells, entrant, first..first + seeds, &is_enough, &keep);
        entrants.iter().map(one).collect()
    };
    let scouted = climb(&entrants, p.scouts.min(p.seeds));
    let ladders = if p.seeds > p.scouts { climb(&contenders(&scouted, &p.targets), p.seeds) } else { scouted };
    let mut races = Vec::new();
    for &target in &p.targets {
        let Some(best) = Best::of(&ladders, target).filter(|best| best.seconds <= p.longest) else { continue };
        let runs = (p.race_seconds / best.seconds).clamp(FEWEST_RUNS.min(p.seeds) as f64, p.seeds as f64) as u64;
        let runs = (first..first + runs)
            .map(|seed| read(&session, cells, truths, &entrants, (target, seed)))
            .collect::<anyhow::Result<_>>()?;
        races.push(Race { scene: String::new(), set_aside: false, target, best, runs });
    }
    Ok(races)
}

/// One run as `auto` makes it.
fn read<const C: usize>(
    session: &Session<'_, C>,
    cells: &[Cell],
    truths: &[Truth],
    entrants: &[Candidate],
    (target, seed): (f64, u64),
) -> anyhow::Result<Run> {
    let with_seed = |entrant: &Candidate| Candidate { settings: Settings { seed, ..entrant.settings }, ..*entrant };
    let entrants: Vec<Candidate> = entrants.iter().map(with_seed).collect();
    let planner =
        Planner { session: *session, cells, target, time_limit: None, patience: None, trusts: &is_clear_of_edges };
    let (clock, start) = (CpuClock::start(), std::time::Instant::now());
    let plan = planner.race(&entrants)?;
    let foretold = plan.seconds_left().map(|left| start.elapsed().as_secs_f64() + left);
    let chosen = entrants[plan.chosen].title();
    let outcome = plan.go_on(&Silent)?;
    let (seconds, took) = (clock.seconds(), start.elapsed().as_secs_f64());
    Ok(Run { seconds, error: largest_error(&outcome, truths), foretold, took, chosen })
}

fn conclude(p: &Parameters, races: &[Race], comparisons: &[Comparison]) -> (Verdict, String) {
    let aside: Vec<&Race> = races.iter().filter(|race| race.set_aside).collect();
    let reason = words(&aside);
    let (tuned, decides) = comparisons.split_at(comparisons.len() / 2);
    let misses = |of: &[Comparison]| of.iter().any(|comparison| comparison.holds == Some(false));
    let verdict = match (p.seeds < p.fewest_seeds || aside.is_empty(), misses(decides), misses(tuned)) {
        (true, ..) => Verdict::NotMeasured,
        (false, true, _) => Verdict::DoesNotHold,
        (false, false, true) => Verdict::HoldsWithinLimits,
        (false, false, false) => Verdict::Holds,
    };
    (verdict, reason)
}
