//! The emission plan: photons per lamp and aim, flux per photon.

use photonlab_photometry::Colour;
use photonlab_scene::World;

use crate::{Emission, Lamp, Lamps, Purpose, Stream, aim::Aims, sobol};

/// No lamp gets less than this share of an even division, so that a weak lamp is not starved.
const FLOOR: f64 = 0.1;
/// Photons per lamp and aim below which photons are not aimed.
const FEWEST: u64 = 16;

/// How many photons each lamp emits, how many of them at what is specular, and what flux each photon carries.
///
/// Promise: the sum of all photons' flux is the sum of all lamps' flux, in every channel: exactly without aims, portals and
/// environments, on average with them.
#[derive(Clone, Debug)]
pub struct EmissionPlan<const C: usize> {
    /// In the order of their photons.
    sources: Vec<Source<C>>,
    /// First photon index of each source, and the total at the end.
    first: Vec<u64>,
    aims: Aims<C>,
    /// Seeds of each source's quasi-random points; empty if photons are independent.
    scrambles: Vec<[u32; sobol::DIMENSIONS]>,
}

/// A lamp's rays: those of one of its aims, or all others.
#[derive(Clone, Copy, Debug)]
struct Source<const C: usize> {
    lamp: usize,
    aim: Option<usize>,
    /// Flux of each photon of weight one.
    flux: Colour<C>,
}

/// Which light photons are to find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// Every lamp's photons leave as its light does.
    AsEmitted,
    /// All light; some photons are aimed at what is specular.
    All,
    /// Light that comes through specular surfaces alone; nothing else is read.
    Caustics,
}

impl Sought {
    /// Share of photons that are aimed, at most.
    fn aimed(self) -> f64 {
        match self {
            Sought::AsEmitted => 0.0,
            // What these find is narrow and bright and rules the error of most pictures that show it: a ball lens under a lamp took half of
            // the time to an error that it took with 1/3, and a room in which it rules nothing 1.2 times as long.
            Sought::All => 0.6,
            Sought::Caustics => 15.0 / 16.0,
        }
    }

    /// Share of the flux that meets specular shapes by itself at which half of the most photons are aimed: what is smaller
    /// lights little.
    fn worth(self) -> f64 {
        match self {
            Sought::AsEmitted | Sought::Caustics => 0.0,
            Sought::All => 1e-4,
        }
    }
}

/// Why photons cannot be shared out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlanError {
    /// Nothing emits.
    #[error("the scene has no lamp that emits")]
    NoLamp,
    /// Some lamp would emit nothing.
    #[error("{photons} photons cannot be shared among {lamps} lamps; ask for at least one photon per lamp and pass")]
    TooFewPhotons {
        /// Photons asked for.
        photons: u64,
        /// Lamps of the scene.
        lamps: usize,
    },
}

impl<const C: usize> EmissionPlan<C> {
    /// Shares photons among lamps by [`Lamp::importance`], with a floor of a tenth of an even share, and aims some of them
    /// where that gains.
    pub fn new(lamps: &Lamps<C>, photons: u64, sought: Sought) -> Result<Self, PlanError> {
        let count = lamps.lamps.len();
        if count == 0 {
            return Err(PlanError::NoLamp);
        }
        if photons < count as u64 {
            return Err(PlanError::TooFewPhotons { photons, lamps: count });
        }
        let total: f64 = lamps.lamps.iter().map(Lamp::importance).sum();
        let (aims, aimed) = aims_for(lamps, total, photons, sought);
        let by_flux = if aims.aims.is_empty() { 0.0 } else { aimed / aims.importance() };
        let mut sources = Vec::with_capacity(count + aims.aims.len());
        let mut shares = Vec::with_capacity(sources.capacity());
        let least = FLOOR * (1.0 / count as f64);
        for (lamp, of) in lamps.lamps.iter().enumerate() {
            sources.push(Source { lamp, aim: None, flux: of.flux });
            shares.push((of.importance() / total).max(least) * (1.0 - aimed));
            for aim in aims.of_lamp(lamp) {
                sources.push(Source { lamp, aim: Some(aim), flux: aims.aims[aim].base });
                shares.push(aims.aims[aim].importance * by_flux);
            }
        }
        let first = shared_out(photons, &shares);
        for (source, ends) in sources.iter_mut().zip(first.windows(2)) {
            source.flux = source.flux * (1.0 / (ends[1] - ends[0]) as f64);
        }
        Ok(Self { sources, first, aims, scrambles: Vec::new() })
    }

    /// The same with photons that are spread evenly over what each source emits, by points of a quasi-random set that is another for
    /// each seed and pass (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995). Means over passes are unbiased, and independent from pass to pass; photons of one pass are not.
    pub fn spread(mut self, seed: u64, pass: u32) -> Self {
        let scramble = |source| {
            let mut stream = Stream::new(seed, Purpose::Scrambles, pass, source);
            std::array::from_fn(|_| stream.word())
        };
        self.scrambles = (0..self.sources.len() as u64).map(scramble).collect();
        self
    }

    /// Photons in all.
    pub fn photons(&self) -> u64 {
        self.first.last().copied().unwrap_or(0)
    }

    /// A photon's lamp, its start and the flux that it carries: zero if its ray is another's to send.
    pub fn emit(
        &self,
        world: &World,
        lamps: &Lamps<C>,
        index: u64,
        stream: &mut Stream,
    ) -> (usize, Emission<C>, Colour<C>) {
        let source = self.first.partition_point(|&first| first <= index) - 1;
        let Source { lamp, aim, flux } = self.sources[source];
        if let Some(seeds) = self.scrambles.get(source) {
            stream.lead_with(sobol::point(index - self.first[source], seeds));
        }
        let of = &lamps.lamps[lamp];
        let emission = match aim {
            Some(aim) => self.aims.emit(aim, world, of, stream),
            None => of.emit(world, stream),
        };
        let is_anothers = aim.is_none() && self.aims.have(self.aims.of_lamp(lamp), &emission.ray);
        let flux = if is_anothers { Colour::ZERO } else { flux * emission.weight };
        (lamp, emission, flux)
    }
}

/// The aims that a plan uses, and the share of its photons that they get.
fn aims_for<const C: usize>(lamps: &Lamps<C>, total: f64, photons: u64, sought: Sought) -> (Aims<C>, f64) {
    // Aimed photons should be at least half as many again as come by themselves.
    let aims = lamps.aims.up_to(total * sought.aimed() / 1.5);
    // Where some caustic light is no aim's, the other photons must find it.
    if sought == Sought::Caustics && !aims.complete {
        return aims_for(lamps, total, photons, Sought::All);
    }
    if aims.aims.is_empty() || photons < FEWEST * (lamps.lamps.len() + aims.aims.len()) as u64 {
        return (lamps.aims.up_to(0.0), 0.0);
    }
    let share = aims.importance() / total;
    (aims, sought.aimed() * share / (share + sought.worth()))
}

/// Cuts photons in parts: one to each, the rest by their shares, rounded cumulatively so that they add up; the first index of
/// each part, and the total at the end.
fn shared_out(photons: u64, shares: &[f64]) -> Vec<u64> {
    let count = shares.len();
    let sum: f64 = shares.iter().sum();
    let spare = photons - count as u64;
    let mut first = vec![0];
    let mut running = 0.0;
    for (index, share) in shares.iter().enumerate() {
        running += share;
        let end = if index + 1 == count { spare } else { ((running / sum) * spare as f64).round() as u64 };
        first.push(end + index as u64 + 1);
    }
    first
}
