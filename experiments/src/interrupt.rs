//! Ctrl-C: ends with status 130, but never in the middle of a file.

use std::sync::{Mutex, MutexGuard};

static WRITING: Mutex<()> = Mutex::new(());

/// Held while a file takes its final name; an interrupt waits for it.
pub(crate) fn writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Makes SIGINT, SIGTERM and SIGHUP end the program once no file is being written.
pub(crate) fn install() {
    // A second handler cannot be installed when `run` is called twice in one process; the first still serves.
    let _ = ctrlc::set_handler(|| {
        let _no_file_is_half_written = writing();
        std::process::exit(130);
    });
}

/// Writes a file under a temporary name in the same folder and renames it, so that it is whole or absent.
pub(crate) fn write_whole(path: &std::path::Path, bytes: &[u8]) -> anyhow::Result<()> {
    use anyhow::Context;
    let _guard = writing();
    // A link keeps pointing where it did: the file behind it is replaced.
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.into());
    let path = target.as_path();
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let partial = std::path::PathBuf::from(partial);
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    written.with_context(|| {
        let _ = std::fs::remove_file(&partial);
        format!("cannot write {}", path.display())
    })
}
