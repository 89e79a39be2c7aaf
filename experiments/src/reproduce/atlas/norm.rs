//! Kernels that are not divided by their own norm.

use photonlab_gather::{Bandwidth, Tests};
use photonlab_measure::Axis;
use photonlab_reference::atlas::{cone_norm, printed_gaussian};

use super::{
    mode::{Curve, Law, Mode, Part, each},
    photons::{facing_up, map, read, square},
};
use crate::reproduce::field::Field;

/// A cone without the factor that belongs to it.
pub(super) fn cone(part: &Part) -> anyhow::Result<Mode> {
    let x = "k of the cone 1 - rho / k";
    with_weight(("cone-norm", "Cone filter without its norm", x), part, Box::new(cone_norm), |k, square| {
        1.0 - square.sqrt() / k
    })
}

/// The Gaussian filter as printed, taken for normalised.
pub(super) fn gaussian(part: &Part) -> anyhow::Result<Mode> {
    let x = "beta of the Gaussian; 1.953 is printed";
    let title = "Gaussian filter taken for normalised";
    with_weight(("gaussian-norm", title, x), part, Box::new(printed_gaussian), |beta, square| {
        0.918 * (1.0 - (-0.5 * beta * square).exp_m1() / (-beta).exp_m1())
    })
}

/// Photons weighed by the swept parameter and their squared distance, over the plain disc and over the norm too.
fn with_weight(
    (id, title, x): (&'static str, &'static str, &str),
    part: &Part,
    norm: Law,
    weight: impl Fn(f64, f64) -> f64 + Send + Sync + Copy + 'static,
) -> anyhow::Result<Mode> {
    let photons = part.photons;
    let norm = std::sync::Arc::new(norm);
    let own = norm.clone();
    Ok(Mode {
        id,
        title,
        x: Axis::linear(x),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("over pi r^2", "norm of the kernel (catalogue A3)", move |x| norm(x)),
            Curve::on("over its norm times pi r^2", "even light", |_| 1.0),
        ],
        trial: each(move |x, stream, scratch| {
            let mut field: Field = square(photons, 1.0, stream);
            for (position, photon) in field.positions.iter().zip(&mut field.photons) {
                let square = f64::from(position[0]).powi(2) + f64::from(position[1]).powi(2);
                photon.flux[0] *= weight(x, square) as f32;
            }
            let map = map(field)?;
            let value = read(&map, &facing_up([0.0; 3]), Bandwidth::Radius(1.0), &Tests::default(), scratch);
            Ok([value, value / own(x)])
        }),
    })
}
