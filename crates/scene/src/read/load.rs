//! From files to one tree of elements, within stated limits.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use roxmltree::{Document, ParsingOptions};

use super::defaults::Defaults;
use super::element::Element;
use super::error::{Fault, Place, SceneError};
use super::scan::{Refusal, check_count, scan};
use super::source::{BYTE_LIMIT, Lines, read_text};
use super::syntax::{nothing, syntax};
use super::tag::Tag;
use super::walk::Walk;

/// Deepest chain of includes, as in Mitsuba.
const INCLUDE_LIMIT: usize = 15;
/// Most files that a scene includes, each time counted.
const INCLUDE_COUNT_LIMIT: usize = 4096;

/// A whole scene as a tree.
pub(super) struct Loaded {
    pub(super) root: Element,
    /// Every id of the scene: where its element is and that element's tag.
    pub(super) ids: HashMap<String, (Place, &'static str)>,
    pub(super) notes: Vec<String>,
}

/// A file being read.
struct OpenFile {
    /// The path by which it was opened; what it includes is beside it.
    path: PathBuf,
    /// The same for every path to this file.
    identity: PathBuf,
}

/// What is carried from file to file while loading.
pub(super) struct Loader {
    start: Place,
    pub(super) defaults: Defaults,
    pub(super) ids: HashMap<String, (Place, &'static str)>,
    pub(super) notes: Vec<String>,
    /// The files being read, each included by the one before; empty if the scene is text without a file.
    open: Vec<OpenFile>,
    bytes_left: u64,
    markup: usize,
    included: usize,
}

impl Loader {
    /// For the scene called `name` in errors, with the caller's defines.
    pub(super) fn new(name: &str, defines: &[(String, String)]) -> Result<Self, SceneError> {
        let start = Place { file: Rc::from(name), line: 1 };
        let defaults = Defaults::new(defines).map_err(|fault| start.error("default", fault))?;
        let (ids, notes, open) = (HashMap::new(), Vec::new(), Vec::new());
        Ok(Loader { start, defaults, ids, notes, open, bytes_left: BYTE_LIMIT, markup: 0, included: 0 })
    }

    /// Loads the scene at `path`.
    pub(super) fn load_file(mut self, path: &Path) -> Result<Loaded, SceneError> {
        let mut roots = Vec::new();
        let start = self.start.clone();
        self.file(path, &start, "scene", &mut |loader, text| loader.document(text, &start.file, None, 0, &mut roots))?;
        self.finish(roots)
    }

    /// Loads a scene from its text.
    pub(super) fn load_text(mut self, text: &str, name: &str) -> Result<Loaded, SceneError> {
        let mut roots = Vec::new();
        self.document(text, &Rc::from(name), None, 0, &mut roots)?;
        self.finish(roots)
    }

    /// Reads what `include` at `place` names and appends its elements to `out`.
    pub(super) fn include(
        &mut self,
        filename: &str,
        place: &Place,
        parent: &'static Tag,
        depth: usize,
        out: &mut Vec<Element>,
    ) -> Result<(), SceneError> {
        let refuse = |what: &str, mend: &str| Err(place.error("include", Fault::new(what, mend)));
        let Some(open) = self.open.last() else {
            return refuse("a scene given as text cannot include files", "put the file's contents here");
        };
        let path = open.path.with_file_name("").join(filename);
        if self.open.len() > INCLUDE_LIMIT {
            return refuse(&format!("more than {INCLUDE_LIMIT} files include each other"), "include less deeply");
        }
        self.included += 1;
        if self.included > INCLUDE_COUNT_LIMIT {
            return refuse(&format!("more than {INCLUDE_COUNT_LIMIT} includes in one scene"), "use fewer");
        }
        let name: Rc<str> = Rc::from(path.display().to_string());
        self.file(&path, place, "include", &mut |loader, text| loader.document(text, &name, Some(parent), depth, out))
    }

    /// Reads one file and hands its text to `then`, with the file marked as open meanwhile.
    fn file(
        &mut self,
        path: &Path,
        place: &Place,
        element: &str,
        then: &mut dyn FnMut(&mut Loader, &str) -> Result<(), SceneError>,
    ) -> Result<(), SceneError> {
        let name = format!("{:?}", path.display().to_string());
        let about = |fault: Fault| place.error(element, Fault::new(format!("{name} {}", fault.what), fault.mend));
        let text = read_text(path, self.bytes_left).map_err(|(line, fault)| match line {
            Some(line) => Place { file: Rc::from(path.display().to_string()), line }.error(element, fault),
            None => about(fault),
        })?;
        self.bytes_left -= text.len() as u64;
        let identity = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        if self.open.iter().any(|open| open.identity == identity) {
            return Err(about(Fault::new("includes itself, directly or through others", "break the circle")));
        }
        let path = path.to_owned();
        self.open.push(OpenFile { path, identity });
        then(self, &text)?;
        self.open.pop();
        Ok(())
    }

    /// Parses one file's text and appends its elements to `out`: the root of the scene, or what an include stands for.
    fn document(
        &mut self,
        text: &str,
        file: &Rc<str>,
        parent: Option<&'static Tag>,
        depth: usize,
        out: &mut Vec<Element>,
    ) -> Result<(), SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let at = |line: u32, fault: Fault| Place { file: file.clone(), line }.error("scene", fault);
        let refused = |Refusal { offset, fault }| at(Lines::new(text.as_bytes()).line_at(offset), fault);
        self.markup += scan(text).map_err(refused)?;
        check_count(self.markup).map_err(|fault| at(1, fault))?;
        if text.trim().is_empty() {
            return Err(at(1, nothing()));
        }
        let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
        let document = Document::parse_with_options(text, options).map_err(|error| {
            let (line, fault) = syntax(&error, text);
            at(line, fault)
        })?;
        Walk::new(self, file.clone(), text).root(document.root_element(), parent, depth, out)
    }

    /// The checks that need the whole scene.
    fn finish(self, mut roots: Vec<Element>) -> Result<Loaded, SceneError> {
        let root = roots.pop().ok_or_else(|| self.start.error("scene", nothing()))?;
        self.defaults.check_used().map_err(|fault| self.start.error("default", fault))?;
        Ok(Loaded { root, ids: self.ids, notes: self.notes })
    }
}
