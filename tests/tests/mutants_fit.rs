//! The mutants still fit the source. Whether each is killed is asked by the `mutants` program, which takes minutes.

use std::{fs, path::Path};

use photonlab_tests::Mutant;

#[test]
fn every_mutant_applies_and_names_a_test_that_exists() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mutants = Mutant::all(&tests.join("mutants")).unwrap_or_else(|error| panic!("{error}"));
    assert!(mutants.len() >= 12, "{} mutants", mutants.len());
    let stale = mutants.iter().filter_map(|m| Some(format!("{}: {}", m.name, m.applies(&tests.join("..")).err()?)));
    assert_eq!(stale.collect::<Vec<_>>(), Vec::<String>::new());
    for mutant in &mutants {
        let file = tests.join("tests").join(format!("{}.rs", mutant.test_file));
        let text =
            fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {}: {error}", mutant.name, file.display()));
        let line = format!("fn {}() {{", mutant.test);
        assert!(text.contains(&line), "{}: no `{line}` in {}", mutant.name, mutant.test_file);
    }
}
