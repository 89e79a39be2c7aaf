//! Photons counted where they arrive, without any map.

use glam::DVec3;
use photonlab_photometry::Colour;
use photonlab_sampling::{EmissionPlan, Optics};
use photonlab_scene::{Hit, World};

use crate::{
    Classes, Job, Ledger, TraceError, Traced,
    compiled::{Flight, tracer},
    in_chunks, path,
};

/// Knows the cells in which a photon counts.
pub trait Counter: Sync {
    /// Calls `found` with each cell in which a photon counts that arrives at a surface.
    fn at_surface(&self, hit: &Hit, found: &mut dyn FnMut(usize));
    /// The same for one that leaves the scene in a direction.
    fn to_infinity(&self, direction: DVec3, found: &mut dyn FnMut(usize));
}

/// What was counted.
#[derive(Clone, Debug)]
pub struct Counted<const C: usize> {
    /// Flux in each cell, W or lm.
    pub flux: Vec<Colour<C>>,
    /// Photons in each cell.
    pub photons: Vec<u64>,
    /// Where all flux went.
    pub ledger: Ledger<C>,
}

/// Follows all photons of a plan and counts them in `cells` cells. Nothing is stored: memory does not grow with photons
/// beyond what a task counts before its sum is taken.
pub fn count<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    plan: &EmissionPlan<C>,
    job: &Job,
    cells: usize,
    counter: &dyn Counter,
) -> Result<Counted<C>, TraceError> {
    tracer().count(Flight { world, optics, plan, job }, cells, counter)
}

pub(crate) fn count_all<const C: usize>(
    Flight { world, optics, plan, job }: Flight<'_, C>,
    cells: usize,
    counter: &dyn Counter,
) -> Result<Counted<C>, TraceError> {
    let job = Job { keep: Classes::NONE, ..*job };
    let parts = in_chunks(plan, |numbers| {
        let mut part = Traced::empty(world);
        let mut tally = Tally { counter, arrivals: Vec::new() };
        for number in numbers {
            path::follow(world, optics, plan, &job, number, &mut part, &mut tally)?;
        }
        Ok((part.ledger, tally.arrivals))
    });
    let mut whole = Counted { flux: vec![Colour::ZERO; cells], photons: vec![0; cells], ledger: Ledger::new(world) };
    for part in parts {
        let (ledger, arrivals) = part?;
        whole.ledger.add(&ledger);
        for (cell, flux) in arrivals {
            whole.flux[cell as usize] += flux;
            whole.photons[cell as usize] += 1;
        }
    }
    Ok(whole)
}

/// Is told of every photon that arrives or leaves.
pub(crate) trait Witness<const C: usize> {
    fn arrived(&mut self, hit: &Hit, flux: Colour<C>);
    fn left(&mut self, direction: DVec3, flux: Colour<C>);
}

/// Counts nothing, at no cost.
pub(crate) struct NoCounter;

impl<const C: usize> Witness<C> for NoCounter {
    #[inline]
    fn arrived(&mut self, _: &Hit, _: Colour<C>) {}

    #[inline]
    fn left(&mut self, _: DVec3, _: Colour<C>) {}
}

struct Tally<'c, const C: usize> {
    counter: &'c dyn Counter,
    arrivals: Vec<(u32, Colour<C>)>,
}

impl<const C: usize> Witness<C> for Tally<'_, C> {
    fn arrived(&mut self, hit: &Hit, flux: Colour<C>) {
        self.counter.at_surface(hit, &mut |cell| self.arrivals.push((cell as u32, flux)));
    }

    fn left(&mut self, direction: DVec3, flux: Colour<C>) {
        self.counter.to_infinity(direction, &mut |cell| self.arrivals.push((cell as u32, flux)));
    }
}
