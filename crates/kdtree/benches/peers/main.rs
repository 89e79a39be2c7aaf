//! This crate's tree beside its peers: same photons, same queries, same job, CPU time of one thread, best of several
//! rounds in which the contestants take turns. Each case is a row; the last line has the geometric means.
//! Queries go to the tree of the default rule; the build that is compared is the median's, as kiddo's is one too.
//!
//! kiddo is measured as compiled here and, by running this bench again with `target-cpu=native` in a target folder of
//! its own, with native flags; the better of the two is the ratio's. nanoflann is measured where a C++ compiler finds
//! its header. `PEERS_PHOTONS` sets the photons (1 000 000), `PEERS_ROUNDS` the rounds (3), `PEERS_INSTRUCTIONS`
//! = `portable` or `avx2` holds our tree back, `PEERS_NATIVE=off` leaves out native kiddo; `PEERS_THREADS`
//! = `2` measures instead what a second thread brings.

mod cases;
mod clock;
mod contestant;
mod grid;
mod kiddo;
mod nanoflann;
mod native;
mod ours;
mod photons;
mod report;
mod rules;
mod threads;

use photonlab_kdtree::{Instructions, SplitRule};

use crate::cases::{Case, Order, cases};
use crate::contestant::Contestant;
use crate::report::{Report, Row};

/// A number from the environment.
fn setting(name: &str, default: usize) -> usize {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

fn instructions() -> Instructions {
    match std::env::var("PEERS_INSTRUCTIONS").as_deref() {
        Ok("portable") => Instructions::Portable,
        Ok("avx2") => Instructions::Avx2,
        _ => Instructions::widest(),
    }
}

/// Best seconds of CPU time of each contestant over rounds in turn, and whether all agreed.
fn race(contestants: &mut [&mut dyn Contestant], case: &Case, set: &photons::PhotonSet, rounds: usize) -> Vec<f64> {
    let queries = case.queries(set);
    let mut best = vec![f64::NAN; contestants.len()];
    let mut expected: Option<contestant::Checksum> = None;
    for _ in 0..rounds {
        for (contestant, best) in contestants.iter_mut().zip(&mut best) {
            let (seconds, sum) = clock::time(|| contestant.run(case.job, queries));
            let Some(sum) = sum else { continue };
            let expected = expected.get_or_insert(sum);
            assert!(sum.agrees(expected), "{case:?} in {}: {sum:?}, not {expected:?}", set.name);
            *best = best.min(seconds);
        }
    }
    best
}

fn main() {
    let (count, rounds) = (setting("PEERS_PHOTONS", 1_000_000), setting("PEERS_ROUNDS", 3));
    let asked = setting("PEERS_QUERIES", 20_000);
    let sets = photons::sets(count, asked);
    if native::is_child() {
        return native::answer(&sets, rounds);
    }
    if let Some(threads) = std::env::var("PEERS_THREADS").ok().and_then(|value| value.parse().ok()) {
        return threads::compare(&sets, threads);
    }
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first pool");
    println!("{count} photons, {asked} queries a case, ours with {:?}", instructions());
    let native = native::ask();
    let mut report = Report::default();
    for set in &sets {
        let mut seconds = [f64::INFINITY; 2];
        for _ in 0..rounds {
            seconds[0] = seconds[0].min(ours::Ours::timed_build(set, SplitRule::Median).0);
            seconds[1] = seconds[1].min(clock::time(|| kiddo::Kiddo::build(set)).0);
        }
        report.add(Row::build(set.name, seconds, native.build(set.name)));

        let mut ours = ours::Ours::build(set, SplitRule::default()).with_instructions(instructions());
        println!("{}: {:?}", set.name, ours.tree.shape());
        rules::compare(set);
        let mut kiddo = kiddo::Kiddo::build(set);
        for k in [50, 100, 200] {
            let radius = cases::typical_radius(&ours, set, k);
            let mut grid = grid::Grid::build(set, radius);
            let nanoflann = nanoflann::measure(set, k, radius, rounds);
            for case in cases(k, radius) {
                let best = race(&mut [&mut ours, &mut kiddo, &mut grid], &case, set, rounds);
                let others = [native.seconds(set.name, &case), nanoflann.seconds(&case)];
                report.add(Row::queries(set.name, &case, asked, best, others));
            }
        }
    }
    if !nanoflann::is_installed() {
        println!("nanoflann: NOT CHECKED (no header)");
    }
    println!("random order is {:?}, coherent {:?}", Order::Random, Order::Coherent);
    report.finish();
}
