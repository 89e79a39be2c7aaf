//! An integrating sphere whose photons are followed by the real tracer.

use std::f64::consts::PI;

use photonlab_photometry::{Colour, Palette};
use photonlab_reference::integrating_sphere::IntegratingSphere;
use photonlab_sampling::{EmissionPlan, Optics, Sought, Stream};
use photonlab_trace::{Classes, Job, Limits, Traced, trace};

use crate::reproduce::lab::Lab;

/// Flux of the lamp in its middle, W.
const FLUX: f64 = 4.0 * PI;

/// A diffuse sphere with a lamp in its middle.
#[derive(Clone)]
pub(super) struct Enclosure {
    sphere: IntegratingSphere<1>,
    radius: f64,
    lab: std::sync::Arc<Lab>,
}

impl Enclosure {
    /// Of a radius in metres.
    pub(super) fn new(radius: f64, reflectance: f64) -> anyhow::Result<Self> {
        let sphere = IntegratingSphere::new(radius, [0.0; 3], Colour([FLUX]), Colour([reflectance]))?;
        let lab = std::sync::Arc::new(Lab::new("integrating sphere", &sphere.xml(), &[])?);
        Ok(Self { sphere, radius, lab })
    }

    /// Flux that meets the wall in all, W.
    pub(super) fn flux_on_wall(&self) -> f64 {
        self.sphere.mean_irradiance()[0] * 4.0 * PI * self.radius * self.radius
    }

    /// The share of it that paths up to so many segments bring.
    pub(super) fn up_to(&self, segments: f64) -> f64 {
        let reflected = self.sphere.indirect_up_to(segments as u32 - 1)[0];
        (self.sphere.mean_direct()[0] + reflected) / self.sphere.mean_irradiance()[0]
    }

    /// Follows photons with a seed drawn from a stream.
    pub(super) fn trace(&self, photons: u64, stream: &mut Stream) -> anyhow::Result<Traced<1>> {
        let optics = Optics::new(&self.lab.world, Palette::Channels);
        let plan = EmissionPlan::new(&optics.lamps, photons, Sought::AsEmitted)?;
        let job = Job { seed: stream.next().to_bits(), pass: 0, limits: Limits::default(), keep: Classes::ALL };
        Ok(trace(&self.lab.world, &optics, &plan, &job)?)
    }
}
