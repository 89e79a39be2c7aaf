//! What the page shows of each record, ready to be written.

use photonlab_measure::{Comparison, FigureData, Group, ImageEntry, Record, Verdict};
use serde::Serialize;

use crate::chapter::{Chapter, ChapterPage};
use crate::data_uri::data_uri;
use crate::number::{interval_text, plain_text};
use crate::{FigureError, ReportEntry, ReportError, caption, draw};

/// The whole page.
#[derive(Serialize)]
pub(crate) struct Page<'a> {
    tally: Vec<Tally>,
    claims: Vec<Claim<'a>>,
    chapters: Vec<ChapterPage<'a>>,
}

impl<'a> Page<'a> {
    /// Draws every figure, rounds every number and turns every picture into text.
    pub(crate) fn new(entries: &[ReportEntry<'a>], chapters: &[Chapter<'a>]) -> Result<Self, ReportError> {
        let tally = Verdict::ALL.iter().filter_map(|&verdict| {
            let count = entries.iter().filter(|e| e.record.verdict == verdict).count();
            (count > 0).then(|| Tally { verdict: Badge::of(verdict), count })
        });
        let claims = entries.iter().map(Claim::new).collect::<Result<_, _>>()?;
        let chapters = chapters.iter().map(ChapterPage::new).collect();
        Ok(Page { tally: tally.collect(), claims, chapters })
    }
}

/// How many claims have a verdict.
#[derive(Serialize)]
struct Tally {
    verdict: Badge,
    count: usize,
}

/// A verdict's word, sign and style: never colour alone.
#[derive(Serialize)]
struct Badge {
    words: &'static str,
    sign: &'static str,
    class: &'static str,
}

impl Badge {
    fn of(verdict: Verdict) -> Self {
        let (sign, class) = match verdict {
            Verdict::Holds => ("✓", "holds"),
            Verdict::HoldsWithinLimits => ("◐", "limits"),
            Verdict::DoesNotHold => ("✗", "fails"),
            Verdict::NotCertifiable => ("?", "open"),
            Verdict::NotMeasured => ("–", "open"),
        };
        Badge { words: verdict.words(), sign, class }
    }
}

/// A record as the page shows it.
#[derive(Serialize)]
struct Claim<'a> {
    anchor: String,
    record: &'a Record,
    budget: &'static str,
    seeds: String,
    rows: usize,
    seconds: String,
    verdict: Badge,
    agreement: String,
    tables: Vec<Table<'a>>,
    figures: Vec<Drawing>,
    images: Vec<Picture<'a>>,
}

impl<'a> Claim<'a> {
    fn new(entry: &ReportEntry<'a>) -> Result<Self, ReportError> {
        let record = entry.record;
        let anchor: String = record.claim.chars().map(|c| if c.is_whitespace() { '-' } else { c }).collect();
        let drawn = |figure| Drawing::new(figure, &anchor);
        let figures = record.figures.iter().map(drawn).collect::<Result<_, _>>();
        Ok(Claim {
            budget: record.budget.name(),
            seeds: seeds_text(&record.seeds),
            rows: record.rows.len(),
            seconds: plain_text((record.run.seconds * 10.0).round() / 10.0),
            verdict: Badge::of(record.verdict),
            agreement: agreement(&record.comparisons),
            tables: Table::of(record),
            figures: figures.map_err(|source| ReportError::Figure { claim: record.claim.clone(), source })?,
            images: record.images.iter().map(|i| Picture::new(i, entry)).collect::<Result<_, _>>()?,
            anchor,
            record,
        })
    }
}

/// Comparisons under a heading of their own, to be folded, or all of a record's without one.
#[derive(Serialize)]
struct Table<'a> {
    heading: Option<&'a Group>,
    agreement: String,
    class: &'static str,
    lines: Vec<Line<'a>>,
}

impl<'a> Table<'a> {
    fn of(record: &'a Record) -> Vec<Self> {
        let mut rest = record.comparisons.as_slice();
        let mut tables: Vec<_> = record
            .groups
            .iter()
            .map(|group| {
                let (own, others) = rest.split_at(group.comparisons.min(rest.len()));
                rest = others;
                Table::new(Some(group), own)
            })
            .collect();
        if !rest.is_empty() {
            tables.push(Table::new(None, rest));
        }
        tables
    }

    fn new(heading: Option<&'a Group>, comparisons: &'a [Comparison]) -> Self {
        let fails = comparisons.iter().any(|c| c.holds == Some(false));
        Table {
            heading,
            agreement: agreement(comparisons),
            class: if fails { "fails" } else { "holds" },
            lines: comparisons.iter().map(Line::new).collect(),
        }
    }
}

/// A comparison, its numbers rounded to their uncertainty.
#[derive(Serialize)]
struct Line<'a> {
    label: &'a str,
    unit: String,
    expected: String,
    source: &'a str,
    measured: Option<String>,
    confidence: String,
    agrees: &'static str,
    class: &'static str,
    note: Option<&'a str>,
}

impl<'a> Line<'a> {
    fn new(comparison: &'a Comparison) -> Self {
        let (expected, measured) = (&comparison.expected, comparison.measured);
        let (agrees, class) = match comparison.holds {
            Some(true) => ("✓ yes", "holds"),
            Some(false) => ("✗ no", "fails"),
            None => ("– not judged", "open"),
        };
        Line {
            label: &comparison.label,
            unit: if comparison.unit == "1" { String::new() } else { comparison.unit.replace("^2", "²") },
            expected: interval_text(expected.value, expected.low, expected.high),
            source: &expected.source,
            measured: measured.map(|m| interval_text(m.value, m.low, m.high)),
            confidence: measured.map_or(String::new(), |m| format!("{} %", plain_text(m.confidence * 100.0))),
            agrees,
            class,
            note: comparison.note.as_deref(),
        }
    }
}

/// A figure, drawn.
#[derive(Serialize)]
struct Drawing {
    anchor: String,
    svg: String,
    caption: String,
}

impl Drawing {
    fn new(figure: &FigureData, claim: &str) -> Result<Self, FigureError> {
        // Inside HTML the name space goes without saying.
        let svg = draw(figure)?.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
        let id: String = figure.id.chars().map(|c| if c.is_whitespace() { '-' } else { c }).collect();
        Ok(Drawing { anchor: format!("{claim}--{id}"), svg, caption: caption(figure) })
    }
}

/// A picture with its bytes.
#[derive(Serialize)]
struct Picture<'a> {
    entry: &'a ImageEntry,
    uri: String,
}

impl<'a> Picture<'a> {
    fn new(entry: &'a ImageEntry, from: &ReportEntry<'a>) -> Result<Self, ReportError> {
        let (claim, path) = (|| from.record.claim.clone(), || entry.path.clone());
        let Some(bytes) = from.images.get(&entry.path) else {
            return Err(ReportError::MissingImage { claim: claim(), path: path() });
        };
        match data_uri(bytes) {
            Some(uri) => Ok(Picture { entry, uri }),
            None => Err(ReportError::UnknownImage { claim: claim(), path: path() }),
        }
    }
}

/// How many of the judged comparisons agree.
fn agreement(comparisons: &[Comparison]) -> String {
    let judged = comparisons.iter().filter(|c| c.holds.is_some()).count();
    let agree = comparisons.iter().filter(|c| c.holds == Some(true)).count();
    match judged {
        0 => "none judged".to_owned(),
        _ => format!("{agree} of {judged}"),
    }
}

/// A run of seeds by its ends, a few one by one.
fn seeds_text(seeds: &[u64]) -> String {
    let list = |seeds: &[u64]| seeds.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
    match seeds {
        [] => "none".to_owned(),
        [first, .., last]
            if seeds.len() > 2 && seeds.windows(2).all(|pair| pair[0].checked_add(1) == Some(pair[1])) =>
        {
            format!("{first} to {last}")
        }
        _ if seeds.len() <= 12 => list(seeds),
        _ => format!("{}, … ({} in all; the record lists them)", list(&seeds[..6]), seeds.len()),
    }
}
