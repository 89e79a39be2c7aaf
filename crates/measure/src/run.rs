//! When, where and how an experiment was run.

use serde::{Deserialize, Serialize};

/// How long an experiment may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Budget {
    /// At most three minutes for all claims.
    Quick,
    /// At most two hours on two cores.
    Paper,
    /// At most twelve hours, resumable.
    Archive,
}

impl Budget {
    /// Its name at the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Budget::Quick => "quick",
            Budget::Paper => "paper",
            Budget::Archive => "archive",
        }
    }
}

/// When, where and by which command a record was made; never the machine's name or paths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// The run's name.
    pub id: String,
    /// The commit of the source; null outside a checkout.
    pub commit: Option<String>,
    /// The command that repeats it.
    pub command: String,
    /// The processor's model.
    pub processor: String,
    /// Threads used.
    pub threads: u32,
    /// Day of the run, YYYY-MM-DD.
    pub date: String,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// True for YYYY-MM-DD with a month and a day that may exist.
pub(crate) fn is_date(text: &str) -> bool {
    let bytes = text.as_bytes();
    let number = |range: std::ops::Range<usize>| text.get(range).and_then(|digits| digits.parse::<u32>().ok());
    bytes.len() == 10
        && bytes.iter().enumerate().all(|(i, b)| if i == 4 || i == 7 { *b == b'-' } else { b.is_ascii_digit() })
        && number(5..7).is_some_and(|month| (1..=12).contains(&month))
        && number(8..10).is_some_and(|day| (1..=31).contains(&day))
}
