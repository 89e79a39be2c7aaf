//! What a scene needs to be read, each with its reason, and what it does not need.

use photonlab_photometry::Channels;

use crate::{
    Scene,
    reasons::{bounces, dispersing, first_specular, indirect_reason, path_classes, spectral_reason},
};

/// One thing that is modelled, or left out, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// What.
    pub need: String,
    /// Why.
    pub reason: String,
}

/// What can change a reading of this scene. Whatever is false here is provably without effect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Needs {
    /// Channels that every photon and reading carries.
    pub channels: Channels,
    /// Light can reach a surface straight from a lamp.
    pub direct: bool,
    /// Light can reach a diffuse surface through specular ones alone, so a caustic map is kept.
    pub caustic: bool,
    /// Light can reach a surface after a diffuse interaction, so a surface map is kept.
    pub indirect: bool,
    /// A medium can scatter light into a ray, so a volume map is kept.
    pub in_scattering: bool,
    /// What is modelled, with reasons.
    pub list: Vec<Need>,
    /// What is left out, with reasons.
    pub left_out: Vec<Need>,
}

impl Needs {
    /// Derives the needs from the scene's lamps, coatings and meters.
    pub fn of(scene: &Scene) -> Self {
        let channels = scene.channels();
        let specular = first_specular(scene);
        let indirect = indirect_reason(scene);
        let scattering = scene.media.iter().find(|medium| medium.scatters());
        let mut needs = Self {
            channels,
            direct: scene.has_light(),
            caustic: scene.has_light() && specular.is_some(),
            indirect: scene.has_light() && indirect.is_some(),
            in_scattering: scene.has_light() && scattering.is_some(),
            list: Vec::new(),
            left_out: Vec::new(),
        };
        match channels {
            Channels::Grey => {
                needs.leave_out("three channels", "every colour of the scene is grey, so one channel carries all")
            }
            Channels::Rgb => needs.model("three channels", "a reflectance or a lamp is coloured"),
            Channels::Spectral => needs.model("wavelengths", &spectral_reason(scene)),
        }
        match dispersing(scene) {
            Some(id) => needs.model("dispersion", &format!("`{id}` refracts each wavelength by its own index")),
            None => needs.leave_out("dispersion", "no glass has an index that differs between wavelengths"),
        }
        if needs.direct {
            needs.model("direct light", "the scene has a lamp");
        }
        match specular.filter(|_| needs.caustic) {
            Some(id) => {
                needs.model("caustic map", &format!("`{id}` is specular, so lamps can shine through or off it"))
            }
            None => needs.leave_out("caustic map", "no surface is specular"),
        }
        match indirect.filter(|_| needs.indirect) {
            Some(reason) => needs.model("surface map", &reason),
            None => needs.leave_out(
                "surface map",
                "no light that a surface reflects diffusely can reach a surface that is read",
            ),
        }
        match scene.media.first() {
            Some(medium) => needs.model("free paths", &format!("`{}` lets light pass only in part", medium.id)),
            None => needs.leave_out("free paths", "the scene has no medium"),
        }
        match scattering.filter(|_| needs.in_scattering) {
            Some(medium) => needs
                .model("volume map", &format!("`{}` scatters light, also into rays that look through it", medium.id)),
            None => needs.leave_out("volume map", "no medium scatters light"),
        }
        let (present, absent) = path_classes(&needs);
        if !present.is_empty() {
            needs.model("path classes", &present);
        }
        if !absent.is_empty() {
            needs.leave_out("path classes", &absent);
        }
        match bounces(scene, &needs) {
            Ok(reason) => needs.model("bounces", &reason),
            Err(reason) => needs.leave_out("bounces", reason),
        }
        needs
    }

    fn model(&mut self, need: &str, reason: &str) {
        self.list.push(Need { need: need.into(), reason: reason.into() });
    }

    fn leave_out(&mut self, need: &str, reason: &str) {
        self.left_out.push(Need { need: need.into(), reason: reason.into() });
    }
}
