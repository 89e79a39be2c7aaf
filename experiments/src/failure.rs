//! How a command fails: status 2 for wrong usage or a wrong scene, 1 for what went wrong while running.

use std::process::ExitCode;

/// Why a command has no result.
#[derive(Debug)]
pub enum Failure {
    /// Wrong options or a wrong scene; the user mends it.
    Usage(String),
    /// Failed while running.
    Running(anyhow::Error),
}

impl Failure {
    /// Wrong usage, in words that say what to do.
    pub fn usage(what: impl Into<String>) -> Self {
        Failure::Usage(what.into())
    }

    /// The exit status of the contract.
    pub fn status(&self) -> ExitCode {
        match self {
            Failure::Usage(_) => ExitCode::from(2),
            Failure::Running(_) => ExitCode::from(1),
        }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::Usage(what) => f.write_str(what),
            Failure::Running(error) => write!(f, "{error:#}"),
        }
    }
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Failure::Running(error.into())
    }
}
