//! The k-nearest estimate on synthetic photons against its laws (catalogue A2, A6, B3).

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimate, Tests};
use photonlab_measure::Replicates;
use photonlab_reference::nearest_law::{self, Counted};
use photonlab_tests::{Family, Field, column, replicates, seed};
use statrs::function::gamma::gamma_lr;

/// Photons per square metre.
const DENSITY: f64 = 64.0;

/// The search radius in the flat field, `sqrt(k / (pi lambda))`, metres.
fn flat_radius(k: u32) -> f64 {
    (f64::from(k) / (PI * DENSITY)).sqrt()
}

fn nearest(k: u32) -> Bandwidth {
    Bandwidth::Nearest { k: k as usize, max_radius: f64::INFINITY }
}

fn gather<const N: usize>(field: Field, at: [f64; N], bandwidth: Bandwidth) -> [Estimate<1>; N] {
    let at = at.map(|x| (DVec3::new(x, 0.0, 0.0), DVec3::Z));
    field.gather(at, bandwidth, AreaModel::Disc, &Tests::default())
}

/// A2: mean 1 (not k / (k - 1)), variance 1 / (k - 2), and lambda pi r_k^2 from Gamma(k, 1).
#[test]
fn in_an_even_field_the_squared_radius_follows_the_gamma_law() {
    let mut family = Family::new("nearest, even field");
    for k in [10, 20, 50] {
        let reach = 3.5 * flat_radius(k);
        let rows = replicates(20_000, seed(20 + k), |stream| {
            let field = Field::default().floor(DENSITY, [-reach; 2], [reach; 2], stream);
            gather(field, [0.0], nearest(k))
        });
        let law = nearest_law::uniform(k, Counted::AllButLast);
        family.mean(format!("k = {k}: mean"), &column(&rows, 0), law.mean);
        let squares: Replicates = rows.iter().map(|row| (row[0].irradiance[0] - 1.0).powi(2)).collect();
        family.mean(format!("k = {k}: variance"), &squares, law.variance);
        let counted: Replicates = rows.iter().map(|row| row[0].photons as f64).collect();
        family.mean(format!("k = {k}: photons"), &counted, f64::from(k - 1));
        let areas: Vec<f64> = rows.iter().map(|row| DENSITY * PI * row[0].radius.powi(2)).collect();
        family.distribution(format!("k = {k}: radius"), &areas, |g| gamma_lr(f64::from(k), g));
    }
    family.decide();
}

/// A6: with fewer than k photons within the largest radius the estimate is over that radius, which keeps it unbiased.
#[test]
fn a_starved_query_divides_by_the_largest_radius() {
    let mut family = Family::new("nearest, starved");
    let k = 20;
    for mu in [5.0, 18.0] {
        let max_radius = (mu / (PI * DENSITY)).sqrt();
        let reach = 2.5 * max_radius;
        let rows = replicates(20_000, seed(80 + mu as u32), |stream| {
            let field = Field::default().floor(DENSITY, [-reach; 2], [reach; 2], stream);
            gather(field, [0.0], Bandwidth::Nearest { k: k as usize, max_radius })
        });
        let law = nearest_law::capped(k, mu, Counted::AllButLast);
        family.mean(format!("mu = {mu}"), &column(&rows, 0), law);
    }
    family.decide();
}

/// B3: 1/2 at the edge for every k, and the exact law inside it.
#[test]
fn near_a_straight_edge_the_exact_law_holds() {
    let mut family = Family::new("nearest, half-plane");
    for k in [20, 50] {
        let r0 = flat_radius(k);
        let places = [0.0, 0.25, 0.5, 0.75, 1.25];
        let rows = replicates(20_000, seed(100 + k), |stream| {
            let field = Field::default().floor(DENSITY, [0.0, -4.5 * r0], [5.5 * r0, 4.5 * r0], stream);
            gather(field, places.map(|d| d * r0), nearest(k))
        });
        for (i, d) in places.into_iter().enumerate() {
            let law = nearest_law::half_plane(k, d, Counted::AllButLast);
            family.mean(format!("k = {k}, d = {d}"), &column(&rows, i), law.mean);
        }
    }
    family.decide();
}
