//! What texts quote of records is what the records say.

use std::{collections::BTreeMap, fs, path::Path};

use photonlab_measure::Record;
use photonlab_paper_figures::draw;

fn records() -> BTreeMap<String, Record> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../experiments/records");
    let files = fs::read_dir(folder).expect("the committed records").map(|file| file.expect("an entry").path());
    let records = files.filter(|path| path.extension().is_some_and(|e| e == "json"));
    records.map(|path| Record::load(&path).expect("a record")).map(|record| (record.claim.clone(), record)).collect()
}

/// With one space wherever there is any.
fn spaced(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What is measured stands in quotation marks behind the name of its record.
#[test]
fn published_results_stand_beside_what_the_records_say() {
    let (text, records) = (include_str!("../../experiments/PUBLISHED.md"), records());
    let mut quotes = 0;
    for entry in text.split("\n- **").skip(1) {
        let (_, measured) = entry.split_once("Measured").unwrap_or_else(|| panic!("nothing is measured: {entry}"));
        for (number, quote) in measured.split('"').enumerate().filter(|(number, _)| number % 2 == 1) {
            let before: String = measured.split('"').take(number).collect();
            let named = before.rsplit('`').skip(1).step_by(2).find_map(|name| records.get(name));
            let record = named.unwrap_or_else(|| panic!("no record is named before {quote}"));
            assert!(spaced(&record.reason).contains(&spaced(quote)), "{}: {quote}", record.claim);
            quotes += 1;
        }
    }
    assert!(quotes >= 10, "{quotes}");
}

/// Every record has a row of the README, and every row is its record's.
#[test]
fn the_readme_says_what_the_records_say() {
    let (text, records) = (include_str!("../../README.md"), records());
    let rows = text.lines().filter(|line| line.starts_with("| `"));
    // A bar of the words themselves has a backslash before it.
    let cells = |line: &str| {
        line.replace("\\|", "\0").split('|').map(|cell| cell.trim().replace('\0', "|")).collect::<Vec<_>>()
    };
    let told: BTreeMap<String, Vec<String>> =
        rows.map(cells).map(|cells| (cells[1].trim_matches('`').to_owned(), cells)).collect();
    for (claim, record) in &records {
        let cells = told.get(claim).unwrap_or_else(|| panic!("{claim} has no row"));
        assert_eq!(cells[2], record.verdict.words(), "{claim}");
        let same = |a: &str, b: &str| a.to_lowercase().trim_end_matches('.') == b.to_lowercase().trim_end_matches('.');
        assert!(same(&spaced(&cells[3]), &spaced(&record.reason)), "{claim}: {}\n{}", cells[3], record.reason);
        assert_eq!(cells[5], record.budget.name(), "{claim}");
        for link in cells[4].split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            // Of very many the folder alone is named.
            if link == "paper-figures/figures" {
                continue;
            }
            if let Some(picture) = link.strip_prefix("experiments/records/") {
                assert!(record.images.iter().any(|image| image.path == picture), "{claim}: {link}");
                continue;
            }
            let drawing = link.strip_prefix("paper-figures/figures/").and_then(|name| name.strip_suffix(".svg"));
            let id = drawing.and_then(|name| name.strip_prefix(claim)?.strip_prefix('-'));
            assert!(record.figures.iter().any(|figure| Some(figure.id.as_str()) == id), "{claim}: {link}");
        }
    }
    let rows: Vec<&String> =
        told.keys().filter(|name| name.contains(|c: char| c.is_ascii_lowercase()) && told[*name].len() == 7).collect();
    assert_eq!(rows, records.keys().collect::<Vec<_>>(), "rows of no record");
}

/// The committed drawings are their records', and no other lies about.
#[test]
fn the_figures_are_the_records() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("figures");
    let mut drawn = BTreeMap::new();
    for record in records().values() {
        for figure in &record.figures {
            drawn.insert(format!("{}-{}.svg", record.claim, figure.id), draw(figure).expect("a figure"));
        }
    }
    for (name, svg) in &drawn {
        let committed = fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(committed == *svg, "{name} is not what its record says");
    }
    for file in fs::read_dir(&folder).expect("the committed figures") {
        let name = file.expect("an entry").file_name().into_string().expect("a plain name");
        assert!(drawn.contains_key(&name) || !name.ends_with(".svg"), "{name} is of no record");
    }
}
