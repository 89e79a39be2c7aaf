//! Ctrl-C: ends with status 130, but never in the middle of a file.

use std::{
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard},
};

use photonlab_readout::partial_name;

static WRITING: Mutex<()> = Mutex::new(());

/// Folders made for a run, the innermost last.
static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Makes a folder, and what leads to it; an interrupt takes away again what is empty then.
pub(crate) fn make_folder(path: &Path) -> std::io::Result<()> {
    let missing: Vec<&Path> =
        path.ancestors().take_while(|part| !part.as_os_str().is_empty() && !part.exists()).collect();
    let mut made = MADE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    made.extend(missing.into_iter().rev().map(Path::to_owned));
    std::fs::create_dir_all(path)
}

/// Takes away the folders made that nothing is in.
fn take_empty_folders_away() {
    for folder in MADE.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).iter().rev() {
        // One that is not empty stays.
        let _ = std::fs::remove_dir(folder);
    }
}

/// Held while a file takes its final name; an interrupt waits for it.
pub(crate) fn writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Makes SIGINT, SIGTERM and SIGHUP end the program once no file is being written.
pub(crate) fn install() {
    // A second handler cannot be installed when `run` is called twice in one process; the first still serves.
    let _ = ctrlc::set_handler(|| {
        let _no_file_is_half_written = writing();
        take_empty_folders_away();
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
    let partial = partial_name(path);
    let write = || {
        let mut file = std::fs::File::create_new(&partial)?;
        std::io::Write::write_all(&mut file, bytes)?;
        file.sync_all()?;
        std::fs::rename(&partial, path)
    };
    let written = write();
    written.with_context(|| {
        let _ = std::fs::remove_file(&partial);
        format!("cannot write {}", path.display())
    })
}

/// Fails where [`write_whole`] would, as far as that can be known before there is anything to write.
pub(crate) fn try_writing(path: &Path) -> anyhow::Result<()> {
    use anyhow::Context;
    let _guard = writing();
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.into());
    let partial = partial_name(&target);
    let tried = std::fs::File::create_new(&partial).and_then(|_| std::fs::remove_file(&partial));
    tried.with_context(|| format!("cannot write {}", path.display()))
}
