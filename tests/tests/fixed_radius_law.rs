//! The fixed-radius estimate on synthetic photons against its laws (catalogue A1, A4, B1, B2).

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimate, Tests};
use photonlab_measure::Replicates;
use photonlab_reference::{edge_laws, fixed_radius_law};
use photonlab_sampling::Stream;
use photonlab_tests::{Family, Field, column, replicates, seed};
use statrs::distribution::{Discrete, Poisson};

/// Search radius in metres; photons per square metre; photons in a whole disc on average.
const RADIUS: f64 = 0.5;
const DENSITY: f64 = 64.0;
const MU: f64 = DENSITY * PI * RADIUS * RADIUS;

/// Gathers on the floor at points given in search radii.
fn gather<const N: usize>(field: Field, at: [[f64; 2]; N], area: AreaModel) -> [Estimate<1>; N] {
    let at = at.map(|[x, y]| (RADIUS * DVec3::new(x, y, 0.0), DVec3::Z));
    field.gather(at, Bandwidth::Radius(RADIUS), area, &Tests::default())
}

/// A floor lit between two corners given in search radii.
fn floor(low: [f64; 2], high: [f64; 2], stream: &mut Stream) -> Field {
    Field::default().floor(DENSITY, low.map(|x| x * RADIUS), high.map(|x| x * RADIUS), stream)
}

/// A1: a Poisson count over its area.
#[test]
fn in_an_even_field_the_estimate_is_a_poisson_count_over_the_disc() {
    let mut family = Family::new("fixed radius, even field");
    let rows =
        replicates(20_000, seed(1), |stream| gather(floor([-2.5; 2], [2.5; 2], stream), [[0.0; 2]], AreaModel::Disc));
    let estimate = column(&rows, 0);
    family.mean("mean", &estimate, 1.0);
    let squares: Replicates = rows.iter().map(|row| (row[0].irradiance[0] - 1.0).powi(2)).collect();
    family.mean("variance", &squares, fixed_radius_law::poisson_variance(MU));
    let bias: Replicates = rows.iter().map(|row| row[0].bias[0]).collect();
    family.mean("estimated bias", &bias, 0.0);

    let law = Poisson::new(MU).expect("a mean above zero");
    let most = (MU + 10.0 * MU.sqrt()) as usize;
    let mut observed = vec![0u64; most + 1];
    rows.iter().for_each(|row| observed[row[0].photons.min(most)] += 1);
    // Beyond ten standard deviations nothing is expected that a double could hold.
    let expected: Vec<f64> = (0..=most as u64).map(|n| law.pmf(n) * rows.len() as f64).collect();
    family.counts("number of photons", &observed, &expected);

    let count: Replicates = rows.iter().map(|row| row[0].photons as f64).collect();
    family.mean("photons reported", &count, MU);
    family.decide();
}

/// A1 with unequal photons: Campbell's theorem, E[f^2] / (E[f]^2 mu).
#[test]
fn unequal_photons_raise_the_variance_as_campbell_says() {
    let mut family = Family::new("fixed radius, unequal flux");
    // Two interleaved fields: irradiance 1 from many weak photons and 1 from few strong ones.
    let (weak, strong) = (DENSITY, DENSITY / 8.0);
    let rows = replicates(20_000, seed(2), |stream| {
        let reach = 2.5 * RADIUS;
        let field = Field::default().floor(weak, [-reach; 2], [reach; 2], stream);
        gather(field.floor(strong, [-reach; 2], [reach; 2], stream), [[0.0; 2]], AreaModel::Disc)
    });
    family.mean("mean", &column(&rows, 0), 2.0);
    let all = weak + strong;
    let (mean_flux, mean_square) = (2.0 / all, (1.0 / weak + 1.0 / strong) / all);
    let relative = fixed_radius_law::unequal_flux_variance(all * PI * RADIUS * RADIUS, mean_flux, mean_square);
    let squares: Replicates = rows.iter().map(|row| (0.5 * row[0].irradiance[0] - 1.0).powi(2)).collect();
    family.mean("relative variance", &squares, relative);
    family.decide();
}

/// A4: the paper's words taken literally lose exactly three quarters; no relative test would see it.
#[test]
fn the_spheres_whole_area_gives_a_quarter_and_the_disc_the_whole() {
    let mut family = Family::new("sphere's area");
    for (area, factor) in [(AreaModel::Disc, 1.0), (AreaModel::Sphere, 0.25)] {
        let rows = replicates(4000, seed(3), |stream| gather(floor([-2.5; 2], [2.5; 2], stream), [[0.0; 2]], area));
        family.mean(format!("{area:?}"), &column(&rows, 0), factor);
    }
    family.decide();
}

/// B1: inside and outside a straight edge, the dark side included.
#[test]
fn near_a_straight_edge_the_half_plane_law_holds() {
    let mut family = Family::new("half-plane");
    let places = [-0.5, 0.0, 0.1, 0.3, 0.5, 0.75, 0.9, 1.0];
    let rows = replicates(10_000, seed(4), |stream| {
        // The edge is long enough for every query to have its own photons.
        let field = floor([0.0, -2.5], [3.5, 18.5], stream);
        gather(field, std::array::from_fn::<_, 8, _>(|i| [places[i], 2.2 * i as f64]), AreaModel::Disc)
    });
    for (i, t) in places.into_iter().enumerate() {
        family.mean(format!("t = {t}"), &column(&rows, i), edge_laws::half_plane(t));
    }
    family.decide();
}

/// B2: corners at a quarter, strips narrower than the ball, and the flux that a whole rectangle loses.
#[test]
fn corner_strip_and_rectangle_laws_hold() {
    let mut family = Family::new("corner, strip, rectangle");
    let corners = [[0.0, 0.0], [0.0, 0.5], [0.25, 0.25], [0.5, 0.5], [0.25, 0.75], [0.9, 0.9]];
    let rows = replicates(6000, seed(5), |stream| gather(floor([0.0; 2], [3.5; 2], stream), corners, AreaModel::Disc));
    for (i, [a, b]) in corners.into_iter().enumerate() {
        family.mean(format!("corner ({a}, {b})"), &column(&rows, i), edge_laws::corner(a, b));
    }
    let strips = [(0.5, 0.125), (1.0, 0.5), (1.5, 0.75), (2.0, 0.5)];
    for (width, d) in strips {
        let rows = replicates(6000, seed(6), |stream| {
            gather(floor([0.0, -2.5], [width, 2.5], stream), [[d, 0.0]], AreaModel::Disc)
        });
        family.mean(format!("strip {width} at {d}"), &column(&rows, 0), edge_laws::strip(width, d));
    }
    let sides = [2.5, 4.0];
    let rows = replicates(10_000, seed(7), |stream| {
        let at = [[sides[0] * stream.next(), sides[1] * stream.next()]];
        gather(floor([0.0; 2], sides, stream), at, AreaModel::Disc)
    });
    let exact = edge_laws::rectangle_mean(sides[0], sides[1], 1.0);
    family.mean("mean over a rectangle", &column(&rows, 0), exact);
    family.decide();
}
