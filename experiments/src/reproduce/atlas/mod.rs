//! `atlas`: the ways in which a photon map fails, each driven into its failure and held against the law that predicts it.

mod ball;
mod blur;
mod classes;
mod colour;
mod crease;
mod dark;
mod edge;
mod enclosure;
mod few;
mod fog;
mod glossy;
mod ground;
mod judgement;
mod leak;
mod mode;
mod norm;
mod passes;
mod photons;
mod picture;
mod radius;
mod sheet;
mod threads;
mod unseen;
mod walk;

use photonlab_measure::{Record, sidak_level};
use serde::Deserialize;

use self::mode::{Measured, Mode, Part};
use crate::reproduce::context::{Context, Findings};

/// The confidence of all comparisons together.
const FAMILY: f64 = 0.99;

/// A mode made of what the definition says of it.
type Maker = fn(&Part) -> anyhow::Result<Mode>;

/// Every mode by its name, in the order of the report.
const MODES: [(&str, Maker); 42] = [
    ("free-edge", edge::free_edge),
    ("free-corner", edge::free_corner),
    ("edge-slope", edge::slope),
    ("crease-60", crease::crease_60),
    ("crease-90", crease::crease_90),
    ("crease-120", crease::crease_120),
    ("crease-angle", crease::crease_angle),
    ("room-corner", edge::room_corner),
    ("shadow-step", blur::shadow_step),
    ("caustic-fold", blur::caustic_fold),
    ("small-sphere", ball::small_sphere),
    ("thin-wall", edge::thin_wall),
    ("wall-on-floor", leak::wall_on_floor),
    ("sheet-over-floor", leak::sheet_over_floor),
    ("one-sided-sheet", sheet::one_sided),
    ("all-k", few::all_k),
    ("cone-norm", norm::cone),
    ("gaussian-norm", norm::gaussian),
    ("dark-place", dark::dark_place),
    ("fewer-than-k", few::starved),
    ("glossy-receiver", glossy::receiver),
    ("shared-map", passes::shared_map),
    ("open-field", unseen::open_field),
    ("keyhole", unseen::keyhole),
    ("many-lamps", unseen::many_lamps),
    ("cut-paths", walk::cut_paths),
    ("roulette-weight", walk::roulette_weight),
    ("roulette-variance", walk::roulette_variance),
    ("shading-normals", classes::shading_normals),
    ("path-classes", classes::path_classes),
    ("specular-diffuse-specular", unseen::behind_glass),
    ("fog-blur", fog::blur),
    ("fog-edge", fog::edge),
    ("mid-air", sheet::mid_air),
    ("colour-ratio", colour::ratio),
    ("seed-reuse", passes::seed_reuse),
    ("thread-order", threads::order),
    ("coincident-photons", few::coincident),
    ("wrong-radius", radius::wrong),
    ("small-counts", few::small_counts),
    ("self-intersection", walk::self_intersection),
    ("wavelength-bins", colour::bins),
];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    /// How many times the repetitions that a mode names.
    times: u64,
    /// Widest half-width over the predicted value that still tells something.
    precision: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut parts = context.parts::<Part>()?;
    let mut measured = Vec::new();
    for (number, (id, make)) in MODES.into_iter().enumerate() {
        let part = parts.remove(id).ok_or_else(|| anyhow::anyhow!("the definition says nothing of {id}"))?;
        say!("       {id}");
        let mode = make(&part)?;
        measured.push(mode.measure(part, p.seed, number as u64, p.times)?);
    }
    if let Some(unknown) = parts.keys().next() {
        anyhow::bail!("the definition tells of {unknown}, which is no mode");
    }
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, measured.iter().map(Measured::comparisons).sum());
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    let mut outcomes = Vec::new();
    for mode in &measured {
        let outcome = mode.judge(confidence, p.precision, &mut found.comparisons);
        found.groups.push(mode.group(&outcome));
        found.rows.extend(mode.rows());
        found.figures.push(mode.figure(confidence));
        outcomes.push((mode.mode.id, outcome));
    }
    let (verdict, reason) = judgement::conclude(&outcomes);
    Ok(context.record(found, verdict, reason))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::{claims::Claim, definition::Definition};

    /// Every mode has its words and every word its mode, and each law is a number wherever it is held against a measured one.
    #[test]
    fn modes_and_their_definitions_agree() {
        let definition = Definition::parse("atlas", Claim::Atlas.definition()).expect("a definition");
        let parts = definition.parts::<Part>().expect("parts");
        assert_eq!(parts.len(), MODES.len());
        for (id, make) in MODES {
            let part = &parts[id];
            let mode = make(part).expect("a mode");
            assert_eq!(mode.id, id);
            assert!(part.sweep.is_sorted() && !mode.curves.is_empty(), "{id}");
            for (curve, &x) in mode.curves.iter().flat_map(|curve| part.sweep.iter().map(move |x| (curve, x))) {
                assert!((curve.law)(x).is_finite(), "{id}, {}, {x}", curve.label);
            }
        }
    }
}
