//! An object being read: its parameters are asked for by name, and what nobody asked for is an error.

use std::collections::HashMap;

use glam::{DAffine3, DVec3};

use photonlab_photometry::Spectrum;

use super::colour::colour;
use super::element::Element;
use super::error::SceneError;
use super::names::{nearest_first, quote};
use super::number::{self, Range};
use super::tag::Kind;
use super::transform::{three, to_world};

/// An object, its plugin's name and its children not read so far.
pub(super) struct Object<'e> {
    pub(super) element: &'e Element,
    pub(super) plugin: &'e str,
    unread: Vec<&'e Element>,
    accepted: Vec<&'static str>,
}

impl<'e> Object<'e> {
    /// Starts on `element`, after checking that no parameter is given twice.
    pub(super) fn open(element: &'e Element) -> Result<Self, SceneError> {
        let mut seen: HashMap<&str, u32> = HashMap::new();
        for child in &element.children {
            let Some(name) = child.attribute("name") else {
                continue;
            };
            if let Some(first) = seen.insert(name, child.place.line) {
                let what = format!("{} is given twice, first on line {first}", quote(name));
                return Err(child.error(what, "remove one of them"));
            }
        }
        let unread = element.children.iter().collect();
        Ok(Object { element, plugin: element.required("type"), unread, accepted: Vec::new() })
    }

    /// The property of this name if it is there; its element must be one of `tags`.
    pub(super) fn take(&mut self, name: &'static str, tags: &[&str]) -> Result<Option<&'e Element>, SceneError> {
        self.accepted.push(name);
        let is_it = |child: &&Element| child.attribute("name") == Some(name);
        let Some(found) = self.unread.iter().position(is_it) else {
            return Ok(None);
        };
        let child = self.unread.remove(found);
        if tags.contains(&child.tag.name) {
            return Ok(Some(child));
        }
        let wanted = tags.join(" or ");
        Err(child.error(format!("{name} of {} is no {}", self.plugin, child.tag.name), format!("make it {wanted}")))
    }

    /// A value of this name, parsed from its element.
    fn value<T>(
        &mut self,
        name: &'static str,
        tags: &[&str],
        parse: impl FnOnce(&Element) -> Result<T, SceneError>,
    ) -> Result<Option<T>, SceneError> {
        self.take(name, tags)?.map(parse).transpose()
    }

    /// A number; `integer` serves too, as in Mitsuba.
    pub(super) fn float(&mut self, name: &'static str, range: Range) -> Result<Option<f64>, SceneError> {
        self.value(name, &["float", "integer"], |child| {
            let number = number::float(child.required("value")).and_then(|number| range.check(number));
            number.map_err(|fault| child.value_fault(fault))
        })
    }

    /// A whole number.
    pub(super) fn integer(&mut self, name: &'static str) -> Result<Option<i64>, SceneError> {
        self.value(name, &["integer"], |child| {
            number::integer(child.required("value")).map_err(|f| child.value_fault(f))
        })
    }

    /// True or false.
    pub(super) fn boolean(&mut self, name: &'static str) -> Result<Option<bool>, SceneError> {
        self.value(name, &["boolean"], |child| {
            number::boolean(child.required("value")).map_err(|f| child.value_fault(f))
        })
    }

    /// A word.
    pub(super) fn string(&mut self, name: &'static str) -> Result<Option<&'e str>, SceneError> {
        Ok(self.take(name, &["string"])?.map(|child| child.required("value")))
    }

    /// A word out of `choices`.
    pub(super) fn choice(&mut self, name: &'static str, choices: &[&str]) -> Result<Option<&'e str>, SceneError> {
        let Some(child) = self.take(name, &["string"])? else {
            return Ok(None);
        };
        let value = child.required("value");
        if choices.contains(&value) {
            return Ok(Some(value));
        }
        let known = nearest_first(value, choices.iter().copied());
        Err(child.error(format!("{} is no {name}", quote(value)), format!("use one of {known}")))
    }

    /// A point or vector, three numbers each in `range`.
    pub(super) fn vector(&mut self, name: &'static str, range: Range) -> Result<Option<DVec3>, SceneError> {
        self.value(name, &["point", "vector"], |child| {
            let vector = three(child, None).and_then(|vector| {
                vector.to_array().into_iter().try_for_each(|number| range.check(number).map(drop)).map(|()| vector)
            });
            vector.map_err(|fault| child.value_fault(fault))
        })
    }

    /// A point or vector, or the element of this name with one of `tags`.
    pub(super) fn vector_or(
        &mut self,
        name: &'static str,
        tags: &[&str],
        range: Range,
    ) -> Result<Option<Result<DVec3, &'e Element>>, SceneError> {
        let is_it = |child: &&&Element| child.attribute("name") == Some(name) && tags.contains(&child.tag.name);
        if self.unread.iter().any(|child| is_it(&child)) {
            return Ok(self.take(name, tags)?.map(Err));
        }
        Ok(self.vector(name, range)?.map(Ok))
    }

    /// A colour, each channel in `range`.
    pub(super) fn colour(&mut self, name: &'static str, range: Range) -> Result<Option<Spectrum>, SceneError> {
        self.value(name, &["rgb", "spectrum", "float"], |child| colour(child, range))
    }

    /// The transform `to_world`.
    pub(super) fn transform(&mut self) -> Result<Option<DAffine3>, SceneError> {
        self.value("to_world", &["transform"], to_world)
    }

    /// Child objects whose tag is one of `tags`, in the order of the file.
    pub(super) fn objects(&mut self, tags: &[&'static str]) -> Vec<&'e Element> {
        self.accepted.extend(tags);
        let taken = self.unread.extract_if(.., |child| tags.contains(&child.tag.name));
        taken.collect()
    }

    /// The only child object of this tag, if there is one.
    pub(super) fn single(&mut self, tags: &[&'static str]) -> Result<Option<&'e Element>, SceneError> {
        let found = self.objects(tags);
        match found.get(1) {
            Some(second) => {
                let what = format!("a second {} in one {}", tags[0], self.element.tag.name);
                Err(second.error(what, "keep one of them"))
            }
            None => Ok(found.first().copied()),
        }
    }

    /// Ends the reading: anything not asked for is an error, a known one if its name is among `later`.
    pub(super) fn close(self, later: &[&str]) -> Result<(), SceneError> {
        let Some(child) = self.unread.first() else {
            return Ok(());
        };
        let label = child.label();
        let plugin = if self.plugin.is_empty() { self.element.tag.name } else { self.plugin };
        if later.contains(&label) {
            return Err(child.error(format!("{label} of {plugin} is known but not built yet"), "take it out for now"));
        }
        let kind = if child.tag.kind == Kind::Object { "child" } else { "parameter" };
        let known = nearest_first(label, self.accepted.iter().copied());
        Err(child.error(format!("unknown {kind} {} of {plugin}", quote(label)), format!("it takes {known}")))
    }
}
