//! Processor time of this process.

use std::{fs, time::Instant};

/// What [`CpuClock`] measures, for captions.
pub(crate) const CPU_SECONDS: &str =
    "CPU seconds are the time on processors of all threads of the process (wall time where the system does not tell)";

/// Seconds to a millionth: the digits below are no measurement, and records are long.
pub(crate) fn microseconds(seconds: f64) -> f64 {
    (1e6 * seconds).round() / 1e6
}

/// Runs from its start.
pub(crate) struct CpuClock {
    cpu: Option<f64>,
    wall: Instant,
}

impl CpuClock {
    pub(crate) fn start() -> Self {
        Self { cpu: on_processors(), wall: Instant::now() }
    }

    /// Seconds since the start, of all threads that live on.
    pub(crate) fn seconds(&self) -> f64 {
        match (self.cpu, on_processors()) {
            (Some(start), Some(now)) => now - start,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

/// What the scheduler booked for each living thread, in nanoseconds: finer than the process's clock ticks.
fn on_processors() -> Option<f64> {
    let threads = fs::read_dir("/proc/self/task").ok()?;
    let nanoseconds = threads.map(|thread| {
        let text = fs::read_to_string(thread.ok()?.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    });
    Some(nanoseconds.sum::<Option<f64>>()? * 1e-9)
}

#[cfg(test)]
mod tests {
    use super::CpuClock;

    /// Other tests' threads come and go and take their time with them, so this thread works until its own is seen.
    #[test]
    fn work_takes_time() {
        let begun = std::time::Instant::now();
        let mut sum = 0u64;
        loop {
            let clock = CpuClock::start();
            sum = (0..2_000_000u64).fold(sum, |sum, i| std::hint::black_box(sum ^ i));
            if clock.seconds() > 0.0 {
                return;
            }
            assert!(begun.elapsed().as_secs() < 20, "no time was booked for work ({sum})");
        }
    }
}
