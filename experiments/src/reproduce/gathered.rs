//! Final gather in the integrating sphere at several numbers of rays.

use photonlab_gather::Estimator;
use photonlab_measure::Replicates;
use photonlab_readout::{Cell, Wanted};
use photonlab_reference::convergence::gathered_sphere::GatheredSphere;
use serde::Deserialize;

use super::{
    decay::{Decay, Step},
    lab::Lab,
    strategy::Strategy,
};

const SPHERE: &str = include_str!("../../scenes/integrating-sphere.xml");
const SOURCE: &str = "rays share the photons, whose hits are geometric numbers";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Parameters {
    pub(super) reflectance: f64,
    /// Emitted in each replicate.
    pub(super) photons: u64,
    /// Metres.
    pub(super) radius: f64,
    /// Where rays rule the error, ascending.
    few_rays: Vec<u64>,
    /// The same where photons do at last.
    many_rays: Vec<u64>,
    pub(super) replicates: u64,
}

/// Squared errors with few rays and with many.
pub(super) fn measure(p: &Parameters, seed: u64) -> anyhow::Result<[Decay; 2]> {
    let lab = Lab::new("integrating-sphere.xml", SPHERE, &[("rho", &p.reflectance.to_string())])?;
    let cells = Cell::of_meters(&lab.world.scene);
    let law = GatheredSphere {
        reflectance: p.reflectance,
        photons: p.photons as f64,
        radius: p.radius,
        variance_factor: Estimator::default().kernel.variance_factor(),
    };
    let step = |rays: u64, part: u64| -> anyhow::Result<Step> {
        let wanted = Wanted { photons: Some(p.photons), passes: Some(1), samples: Some(rays), ..Wanted::default() };
        let mut squared = Replicates::new();
        for replicate in 0..p.replicates {
            let settings = Strategy::FINAL_GATHER.within(p.radius).settings(seed + (part << 32 | replicate));
            let outcome = lab.read::<1>(&cells, settings, &wanted, 0.99)?;
            let value = outcome.cells[0].value[0].mean().unwrap_or(f64::NAN);
            squared.push((value - law.irradiance()).powi(2));
        }
        let effort = rays as f64;
        Ok(Step { effort, setting: p.radius, squared, law: law.variance(effort) })
    };
    let decay = |name, limit, rays: &[u64], first: u64| -> anyhow::Result<Decay> {
        let steps = rays.iter().zip(first..).map(|(&rays, part)| step(rays, part)).collect::<anyhow::Result<_>>()?;
        Ok(Decay { name, source: SOURCE, limit, steps })
    };
    Ok([
        decay("final gather, few rays", -1.0, &p.few_rays, 1)?,
        decay("final gather, many rays", 0.0, &p.many_rays, 1001)?,
    ])
}
