//! The command, run as its users run it.

use std::{
    path::{Path, PathBuf},
    process::{Command, Output},
    time::{Duration, Instant},
};

use serde_json::Value;
use tempfile::TempDir;

/// The program and a folder of its own to work in.
pub struct Program {
    executable: PathBuf,
    folder: TempDir,
}

/// What one run left.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The exit status; `None` if a signal ended it.
    pub status: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
    /// Wall time.
    pub took: Duration,
}

impl Program {
    /// The program at a path, in an empty folder.
    pub fn new(executable: &str) -> Self {
        Self { executable: executable.into(), folder: tempfile::tempdir().expect("a temporary folder") }
    }

    /// The folder that it works in.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A path in that folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// Writes a file there.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).expect("the folder can be written");
    }

    /// Reads a file there.
    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Runs it with arguments divided at spaces.
    pub fn run(&self, arguments: &str) -> Answer {
        self.answer(Command::new(&self.executable).args(arguments.split_whitespace()))
    }

    /// Runs it and returns standard output.
    ///
    /// # Panics
    /// If its status is not 0.
    pub fn succeed(&self, arguments: &str) -> String {
        self.run(arguments).success(arguments)
    }

    /// Runs `measure .. --json`.
    ///
    /// # Panics
    /// If its status is not 0 or its output is not one JSON value.
    pub fn measure(&self, arguments: &str) -> Value {
        let text = self.succeed(&format!("measure {arguments} --json"));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error} in {text}"))
    }

    /// Runs a line that names `photonlab` as a shell takes it; none on systems without `sh`.
    pub fn shell(&self, line: &str) -> Option<Answer> {
        let script = format!("photonlab() {{ \"$PHOTONLAB\" \"$@\"; }}\n{line}");
        let known = Command::new("sh").args(["-c", "true"]).output().is_ok();
        known.then(|| self.answer(Command::new("sh").args(["-c", &script]).env("PHOTONLAB", &self.executable)))
    }

    fn answer(&self, command: &mut Command) -> Answer {
        let start = Instant::now();
        let Output { status, stdout, stderr } =
            command.current_dir(self.folder()).output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Answer { status: status.code(), out: text(stdout), err: text(stderr), took: start.elapsed() }
    }
}

impl Answer {
    /// Standard output of a run that must have succeeded.
    ///
    /// # Panics
    /// If it did not.
    pub fn success(self, what: &str) -> String {
        assert_eq!(self.status, Some(0), "photonlab {what}: {}", self.err);
        self.out
    }
}
