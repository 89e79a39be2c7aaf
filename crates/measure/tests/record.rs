//! Records are written and read by the same code, whole or not at all.

use std::fs;
use std::path::PathBuf;

use photonlab_measure::{
    Axis, Budget, Comparison, Expected, FigureData, Group, ImageEntry, Interval, Point, Record, RecordError, Row, Run,
    Series, SeriesKind, Verdict, json_number,
};

fn example() -> Record {
    let measured = Interval::around(0.2502, 0.0011, 0.95);
    Record {
        claim: "sphere-area".into(),
        title: "Divide by the sphere's surface".into(),
        statement: "divide the gathered flux by the area of the sphere's surface".into(),
        question: "What does the estimate read on a uniform plane?".into(),
        formula: "E = flux / (4 pi r^2)".into(),
        expectation: "1/4 of the truth".into(),
        expectation_reason: "a plane cuts the sphere in a disc of area pi r^2".into(),
        refuted_if: "the ratio's interval misses 1/4".into(),
        budget: Budget::Quick,
        run: Run {
            id: "sphere-area-quick-1".into(),
            commit: None,
            command: "photonlab reproduce sphere-area".into(),
            processor: "an invented processor".into(),
            threads: 2,
            date: "2026-11-23".into(),
            seconds: 3.5,
        },
        seeds: vec![1, u64::MAX],
        comparisons: vec![Comparison::judge("ratio to truth", "1", Expected::exact(0.25, "A4"), Some(measured))],
        groups: vec![Group { title: "spheres".into(), summary: "all agree".into(), comparisons: 1 }],
        rows: vec![Row::from([("seed".into(), 1.into()), ("ratio".into(), json_number("ratio", 0.2502).unwrap())])],
        figures: vec![FigureData {
            id: "ratio".into(),
            title: "Ratio to truth".into(),
            caption: "One quarter at every radius.".into(),
            x: Axis::log("radius / m"),
            y: Axis::linear("ratio"),
            series: vec![Series {
                label: "sphere".into(),
                kind: SeriesKind::Measured,
                points: vec![Point::measured(0.05, measured), Point::new(0.1, 0.25)],
            }],
        }],
        images: vec![ImageEntry { title: "plane".into(), path: "images/plane.png".into(), caption: "Even.".into() }],
        verdict: Verdict::DoesNotHold,
        reason: "taken literally it reads a quarter of the truth".into(),
    }
}

/// A fresh folder of this test, removed with it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("photonlab-record-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_record_comes_back_as_it_was() {
    let folder = Folder::new("round-trip");
    let path = folder.0.join("sphere-area.json");
    fs::write(&path, "an earlier run").unwrap();
    example().save(&path).unwrap();
    assert_eq!(Record::load(&path).unwrap(), example());
    assert!(fs::read_to_string(&path).unwrap().contains("\"does not hold\""));
    assert_eq!(fs::read_dir(&folder.0).unwrap().count(), 1, "a draft was left behind");
}

#[test]
fn a_refused_record_leaves_the_old_file() {
    let folder = Folder::new("refused");
    let path = folder.0.join("old.json");
    example().save(&path).unwrap();
    let mut bad = example();
    bad.figures[0].series[0].points[1].y = f64::NAN;
    let refused = bad.save(&path).unwrap_err();
    assert!(refused.to_string().contains("figures[0].series[0].points[1].y is NaN"), "{refused}");
    assert_eq!(Record::load(&path).unwrap(), example());
}

#[test]
fn what_is_wrong_is_named() {
    let wrong = |change: fn(&mut Record)| {
        let mut record = example();
        change(&mut record);
        match record.check() {
            Err(RecordError::Wrong { field, .. }) => field,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(wrong(|r| r.run.date = "23 Nov 2026".into()), "run.date");
    assert_eq!(wrong(|r| r.run.date = "2026-13-01".into()), "run.date");
    assert_eq!(wrong(|r| r.figures.push(r.figures[0].clone())), "figures");
    assert_eq!(wrong(|r| r.images[0].path = "/tmp/x.png".into()), "images");
    assert_eq!(wrong(|r| r.comparisons[0].expected.low = 0.3), "comparisons[0].expected");
    assert_eq!(wrong(|r| r.comparisons[0].measured.as_mut().unwrap().high = 0.0), "comparisons[0].measured");
}

#[test]
fn a_file_that_is_no_record_says_where() {
    let folder = Folder::new("broken");
    let path = folder.0.join("broken.json");
    let missing = Record::load(&path).unwrap_err();
    assert!(matches!(missing, RecordError::Read { .. }));

    let text = serde_json::to_string_pretty(&example()).unwrap();
    fs::write(&path, text.replacen("\"question\"", "\"qestion\"", 1)).unwrap();
    let typo = Record::load(&path).unwrap_err().to_string();
    assert!(typo.contains("broken.json") && typo.contains("qestion") && typo.contains("line"), "{typo}");
    fs::write(&path, text.replacen("\"does not hold\"", "\"fails\"", 1)).unwrap();
    assert!(Record::load(&path).unwrap_err().to_string().contains("unknown variant `fails`"));
}

#[test]
fn a_missing_folder_is_a_clear_error() {
    let folder = Folder::new("nowhere");
    let error = example().save(&folder.0.join("no/such/record.json")).unwrap_err();
    assert!(matches!(error, RecordError::Write { .. }) && error.to_string().contains("record.json"));
}
