//! No output file is left half written.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Writes `bytes` to a file beside `path`, then renames it: a reader sees the old file or the new one, never a part.
///
/// The folder must exist. On an error the old file stands and nothing is left beside it.
pub fn replace_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not a file name"))?;
    let draft = path.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    let written = fs::File::create(&draft).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let replaced = written.and_then(|()| fs::rename(&draft, path));
    if replaced.is_err() {
        // The draft is of no use to anyone; the first error is the one to report.
        let _ = fs::remove_file(&draft);
    }
    replaced
}
