//! What the machine tells about a run.

use std::fs;

/// Largest resident memory of this process in bytes, where the system tells.
pub(crate) fn peak_bytes() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// Starts the thread pool; zero threads means all cores.
pub(crate) fn start_threads(threads: Option<u32>) -> anyhow::Result<()> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0) as usize);
    // A second call in one process keeps the first pool: results do not depend on it.
    let _ = pool.build_global();
    Ok(())
}

/// Threads in use.
pub(crate) fn threads() -> u32 {
    rayon::current_num_threads() as u32
}

/// The processor's model, never the machine's name.
pub(crate) fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, name)| name.trim()));
    format!("{} ({})", model.unwrap_or("unknown processor"), std::env::consts::ARCH)
}
