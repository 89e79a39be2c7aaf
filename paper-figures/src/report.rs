//! All claims on one page.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment};
use photonlab_measure::{ImageEntry, Record};

use crate::page::Page;
use crate::{Chapter, ReportError};

/// A record and the bytes of its pictures, by their paths in the record.
#[derive(Clone, Debug)]
pub struct ReportEntry<'a> {
    /// The record.
    pub record: &'a Record,
    /// PNG or JPEG files; every picture of the record must be here.
    pub images: BTreeMap<String, Vec<u8>>,
}

impl<'a> ReportEntry<'a> {
    /// Reads the record's pictures from its folder.
    pub fn load(record: &'a Record, folder: &Path) -> Result<Self, ReportError> {
        let read = |image: &ImageEntry| {
            let path = folder.join(&image.path);
            match std::fs::read(&path) {
                Ok(bytes) => Ok((image.path.clone(), bytes)),
                Err(source) => Err(ReportError::Read { path, source }),
            }
        };
        Ok(ReportEntry { record, images: record.images.iter().map(read).collect::<Result<_, _>>()? })
    }
}

/// One self-contained HTML page: a summary, then claim by claim what was expected, measured and concluded, in the order
/// of the entries, and chapters behind them. No scripts, nothing from outside; failures stand beside passes.
pub fn report(entries: &[ReportEntry<'_>], chapters: &[Chapter<'_>]) -> Result<String, ReportError> {
    let mut seen = BTreeSet::new();
    if let Some(twice) = entries.iter().find(|e| !seen.insert(e.record.claim.as_str())) {
        return Err(ReportError::Twice { claim: twice.record.claim.clone() });
    }
    if let Some(twice) = chapters.iter().find(|chapter| chapter.id == "top" || !seen.insert(chapter.id)) {
        return Err(ReportError::Twice { claim: twice.id.to_string() });
    }
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build()?);
    Ok(environment.render_str(include_str!("report.html"), Serde(Page::new(entries, chapters)?))?)
}
