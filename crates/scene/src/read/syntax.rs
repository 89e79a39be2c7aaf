//! What to say of a text that is not XML.

use super::error::Fault;
use super::source::Lines;

/// Line and fault of a text that is not XML.
pub(super) fn syntax(error: &roxmltree::Error, text: &str) -> (u32, Fault) {
    use roxmltree::Error::{NoRootNode, UnclosedRootNode, UnexpectedEndOfStream};
    if matches!(error, UnclosedRootNode | UnexpectedEndOfStream) {
        let fault = Fault::new("the file ends inside an element", "close every element; the file may be cut off");
        return (Lines::new(text.as_bytes()).last_line(), fault);
    }
    if matches!(error, NoRootNode) {
        return (1, nothing());
    }
    let said = error.to_string();
    let said = said.split(" at ").next().unwrap_or(&said);
    let what = format!("not XML at column {}: {}", error.pos().col, said.escape_debug());
    (error.pos().row, Fault::new(what, "correct the syntax there"))
}

/// The fault of a file without any element.
pub(super) fn nothing() -> Fault {
    Fault::new("the file holds no element", "start it with <scene version=\"3.0.0\">")
}
