//! Comparisons that belong together.

use serde::{Deserialize, Serialize};

/// A run of a record's comparisons under a heading, or a heading alone for what was not compared.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// What they have in common.
    pub title: String,
    /// What they came to, or why there are none.
    pub summary: String,
    /// How many of the record's comparisons, after those of the groups before it.
    pub comparisons: usize,
}
