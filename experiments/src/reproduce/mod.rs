//! `photonlab reproduce`: claims to records, figures and a report.

mod atlas;
mod billions_chart;
mod case_charts;
mod case_judgement;
mod case_reading;
mod caustic_flux;
mod caustic_profile;
mod checker_detail;
mod claims;
mod command_cost;
mod context;
mod controlled;
mod covered;
mod cube_error;
mod cube_face;
mod cube_field;
mod cube_law;
mod date;
mod decay;
mod definition;
mod edges;
mod face_edges;
mod faces;
mod far;
mod field;
mod fnv;
mod furnace;
mod gathered;
mod growth;
mod hindsight;
mod known_scenes;
mod lab;
mod lamp_caustic;
mod map_scene;
mod peers;
mod photon_law;
mod photon_set;
mod picture;
mod placed;
mod progressive;
mod races;
mod ray_curves;
mod receivers;
mod report;
mod search;
mod slab;
mod speeds;
mod split_charts;
mod split_rules;
mod split_times;
mod split_trials;
mod stop_charts;
mod stopped;
mod strategy;
mod table;
mod tested;
mod torus;
mod transmitter;
mod trials;
mod uneven;

use std::path::{Path, PathBuf};

use photonlab_measure::{Budget, Record};

use crate::{Failure, command, cpu_clock, interrupt, system};
use claims::Claim;
use context::Context;

/// Runs the claims asked for and writes the report; its path is the last line on standard output.
pub(crate) fn reproduce(arguments: &command::Reproduce) -> Result<(), Failure> {
    if arguments.device == command::DeviceName::Gpu {
        return Err(Failure::usage("--device gpu is not built yet; leave it out"));
    }
    system::start_threads(arguments.threads)?;
    let budget = arguments.budget.budget();
    let claims = chosen(&arguments.claims)?;
    check_entries(&claims, &arguments.entries)?;
    let out = arguments.out.clone().unwrap_or_else(|| Path::new("target/reproduce").join(budget.name()));
    for folder in ["records", "records/images", "figures"] {
        interrupt::make_folder(&out.join(folder)).map_err(|error| {
            Failure::usage(format!(
                "--out {}: cannot make {folder} there: {error}; choose a writable folder",
                out.display()
            ))
        })?;
    }
    let mut finished = Vec::new();
    for (number, &claim) in claims.iter().enumerate() {
        say!("[{}/{}] {}", number + 1, claims.len(), claim.id());
        let record = run(claim, budget, &arguments.entries, &out)?;
        say!("       {}: {}", verdict_word(&record), record.reason);
        finished.push(record);
        // The page is brought up to date after each claim, so that an interrupt leaves a report of what is finished.
        report::write(&finished, &out)?;
    }
    println!("{}", out.join("report.html").display());
    Ok(())
}

fn run(claim: Claim, budget: Budget, entries: &[String], out: &Path) -> Result<Record, Failure> {
    let context = Context::new(claim, budget, entries, out)?;
    let record = claim.run(&context)?;
    let _guard = interrupt::writing();
    record.save(&out.join("records").join(format!("{}.json", claim.id()))).map_err(anyhow::Error::from)?;
    Ok(record)
}

/// The claims that the words name; none named means all.
fn chosen(words: &[String]) -> Result<Vec<Claim>, Failure> {
    if words.is_empty() {
        return Ok(Claim::ALL.to_vec());
    }
    let asked = [
        Claim::Catalogue,
        Claim::Atlas,
        Claim::Coverage,
        Claim::Convergence,
        Claim::Cost,
        Claim::GatherAids,
        Claim::TestedRadii,
        Claim::Needs,
        Claim::Planner,
        Claim::SpeedAccuracy,
        Claim::IlluminanceMaps,
    ];
    let all = || Claim::ALL.into_iter().chain(asked);
    let known = || all().map(Claim::id).collect::<Vec<_>>().join(", ");
    let find = |word: &String| {
        all()
            .find(|claim| claim.id() == word)
            .ok_or_else(|| Failure::usage(format!("no claim is called `{word}`; claims built: {}", known())))
    };
    words.iter().map(find).collect()
}

/// Entries are the catalogue's alone, and it must have them.
fn check_entries(claims: &[Claim], entries: &[String]) -> Result<(), Failure> {
    if !entries.is_empty() && claims != [Claim::Catalogue] {
        return Err(Failure::usage("--entries is used by the claim catalogue alone; leave it out, or name that claim"));
    }
    let known: Vec<&str> = photonlab_reference::catalogue::ALL.iter().map(|entry| entry.id).collect();
    match entries.iter().find(|entry| !known.contains(&entry.as_str())) {
        Some(unknown) => {
            let known = known.join(", ");
            Err(Failure::usage(format!(
                "--entries: the catalogue has no entry `{unknown}` with a scene; choose of {known}"
            )))
        }
        None => Ok(()),
    }
}

fn verdict_word(record: &Record) -> String {
    serde_json::to_value(record.verdict).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}

/// Where a claim's pictures go, relative to its record.
fn image_path(claim: Claim, name: &str) -> PathBuf {
    Path::new("images").join(format!("{}-{name}", claim.id()))
}
