//! Files whose last 16 bytes are a hash of all bytes before them.

use std::{
    fs::File,
    io::{self, Read, Write},
    path::{Path, PathBuf},
};

use xxhash_rust::xxh3::Xxh3;

use crate::map_file::{MAGIC, MapFileError};

/// The name under which a file is written before it takes its own: beside that, hidden, and of this process alone, so that
/// nothing of the user's is in its way.
pub fn partial_name(path: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.partial", std::process::id()));
    path.with_file_name(name)
}

/// A file being written and the hash of what is in it so far.
pub(crate) struct Hashing {
    file: io::BufWriter<File>,
    hash: Xxh3,
}

impl Hashing {
    /// Creates the file.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        Ok(Self { file: io::BufWriter::new(File::create_new(path)?), hash: Xxh3::new() })
    }

    pub(crate) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hash.update(bytes);
        self.file.write_all(bytes)
    }

    /// Appends the hash and makes the file safe on disk.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        let digest = self.hash.digest128().to_le_bytes();
        self.file.write_all(&digest)?;
        self.file.into_inner()?.sync_all()
    }
}

/// The contents of a map file, read in order.
pub(crate) struct Bytes {
    path: PathBuf,
    data: Vec<u8>,
    at: usize,
}

impl Bytes {
    /// The contents of a map file without its hash, which is checked.
    pub(crate) fn of(path: &Path) -> Result<Self, MapFileError> {
        let io = |cause| MapFileError::Io { path: path.into(), cause };
        // Asked before opening: to open a pipe would wait for its other end.
        if !std::fs::metadata(path).map_err(io)?.is_file() {
            return Err(MapFileError::Unusable { path: path.into(), what: "it is not a regular file".into() });
        }
        let mut file = File::open(path).map_err(io)?;
        // A foreign file is refused by its first bytes, before it is read into memory.
        let mut magic = [0; 8];
        let found = file.read(&mut magic).map_err(io)?;
        let mut bytes = Self { path: path.into(), data: magic[..found].to_vec(), at: 0 };
        if magic != *MAGIC {
            return Err(bytes.unusable("it is not a photon map of photonlab"));
        }
        file.read_to_end(&mut bytes.data).map_err(io)?;
        let Some(end) = bytes.data.len().checked_sub(16) else {
            return Err(bytes.unusable("it is cut short"));
        };
        let mut hash = Xxh3::new();
        hash.update(&bytes.data[..end]);
        if hash.digest128().to_le_bytes() != bytes.data[end..] {
            return Err(bytes.unusable("it is damaged or cut short: its checksum does not fit"));
        }
        bytes.data.truncate(end);
        Ok(bytes)
    }

    /// True if everything was read.
    pub(crate) fn is_at_end(&self) -> bool {
        self.at == self.data.len()
    }

    pub(crate) fn unusable(&self, what: &str) -> MapFileError {
        MapFileError::Unusable { path: self.path.clone(), what: what.into() }
    }

    pub(crate) fn take<const N: usize>(&mut self) -> Result<[u8; N], MapFileError> {
        let next = self.data.get(self.at..self.at + N).and_then(|bytes| bytes.try_into().ok());
        self.at += N;
        next.ok_or_else(|| self.unusable("it is cut short"))
    }

    pub(crate) fn u32(&mut self) -> Result<u32, MapFileError> {
        self.take().map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self) -> Result<u64, MapFileError> {
        self.take().map(u64::from_le_bytes)
    }

    pub(crate) fn f32(&mut self) -> Result<f32, MapFileError> {
        self.take().map(f32::from_le_bytes)
    }
}
