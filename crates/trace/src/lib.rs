//! Follows photons until they are absorbed and keeps the books.
//!
//! [`trace`] sends every photon of an [`photonlab_sampling::EmissionPlan`] through a world and returns what it left at
//! diffuse surfaces and in media, in arrays whose order depends on the photons' numbers alone, and the [`Ledger`].
#![forbid(unsafe_code)]

mod compiled;
mod counter;
mod ledger;
mod path;

pub use counter::{Counted, Counter, count};
pub use ledger::{Book, Ledger, SurfaceBook};
pub use path::{Classes, Limits, TraceError};

use photonlab_photometry::{Photon, VolumePhoton};
use photonlab_sampling::{EmissionPlan, Optics};
use photonlab_scene::World;
use rayon::prelude::*;

use compiled::{Flight, tracer};
use counter::NoCounter;

/// Photons followed by one task; part of nothing that can be read from the result.
const CHUNK: u64 = 2048;

/// What the photons left behind.
#[derive(Clone, Debug)]
pub struct Traced<const C: usize> {
    /// Where each record was stored, metres from the scene's middle ([`World::stored`]).
    pub positions: Vec<[f32; 3]>,
    /// The records, in the order of their photons' numbers and along each path.
    pub photons: Vec<Photon<C>>,
    /// The same where photons met the matter of media that scatter.
    pub volume: VolumeRecords<C>,
    /// Where all flux went.
    pub ledger: Ledger<C>,
}

impl<const C: usize> Traced<C> {
    fn empty(world: &World) -> Self {
        Self {
            positions: Vec::new(),
            photons: Vec::new(),
            volume: VolumeRecords::default(),
            ledger: Ledger::new(world),
        }
    }
}

/// What photons left in media; empty in a scene without one that scatters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VolumeRecords<const C: usize> {
    /// Where each collided, metres from the scene's middle ([`World::stored`]).
    pub positions: Vec<[f32; 3]>,
    /// The records, in the order of their photons' numbers and along each path.
    pub photons: Vec<VolumePhoton<C>>,
}

/// What to trace.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// The run's seed.
    pub seed: u64,
    /// Number of the pass; passes share no random number.
    pub pass: u32,
    /// When a path ends early.
    pub limits: Limits,
    /// Which photons are kept; all are followed and booked.
    pub keep: Classes,
}

/// Follows all photons of a plan.
pub fn trace<const C: usize>(
    world: &World,
    optics: &Optics<C>,
    plan: &EmissionPlan<C>,
    job: &Job,
) -> Result<Traced<C>, TraceError> {
    tracer().trace(Flight { world, optics, plan, job })
}

fn follow_all<const C: usize>(Flight { world, optics, plan, job }: Flight<'_, C>) -> Result<Traced<C>, TraceError> {
    let parts: Vec<Traced<C>> = in_chunks(plan, |numbers| {
        let mut part = Traced::empty(world);
        for number in numbers {
            path::follow(world, optics, plan, job, number, &mut part, &mut NoCounter)?;
        }
        Ok(part)
    })
    .into_iter()
    .collect::<Result<_, TraceError>>()?;
    let mut whole = Traced::empty(world);
    // Exactly what is needed: the largest arrays of a run would grow by doubling.
    let stored = |of: fn(&Traced<C>) -> usize| parts.iter().map(of).sum();
    whole.positions.reserve_exact(stored(|part| part.positions.len()));
    whole.photons.reserve_exact(stored(|part| part.photons.len()));
    whole.volume.positions.reserve_exact(stored(|part| part.volume.positions.len()));
    whole.volume.photons.reserve_exact(stored(|part| part.volume.photons.len()));
    for part in parts {
        whole.positions.extend(part.positions);
        whole.photons.extend(part.photons);
        whole.volume.positions.extend(part.volume.positions);
        whole.volume.photons.extend(part.volume.photons);
        whole.ledger.add(&part.ledger);
    }
    Ok(whole)
}

/// Works on all photons' numbers, a chunk to a task; the results stand in the order of the numbers.
fn in_chunks<const C: usize, T: Send>(
    plan: &EmissionPlan<C>,
    work: impl Fn(std::ops::Range<u64>) -> T + Sync,
) -> Vec<T> {
    (0..plan.photons().div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| work(chunk * CHUNK..((chunk + 1) * CHUNK).min(plan.photons())))
        .collect()
}
