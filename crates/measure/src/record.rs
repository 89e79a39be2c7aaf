//! What an experiment leaves behind: question, expectation, every replicate, verdict.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::finite::{NotFinite, finite};
use crate::run::is_date;
use crate::{Budget, Comparison, FigureData, Group, ImageEntry, Run, Verdict, replace_file};

/// One row of a record: every replicate has one, failures too. Build numbers with [`json_number`](crate::json_number).
pub type Row = BTreeMap<String, Value>;

/// One claim, put to the test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// The claim's id, its name everywhere.
    pub claim: String,
    /// A short headline.
    pub title: String,
    /// What the paper says.
    pub statement: String,
    /// What is asked.
    pub question: String,
    /// The formula, as plain text.
    pub formula: String,
    /// What is expected.
    pub expectation: String,
    /// Why it is expected.
    pub expectation_reason: String,
    /// What would refute it.
    pub refuted_if: String,
    /// The budget it was run with.
    pub budget: Budget,
    /// When, where and how it was run.
    pub run: Run,
    /// The seeds, in the order of the replicates.
    pub seeds: Vec<u64>,
    /// Expected against measured.
    pub comparisons: Vec<Comparison>,
    /// The comparisons in groups, where there are many: none, or groups that hold all of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<Group>,
    /// Every replicate's row.
    pub rows: Vec<Row>,
    /// The numbers of its figures.
    pub figures: Vec<FigureData>,
    /// Its pictures.
    pub images: Vec<ImageEntry>,
    /// What is concluded.
    pub verdict: Verdict,
    /// Why.
    pub reason: String,
}

/// Why a record was not written or read.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// A number that JSON cannot hold.
    #[error("record {claim}: {source}")]
    NotFinite {
        /// The record's claim.
        claim: String,
        /// The number and its field.
        source: NotFinite,
    },
    /// A field is not what it says it is.
    #[error("record {claim}: {field}: {what}")]
    Wrong {
        /// The record's claim.
        claim: String,
        /// The field.
        field: String,
        /// What is wrong with it.
        what: String,
    },
    /// The file could not be written; nothing is left half written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file is not a record; line and column are in the reason.
    #[error("{} is not a record: {source}", path.display())]
    Parse {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        source: serde_json::Error,
    },
}

impl Record {
    /// Writes the record as JSON, a line for each entry of its lists, to a file of its own beside `path` first, which then takes its place.
    ///
    /// The folder must exist. Refuses what [`Record::check`] refuses.
    pub fn save(&self, path: &Path) -> Result<(), RecordError> {
        self.check()?;
        let text = crate::lines::to_lines(self).expect("strings, numbers and lists have a JSON form");
        replace_file(path, &text).map_err(|source| RecordError::Write { path: path.to_owned(), source })
    }

    /// Reads a record and checks it; an unknown or missing field is an error.
    pub fn load(path: &Path) -> Result<Self, RecordError> {
        let text = fs::read_to_string(path).map_err(|source| RecordError::Read { path: path.to_owned(), source })?;
        let record: Record =
            serde_json::from_str(&text).map_err(|source| RecordError::Parse { path: path.to_owned(), source })?;
        record.check()?;
        Ok(record)
    }

    /// Refuses numbers that are not finite, intervals out of order, a date that is none, figure ids used twice and
    /// image paths that leave the record's folder, and groups that do not hold all comparisons.
    pub fn check(&self) -> Result<(), RecordError> {
        self.check_numbers().map_err(|source| RecordError::NotFinite { claim: self.claim.clone(), source })?;
        self.check_intervals()?;
        if !is_date(&self.run.date) {
            return Err(self.wrong("run.date", format!("{:?} is not YYYY-MM-DD", self.run.date)));
        }
        let grouped: usize = self.groups.iter().map(|group| group.comparisons).sum();
        if !self.groups.is_empty() && grouped != self.comparisons.len() {
            return Err(
                self.wrong("groups", format!("{grouped} of {} comparisons are in them", self.comparisons.len()))
            );
        }
        let mut seen = BTreeSet::new();
        if let Some(twice) = self.figures.iter().find(|f| !seen.insert(&f.id)) {
            return Err(self.wrong("figures", format!("the id {:?} is used twice", twice.id)));
        }
        let outside = |path: &str| path.starts_with('/') || path.split('/').any(|part| part == "..");
        match self.images.iter().find(|image| outside(&image.path)) {
            Some(image) => Err(self.wrong("images", format!("{:?} leaves the record's folder", image.path))),
            None => Ok(()),
        }
    }

    fn check_numbers(&self) -> Result<(), NotFinite> {
        finite("run", "seconds", self.run.seconds)?;
        for (i, comparison) in self.comparisons.iter().enumerate() {
            comparison.check(&format!("comparisons[{i}]"))?;
        }
        for (i, figure) in self.figures.iter().enumerate() {
            figure.check(&format!("figures[{i}]"))?;
        }
        Ok(())
    }

    fn check_intervals(&self) -> Result<(), RecordError> {
        for (i, comparison) in self.comparisons.iter().enumerate() {
            let (e, m) = (&comparison.expected, &comparison.measured);
            if !(e.low <= e.value && e.value <= e.high) {
                return Err(self.wrong(&format!("comparisons[{i}].expected"), "low <= value <= high fails"));
            }
            let Some(m) = m else { continue };
            if !(m.low <= m.value && m.value <= m.high) {
                return Err(self.wrong(&format!("comparisons[{i}].measured"), "low <= value <= high fails"));
            }
            if !(m.confidence > 0.0 && m.confidence < 1.0) {
                return Err(self.wrong(&format!("comparisons[{i}].measured.confidence"), "outside (0, 1)"));
            }
        }
        Ok(())
    }

    fn wrong(&self, field: &str, what: impl Into<String>) -> RecordError {
        RecordError::Wrong { claim: self.claim.clone(), field: field.to_owned(), what: what.into() }
    }
}
