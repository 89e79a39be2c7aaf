//! What a run has found so far.

use photonlab_final_gather::{Guide, Sites};
use photonlab_measure::Stopped;
use photonlab_photometry::Colour;
use photonlab_trace::Ledger;

use crate::{
    CellResult, Method, Outcome, Session,
    adaptive::{CellRadius, Common},
    maps::Radii,
    precomputed::PlaceOnSide,
};

/// What the passes so far have found.
pub(crate) struct Run<const C: usize> {
    pub(crate) cells: Vec<CellResult<C>>,
    pub(crate) ledger: Option<Ledger<C>>,
    pub(crate) radii: Radii,
    /// Where an irradiance cache looks around, chosen before the first pass.
    pub(crate) sites: Option<Sites<C>>,
    /// What guides the rays of each cell, by the photons of the first pass; empty if nothing does.
    pub(crate) guides: Option<Vec<Option<Guide>>>,
    /// Where final gather's map is read once a pass, chosen before the first.
    pub(crate) places: Option<Vec<PlaceOnSide<C>>>,
    /// What each cell has learnt of its bias, where that is taken off, and for [`Method::Adaptive`] its own radius.
    pub(crate) of_cells: Vec<CellRadius>,
    /// What all cells have shown before the first pass is read, for it and other direct views that nobody has tuned.
    pub(crate) common: Common,
    /// Photons of a nearest-photon estimate in the first pass, if the run has chosen them.
    pub(crate) k: Option<f64>,
    pub(crate) radius: f64,
    pub(crate) photons: u64,
    pub(crate) passes: u64,
    pub(crate) samples: u64,
    pub(crate) out_of_reach: bool,
    /// Found once: see [`Session::brightest_glint`].
    pub(crate) brightest_glint: Option<Option<Colour<C>>>,
}

impl<const C: usize> Run<C> {
    pub(crate) fn new(cells: usize) -> Self {
        Self {
            cells: vec![CellResult::default(); cells],
            ledger: None,
            radii: Radii::default(),
            sites: None,
            guides: None,
            places: None,
            of_cells: vec![CellRadius::default(); cells],
            common: Common::default(),
            k: None,
            radius: 0.0,
            photons: 0,
            passes: 0,
            samples: 0,
            out_of_reach: false,
            brightest_glint: None,
        }
    }

    pub(crate) fn book(&mut self, emitted: u64, pass: &Ledger<C>) {
        self.photons += emitted;
        match &mut self.ledger {
            Some(ledger) => ledger.add(pass),
            None => self.ledger = Some(pass.clone()),
        }
    }

    pub(crate) fn finish(self, session: &Session<'_, C>, stopped: Stopped) -> Outcome<C> {
        let per_pass = 1.0 / self.passes as f64;
        let has_radius = matches!(session.settings.method, Method::Radius { .. } | Method::FinalGather { .. });
        let optics = session.optics.any();
        Outcome {
            ledger: self.ledger.map(|ledger| ledger.scaled(per_pass)),
            radius: (has_radius && self.photons > 0).then_some(self.radius * per_pass),
            cells: self.cells,
            photons: self.photons,
            passes: self.passes,
            samples: self.samples,
            stopped,
            lamp_flux: optics.palette.develop(optics.lamps.total_flux()),
            results: session.optics.results(),
            out_of_reach: self.out_of_reach,
            channels: session.needs.channels,
        }
    }
}
