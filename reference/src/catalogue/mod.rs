//! Every scene with a known answer in one list, so that one loop can run them all and compare every meter.
//!
//! The identifiers are those of the project's catalogue of closed forms: C direct light, D interreflection, E specular
//! paths, F participating media, G scattering laws, I photometry.

mod case;

use crate::{
    ball_lens, closed_room, daylight, emitting_cube, furnace, groove, integrating_sphere, lamps, medium, mirror_arc,
    pane, paraboloid, prism, square_lamp,
};

pub use case::{Case, Expected, Reads};

pub(crate) use case::{Draft, meter};

/// An entry of the catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its identifier, such as `C1`.
    pub id: &'static str,
    /// What it is, in a few words.
    pub title: &'static str,
    /// Its scenes with their answers. Those of D4 and F7 take seconds to compute, the others milliseconds.
    pub cases: fn() -> Vec<Case>,
}

/// All entries that have scenes, in the order C, D, E, F, I.
pub const ALL: &[Entry] = &[
    Entry { id: "C1", title: "point lamp over a plane", cases: lamps::point::cases },
    Entry { id: "C2", title: "rectangular lamp, parallel and standing", cases: rectangles },
    Entry { id: "C3", title: "disc lamp", cases: lamps::disc::cases },
    Entry { id: "C4", title: "spherical lamp and a tilted element", cases: lamps::ball::cases },
    Entry { id: "C5", title: "endless strip and tube", cases: strips_and_tubes },
    Entry { id: "C6", title: "lamp with tabulated intensity", cases: lamps::table::cases },
    Entry { id: "D1", title: "integrating sphere", cases: integrating_sphere::cases },
    Entry { id: "D2", title: "furnace", cases: furnace::cases },
    Entry { id: "D4", title: "diffuse cube with an emitting ceiling", cases: emitting_cube::cases },
    Entry { id: "D6", title: "V-groove", cases: groove::cases },
    Entry { id: "E1", title: "window pane", cases: pane::cases },
    Entry { id: "E2", title: "ball lens in a collimated beam", cases: ball_lens::cases },
    Entry { id: "E3", title: "paraboloid mirror", cases: paraboloid::cases },
    Entry { id: "E4", title: "cylindrical mirror and its caustic", cases: mirror_arc::cases },
    Entry { id: "E6", title: "prism", cases: prism::cases },
    Entry { id: "F1", title: "absorbing medium", cases: medium::attenuation::cases },
    Entry { id: "F2", title: "light scattered once", cases: medium::once_scattered::cases },
    Entry { id: "F3", title: "endless scattering medium", cases: medium::infinite::cases },
    Entry { id: "F6", title: "scattering half-space", cases: medium::half_space::cases },
    Entry { id: "F7", title: "scattering slab", cases: medium::slab::cases },
    Entry { id: "I2", title: "mean irradiance of a closed room", cases: closed_room::cases },
    Entry { id: "I3", title: "light reflected by an evenly lit wall", cases: lamps::patch::wall_cases },
    Entry { id: "I4", title: "sky component under a roof opening", cases: daylight::roof_opening::cases },
];

/// An entry, or part of one, whose answer is a function to be compared with directly.
#[derive(Clone, Copy, Debug)]
pub struct Bare {
    /// Its identifier.
    pub id: &'static str,
    /// What it is, and where the function stands.
    pub title: &'static str,
    /// Why it has no scene.
    pub why: &'static str,
}

/// What has no scene.
pub const WITHOUT_SCENE: &[Bare] = &[
    Bare {
        id: "C5",
        title: "isotropic line source; tubes of finite length: `lamps::tube::line_irradiance`",
        why: "no emitter is a line, and a tube of finite length and radius has no such closed form",
    },
    Bare {
        id: "C6",
        title: "table linear in the cosine: `lamps::table`",
        why: "luminaire files are read as linear in the angle",
    },
    Bare { id: "E1", title: "polarised light through a pane: `pane`", why: "light carries no polarisation" },
    Bare {
        id: "F5",
        title: "Henyey and Greenstein's phase function: `medium::phase`",
        why: "a law of draws and densities; F7 has scenes with it",
    },
    Bare { id: "F6", title: "half-space of albedo 1", why: "no finite block of it is deep enough" },
    Bare { id: "G1", title: "Lambert's law: `scattering::lambert`", why: "a law of draws and densities" },
    Bare {
        id: "G2",
        title: "Fresnel's interface: `scattering::fresnel`",
        why: "a law of draws and densities; E1 has scenes",
    },
    Bare { id: "G3", title: "rough mirror: `scattering::ggx`", why: "a law of draws and densities" },
    Bare { id: "G4", title: "rough interface: `scattering::rough_dielectric`", why: "a law of draws and densities" },
    Bare { id: "G5", title: "Phong's lobe: `scattering::phong`", why: "no coating has this lobe" },
    Bare { id: "G6", title: "chi-square test: `scattering::chi_square_critical`", why: "a test, not a scene" },
    Bare { id: "I1", title: "watts to lumens: `eye`", why: "a weight of spectra; scenes here are grey or RGB" },
    Bare {
        id: "I5",
        title: "cases in the manner of CIE 171:2006",
        why: "a map: its 5.2 to 5.14 are C1, C6, C2, C3, E1, I3, I2 and I4",
    },
];

fn rectangles() -> Vec<Case> {
    let mut cases = square_lamp::cases();
    cases.extend(lamps::patch::lamp_cases());
    cases
}

fn strips_and_tubes() -> Vec<Case> {
    let mut cases = lamps::strip::cases();
    cases.extend(lamps::tube::cases());
    cases
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    /// Every case is a well-formed scene whose sensors are exactly those it has answers for.
    #[test]
    fn answers_and_sensors_belong_together() {
        let mut ids = HashSet::new();
        for entry in ALL {
            assert!(ids.insert(entry.id), "{} twice", entry.id);
            let (cases, mut names) = ((entry.cases)(), HashSet::new());
            assert!(!cases.is_empty(), "{}", entry.id);
            for case in cases {
                assert!(names.insert(case.name.clone()), "{}: {} twice", entry.id, case.name);
                crate::mitsuba::assert_balanced(&case.xml);
                assert_eq!(case.xml.matches("<sensor ").count(), case.expected.len(), "{} {}", entry.id, case.name);
                let mut sensors = HashSet::new();
                for e in &case.expected {
                    let named = format!("id=\"{}\"", e.sensor);
                    assert!(sensors.insert(&e.sensor) && case.xml.contains(&named), "{}: {}", case.name, e.sensor);
                    assert!(e.value.iter().all(|v| v.is_finite() && *v >= 0.0), "{}: {e:?}", case.name);
                    let scale = case.expected.iter().flat_map(|e| &e.value).fold(0.0, |m: f64, v| m.max(*v));
                    assert!(e.uncertainty >= 0.0 && e.uncertainty < 1e-3 * scale, "{} {}: {e:?}", entry.id, case.name);
                }
            }
        }
    }
}
