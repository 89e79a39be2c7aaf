//! A peer's readings of a scene, in the same run, where it is installed.

use std::{collections::BTreeMap, path::Path, process::Command};

use photonlab_readout::Cell;
use serde::Deserialize;

use super::{covered::Truth, lab::Lab};

/// Reads a scene with Mitsuba 3.
const SCRIPT: &str = include_str!("../../crosscheck/mitsuba_times.py");

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

/// Mitsuba's path tracer, by so many seeds, up to runs of so many CPU seconds; `None` where it is not installed or does not read the scene.
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
    let levels = runs.chunk_by(|a, b| a.points == b.points).map(level).collect::<Option<_>>()?;
    Some(Peer { name, levels })
}

impl PeerRun {
    fn largest_error(&self, lab: &Lab, cells: &[Cell], truths: &[Truth]) -> Option<f64> {
        let mut largest = 0.0_f64;
        for (cell, truths) in cells.iter().zip(truths.chunks(truths.len() / cells.len())) {
            let values = self.values.get(&lab.world.scene.sensors[cell.sensor].id)?;
            for (channel, truth) in truths.iter().enumerate() {
                largest = largest.max(truth.relative_error(*values.get(channel.min(values.len().checked_sub(1)?))?));
            }
        }
        Some(largest)
    }
}
