//! One XML element with its attributes after substitution, its children, and where it came from.

use super::error::{Fault, Place, SceneError};
use super::tag::Tag;

/// An element whose tag and attribute names are known to be Mitsuba's.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) tag: &'static Tag,
    pub(super) place: Place,
    pub(super) attributes: Vec<(&'static str, String)>,
    pub(super) children: Vec<Element>,
}

impl Element {
    /// The attribute's value, if it is there.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| *known == name).map(|(_, value)| value.as_str())
    }

    /// The value of an attribute that the tag requires; empty if the tag does not.
    pub(super) fn required(&self, name: &str) -> &str {
        self.attribute(name).unwrap_or_default()
    }

    /// What to call it in a message: its name if it has one, else its tag.
    pub(super) fn label(&self) -> &str {
        self.attribute("name").unwrap_or(self.tag.name)
    }

    /// An error about this element.
    pub(super) fn error(&self, what: impl Into<String>, mend: impl Into<String>) -> SceneError {
        self.fault(Fault::new(what, mend))
    }

    /// The same from a [`Fault`].
    pub(super) fn fault(&self, fault: Fault) -> SceneError {
        self.place.error(self.tag.name, fault)
    }

    /// The same for the value of a named property: the name goes before what is wrong.
    pub(super) fn value_fault(&self, fault: Fault) -> SceneError {
        self.error(format!("{} {}", self.label(), fault.what), fault.mend)
    }
}
