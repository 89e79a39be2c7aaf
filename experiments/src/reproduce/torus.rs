//! Independent photons on the unit torus: of a whole set, those that lie where they can be read.
//!
//! A set of N independent photons has a binomial number of them in any region, and there they are independent again: the others need
//! not be made.

use std::f64::consts::PI;

use photonlab_gather::{AreaModel, Bandwidth, Estimator, GatherPoint, Kernel, PhotonMap, Scratch, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_reference::convergence::{cosine_torus, half_lit_torus};
use photonlab_sampling::Stream;

use super::field::Field;

/// The paper's estimate, without a second ball that would tell its bias.
const ESTIMATOR: Estimator = Estimator { kernel: Kernel::Disc, area: AreaModel::Disc, tells_bias: false };
const UP: [f64; 3] = [0.0, 0.0, 1.0];
/// A region is this much wider than a radius, so that rounding leaves no photon out.
const MARGIN: f64 = 1.01;
/// Points that an image's row has to each radius: the edges' bias is known by many of them.
const POINTS_PER_RADIUS: f64 = 4.0;

/// Reads the irradiance `1 + cos(2 pi x) cos(2 pi y) / 2` at its brightest point, the origin, from `photons` photons.
pub(super) fn read_crest(
    photons: u64,
    bandwidth: Bandwidth,
    stream: &mut Stream,
    scratch: &mut Scratch,
) -> anyhow::Result<f64> {
    let field = around_crest(photons, half_side(photons, bandwidth), stream);
    let map = PhotonMap::build(field.positions, field.photons, SplitRule::Median)?;
    Ok(gather(&map, [0.0; 2], bandwidth, scratch))
}

/// Mean squared error along one row of an image of the half-lit torus, at a random height, from `photons` photons. All rows are alike
/// in the mean, so that its mean is that of the image.
pub(super) fn read_row(photons: u64, radius: f64, stream: &mut Stream, scratch: &mut Scratch) -> anyhow::Result<f64> {
    anyhow::ensure!(radius < half_lit_torus::WIDEST, "discs of {radius} m reach both edges");
    let half = MARGIN * radius;
    let mut field = Field::default();
    for _ in 0..binomial(photons, 2.0 * half, stream) {
        let [u, v] = stream.next2();
        field.push([0.5 * u, (2.0 * v - 1.0) * half, 0.0], UP, 1.0 / photons as f64);
    }
    let map = PhotonMap::build(field.positions, field.photons, SplitRule::Median)?;
    let points = (POINTS_PER_RADIUS / radius).ceil();
    let offset = stream.next();
    let mut sum = 0.0;
    for point in 0..points as u32 {
        // From the middle of the dark half to itself: no disc reaches around the torus.
        let x = (f64::from(point) + offset) / points - 0.25;
        let truth = if (0.0..0.5).contains(&x) { 2.0 } else { 0.0 };
        sum += (gather(&map, [x, 0.0], Bandwidth::Radius(radius), scratch) - truth).powi(2);
    }
    Ok(sum / points)
}

fn gather(map: &PhotonMap<1>, [x, y]: [f64; 2], bandwidth: Bandwidth, scratch: &mut Scratch) -> f64 {
    let at = GatherPoint { position: [x as f32, y as f32, 0.0], normal: [0.0, 0.0, 1.0] };
    map.gather(&at, bandwidth, ESTIMATOR, &Tests::default(), scratch).irradiance[0]
}

/// Half the side of a square that holds all that a search can find (the k nearest but once in 10^12 sets).
fn half_side(photons: u64, bandwidth: Bandwidth) -> f64 {
    let radius = match bandwidth {
        Bandwidth::Radius(radius) => radius,
        Bandwidth::Nearest { k, .. } => {
            let certain = k as f64 + 8.0 * (k as f64).sqrt() + 30.0;
            cosine_torus::radius_of(certain / photons as f64)
        }
    };
    (MARGIN * radius).min(0.5)
}

/// Those of `photons` photons in a square around the origin, by rejection.
fn around_crest(photons: u64, half: f64, stream: &mut Stream) -> Field {
    let wave = |x: f64| (2.0 * PI * x).cos();
    let mut field = Field::default();
    for _ in 0..binomial(photons, share_of_square(half), stream) {
        loop {
            let [x, y] = stream.next2().map(|u| (2.0 * u - 1.0) * half);
            if cosine_torus::TRUTH * stream.next() < 1.0 + 0.5 * wave(x) * wave(y) {
                field.push([x, y, 0.0], UP, 1.0 / photons as f64);
                break;
            }
        }
    }
    field
}

/// Share of the light in the square of this half side around the origin.
fn share_of_square(half: f64) -> f64 {
    4.0 * half * half + 0.5 * ((2.0 * PI * half).sin() / PI).powi(2)
}

/// How many of independent trials succeed, each with the probability `share`: by the waiting times between them, which are geometric.
fn binomial(trials: u64, share: f64, stream: &mut Stream) -> u64 {
    if share >= 1.0 {
        return trials;
    }
    let per_logarithm = 1.0 / (-share).ln_1p();
    let (mut count, mut place) = (0, 0.0);
    loop {
        place += (stream.next().ln() * per_logarithm).floor() + 1.0;
        if place > trials as f64 {
            return count;
        }
        count += 1;
    }
}

#[cfg(test)]
mod tests {
    use photonlab_measure::Replicates;

    use super::*;
    use crate::reproduce::field::stream;

    /// Mean and variance of a binomial number, and of the photons in a disc of the square they are made in; 6 comparisons at 4.5
    /// standard errors.
    #[test]
    fn counts_are_binomial() {
        let mut random = stream(144, 0);
        for (trials, share) in [(40, 0.02), (40, 0.7), (3000, 0.1)] {
            let expected = trials as f64 * share;
            let counts: Vec<f64> = (0..20_000).map(|_| binomial(trials, share, &mut random) as f64).collect();
            must_agree(counts.iter().copied().collect(), expected);
            must_agree(counts.iter().map(|n| (n - expected).powi(2)).collect(), expected * (1.0 - share));
        }
        assert_eq!(binomial(17, 1.0, &mut random), 17);
    }

    /// The square holds the share of light that its photons have in a disc of it, whatever its size; 3 comparisons at 4.5 standard errors.
    #[test]
    fn squares_hold_their_share() {
        let (mut random, radius) = (stream(145, 0), 0.2);
        for half in [0.2, 0.31, 0.5] {
            let within =
                |field: Field| field.positions.iter().filter(|p| f64::from(p[0].hypot(p[1])) < radius).count() as f64;
            let counts = (0..3000).map(|_| within(around_crest(500, half, &mut random))).collect();
            must_agree(counts, 500.0 * cosine_torus::share(radius));
        }
        assert!((share_of_square(0.5) - 1.0).abs() < 1e-15);
    }

    fn must_agree(values: Replicates, expected: f64) {
        let z = (values.mean().expect("values") - expected) / values.std_error().expect("values");
        assert!(z.abs() < 4.5, "{expected}: {z}");
    }
}
