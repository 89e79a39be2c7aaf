//! Figures and the report page of finished records.

use std::path::{Path, PathBuf};

use photonlab_measure::Record;
use photonlab_paper_figures::{ReportEntry, draw, report};

use crate::interrupt::write_whole;

/// Writes every record's figures and the report beside them; returns the report's path.
pub(super) fn write(records: &[Record], out: &Path) -> anyhow::Result<PathBuf> {
    for record in records {
        for figure in &record.figures {
            let path = out.join("figures").join(format!("{}-{}.svg", record.claim, figure.id));
            write_whole(&path, draw(figure)?.as_bytes())?;
        }
    }
    let folder = out.join("records");
    let entries = records.iter().map(|record| ReportEntry::load(record, &folder)).collect::<Result<Vec<_>, _>>()?;
    let page = out.join("report.html");
    write_whole(&page, report(&entries)?.as_bytes())?;
    Ok(page)
}
