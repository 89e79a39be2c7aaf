//! Scenes of the catalogue, of which some are read.

use photonlab_photometry::Response;
use photonlab_planner::Candidate;
use photonlab_readout::{Cell, ErrorOver, Session, Target};
use photonlab_reference::catalogue::{Case, Entry};
use photonlab_sampling::PassOptics;

use super::{
    covered::{Truth, truths},
    fnv::fnv1a,
    lab::Lab,
};
use crate::{command::Options, planned::candidates};

/// Confidence of the intervals that end a run.
pub(super) const BARS: f64 = 0.95;
/// One scene in so many is set aside.
const ASIDE: u64 = 3;
/// What is less than this share of the brightest reading is rounding.
const ROUNDING: f64 = 1e-9;

/// Some scenes of an entry, those of the least hashes of their names, with these names.
pub(super) fn chosen(entry: &Entry, most: usize) -> Vec<(String, Case)> {
    let named = |case: Case| (format!("{} {}", entry.id, case.name), case);
    let mut cases: Vec<(String, Case)> = (entry.cases)().into_iter().map(named).collect();
    // The quotient, for the remainder says what is set aside.
    cases.sort_by_key(|(name, _)| fnv1a(name) / ASIDE);
    cases.truncate(most);
    cases
}

/// True if nothing was tuned on a scene.
pub(super) fn is_set_aside(name: &str) -> bool {
    fnv1a(name).is_multiple_of(ASIDE)
}

/// The cells of all meters but goniometers that light reaches, with their answers channel by channel: a reading of nothing has no relative error.
fn lit_meters(lab: &Lab, case: &Case, results: usize) -> anyhow::Result<(Vec<Cell>, Vec<Truth>)> {
    let mut cells = Cell::of_meters(&lab.world.scene);
    cells.retain(|cell| !matches!(cell.target, Target::Leaving { .. }));
    let all = truths(lab, case, &cells, results)?;
    let brightest = all.iter().map(|truth| truth.value).fold(0.0, f64::max);
    let is_lit = |of_cell: &[Truth]| of_cell.iter().all(|truth| truth.value > ROUNDING * brightest);
    let mut lit = all.chunks(results.max(1)).map(is_lit).collect::<Vec<_>>().into_iter();
    cells.retain(|_| lit.next().unwrap_or(false));
    let truths = truths(lab, case, &cells, results)?;
    Ok((cells, truths))
}

/// A scene of the catalogue as `auto` would read it.
pub(super) struct Known<'k, const C: usize> {
    pub(super) session: Session<'k, C>,
    pub(super) cells: &'k [Cell],
    pub(super) truths: &'k [Truth],
    pub(super) entrants: Vec<Candidate>,
}

/// Does something with a scene's lit meters and the candidates that read them; `None` if light reaches none.
pub(super) fn with_known<const C: usize, T>(
    lab: &Lab,
    case: &Case,
    act: impl FnOnce(Known<'_, C>) -> anyhow::Result<T>,
) -> anyhow::Result<Option<T>> {
    let optics = PassOptics::<C>::new(&lab.world, Response::Radiometric)?;
    let (cells, truths) = lit_meters(lab, case, optics.results())?;
    if cells.is_empty() {
        return Ok(None);
    }
    let options = Options::usual();
    let settings = options.settings(&lab.world.scene).map_err(|failure| anyhow::anyhow!("{failure}"))?;
    let (world, needs, error_over) = (&lab.world, &lab.needs, ErrorOver::Worst);
    let session = Session { world, optics: &optics, needs, settings, confidence: BARS, error_over };
    let entrants = candidates(&options, &session, &cells).map_err(|failure| anyhow::anyhow!("{failure}"))?;
    act(Known { session, cells: &cells, truths: &truths, entrants }).map(Some)
}
