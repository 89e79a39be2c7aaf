//! An irradiance cache over the places that cells read.

use photonlab_final_gather::{ACCURACY, Gatherer, Light, Record, Site, Sites, Spot};
use photonlab_gather::Scratch;
use photonlab_kdtree::{KdTree, Neighbours, SplitRule};
use photonlab_sampling::{Purpose, Stream};
use rayon::prelude::*;

use crate::{Cell, Method, Session, Settings, look::Look};

/// Places that are asked whether the cache covers them, all cells together, unless cells are more.
const CANDIDATES: usize = 1 << 14;
/// Rays that tell how far things are.
const RAYS_OF_REACH: u32 = 64;
/// Sites are chosen before any pass, by numbers of their own, whatever the run's seed: each run would have another bias else, of which the
/// spread of its passes shows nothing.
const SEED: u64 = 0;
const PASS: u32 = u32::MAX - 3;
/// Candidates in the first batch; each one after takes half as many as were asked before it, and no more than that: the sites of one batch are
/// compared each with each.
const FIRST_BATCH: usize = 64;
const LARGEST_BATCH: usize = 1 << 13;
/// Sites stand no closer than candidates, of which so many are nearest.
const NEIGHBOURS: usize = 4;
/// The shortest reach over the scene's size.
const SHORTEST: f64 = 1e-6;

/// What one pass has found at the sites.
#[derive(Clone, Copy)]
pub(crate) struct Cache<'p, const C: usize> {
    pub(crate) sites: &'p Sites<C>,
    pub(crate) records: &'p [Record<C>],
}

impl<const C: usize> Cache<'_, C> {
    /// One sample of the irradiance at a spot: of direct and caustic light its own, of the rest what the records tell, or its own again
    /// where no site stands for it.
    pub(crate) fn irradiance(
        &self,
        gatherer: &Gatherer<'_, C>,
        spot: &Spot<C>,
        share: f64,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Light<C> {
        let Spot { at, sight, used } = spot;
        let mut light = gatherer.without_reflected(at, sight, (*used, share), stream, scratch);
        let told = self.sites.tell(spot, self.records, gatherer.world);
        light.add(&told.unwrap_or_else(|| gatherer.reflected_once(at, *sight, *used, stream, scratch)));
        light
    }
}

impl<const C: usize> Session<'_, C> {
    /// True if final gather has anything to look around for.
    pub fn reads_reflected(&self) -> bool {
        let gathers = matches!(self.settings.method, Method::FinalGather { .. });
        gathers && (self.needs.indirect || self.needs.in_scattering)
    }

    /// True if a cache has anything to tell.
    pub(crate) fn caches(&self) -> bool {
        self.settings.aids.cache && self.reads_reflected()
    }

    /// Where the cache looks around: places that cells read, so that some site stands for each. Candidates come in an order without
    /// pattern and in growing batches, so that sites far apart come first; of each batch those become sites that none before stands for.
    pub(crate) fn sites(&self, look: &Look<'_, C>, cells: &[Cell]) -> Sites<C> {
        let settings = Settings { seed: SEED, ..self.settings };
        let spots = candidates(&Look { pass: PASS, settings: &settings, ..*look }, cells);
        let spacings = self.spacings(&spots);
        let (low, high) = self.world.bounds();
        let shortest = SHORTEST * (high - low).max_element();
        let gatherer = look.gatherer(true);
        let mut order: Vec<(f64, usize)> =
            (0..spots.len()).map(|index| (rays(SEED, PASS - 1, index).next(), index)).collect();
        order.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        let mut sites = Sites::default();
        let mut asked = 0;
        while asked < order.len() {
            let batch = &order[asked..(asked + (asked / 2).clamp(FIRST_BATCH, LARGEST_BATCH)).min(order.len())];
            asked += batch.len();
            let found: Vec<Site<C>> = batch
                .par_iter()
                .map(|&(_, index)| (index, spots[index]))
                .filter(|(_, spot)| !sites.cover(spot, self.world))
                .map(|(index, spot)| {
                    let reaches = [(spacings[index] / ACCURACY).max(shortest), 2.0 * self.largest_radius()];
                    Site::new(spot, &gatherer, RAYS_OF_REACH, reaches, &mut rays(SEED, PASS, index))
                })
                .collect();
            let mut taken: Vec<Site<C>> = Vec::new();
            for site in found {
                if taken.iter().all(|other| other.stands_for(&site.spot, ACCURACY, self.world).is_none()) {
                    taken.push(site);
                }
            }
            if !taken.is_empty() {
                sites.add(taken);
            }
        }
        sites
    }

    /// Looks around at every site with one pass's photons.
    pub(crate) fn records(&self, look: &Look<'_, C>, sites: &Sites<C>) -> Vec<Record<C>> {
        let gatherer = look.gatherer(true);
        let measure = |scratch: &mut Scratch, (index, site): (usize, &Site<C>)| {
            site.measure(&gatherer, self.settings.gather_rays, &mut rays(self.settings.seed, look.pass, index), scratch)
        };
        sites.all().par_iter().enumerate().map_init(Scratch::default, measure).collect()
    }

    /// How far the nearest few other spots lie from each, metres.
    fn spacings(&self, spots: &[Spot<C>]) -> Vec<f64> {
        let places: Vec<[f32; 3]> = spots.iter().map(|spot| self.world.stored(spot.at.position)).collect();
        let Ok(tree) = KdTree::build(places.clone(), vec![(); places.len()], SplitRule::Median) else {
            return vec![0.0; spots.len()];
        };
        let farthest = |found: &mut Neighbours, place: &[f32; 3]| {
            tree.nearest(*place, NEIGHBOURS + 1, f32::INFINITY, found);
            found.farthest_squared().map_or(0.0, |squared| f64::from(squared.sqrt()))
        };
        places.par_iter().map_init(Neighbours::default, farthest).collect()
    }
}

/// Random numbers of a site's rays.
fn rays(seed: u64, pass: u32, index: usize) -> Stream {
    Stream::new(seed, Purpose::Cache, pass, index as u64)
}

/// Plain spots that cells read, in the cells' order.
fn candidates<const C: usize>(look: &Look<'_, C>, cells: &[Cell]) -> Vec<Spot<C>> {
    let of_each = (CANDIDATES / cells.len().max(1)).clamp(1, look.samples as usize) as u64;
    let look = Look { samples: of_each, ..*look };
    let of_cell = |(number, cell): (usize, &Cell)| {
        let shift = look.shift(number);
        (0..of_each).filter_map(|sample| look.spot(cell, number, sample, &shift)).collect::<Vec<_>>()
    };
    let spots: Vec<Vec<Spot<C>>> = cells.par_iter().enumerate().map(of_cell).collect();
    spots.into_iter().flatten().filter(Spot::is_plain).collect()
}
