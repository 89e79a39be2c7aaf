//! The scene itself: its parts in the order of the file.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use crate::luminaire::IntensityTable;
use crate::{Bsdf, Emitter, Scene};

use super::bsdf::bsdf;
use super::element::Element;
use super::emitter::emitter;
use super::error::{Place, SceneError};
use super::integrator::integrator;
use super::load::Loaded;
use super::lumens::keep_lumens;
use super::medium::medium;
use super::names::{nearest_first, quote};
use super::sensor::{Position, sensor};
use super::shape::shape;

/// A scene on its way.
pub(super) struct Builder<'e> {
    pub(super) scene: Scene,
    /// The bsdfs with an id that were read so far.
    pub(super) bsdfs: HashMap<&'e str, Bsdf>,
    /// The media with an id that were read so far.
    pub(super) media: HashMap<&'e str, u32>,
    /// Every id of the whole scene, where it is and of which tag.
    pub(super) ids: &'e HashMap<String, (Place, &'static str)>,
    /// Every element with an id: a `ref` may stand before what it names.
    elements: HashMap<&'e str, &'e Element>,
    /// The ids that are being read, each by a `ref` inside the one before.
    open: Vec<&'e str>,
    pub(super) integrator: Option<&'e Element>,
    /// The luminaire files that were read so far: a room hangs one many times.
    pub(super) luminaires: HashMap<PathBuf, Arc<IntensityTable>>,
    /// The portals that were read so far and the shapes that they stand in.
    pub(super) portals: Vec<(&'e Element, usize)>,
}

/// Makes the scene that the tree describes.
pub(super) fn build(loaded: Loaded) -> Result<Scene, SceneError> {
    let Loaded { root, ids, notes } = &loaded;
    let scene = Scene {
        shapes: Vec::new(),
        emitters: Vec::new(),
        sensors: Vec::new(),
        media: Vec::new(),
        max_depth: None,
        hides_lamps: false,
        notes: notes.clone(),
    };
    let mut builder = Builder {
        scene,
        bsdfs: HashMap::new(),
        media: HashMap::new(),
        ids,
        elements: HashMap::new(),
        open: Vec::new(),
        integrator: None,
        luminaires: HashMap::new(),
        portals: Vec::new(),
    };
    builder.find_ids(root);
    for element in &root.children {
        builder.part(element)?;
    }
    check_indices(root, &builder.scene)?;
    builder.check_hidden_lamps()?;
    builder.aim()?;
    keep_lumens(&mut builder.scene);
    Ok(builder.scene)
}

/// Glass must be known at every wavelength that a lamp emits.
fn check_indices(root: &Element, scene: &Scene) -> Result<(), SceneError> {
    let band = scene.band();
    for shape in &scene.shapes {
        if shape.bsdf.indices().into_iter().any(|index| !index.holds_over(band)) {
            let what = format!(
                "the index of `{}` is not known from {} to {} nm, where the lamps emit",
                shape.id, band[0], band[1]
            );
            return Err(root.error(what, "give the index over that range, or cut the lamps' spectra"));
        }
    }
    Ok(())
}

impl<'e> Builder<'e> {
    /// A camera that looks through lamps starts behind them, and would miss what a medium before them does.
    fn check_hidden_lamps(&self) -> Result<(), SceneError> {
        match self.integrator.filter(|_| self.scene.hides_lamps && !self.scene.media.is_empty()) {
            Some(element) => {
                let what = "hide_emitters in a scene with a medium is not built yet";
                Err(element.error(what, "set it to false, or take the medium out"))
            }
            None => Ok(()),
        }
    }

    fn part(&mut self, element: &'e Element) -> Result<(), SceneError> {
        match element.tag.name {
            "integrator" => integrator(element, self),
            "sensor" => sensor(element, Position::Free, self),
            "shape" => shape(element, self),
            "emitter" => emitter(element, self),
            "bsdf" => bsdf(element, self).map(drop),
            "medium" => medium(element, self).map(drop),
            "film" | "sampler" => Err(element.error(
                format!("{} outside a sensor is known but not built yet", element.tag.name),
                "put it into the sensor that uses it",
            )),
            _ => {
                let what = format!("{} cannot stand directly inside scene", quote(element.label()));
                Err(element
                    .error(what, "a scene takes bsdf, default, emitter, include, integrator, medium, sensor, shape"))
            }
        }
    }

    fn find_ids(&mut self, element: &'e Element) {
        for child in &element.children {
            if let Some(id) = child.attribute("id").filter(|_| child.tag.name != "ref") {
                self.elements.insert(id, child);
            }
            self.find_ids(child);
        }
    }

    /// The element that a `ref` names, whose tag must be one of `tags`, handed to `read`.
    pub(super) fn follow<T>(
        &mut self,
        reference: &'e Element,
        tags: &[&str],
        read: impl FnOnce(&'e Element, &mut Self) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        let (id, wanted) = (reference.required("id"), tags.join(" or "));
        let name = quote(id);
        let Some(&element) = self.elements.get(id) else {
            let of_tag = self.elements.iter().filter(|(_, element)| tags.contains(&element.tag.name));
            let known = nearest_first(id, of_tag.map(|(id, _)| *id));
            return Err(reference.error(format!("no {wanted} has the id {name}"), format!("the scene has {known}")));
        };
        if !tags.contains(&element.tag.name) {
            let what = format!("{name} is the {} at {}, not a {wanted}", element.tag.name, element.place);
            return Err(reference.error(what, format!("refer to a {wanted}")));
        }
        if self.open.contains(&id) {
            return Err(reference.error(format!("{name} refers to itself"), "break the circle"));
        }
        self.open.push(id);
        let found = read(element, self)?;
        self.open.pop();
        Ok(found)
    }

    /// Gives the environment its portals.
    fn aim(&mut self) -> Result<(), SceneError> {
        let Some(&(first, _)) = self.portals.first() else { return Ok(()) };
        let environment = self.scene.emitters.iter_mut().find_map(|emitter| match emitter {
            Emitter::Environment { portals, .. } => Some(portals),
            _ => None,
        });
        let Some(portals) = environment else {
            return Err(first.error("a portal without an environment", "add one of constant, envmap and sky"));
        };
        portals.extend(self.portals.iter().map(|(_, shape)| *shape));
        Ok(())
    }

    /// The element's id, or `STEM-NUMBER` if it has none and no other element has that.
    pub(super) fn id(&self, element: &Element, stem: &str, number: usize) -> Result<String, SceneError> {
        if let Some(id) = element.attribute("id") {
            return Ok(id.to_owned());
        }
        let id = format!("{stem}-{number}");
        if let Some((place, _)) = self.ids.get(&id) {
            let what = format!("without id it is called {id}, but that is the id at {place}");
            return Err(element.error(what, "give it an id"));
        }
        Ok(id)
    }

    /// Adds a note, once.
    pub(super) fn note(&mut self, text: &str) {
        if !self.scene.notes.iter().any(|note| note == text) {
            self.scene.notes.push(text.to_owned());
        }
    }
}
