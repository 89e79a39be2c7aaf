//! Bytes of a file, and the lines in them.

use std::fs::{File, metadata};
use std::io::Read;
use std::path::Path;

use super::error::Fault;

/// Most bytes in all files of a scene.
pub(super) const BYTE_LIMIT: u64 = 256 << 20;

/// The text of a file of at most `limit` bytes, without a byte order mark. Anything but a plain file is refused before
/// it is opened, since opening a pipe waits.
pub(super) fn read_text(path: &Path, limit: u64) -> Result<String, (Option<u32>, Fault)> {
    let whole = |fault| (None, fault);
    let unreadable = |error: std::io::Error| {
        whole(Fault::new(format!("cannot be read: {error}"), "give the path of a Mitsuba 3 XML file"))
    };
    if !metadata(path).map_err(unreadable)?.is_file() {
        return Err(whole(Fault::new("is not a plain file", "give the path of a Mitsuba 3 XML file")));
    }
    let mut bytes = Vec::new();
    File::open(path).map_err(unreadable)?.take(limit + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > limit {
        let what = format!("the scene's files hold more than {} MiB", BYTE_LIMIT >> 20);
        return Err(whole(Fault::new(what, "use a smaller scene")));
    }
    decode(bytes)
}

fn decode(bytes: Vec<u8>) -> Result<String, (Option<u32>, Fault)> {
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let line = Lines::new(error.as_bytes()).line_at(start);
        (Some(line), Fault::new("is not UTF-8 text", "save the file as UTF-8"))
    })
}

/// Line numbers of growing offsets into a text.
pub(super) struct Lines<'t> {
    bytes: &'t [u8],
    offset: usize,
    line: u32,
}

impl<'t> Lines<'t> {
    pub(super) fn new(bytes: &'t [u8]) -> Self {
        Lines { bytes, offset: 0, line: 1 }
    }

    /// The line of the byte at `offset`, counted from 1; offsets must not decrease from call to call.
    pub(super) fn line_at(&mut self, offset: usize) -> u32 {
        let end = offset.clamp(self.offset, self.bytes.len());
        let newlines = self.bytes[self.offset..end].iter().filter(|byte| **byte == b'\n').count();
        self.line = self.line.saturating_add(newlines as u32);
        self.offset = end;
        self.line
    }

    /// The line on which the text ends, trailing space aside.
    pub(super) fn last_line(mut self) -> u32 {
        self.line_at(self.bytes.trim_ascii_end().len())
    }
}
