//! The elements of the format: what each is, and which attributes it takes.

use super::element::Element;
use super::error::Fault;
use super::names::{nearest_first, quote};

/// What part an element plays; decides what may stand inside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A thing with a `type`: holds objects, properties, transforms and directives.
    Object,
    /// A named value.
    Property,
    /// A named list of [`Kind::Step`]s.
    Transform,
    /// One step of a transform.
    Step,
    /// `default` and `include`: done with while loading.
    Directive,
    /// Known in Mitsuba and promised here, but not built yet.
    Later,
}

/// One kind of element.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Tag {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) required: &'static [&'static str],
    pub(super) optional: &'static [&'static str],
}

const fn tag(
    name: &'static str,
    kind: Kind,
    required: &'static [&'static str],
    optional: &'static [&'static str],
) -> Tag {
    Tag { name, kind, required, optional }
}

const fn object(name: &'static str) -> Tag {
    tag(name, Kind::Object, &["type"], &["id", "name"])
}

const fn property(name: &'static str) -> Tag {
    tag(name, Kind::Property, &["name", "value"], &[])
}

/// Every element that Mitsuba 3 knows.
static TAGS: [Tag; 31] = [
    tag("scene", Kind::Object, &[], &["version", "id", "name"]),
    object("integrator"),
    object("sensor"),
    object("sampler"),
    object("film"),
    object("rfilter"),
    object("shape"),
    object("bsdf"),
    object("emitter"),
    tag("ref", Kind::Object, &["id"], &["name"]),
    tag("default", Kind::Directive, &["name", "value"], &[]),
    tag("include", Kind::Directive, &["filename"], &[]),
    property("boolean"),
    property("integer"),
    property("float"),
    property("string"),
    property("rgb"),
    tag("spectrum", Kind::Property, &["name"], &["value", "filename", "type", "id"]),
    tag("point", Kind::Property, &["name"], &["value", "x", "y", "z"]),
    tag("vector", Kind::Property, &["name"], &["value", "x", "y", "z"]),
    tag("transform", Kind::Transform, &["name"], &[]),
    tag("translate", Kind::Step, &[], &["value", "x", "y", "z"]),
    tag("scale", Kind::Step, &[], &["value", "x", "y", "z"]),
    tag("rotate", Kind::Step, &["angle"], &["value", "x", "y", "z"]),
    tag("lookat", Kind::Step, &["origin", "target"], &["up"]),
    tag("matrix", Kind::Step, &["value"], &[]),
    tag("texture", Kind::Later, &[], &[]),
    object("medium"),
    object("phase"),
    tag("volume", Kind::Later, &[], &[]),
    tag("alias", Kind::Later, &[], &[]),
];

impl Tag {
    /// The tag of this name, or why there is none.
    pub(super) fn find(name: &str) -> Result<&'static Tag, Fault> {
        if name == "path" {
            return Err(Fault::new(
                "search paths are not built yet",
                "give file names relative to the file that names them",
            ));
        }
        let Some(found) = TAGS.iter().find(|tag| tag.name == name) else {
            let known = nearest_first(name, TAGS.iter().filter(|tag| tag.kind != Kind::Later).map(|tag| tag.name));
            return Err(Fault::new(format!("unknown element {}", quote(name)), format!("use one of {known}")));
        };
        if found.kind == Kind::Later {
            return Err(Fault::new(format!("{name} is known but not built yet"), "take it out of the scene for now"));
        }
        Ok(found)
    }

    /// The attribute's name as this tag spells it, or why it has none.
    pub(super) fn attribute(&self, name: &str) -> Result<&'static str, Fault> {
        let mut accepted = self.required.iter().chain(self.optional).copied();
        accepted.find(|known| *known == name).ok_or_else(|| {
            let known = nearest_first(name, self.required.iter().chain(self.optional).copied());
            Fault::new(format!("unknown attribute {}", quote(name)), format!("{} takes {known}", self.name))
        })
    }

    /// Whether this may stand directly inside an element of tag `parent`.
    pub(super) fn fits_in(&self, parent: &Tag) -> Result<(), Fault> {
        let fits = match parent.kind {
            Kind::Object if parent.name == "ref" => false,
            Kind::Object => self.kind != Kind::Step && self.name != "scene",
            Kind::Transform => self.kind == Kind::Step,
            Kind::Property | Kind::Step | Kind::Directive | Kind::Later => false,
        };
        if fits {
            return Ok(());
        }
        let mend = match self.kind {
            Kind::Step => "put it into a <transform name=\"to_world\">",
            _ if self.name == "scene" => "use include, or move its contents up",
            _ => "move it out",
        };
        Err(Fault::new(format!("cannot stand inside {}", parent.name), mend))
    }

    /// Checks that nothing required is missing from `element`.
    pub(super) fn check_required(&self, element: &Element) -> Result<(), Fault> {
        match self.required.iter().find(|name| element.attribute(name).is_none()) {
            Some(name) => Err(Fault::new(format!("attribute {name} is missing"), format!("add {name}=\"...\""))),
            None => Ok(()),
        }
    }
}
