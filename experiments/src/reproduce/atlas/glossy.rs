//! A glossy receiver.

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimator, Kernel, Surroundings};
use photonlab_measure::Axis;
use photonlab_photometry::Photon;
use photonlab_reference::{atlas::lobe_variance_factor, fixed_radius_law::poisson_variance};

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{NO_TEST, diffuse, facing_up, map, square},
};

/// Photons weighed by a Phong lobe around the normal, as an eye on the normal sees them.
struct Lobe(f64);

impl Surroundings<Photon<1>> for Lobe {
    fn weigh(&self, photon: &Photon<1>) -> f64 {
        let direction = DVec3::from(photon.direction.unpack().map(f64::from));
        // Over its mean for diffuse light, 2 / (n + 2).
        (-direction.z).max(0.0).powf(self.0) * 0.5 * (self.0 + 2.0)
    }
}

/// The narrower the lobe, the fewer of the photons near the point tell anything.
pub(super) fn receiver(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    Ok(Mode {
        id: "glossy-receiver",
        title: "Glossy receiver",
        x: Axis::log("exponent of the receiver's lobe"),
        y: Axis::log("squared error over the radiance squared"),
        truth: None,
        between: true,
        curves: vec![Curve::off("gathered", "sum of unequal weights (catalogue A1)", move |exponent| {
            lobe_variance_factor(exponent) * poisson_variance(photons)
        })],
        trial: each(move |exponent, stream, scratch| {
            let mut field = square(photons, 1.0, stream);
            diffuse(&mut field, stream);
            let (map, at) = (map(field)?, facing_up([0.0; 3]));
            let estimator = Estimator::new(Kernel::Disc, AreaModel::Disc);
            let ball = Bandwidth::Radius(1.0);
            let value = map.gather_among(&at, ball, estimator, &NO_TEST, &Lobe(exponent), scratch).irradiance[0];
            Ok([(value - 1.0).powi(2)])
        }),
    })
}
