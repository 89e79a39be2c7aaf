//! What a command takes that reads and ends.

use std::{fs, path::Path, process::Command, time::Instant};

use anyhow::Context as _;

/// Commands are repeated until they have taken so many seconds together, for the system tells the time of a process that has ended in
/// hundredths.
const LONG: f64 = 2.0;
/// Clock ticks of a second in what Linux tells programs.
const TICKS: f64 = 100.0;

/// Of one command, on one thread.
pub(super) struct Spent {
    /// CPU seconds, mean over its repetitions.
    pub(super) seconds: f64,
    /// Largest resident memory of any repetition, where the system tells. Within one process the allocator keeps what earlier pictures have
    /// freed, in pieces, and that would be told as a pass's need.
    pub(super) bytes: Option<u64>,
}

impl Spent {
    /// Of a final gather in a scene with independent photons and points of a cell.
    pub(super) fn reading(scene: &Path, photons: u64, samples: u64, seed: u64) -> anyhow::Result<Self> {
        // This program as it runs, whatever a build has put in its place since.
        let itself = Path::new("/proc/self/exe");
        let program = if itself.exists() { itself.to_path_buf() } else { std::env::current_exe()? };
        let (mut seconds, mut bytes, mut times) = (0.0, None, 0.0);
        while seconds < LONG {
            let (before, clock) = (of_ended_children(), Instant::now());
            let ended = Command::new(&program)
                .arg("measure")
                .arg(scene)
                .args(["--json", "--method", "final-gather", "--draws", "independent", "--threads", "1"])
                .args(["--photons", &photons.to_string(), "--spp", &samples.to_string(), "--seed", &seed.to_string()])
                .output()?;
            let wall = clock.elapsed().as_secs_f64();
            seconds += before.zip(of_ended_children()).map_or(wall, |(before, now)| now - before);
            times += 1.0;
            let told = serde_json::from_slice::<serde_json::Value>(&ended.stdout)
                .with_context(|| format!("the command's reading: {}", String::from_utf8_lossy(&ended.stderr).trim()))?;
            bytes = bytes.max(told["peak_bytes"].as_u64());
        }
        Ok(Self { seconds: seconds / times, bytes })
    }
}

/// CPU seconds of all processes that this one has started and that have ended.
fn of_ended_children() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name, which may hold anything, the times of children in user and system mode are the 14th and 15th.
    let mut behind = text.rsplit_once(')')?.1.split_whitespace().skip(13);
    let mut ticks = || behind.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_that_works_takes_time() {
        let before = of_ended_children().expect("Linux");
        let work = "i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done";
        let ended = Command::new("sh").args(["-c", work]).status().expect("a shell");
        assert!(ended.success() && of_ended_children().expect("Linux") > before);
    }
}
