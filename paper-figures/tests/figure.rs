//! What a figure shows is what its numbers say.

use photonlab_measure::{Axis, FigureData, Point, Series, SeriesKind};
use photonlab_paper_figures::{FigureError, caption, draw};
use roxmltree::Document;

fn with_interval(x: f64, y: f64, low: f64, high: f64) -> Point {
    Point { x, y, low: Some(low), high: Some(high) }
}

fn figure(x: Axis, y: Axis, series: Vec<(&str, SeriesKind, Vec<Point>)>) -> FigureData {
    let series = series.into_iter().map(|(label, kind, points)| Series { label: label.into(), kind, points }).collect();
    FigureData { id: "test".into(), title: "Error & <cost>".into(), caption: "As measured.".into(), x, y, series }
}

/// The centres of all discs but the white rims, in pixels.
fn discs(document: &Document<'_>) -> Vec<(f64, f64)> {
    let number = |n: roxmltree::Node<'_, '_>, name| n.attribute(name).unwrap().parse::<f64>().unwrap() / 10.0;
    let coloured = |n: &roxmltree::Node<'_, '_>| n.has_tag_name("circle") || n.tag_name().name() == "circle";
    let inked = |n: &roxmltree::Node<'_, '_>| n.attribute("fill") != Some("#FFFFFF");
    document.descendants().filter(coloured).filter(inked).map(|n| (number(n, "cx"), number(n, "cy"))).collect()
}

fn texts(document: &Document<'_>) -> Vec<String> {
    let is_text = |n: &roxmltree::Node<'_, '_>| n.tag_name().name() == "text";
    document.descendants().filter(is_text).filter_map(|n| n.text()).map(|t| t.trim().to_owned()).collect()
}

#[test]
fn the_sheet_is_well_formed_titled_and_scales() {
    let points = vec![Point::new(1.0, 2.0), Point::new(2.0, 3.0)];
    let svg =
        draw(&figure(Axis::linear("a < b"), Axis::linear("y"), vec![("s", SeriesKind::Measured, points)])).unwrap();
    let document = Document::parse(&svg).unwrap();
    let root = document.root_element();
    assert!(root.attribute("viewBox").is_some() && root.attribute("role") == Some("img"));
    assert_eq!(root.first_element_child().unwrap().text(), Some("Error & <cost>"));
    let texts = texts(&document);
    for label in ["Error & <cost>", "a < b", "y", "s"] {
        assert!(texts.iter().any(|t| t == label), "{label} is not in {texts:?}");
    }
}

#[test]
fn equal_factors_are_equal_lengths_on_logarithmic_axes() {
    let points = vec![Point::new(1.0, 1e-3), Point::new(10.0, 1e-2), Point::new(100.0, 1e-1)];
    let svg = draw(&figure(Axis::log("x"), Axis::log("y"), vec![("s", SeriesKind::Measured, points)])).unwrap();
    let document = Document::parse(&svg).unwrap();
    let spots = discs(&document);
    // The legend's sample is the one disc that is drawn first.
    let [_, a, b, c] = spots[..] else { panic!("{spots:?}") };
    assert!((b.0 - a.0 - (c.0 - b.0)).abs() < 0.2 && b.0 > a.0, "{spots:?}");
    assert!((b.1 - a.1 - (c.1 - b.1)).abs() < 0.2 && b.1 < a.1, "{spots:?}");
}

#[test]
fn named_places_stand_apart_and_no_line_joins_them() {
    let points = || vec![Point::new(1.0, 1.0), Point::new(2.0, 2.0), Point::new(3.0, 1.0)];
    let lines = |x: Axis| {
        let svg = draw(&figure(x, Axis::linear("y"), vec![("law", SeriesKind::Predicted, points())])).unwrap();
        let document = Document::parse(&svg).unwrap();
        let labels = texts(&document).into_iter().filter(|t| ["floor", "wall", "roof"].contains(&t.as_str())).count();
        (labels, svg.matches("stroke-width=\"2").count())
    };
    let joined = lines(Axis::linear("place"));
    let apart = lines(Axis::named("place", ["floor", "wall", "roof"]));
    assert_eq!((joined.0, apart.0), (0, 3));
    assert_eq!(apart.1, joined.1 + 2, "three bars in place of one line");
}

#[test]
fn a_bar_that_crosses_zero_is_cut_and_said() {
    let cut = vec![with_interval(1.0, 0.5, -0.2, 1.2), with_interval(2.0, 0.4, 0.3, 0.5), Point::new(3.0, -0.1)];
    let log = figure(Axis::linear("x"), Axis::log("y"), vec![("s", SeriesKind::Measured, cut.clone())]);
    assert_eq!(caption(&log), "As measured. 2 intervals go on below the axis, to zero or near it: open arrows.");
    let svg = draw(&log).unwrap();
    let document = Document::parse(&svg).unwrap();
    assert!(texts(&document).iter().any(|t| t == "goes on below the axis"));
    assert_eq!(discs(&document).len(), 1 + 2, "the value below zero has no mark");

    let linear = figure(Axis::linear("x"), Axis::linear("y"), vec![("s", SeriesKind::Measured, cut)]);
    assert_eq!(caption(&linear), "As measured.");
}

#[test]
fn what_cannot_be_drawn_is_named() {
    let one = |x, y, points| draw(&figure(x, y, vec![("s", SeriesKind::Measured, points)])).unwrap_err();
    let (lin, log) = (|| Axis::linear("a"), || Axis::log("a"));
    assert!(matches!(one(lin(), lin(), vec![]), FigureError::Empty { .. }));
    assert!(matches!(one(lin(), lin(), vec![Point::new(f64::NAN, 1.0)]), FigureError::NotFinite { .. }));
    assert!(matches!(one(log(), lin(), vec![Point::new(0.0, 1.0)]), FigureError::NotOnLogAxis { .. }));
    let named = || Axis::named("a", ["one", "two"]);
    assert!(matches!(one(named(), lin(), vec![Point::new(2.6, 1.0)]), FigureError::NoSuchName { .. }));
    assert!(matches!(one(lin(), named(), vec![Point::new(1.0, 1.0)]), FigureError::NamesUpright { .. }));
    assert!(matches!(one(lin(), log(), vec![Point::new(1.0, 0.0)]), FigureError::NothingAboveZero { .. }));
}

/// A single point, equal values, huge ranges: every finite figure can be drawn, with at least two labelled ticks.
#[test]
fn odd_ranges_are_drawn() {
    for kind in [SeriesKind::Measured, SeriesKind::Predicted, SeriesKind::Reference] {
        for (x, y) in [(Axis::linear("x"), Axis::linear("y")), (Axis::log("x"), Axis::log("y"))] {
            for points in [
                vec![Point::new(5.0, 5.0)],
                vec![Point::new(1.0, 7.0), Point::new(2.0, 7.0)],
                vec![Point::new(1e-9, 1e-12), Point::new(1e9, 1e15)],
                vec![Point::new(1.0, 1.0 + 1e-9), Point::new(2.0, 1.0)],
            ] {
                let svg = draw(&figure(x.clone(), y.clone(), vec![("s", kind, points.clone())])).unwrap();
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{points:?}");
                let document = Document::parse(&svg).unwrap();
                assert!(texts(&document).len() >= 4 + 4, "{points:?}: {:?}", texts(&document));
            }
        }
    }
}
