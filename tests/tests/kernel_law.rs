//! Density estimates with a kernel on synthetic photons against their laws (catalogue A3, A5, B1).

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimate, Estimator, Kernel, Tests};
use photonlab_measure::Replicates;
use photonlab_reference::{
    edge_laws,
    kernel_law::{self, KernelUsed},
};
use photonlab_tests::{Family, Field, column, replicates, seed};

/// Search radius in metres; photons per square metre; photons in a whole disc on average.
const RADIUS: f64 = 0.5;
const DENSITY: f64 = 64.0;
const MU: f64 = DENSITY * PI * RADIUS * RADIUS;

const KERNELS: [(Kernel, KernelUsed); 5] = [
    (Kernel::Disc, KernelUsed::Disc),
    (Kernel::Cone, KernelUsed::Cone),
    (Kernel::Epanechnikov, KernelUsed::Epanechnikov),
    (Kernel::Biweight, KernelUsed::Biweight),
    (Kernel::Gaussian, KernelUsed::Gaussian),
];

fn gather<const N: usize>(field: Field, at: [f64; N], bandwidth: Bandwidth, kernel: Kernel) -> [Estimate<1>; N] {
    let at = at.map(|x| (DVec3::new(x, 0.0, 0.0), DVec3::Z));
    field.gather(at, bandwidth, Estimator::new(kernel, AreaModel::Disc), &Tests::default())
}

fn squares(rows: &[[Estimate<1>; 1]], mean: f64) -> Replicates {
    rows.iter().map(|row| (row[0].irradiance[0] - mean).powi(2)).collect()
}

/// A3: every kernel is normalised in the plane, and its noise is Campbell's.
#[test]
fn in_even_light_every_kernel_reads_the_truth_with_its_own_noise() {
    let mut family = Family::new("kernels, even field");
    for (i, (kernel, law)) in KERNELS.into_iter().enumerate() {
        let rows = replicates(10_000, seed(1500 + i as u32), |stream| {
            let field = Field::default().floor(DENSITY, [-2.5 * RADIUS; 2], [2.5 * RADIUS; 2], stream);
            gather(field, [0.0], Bandwidth::Radius(RADIUS), kernel)
        });
        family.mean(format!("{kernel:?}: mean"), &column(&rows, 0), 1.0);
        family.mean(format!("{kernel:?}: variance"), &squares(&rows, 1.0), law.variance_factor() / MU);
    }
    family.decide();
}

/// A3: in a quadratic field the bias is `m2` times the bend, and the second ball's estimate of it is unbiased.
#[test]
fn in_curved_light_every_kernel_is_off_by_its_second_moment_and_says_so() {
    let mut family = Family::new("kernels, curved field");
    let bend = 0.8;
    for (i, (kernel, law)) in KERNELS.into_iter().enumerate() {
        let rows = replicates(20_000, seed(1510 + i as u32), |stream| {
            let field = Field::default().floor(DENSITY, [-2.5 * RADIUS; 2], [2.5 * RADIUS; 2], stream);
            let field = field.shaded(|at| 1.0 + bend * at.truncate().length_squared() / (RADIUS * RADIUS));
            gather(field, [0.0], Bandwidth::Radius(RADIUS), kernel)
        });
        let exact = kernel_law::quadratic(law, bend);
        family.mean(format!("{kernel:?}: mean"), &column(&rows, 0), exact);
        let bias: Replicates = rows.iter().map(|row| row[0].bias[0]).collect();
        family.mean(format!("{kernel:?}: estimated bias"), &bias, exact - 1.0);
    }
    family.decide();
}

/// A5: with the k-th photon's radius every kernel is unbiased without a further factor.
#[test]
fn over_the_kth_photons_radius_every_kernel_is_unbiased() {
    let mut family = Family::new("kernels, nearest");
    let k = 12;
    let reach = 3.5 * (f64::from(k) / (PI * DENSITY)).sqrt();
    for (i, (kernel, law)) in KERNELS.into_iter().enumerate() {
        let rows = replicates(20_000, seed(1520 + i as u32), |stream| {
            let field = Field::default().floor(DENSITY, [-reach; 2], [reach; 2], stream);
            gather(field, [0.0], Bandwidth::Nearest { k: k as usize, max_radius: f64::INFINITY }, kernel)
        });
        family.mean(format!("{kernel:?}: mean"), &column(&rows, 0), 1.0);
        family.mean(format!("{kernel:?}: variance"), &squares(&rows, 1.0), kernel_law::nearest_variance(law, k));
        let bias: Replicates = rows.iter().map(|row| row[0].bias[0]).collect();
        family.mean(format!("{kernel:?}: estimated bias"), &bias, 0.0);
    }
    family.decide();
}

/// B1 with the kernels `(1 - rho^2)^n`: what is missing beyond an edge is weighed less.
#[test]
fn near_a_straight_edge_kernels_lose_what_the_law_says() {
    let mut family = Family::new("kernels, half-plane");
    let places = [0.0, 0.25, 0.5, 0.75];
    for (n, kernel) in [Kernel::Disc, Kernel::Epanechnikov, Kernel::Biweight].into_iter().enumerate() {
        let rows = replicates(10_000, seed(1530 + n as u32), |stream| {
            let field = Field::default().floor(DENSITY, [0.0, -2.5 * RADIUS], [3.5 * RADIUS, 2.5 * RADIUS], stream);
            gather(field, places.map(|t| t * RADIUS), Bandwidth::Radius(RADIUS), kernel)
        });
        for (i, t) in places.into_iter().enumerate() {
            let exact = edge_laws::half_plane_kernel(t, n as u32);
            family.mean(format!("{kernel:?}, t = {t}"), &column(&rows, i), exact);
        }
    }
    family.decide();
}
