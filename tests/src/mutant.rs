//! Mutants: one-line changes of the production source that a named test must notice.
//!
//! A file under `tests/mutants/` reads
//!
//! ```text
//! What is wrong, in a sentence.
//! kills: TEST-FILE TEST-NAME
//! --- path/of/the/source.rs
//! - a line as it stands there, without its indentation
//! + what the mutant has in its place
//! ```
//!
//! with more pairs of lines, and more files, if one change needs them. The old line must occur exactly once.

use std::{fmt, fs, path::Path};

/// A change and the test that must notice it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The file's name without its extension.
    pub name: String,
    /// What is wrong with it.
    pub what: String,
    /// The integration test's file, without its extension.
    pub test_file: String,
    /// The test in it.
    pub test: String,
    changes: Vec<Change>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Change {
    file: String,
    old: String,
    new: String,
}

/// Why a mutant cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MutantError {
    /// Its file is not of the form above.
    Malformed(String),
    /// The source has the old line not once.
    Stale {
        /// The source.
        file: String,
        /// The line.
        line: String,
        /// How often it is there.
        times: usize,
    },
    /// The source cannot be read or written.
    Io(String),
}

impl fmt::Display for MutantError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MutantError::Malformed(what) => write!(f, "malformed: {what}"),
            MutantError::Stale { file, line, times } => {
                write!(f, "stale: {file} has the line `{line}` {times} times, not once; bring the mutant up to date")
            }
            MutantError::Io(what) => f.write_str(what),
        }
    }
}

impl Mutant {
    /// All mutants of a folder, by name.
    pub fn all(folder: &Path) -> Result<Vec<Self>, MutantError> {
        let io = |error: std::io::Error| MutantError::Io(format!("{}: {error}", folder.display()));
        let mut mutants = Vec::new();
        for entry in fs::read_dir(folder).map_err(io)? {
            let path = entry.map_err(io)?.path();
            if path.extension().is_some_and(|extension| extension == "patch") {
                let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                mutants.push(Self::parse(&name, &fs::read_to_string(&path).map_err(io)?)?);
            }
        }
        mutants.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(mutants)
    }

    /// Reads one.
    pub fn parse(name: &str, text: &str) -> Result<Self, MutantError> {
        let malformed = |what: &str| MutantError::Malformed(format!("{name}: {what}"));
        let mut lines = text.lines().filter(|line| !line.trim().is_empty());
        let what = lines.next().ok_or_else(|| malformed("empty"))?.to_string();
        let kills =
            lines.next().and_then(|line| line.strip_prefix("kills: ")).ok_or_else(|| malformed("no `kills:`"))?;
        let (test_file, test) = kills.split_once(' ').ok_or_else(|| malformed("`kills:` needs a file and a test"))?;
        let mut changes = Vec::new();
        let mut file = None;
        let mut old = None;
        for line in lines {
            if let Some(path) = line.strip_prefix("--- ") {
                file = Some(path.trim().to_string());
            } else if let Some(line) = line.strip_prefix("- ") {
                old = Some(line.trim().to_string());
            } else if let (Some(line), Some(file), Some(old)) = (line.strip_prefix('+'), &file, old.take()) {
                changes.push(Change { file: file.clone(), old, new: line.trim().to_string() });
            } else {
                return Err(malformed(&format!("the line `{line}` is out of place")));
            }
        }
        if changes.is_empty() || old.is_some() {
            return Err(malformed("no whole pair of `-` and `+` lines"));
        }
        let (test_file, test) = (test_file.to_string(), test.to_string());
        Ok(Self { name: name.into(), what, test_file, test, changes })
    }

    /// True if the change can be made to the tree at `root`.
    pub fn applies(&self, root: &Path) -> Result<(), MutantError> {
        self.changed(root).map(|_| ())
    }

    /// Changes the tree at `root` and returns what undoes it: each file with its text before.
    pub fn apply(&self, root: &Path) -> Result<Vec<(String, String)>, MutantError> {
        let io = |file: &str, error: std::io::Error| MutantError::Io(format!("{file}: {error}"));
        let mut before = Vec::new();
        for (file, text) in self.changed(root)? {
            let path = root.join(&file);
            before.push((file.clone(), fs::read_to_string(&path).map_err(|error| io(&file, error))?));
            fs::write(&path, text).map_err(|error| io(&file, error))?;
        }
        Ok(before)
    }

    fn changed(&self, root: &Path) -> Result<Vec<(String, String)>, MutantError> {
        let mut texts: Vec<(String, String)> = Vec::new();
        for change in &self.changes {
            if !texts.iter().any(|(file, _)| *file == change.file) {
                let text = fs::read_to_string(root.join(&change.file));
                let text = text.map_err(|error| MutantError::Io(format!("{}: {error}", change.file)))?;
                texts.push((change.file.clone(), text));
            }
            let (_, text) = texts.iter_mut().find(|(file, _)| *file == change.file).expect("just added");
            *text = change.made_in(text)?;
        }
        Ok(texts)
    }
}

impl Change {
    fn made_in(&self, text: &str) -> Result<String, MutantError> {
        let times = text.lines().filter(|line| line.trim() == self.old).count();
        if times != 1 {
            return Err(MutantError::Stale { file: self.file.clone(), line: self.old.clone(), times });
        }
        let lines = text.lines().map(|line| match line.trim() == self.old {
            true => line.replace(&self.old, &self.new),
            false => line.to_string(),
        });
        Ok(lines.collect::<Vec<_>>().join("\n") + "\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "A half too little.\nkills: laws the_law\n--- a.rs\n- x * 2.0\n+ x\n";

    #[test]
    fn a_mutant_changes_one_line_and_keeps_its_indentation() {
        let folder = tempfile::tempdir().unwrap();
        let source = folder.path().join("a.rs");
        fs::write(&source, "fn f() {\n    x * 2.0\n}\n").unwrap();
        let mutant = Mutant::parse("half", TEXT).unwrap();
        assert_eq!((mutant.test_file.as_str(), mutant.test.as_str()), ("laws", "the_law"));
        let before = mutant.apply(folder.path()).unwrap();
        assert_eq!(fs::read_to_string(&source).unwrap(), "fn f() {\n    x\n}\n");
        assert_eq!(before, [("a.rs".to_string(), "fn f() {\n    x * 2.0\n}\n".to_string())]);
        assert!(matches!(mutant.applies(folder.path()), Err(MutantError::Stale { times: 0, .. })));
    }

    #[test]
    fn what_is_malformed_is_refused() {
        for wrong in
            ["", "What.\n", "What.\nkills: laws t\n", "What.\nkills: laws t\n+ x\n", "W.\nkills: l t\n--- a\n- x\n"]
        {
            assert!(matches!(Mutant::parse("wrong", wrong), Err(MutantError::Malformed(_))), "{wrong:?}");
        }
    }
}
