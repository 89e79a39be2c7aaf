//! A peer's readings of a scene, in the same run, where it is installed.

use std::{collections::BTreeMap, path::Path, process::Command};

use photonlab_measure::Replicates;
use photonlab_readout::Cell;
use serde::Deserialize;

use super::{covered::Truth, lab::Lab};

/// Reads a scene with Mitsuba 3.
const SCRIPT: &str = include_str!("../../crosscheck/mitsuba_times.py");

/// Standard errors within which means agree.
const SURE: f64 = 5.0;
/// What single precision costs a mean of many.
const OF_SINGLES: f64 = 1e-3;

/// What a peer needs for which error in a scene.
#[derive(Clone, Debug)]
pub(super) struct Peer {
    pub(super) name: String,
    /// By number of points, fewest first.
    pub(super) levels: Vec<PeerLevel>,
}

/// Runs of a peer at one number of points.
#[derive(Clone, Debug)]
pub(super) struct PeerLevel {
    /// Mean CPU time.
    pub(super) seconds: f64,
    /// The largest relative error of each run.
    pub(super) errors: Vec<f64>,
}

/// One run.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PeerRun {
    peer: String,
    points: u64,
    seconds: f64,
    /// By sensor, channel by channel.
    values: BTreeMap<String, Vec<f64>>,
}

/// Mitsuba's path tracer, by so many seeds, up to runs of so many CPU seconds; `None` where it is not installed, does not read the scene, or by its
/// longest runs reads something else: it does not find the light, or means something else by the scene.
pub(super) fn mitsuba(
    (scene, lab): (&Path, &Lab),
    (cells, truths): (&[Cell], &[Truth]),
    (seconds, seeds): (f64, u64),
) -> Option<Peer> {
    let counts = [seconds.to_string(), seeds.to_string()];
    let output = Command::new("python3").arg("-c").arg(SCRIPT).arg(scene).args(counts).output();
    let output = output.ok().filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?;
    let runs: Vec<PeerRun> = text.lines().map(serde_json::from_str).collect::<Result<_, _>>().ok()?;
    let name = runs.first()?.peer.clone();
    let level = |runs: &[PeerRun]| {
        let errors = runs.iter().map(|run| run.largest_error(lab, cells, truths)).collect::<Option<_>>()?;
        let seconds = runs.iter().map(|run| run.seconds).sum::<f64>() / runs.len() as f64;
        Some(PeerLevel { seconds, errors })
    };
    let longest = runs.last()?.points;
    let longest: Vec<&PeerRun> = runs.iter().filter(|run| run.points == longest).collect();
    if !agree(&longest, lab, (cells, truths))? {
        return None;
    }
    let levels = runs.chunk_by(|a, b| a.points == b.points).map(level).collect::<Option<_>>()?;
    Some(Peer { name, levels })
}

/// True if the mean of some runs is the answer within its own noise, for every reading; `None` if one of them is not told.
fn agree(runs: &[&PeerRun], lab: &Lab, (cells, truths): (&[Cell], &[Truth])) -> Option<bool> {
    let results = truths.len() / cells.len();
    for (number, truth) in truths.iter().enumerate() {
        let (cell, channel) = (&cells[number / results], number % results);
        let values = runs.iter().map(|run| run.value(lab, cell, channel));
        let values: Replicates = values.collect::<Option<Vec<f64>>>()?.into_iter().collect();
        let reach = SURE * values.std_error()? + OF_SINGLES * truth.value + truth.uncertainty;
        if (values.mean()? - truth.value).abs() > reach {
            return Some(false);
        }
    }
    Some(true)
}

impl PeerRun {
    fn value(&self, lab: &Lab, cell: &Cell, channel: usize) -> Option<f64> {
        let values = self.values.get(&lab.world.scene.sensors[cell.sensor].id)?;
        values.get(channel.min(values.len().checked_sub(1)?)).copied()
    }

    fn largest_error(&self, lab: &Lab, cells: &[Cell], truths: &[Truth]) -> Option<f64> {
        let results = truths.len() / cells.len();
        let mut largest = 0.0_f64;
        for (number, truth) in truths.iter().enumerate() {
            largest = largest.max(truth.relative_error(self.value(lab, &cells[number / results], number % results)?));
        }
        Some(largest)
    }
}
