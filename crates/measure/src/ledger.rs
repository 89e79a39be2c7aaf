//! Where the flux went.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::finite::{NotFinite, finite};

/// Five accounts of flux (W or lm), each a list in the order of the channels.
///
/// emitted + roulette = absorbed + escaped + cut_off: roulette is its gain minus its loss.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FluxBook {
    /// Sent out by the lamps.
    pub emitted: Vec<f64>,
    /// Absorbed by surfaces and media.
    pub absorbed: Vec<f64>,
    /// Left the scene.
    pub escaped: Vec<f64>,
    /// Ended by a limit on path length.
    pub cut_off: Vec<f64>,
    /// Gained minus lost by Russian roulette; zero on average.
    pub roulette: Vec<f64>,
}

impl FluxBook {
    pub(crate) fn check(&self, at: &str) -> Result<(), NotFinite> {
        let accounts = [
            ("emitted", &self.emitted),
            ("absorbed", &self.absorbed),
            ("escaped", &self.escaped),
            ("cut_off", &self.cut_off),
            ("roulette", &self.roulette),
        ];
        for (name, account) in accounts {
            for (channel, &flux) in account.iter().enumerate() {
                finite(at, &format!("{name}[{channel}]"), flux)?;
            }
        }
        Ok(())
    }
}

/// The books of a whole run, and of each path class where they are kept apart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FluxLedger {
    /// All paths together.
    #[serde(flatten)]
    pub total: FluxBook,
    /// By the name of the path class (`PathClass::name`); left out of the JSON if empty.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub classes: BTreeMap<String, FluxBook>,
}

impl FluxLedger {
    pub(crate) fn check(&self, at: &str) -> Result<(), NotFinite> {
        self.total.check(at)?;
        self.classes.iter().try_for_each(|(class, book)| book.check(&format!("{at}.classes.{class}")))
    }
}
