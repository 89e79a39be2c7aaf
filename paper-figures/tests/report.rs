//! A report of invented records: complete, self-contained, well formed.

use std::collections::BTreeMap;

use photonlab_measure::{
    Axis, Budget, Comparison, Expected, FigureData, Group, ImageEntry, Interval, Point, Record, Run, Series,
    SeriesKind, Verdict,
};
use photonlab_paper_figures::{Chapter, ReportEntry, ReportError, report};

/// The start of a PNG file; enough to be known as one.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

fn record(claim: &str, verdict: Verdict) -> Record {
    let measured = Interval::around(0.2502, 0.0011, 0.95);
    Record {
        claim: claim.into(),
        title: format!("An invented record of <{claim}>"),
        statement: "divide by the area of the sphere's surface".into(),
        question: "What does it read on a uniform plane?".into(),
        formula: "E = flux / (4 pi r^2) & nothing else".into(),
        expectation: "One quarter.".into(),
        expectation_reason: "a plane cuts the sphere in a disc".into(),
        refuted_if: "the interval misses 1/4".into(),
        budget: Budget::Quick,
        run: Run {
            id: format!("{claim}-quick-1"),
            commit: Some("0123456789abcdef0123456789abcdef01234567".into()),
            command: format!("photonlab reproduce {claim} --budget quick"),
            processor: "an invented processor".into(),
            threads: 2,
            date: "2026-11-23".into(),
            seconds: 3.46,
        },
        seeds: (1..=16).collect(),
        comparisons: vec![
            Comparison::judge("ratio to truth", "1", Expected::exact(0.25, "A4"), Some(measured)),
            Comparison::judge("illuminance", "lx", Expected::within(700.0, 20.0, "D4"), Some(measured))
                .with_note("far"),
            Comparison::judge("another", "lx", Expected::exact(1.0, "D4"), None),
        ],
        groups: vec![],
        rows: vec![],
        figures: vec![figure("ratio"), figure("noise")],
        images: vec![ImageEntry { title: "Plane".into(), path: "plane.png".into(), caption: "Even.".into() }],
        verdict,
        reason: "it reads a quarter of the truth".into(),
    }
}

fn figure(id: &str) -> FigureData {
    FigureData {
        id: id.into(),
        title: format!("Figure {id}"),
        caption: format!("Caption of {id}."),
        x: Axis::log("radius / m"),
        y: Axis::linear("ratio"),
        series: vec![Series {
            label: "sphere".into(),
            kind: SeriesKind::Measured,
            points: vec![Point::new(0.05, 0.25), Point::new(0.1, 0.25)],
        }],
    }
}

fn page(records: &[Record]) -> String {
    let images = BTreeMap::from([("plane.png".to_owned(), PNG.to_vec())]);
    let entries: Vec<_> = records.iter().map(|record| ReportEntry { record, images: images.clone() }).collect();
    report(&entries, &[]).unwrap()
}

#[test]
fn the_page_is_self_contained_and_well_formed() {
    let page = page(&[record("sphere-area", Verdict::Holds), record("knn-bias", Verdict::DoesNotHold)]);
    for outside in ["http:", "https:", "//cdn", "<script", "<link", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(&page, options).unwrap();
    let attribute = |name| document.descendants().filter_map(move |n| n.attribute(name));
    for source in attribute("src").chain(attribute("href")) {
        assert!(source.starts_with("data:") || source.starts_with('#'), "{source}");
    }
    let mut ids: Vec<&str> = attribute("id").collect();
    for target in attribute("href") {
        assert!(ids.contains(&&target[1..]), "{target} leads nowhere");
    }
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{ids:?}");
    assert!(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">") && page.contains("width=device-width"));
}

#[test]
fn every_figure_and_picture_stands_once() {
    let page = page(&[record("sphere-area", Verdict::Holds), record("knn-bias", Verdict::DoesNotHold)]);
    for claim in ["sphere-area", "knn-bias"] {
        for figure in ["ratio", "noise"] {
            assert_eq!(page.matches(&format!("id=\"{claim}--{figure}\"")).count(), 1);
        }
        assert_eq!(page.matches(&format!("<code>{claim}-quick-1</code>")).count(), 1);
    }
    assert_eq!(page.matches("<svg").count(), 4);
    assert_eq!(page.matches("Caption of noise.").count(), 2);
    assert_eq!(page.matches("src=\"data:image&#x2f;png;base64,").count(), 2);
}

#[test]
fn every_verdict_is_in_words_and_failures_stand_beside_passes() {
    let claims = ["a", "b", "c", "d", "e"];
    let records: Vec<_> = claims.iter().zip(Verdict::ALL).map(|(claim, verdict)| record(claim, verdict)).collect();
    let page = page(&records);
    for verdict in Verdict::ALL {
        // In the tally, in the table and at the claim.
        assert_eq!(page.matches(&format!("</span> {}</span>", verdict.words())).count(), 3, "{verdict}");
    }
    assert!(page.find("id=\"b\"").unwrap() < page.find("id=\"c\"").unwrap());
}

#[test]
fn numbers_are_rounded_and_text_is_escaped() {
    let page = page(&[record("sphere-area", Verdict::Holds)]);
    for text in ["0.2502 ± 0.0011", "700 ± 20</span> lx", "95 % interval", "1 of 2", "1 to 16", "not measured", "✗ no"]
    {
        assert!(page.contains(text), "{text}");
    }
    assert!(page.contains("&lt;sphere-area&gt;") && page.contains("4 pi r^2) &amp; nothing"));
}

/// Every comparison stands in its group, whose heading says what failed; a group without any is a line.
#[test]
fn groups_fold_their_comparisons() {
    let mut grouped = record("catalogue", Verdict::DoesNotHold);
    grouped.comparisons[1].holds = Some(false);
    let group = |title: &str, comparisons| Group { title: title.into(), summary: format!("on {title}"), comparisons };
    grouped.groups = vec![group("C1", 1), group("D1", 2), group("G5", 0)];
    let page = page(&[grouped]);
    assert_eq!(page.matches("<details").count(), 2);
    let parts: Vec<&str> = page.split("<details").collect();
    assert!(parts[1].contains("1 of 1 agree") && parts[1].contains("ratio to truth") && !parts[1].contains("another"));
    assert!(parts[2].contains("fails\">0 of 1 agree") && parts[2].contains("illuminance"));
    assert!(parts[2].contains("another") && parts[2].split("</details>").nth(1).unwrap().contains("on G5"));
}

#[test]
fn what_is_missing_is_an_error() {
    let one = record("one", Verdict::Holds);
    let bare = ReportEntry { record: &one, images: BTreeMap::new() };
    assert!(matches!(report(std::slice::from_ref(&bare), &[]), Err(ReportError::MissingImage { .. })));
    let odd = ReportEntry { record: &one, images: BTreeMap::from([("plane.png".into(), b"GIF89a".to_vec())]) };
    assert!(matches!(report(&[odd], &[]), Err(ReportError::UnknownImage { .. })));
    assert!(matches!(report(&[bare.clone(), bare], &[]), Err(ReportError::Twice { .. })));
    assert!(matches!(ReportEntry::load(&one, std::path::Path::new("nowhere")), Err(ReportError::Read { .. })));

    let mut empty = record("two", Verdict::Holds);
    empty.images.clear();
    empty.figures[0].series.clear();
    let entry = ReportEntry { record: &empty, images: BTreeMap::new() };
    assert!(matches!(report(&[entry], &[]), Err(ReportError::Figure { .. })));
}

/// Chapters stand behind the claims, named in the head; what is written in them is text.
#[test]
fn chapters_stand_behind_the_claims() {
    let one = record("a", Verdict::Holds);
    let bare = ReportEntry { record: &one, images: BTreeMap::from([("plane.png".to_owned(), PNG.to_vec())]) };
    let text = "# Method\n\n<script>alert(1)</script>\n\nSee [a file](file.md).";
    let chapter = |id| Chapter { id, text };
    let page = report(std::slice::from_ref(&bare), &[chapter("method")]).unwrap();
    assert!(page.contains("<a href=\"#method\">Method</a>") && page.contains("<section id=\"method\">"), "{page}");
    assert!(!page.contains("<script>") && !page.contains("file.md"));
    for id in ["a", "top"] {
        assert!(matches!(report(std::slice::from_ref(&bare), &[chapter(id)]), Err(ReportError::Twice { .. })));
    }
}
