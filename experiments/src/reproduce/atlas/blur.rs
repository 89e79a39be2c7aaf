//! Detail finer than the search radius is blurred.

use photonlab_gather::{AreaModel, Bandwidth, Estimator, Kernel, PhotonMap, Scratch, Tests};
use photonlab_measure::Axis;
use photonlab_reference::{
    atlas::fold,
    edge_laws::{half_plane, half_plane_kernel},
    nearest_law::{self, Counted},
};

use super::{
    mode::{Curve, Mode, Part},
    photons::{density, facing_up, map, nearest, read},
};
use crate::reproduce::field::{Field, poisson};

const BALL: Bandwidth = Bandwidth::Radius(1.0);
/// How far from the line light reaches, in search radii: beyond the k nearest where they are sought.
const REACH: f64 = 6.0;

fn with_kernel(map: &PhotonMap<1>, x: f64, kernel: Kernel, scratch: &mut Scratch) -> f64 {
    let estimator = Estimator::new(kernel, AreaModel::Disc);
    map.gather(&facing_up([x, 0.0, 0.0]), BALL, estimator, &Tests::default(), scratch).irradiance[0]
}

/// The straight shadow of a sharp edge, read across.
pub(super) fn shadow_step(part: &Part) -> anyhow::Result<Mode> {
    let k = part.photons;
    Ok(Mode {
        id: "shadow-step",
        title: "Blur of a shadow's edge",
        x: Axis::linear("distance from the shadow's edge over the search radius, lit side positive"),
        y: Axis::linear("reading over the lit irradiance"),
        truth: Some(("truth", Box::new(|x| if x > 0.0 { 1.0 } else { 0.0 }))),
        between: true,
        curves: vec![
            Curve::off("fixed radius", "half-plane (catalogue B1)", half_plane),
            Curve::off("k nearest", "k nearest beside a half-plane (catalogue B3)", move |x| {
                nearest_law::half_plane(k as u32, x, Counted::AllButLast).mean
            }),
            Curve::on("biweight kernel", "half-plane with a kernel (catalogue B1)", |x| half_plane_kernel(x, 2)),
        ],
        trial: Box::new(move |sweep, stream, scratch| {
            let map = map(Field::uniform(density(k), [0.0, -0.5 * REACH], [0.6 * REACH, 0.5 * REACH], stream))?;
            let mut values = Vec::new();
            for &x in sweep {
                let at = facing_up([x, 0.0, 0.0]);
                values.push(read(&map, &at, BALL, &Tests::default(), scratch));
                values.push(read(&map, &at, nearest(k), &Tests::default(), scratch));
                values.push(with_kernel(&map, x, Kernel::Biweight, scratch));
            }
            Ok(values)
        }),
    })
}

/// The fold of a caustic, irradiance one over the root of the distance, read across.
pub(super) fn caustic_fold(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    Ok(Mode {
        id: "caustic-fold",
        title: "Blur of a caustic's fold",
        x: Axis::linear("distance from the fold over the search radius, lit side positive"),
        y: Axis::linear("reading over the irradiance one radius inside the fold"),
        // Drawn up to where it leaves the readings far below; on the fold it is infinite.
        truth: Some(("truth", Box::new(|x| if x < 0.12 { f64::INFINITY } else { x.powf(-0.5) }))),
        between: true,
        curves: vec![
            Curve::off("disc", "blurred fold, by quadrature", |x| fold(x, 0)),
            Curve::on("Epanechnikov kernel", "blurred fold, by quadrature", |x| fold(x, 1)),
            Curve::on("biweight kernel", "blurred fold, by quadrature", |x| fold(x, 2)),
        ],
        trial: Box::new(move |sweep, stream, scratch| {
            let mut field = Field::default();
            // The irradiance over a strip of this length and of the width 2.
            let flux = 2.0 * REACH.sqrt() * 2.02;
            for _ in 0..poisson(density(photons) * flux, stream) {
                let [u, v] = stream.next2();
                field.push([REACH * u * u, 2.02 * (v - 0.5), 0.0], [0.0, 0.0, 1.0], 1.0 / density(photons));
            }
            let map = map(field)?;
            let kernels = [Kernel::Disc, Kernel::Epanechnikov, Kernel::Biweight];
            let at = |&x: &f64| kernels.map(|kernel| with_kernel(&map, x, kernel, scratch));
            Ok(sweep.iter().flat_map(at).collect())
        }),
    })
}
