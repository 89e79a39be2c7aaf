//! One parsed file, walked in order: structure checked, defaults put in, includes opened.

use std::rc::Rc;

use roxmltree::Node;

use super::element::Element;
use super::error::{Fault, Place, SceneError};
use super::load::Loader;
use super::names::quote;
use super::scan::DEPTH_LIMIT;
use super::source::Lines;
use super::tag::{Kind, Tag};
use super::version::check_version;

/// The walk over one file.
pub(super) struct Walk<'l, 't> {
    loader: &'l mut Loader,
    file: Rc<str>,
    text: &'t str,
    lines: Lines<'t>,
}

impl<'l, 't> Walk<'l, 't> {
    pub(super) fn new(loader: &'l mut Loader, file: Rc<str>, text: &'t str) -> Self {
        Walk { loader, file, text, lines: Lines::new(text.as_bytes()) }
    }

    /// Walks the file's root: of an included `scene`, only what it holds is appended to `out`.
    pub(super) fn root(
        &mut self,
        node: Node<'_, 't>,
        parent: Option<&'static Tag>,
        depth: usize,
        out: &mut Vec<Element>,
    ) -> Result<(), SceneError> {
        let Some(parent) = parent else {
            let mut root = self.open(node)?;
            if root.tag.name != "scene" {
                return Err(root.error("the root element is not scene", "wrap it in <scene version=\"3.0.0\">"));
            }
            check_version(root.attribute("version"), true).map_err(|fault| root.fault(fault))?;
            self.children(node, root.tag, 1, &mut root.children)?;
            out.push(root);
            return Ok(());
        };
        if node.tag_name().name() != "scene" {
            return self.element(node, parent, depth, out);
        }
        let root = self.open(node)?;
        check_version(root.attribute("version"), false).map_err(|fault| root.fault(fault))?;
        self.children(node, parent, depth, out)
    }

    fn children(
        &mut self,
        node: Node<'_, 't>,
        parent: &'static Tag,
        depth: usize,
        out: &mut Vec<Element>,
    ) -> Result<(), SceneError> {
        for child in node.children() {
            if child.is_element() {
                self.element(child, parent, depth, out)?;
            } else if child.is_text() && !child.text().unwrap_or_default().trim().is_empty() {
                return Err(self.stray_text(child, parent));
            }
        }
        Ok(())
    }

    fn element(
        &mut self,
        node: Node<'_, 't>,
        parent: &'static Tag,
        depth: usize,
        out: &mut Vec<Element>,
    ) -> Result<(), SceneError> {
        let mut element = self.open(node)?;
        element.tag.fits_in(parent).map_err(|fault| element.fault(fault))?;
        if depth > DEPTH_LIMIT {
            return Err(
                element.error(format!("more than {DEPTH_LIMIT} elements inside each other"), "nest less deeply")
            );
        }
        element.tag.check_required(&element).map_err(|fault| element.fault(fault))?;
        self.register(&element)?;
        self.children(node, element.tag, depth + 1, &mut element.children)?;
        match element.tag.kind {
            Kind::Directive if element.tag.name == "include" => {
                self.loader.include(element.required("filename"), &element.place, parent, depth, out)
            }
            Kind::Directive => self.define(&element),
            _ => {
                out.push(element);
                Ok(())
            }
        }
    }

    /// The element without its children.
    fn open(&mut self, node: Node<'_, 't>) -> Result<Element, SceneError> {
        let place = Place { file: self.file.clone(), line: self.lines.line_at(node.range().start) };
        let name = node.tag_name().name();
        let known_name = if name.len() <= 32 { name } else { "element" };
        let fail = |fault| place.error(known_name, fault);
        let prefixed = |prefix: Option<&str>| prefix != Some("xml");
        if node.tag_name().namespace().is_some() || node.namespaces().any(|namespace| prefixed(namespace.name())) {
            return Err(fail(Fault::new("namespaces are not part of the format", "remove xmlns and prefixes")));
        }
        let tag = Tag::find(name).map_err(fail)?;
        let mut attributes = Vec::with_capacity(node.attributes().len());
        for attribute in node.attributes() {
            if attribute.namespace().is_some() {
                return Err(fail(Fault::new("attributes take no prefix", "remove the prefix")));
            }
            let known = tag.attribute(attribute.name()).map_err(fail)?;
            attributes.push((known, self.loader.defaults.substitute(attribute.value()).map_err(fail)?));
        }
        Ok(Element { tag, place, attributes, children: Vec::new() })
    }

    /// Checks that the element's id is new and keeps it.
    fn register(&mut self, element: &Element) -> Result<(), SceneError> {
        let Some(id) = element.attribute("id").filter(|_| element.tag.name != "ref") else {
            return Ok(());
        };
        if id.is_empty() {
            return Err(element.error("the id is empty", "give it a name, or leave id out"));
        }
        if let Some((first, _)) = self.loader.ids.insert(id.to_owned(), (element.place.clone(), element.tag.name)) {
            return Err(
                element.error(format!("id {} is used twice, first at {first}", quote(id)), "rename one of them")
            );
        }
        Ok(())
    }

    fn define(&mut self, element: &Element) -> Result<(), SceneError> {
        let (name, value) = (element.required("name"), element.required("value"));
        let kept = self.loader.defaults.define(name, value).map_err(|fault| element.fault(fault))?.to_owned();
        if kept != value && !self.loader.defaults.is_given(name) {
            let note = format!("{}: default {} keeps its first value {}", element.place, quote(name), quote(&kept));
            self.loader.notes.push(note);
        }
        Ok(())
    }

    fn stray_text(&mut self, node: Node<'_, 't>, parent: &Tag) -> SceneError {
        let raw = &self.text[node.range()];
        let start = node.range().start + raw.len() - raw.trim_start().len();
        let place = Place { file: self.file.clone(), line: self.lines.line_at(start) };
        let what = format!("text {} between elements", quote(raw.trim()));
        place.error(parent.name, Fault::new(what, "remove it, or make it a comment"))
    }
}
