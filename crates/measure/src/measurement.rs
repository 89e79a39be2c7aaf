//! The answer of `photonlab measure --json`.

use serde::{Deserialize, Serialize};

use crate::finite::{NotFinite, finite};
use crate::{FluxLedger, Reading};

/// What ended a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stopped {
    /// The wanted error was reached.
    Target,
    /// The time limit was reached.
    Time,
    /// The count of photons, passes or samples was reached.
    Count,
}

/// Something the scene needs (channels, a map, a dimension), with the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Need {
    /// What is needed.
    pub need: String,
    /// What in the scene asks for it.
    pub reason: String,
}

/// The one object that `measure --json` writes; fields and order of `measure.schema.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// The scene's file as given.
    pub scene: String,
    /// The method used, never `auto`.
    pub method: String,
    /// The fixed command that gives these bits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// The seed.
    pub seed: u64,
    /// Threads used; no result depends on it.
    pub threads: u32,
    /// Emitted paths in all.
    pub photons: u64,
    /// Wall time in seconds.
    pub seconds: f64,
    /// Largest memory in use, in bytes; null where the system does not tell.
    pub peak_bytes: Option<u64>,
    /// What ended the run.
    pub stopped: Stopped,
    /// `["Y"]` or `["R", "G", "B"]`.
    pub channels: Vec<String>,
    /// What the scene needs and why.
    pub needs: Vec<Need>,
    /// Where the flux went.
    pub ledger: FluxLedger,
    /// One per sensor, cell and channel.
    pub readings: Vec<Reading>,
}

impl Measurement {
    /// The JSON text, indented, with a newline at its end; refuses numbers that JSON cannot hold.
    pub fn to_json(&self) -> Result<String, NotFinite> {
        finite("", "seconds", self.seconds)?;
        self.ledger.check("ledger")?;
        for (i, reading) in self.readings.iter().enumerate() {
            reading.check(&format!("readings[{i}]"))?;
        }
        let text = serde_json::to_string_pretty(self).expect("strings, numbers and lists have a JSON form");
        Ok(text + "\n")
    }
}
