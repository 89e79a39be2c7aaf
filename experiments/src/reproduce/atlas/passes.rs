//! Readings that are taken for independent and are not.

use photonlab_gather::{Bandwidth, PhotonMap, Scratch, Tests};
use photonlab_measure::Axis;
use photonlab_reference::{
    atlas::{ray_variance, shared_map_variance},
    fixed_radius_law::poisson_variance,
};
use photonlab_sampling::{Purpose, Stream};

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{facing_up, map, read, square},
};

/// Side of the square on which gather rays land, in search radii.
const SIDE: f64 = 4.0;
const BALL: Bandwidth = Bandwidth::Radius(1.0);

fn read_at(map: &PhotonMap<1>, [x, y]: [f64; 2], scratch: &mut Scratch) -> f64 {
    read(map, &facing_up([x, y, 0.0]), BALL, &Tests::default(), scratch)
}

/// Gather rays of one point that read one map.
pub(super) fn shared_map(part: &Part) -> anyhow::Result<Mode> {
    let mu = part.photons;
    Ok(Mode {
        id: "shared-map",
        title: "Final-gather rays that share a map",
        x: Axis::log("gather rays"),
        y: Axis::log("squared error over the irradiance squared"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("error of one map", "covariance of discs that overlap", move |rays| {
                shared_map_variance(mu, rays, SIDE)
            }),
            Curve::off("error as the rays' spread tells it", "covariance of discs that overlap", move |rays| {
                ray_variance(mu, rays, SIDE)
            }),
            Curve::on("a map for every ray", "independent counts (catalogue A1)", move |rays| {
                poisson_variance(mu * rays)
            }),
        ],
        trial: each(move |rays, stream, scratch| {
            let place = |stream: &mut Stream| stream.next2().map(|u| (u - 0.5) * SIDE);
            let shared = map(square(mu, 0.5 * SIDE + 1.0, stream))?;
            let own: Vec<f64> = (0..rays as usize).map(|_| read_at(&shared, place(stream), scratch)).collect();
            let mean = own.iter().sum::<f64>() / rays;
            let spread = own.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (rays - 1.0) / rays;
            let mut apart = 0.0;
            for _ in 0..rays as usize {
                apart += read_at(&map(square(mu, 1.0, stream))?, [0.0; 2], scratch) / rays;
            }
            Ok([(mean - 1.0).powi(2), spread, (apart - 1.0).powi(2)])
        }),
    })
}

/// Passes averaged that were traced with the same random numbers.
pub(super) fn seed_reuse(part: &Part) -> anyhow::Result<Mode> {
    let mu = part.photons;
    Ok(Mode {
        id: "seed-reuse",
        title: "Passes with the same random numbers",
        x: Axis::log("passes"),
        y: Axis::log("squared error over the irradiance squared"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("same seed and pass number", "one pass, however often", move |_| poisson_variance(mu)),
            Curve::on("a pass number of its own", "independent counts (catalogue A1)", move |passes| {
                poisson_variance(mu * passes)
            }),
        ],
        trial: each(move |passes, stream, scratch| {
            // The seed is what this repetition drew; passes differ by their number alone.
            let seed = stream.next().to_bits();
            let mut mean = |number: fn(u32) -> u32| -> anyhow::Result<f64> {
                let mut sum = 0.0;
                for pass in 0..passes as u32 {
                    let mut photons = Stream::new(seed, Purpose::Synthetic, number(pass), 0);
                    sum += read_at(&map(square(mu, 1.0, &mut photons))?, [0.0; 2], scratch);
                }
                Ok((sum / passes - 1.0).powi(2))
            };
            Ok([mean(|_| 0)?, mean(|pass| pass)?])
        }),
    })
}
