//! What a claim's definition file says.

use std::collections::BTreeMap;

use anyhow::Context as _;
use photonlab_measure::Budget;
use serde::{Deserialize, de::DeserializeOwned};

/// The question of an experiment and how it is asked at each budget: `experiments/definitions/<claim>.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Definition {
    /// A short headline.
    pub(super) title: String,
    /// What the paper says.
    pub(super) statement: String,
    /// What is asked.
    pub(super) question: String,
    /// The formula in plain text.
    pub(super) formula: String,
    /// What is expected.
    pub(super) expectation: String,
    /// Why.
    pub(super) expectation_reason: String,
    /// What would refute it.
    pub(super) refuted_if: String,
    quick: toml::Table,
    paper: toml::Table,
    archive: toml::Table,
    /// What has a statement of its own within the claim, by its name.
    #[serde(default)]
    parts: toml::Table,
}

impl Definition {
    /// Parses a definition file's text.
    pub(super) fn parse(claim: &str, text: &str) -> anyhow::Result<Self> {
        toml::from_str(text).with_context(|| format!("experiments/definitions/{claim}.toml"))
    }

    /// The claim's own parameters at a budget.
    pub(super) fn parameters<P: DeserializeOwned>(&self, budget: Budget) -> anyhow::Result<P> {
        let table = match budget {
            Budget::Quick => &self.quick,
            Budget::Paper => &self.paper,
            Budget::Archive => &self.archive,
        };
        table.clone().try_into().with_context(|| format!("parameters of the {} budget", budget.name()))
    }

    /// What has a statement of its own within the claim, by its name.
    pub(super) fn parts<P: DeserializeOwned>(&self) -> anyhow::Result<BTreeMap<String, P>> {
        let parse = |(name, value): (&String, &toml::Value)| {
            let part = value.clone().try_into().with_context(|| format!("part {name}"))?;
            Ok((name.clone(), part))
        };
        self.parts.iter().map(parse).collect()
    }
}
