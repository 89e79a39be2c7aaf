//! What is wrong with a scene file, where, and what to do about it.

use std::rc::Rc;

/// A scene that cannot be read: where, what is wrong and what to do. One line when shown.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {element}: {what}; {mend}")]
pub struct SceneError {
    /// The file as the user or the `include` called it.
    pub file: String,
    /// Line, counted from 1; the line of the element's opening bracket.
    pub line: u32,
    /// Name of the XML element.
    pub element: String,
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub mend: String,
}

/// A line of a file.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) file: Rc<str>,
    pub(super) line: u32,
}

/// What is wrong and what to do, found by code that does not know where; [`Place::error`] adds that.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) what: String,
    pub(super) mend: String,
}

impl Fault {
    pub(super) fn new(what: impl Into<String>, mend: impl Into<String>) -> Self {
        Fault { what: what.into(), mend: mend.into() }
    }
}

impl Place {
    pub(super) fn error(&self, element: &str, fault: Fault) -> SceneError {
        SceneError {
            file: self.file.to_string(),
            line: self.line,
            element: element.to_owned(),
            what: fault.what,
            mend: fault.mend,
        }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}
