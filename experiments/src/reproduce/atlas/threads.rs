//! The same photons, followed by more threads.

use photonlab_measure::Axis;
use photonlab_reference::atlas::thread_bound;
use photonlab_sampling::{Purpose, Stream};

use super::{
    enclosure::Enclosure,
    mode::{Curve, Mode, Part},
};

/// Records compared with those of one thread.
pub(super) fn order(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons as u64;
    let room = Enclosure::new(1.0, 0.8)?;
    Ok(Mode {
        id: "thread-order",
        title: "Photons followed by more threads",
        x: Axis::linear("threads"),
        y: Axis::linear("share of photon records that differ from those of one thread"),
        truth: None,
        between: false,
        curves: vec![
            Curve::off("numbers drawn from the thread's stream", "all but the first thread's", thread_bound),
            Curve::on("numbers from seed and photon alone", "the same bits", |_| 0.0),
        ],
        trial: Box::new(move |sweep, stream, _| {
            let (seed, own) = (stream.next().to_bits(), stream.clone());
            let by = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
                pool.install(|| room.trace(photons, &mut own.clone()))
            };
            let (one, one_bound) = (by(1)?, from_threads(seed, photons, 1));
            let mut values = Vec::new();
            for &threads in sweep {
                let many = by(threads as usize)?;
                let record = |traced: &photonlab_trace::Traced<1>| -> Vec<_> {
                    traced.positions.iter().copied().zip(traced.photons.iter().copied()).collect()
                };
                values.push(unlike(&one_bound, &from_threads(seed, photons, threads as u64)));
                values.push(unlike(&record(&one), &record(&many)));
            }
            Ok(values)
        }),
    })
}

/// Places of photons in equal parts, each of which a thread draws one after the other from a stream of its own.
fn from_threads(seed: u64, photons: u64, threads: u64) -> Vec<[f64; 2]> {
    let part = |thread: u64| {
        let mut stream = Stream::new(seed, Purpose::Synthetic, 0, thread);
        (0..photons / threads).map(move |_| stream.next2())
    };
    (0..threads).flat_map(part).collect()
}

/// Share of records that differ or are missing.
fn unlike<T: PartialEq>(one: &[T], other: &[T]) -> f64 {
    let differ = one.iter().zip(other).filter(|(a, b)| a != b).count();
    (differ + one.len().abs_diff(other.len())) as f64 / one.len() as f64
}
