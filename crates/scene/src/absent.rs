//! Why a file that a scene names cannot be one.

use std::path::Path;

/// What a path is that is no plain file.
pub(crate) fn absent(path: &Path) -> &'static str {
    match (path.is_dir(), path.exists()) {
        (true, _) => "is a folder",
        (_, true) => "is no plain file",
        _ => "is not there",
    }
}
