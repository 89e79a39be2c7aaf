//! What a photon map reads where it fails: one law for each way of failing that the other laws do not cover.
//!
//! Lengths in search radii and readings over the true irradiance unless a law says otherwise. Each law is checked here by
//! quadrature or by a simulation of its own before it judges anything.

mod bins;
mod clusters;
mod colours;
mod counting;
mod coverage;
mod fog;
mod fold;
mod glossy;
mod norms;
mod roulette;
mod self_hit;
mod shading;
mod shared_map;
mod side_test;
mod small_sphere;
mod starved;
mod unseen;
mod wrong_radius;

pub use bins::bin_reading;
pub use clusters::{clusters_by_nearest, clusters_by_radius};
pub use colours::{rare_by_nearest, rare_by_radius};
pub use counting::{both_sides, direct_left_out, direct_twice, thread_bound};
pub use coverage::{Counts, Intervals};
pub use fog::{exponential_over_ball, exponential_over_two_balls, share_of_ball};
pub use fold::fold;
pub use glossy::lobe_variance_factor;
pub use norms::{cone_norm, printed_gaussian};
pub use roulette::{unweighted_total, weighted_variance};
pub use self_hit::{lost_per_bounce, total_with_losses};
pub use shading::without_factor;
pub use shared_map::{mean_overlap, ray_variance, shared_map_variance};
pub use side_test::{crease_with_side_test, seen_from_both};
pub use small_sphere::SmallSphere;
pub use starved::starved_from;
pub use unseen::{disc_by_cosine, keyhole};
pub use wrong_radius::BentField;
