//! What every claim gets to run with, and the record it starts from.

use std::{collections::BTreeMap, path::Path, path::PathBuf, process::Command, time::Instant};

use photonlab_measure::{Budget, Comparison, FigureData, Group, ImageEntry, Record, Row, Run, Verdict};
use photonlab_paper_figures::interval_text;
use serde::de::DeserializeOwned;

use super::{claims::Claim, date::today, definition::Definition};
use crate::system;

/// A claim about to be run.
pub(super) struct Context {
    pub(super) claim: Claim,
    pub(super) budget: Budget,
    /// The catalogue's entries to be read; none means all.
    pub(super) entries: Vec<String>,
    definition: Definition,
    out: PathBuf,
    /// The tree's at the start: it may change before a long run ends.
    commit: Option<String>,
    start: Instant,
}

/// What a claim's experiment found.
#[derive(Default)]
pub(super) struct Findings {
    pub(super) seeds: Vec<u64>,
    pub(super) comparisons: Vec<Comparison>,
    pub(super) groups: Vec<Group>,
    pub(super) rows: Vec<Row>,
    pub(super) figures: Vec<FigureData>,
    pub(super) images: Vec<ImageEntry>,
}

impl Context {
    pub(super) fn new(claim: Claim, budget: Budget, entries: &[String], out: &Path) -> anyhow::Result<Self> {
        let definition = Definition::parse(claim.id(), claim.definition())?;
        let entries = entries.to_vec();
        Ok(Self { claim, budget, entries, definition, out: out.into(), commit: commit(), start: Instant::now() })
    }

    /// The claim's own parameters at this budget.
    pub(super) fn parameters<P: DeserializeOwned>(&self) -> anyhow::Result<P> {
        self.definition.parameters(self.budget)
    }

    /// What the definition says of the claim's parts, by their names.
    pub(super) fn parts<P: DeserializeOwned>(&self) -> anyhow::Result<BTreeMap<String, P>> {
        self.definition.parts()
    }

    /// A folder of this run for files that are not part of the record.
    pub(super) fn folder(&self, name: &str) -> anyhow::Result<PathBuf> {
        let path = self.out.join(name);
        crate::interrupt::make_folder(&path)?;
        Ok(path)
    }

    /// Where a picture of this claim is written, and its path relative to the record.
    pub(super) fn image(&self, name: &str) -> (PathBuf, String) {
        let relative = super::image_path(self.claim, name);
        (self.out.join("records").join(&relative), relative.to_string_lossy().into_owned())
    }

    /// The command that runs this again.
    fn command(&self) -> String {
        let entries =
            if self.entries.is_empty() { String::new() } else { format!(" --entries {}", self.entries.join(",")) };
        format!("photonlab reproduce {} --budget {}{entries}", self.claim.id(), self.budget.name())
    }

    /// The record of what was found.
    pub(super) fn record(&self, found: Findings, verdict: Verdict, reason: impl Into<String>) -> Record {
        let d = &self.definition;
        let date = today();
        let commit = self.commit.clone();
        let short = commit.as_deref().map_or("no-commit", |c| &c[..c.len().min(10)]).to_string();
        Record {
            claim: self.claim.id().into(),
            title: d.title.clone(),
            statement: d.statement.clone(),
            question: d.question.clone(),
            formula: d.formula.clone(),
            expectation: d.expectation.clone(),
            expectation_reason: d.expectation_reason.clone(),
            refuted_if: d.refuted_if.clone(),
            budget: self.budget,
            run: Run {
                id: format!("{}-{}-{date}-{short}", self.claim.id(), self.budget.name()),
                commit,
                command: self.command(),
                processor: system::processor(),
                threads: system::threads(),
                date,
                seconds: self.start.elapsed().as_secs_f64(),
            },
            seeds: found.seeds,
            rows: found.rows,
            groups: found.groups,
            figures: found.figures,
            images: found.images,
            reason: with_what_failed(reason.into(), verdict, &found.comparisons),
            comparisons: found.comparisons,
            verdict,
        }
    }
}

/// A verdict against a claim names the comparisons that it rests on.
fn with_what_failed(reason: String, verdict: Verdict, comparisons: &[Comparison]) -> String {
    let failed = comparisons.iter().filter(|c| c.holds == Some(false));
    let words: Vec<String> = failed
        .filter_map(|c| {
            let measured = c.measured?;
            Some(format!(
                "{} is {} where {} was expected",
                c.label,
                interval_text(measured.value, measured.low, measured.high),
                interval_text(c.expected.value, c.expected.low, c.expected.high)
            ))
        })
        .collect();
    match (verdict, words.is_empty()) {
        (Verdict::DoesNotHold, false) => format!("{reason}; {}", words.join("; ")),
        _ => reason,
    }
}

/// The commit of the checkout that this program was built in, if the program still runs beside it.
fn commit() -> Option<String> {
    let output = Command::new("git").args(["-C", env!("CARGO_MANIFEST_DIR"), "rev-parse", "HEAD"]).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success() && !text.trim().is_empty()).then(|| text.trim().to_owned())
}
