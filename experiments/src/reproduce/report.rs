//! Figures and the report page of finished records.

use std::path::Path;

use photonlab_measure::Record;
use photonlab_paper_figures::{Chapter, ReportEntry, draw, report};

use crate::interrupt::write_whole;

/// What stands behind the claims.
const CHAPTERS: [Chapter<'_>; 3] = [
    Chapter { id: "published", text: include_str!("../../PUBLISHED.md") },
    Chapter { id: "methodology", text: include_str!("../../METHODOLOGY.md") },
    Chapter { id: "bias", text: include_str!("../../BIAS.md") },
];

/// Writes every record's figures and the report beside them.
pub(super) fn write(records: &[Record], out: &Path) -> anyhow::Result<()> {
    for record in records {
        for figure in &record.figures {
            let path = out.join("figures").join(format!("{}-{}.svg", record.claim, figure.id));
            write_whole(&path, draw(figure)?.as_bytes())?;
        }
    }
    let folder = out.join("records");
    let entries = records.iter().map(|record| ReportEntry::load(record, &folder)).collect::<Result<Vec<_>, _>>()?;
    write_whole(&out.join("report.html"), report(&entries, &CHAPTERS)?.as_bytes())
}
