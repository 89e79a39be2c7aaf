//! A thin diffusing sheet with different light on each side.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimator, GatherPoint, PhotonMap, Scratch, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_measure::Replicates;
use photonlab_photometry::Palette;
use photonlab_readout::{Aids, Direct, Draws, Method, PassPhotons, Settings, trace_pass};
use photonlab_reference::rendering_equation::{DiffuseTransmitter, EquationReading};
use photonlab_sampling::{Optics, Sought, Stream, warp};
use photonlab_trace::{Classes, Limits};
use serde::Deserialize;

use super::{field::stream, lab::Lab};

/// What [`SheetReadings`] holds.
pub(super) const QUANTITIES: usize = 7;
/// Gather radius, metres; the sheet is 2 m wide and evenly lit.
const RADIUS: f64 = 0.5;
const SHEET_AREA: f64 = 4.0;
/// Outgoing photons are counted where the cosine is at least this: a cone around the normal.
const CONE: f64 = 0.8;

/// The sheet, its light and how often it is read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sheet {
    pub(super) seed: u64,
    pub(super) replicates: u32,
    /// Emitted per replicate.
    photons: u64,
    pub(super) reflectance: f64,
    pub(super) transmittance: f64,
    /// On front and back, W/m^2.
    pub(super) irradiance: [f64; 2],
}

/// Readings over independent maps.
#[derive(Default)]
pub(super) struct SheetReadings {
    /// Irradiance, W/m^2.
    pub(super) front: Replicates,
    pub(super) back: Replicates,
    /// On the front without any test.
    pub(super) both: Replicates,
    /// Radiance of the front, W/(m^2 sr): flux that leaves within a cone, per area and projected solid angle.
    pub(super) counted: Replicates,
    /// Equation 1 on the irradiances measured.
    pub(super) luminance_factor: Replicates,
    pub(super) per_steradian: Replicates,
    pub(super) signed_cosine: Replicates,
}

/// Traces photons onto the sheet and reads it.
pub(super) fn read(p: &Sheet, sheet: &DiffuseTransmitter) -> anyhow::Result<SheetReadings> {
    let lab = Lab::new("sheet.xml", &xml(p), &[])?;
    let optics = Optics::<1>::new(&lab.world, Palette::Channels);
    let settings = Settings {
        method: Method::Radius { radius: Some(RADIUS) },
        direct: Direct::Photons,
        estimator: Estimator::default(),
        gather_rays: 1,
        aids: Aids::default(),
        draws: Draws::Independent,
        seed: p.seed,
        limits: Limits::default(),
    };
    let mut readings = SheetReadings::default();
    for pass in 0..p.replicates {
        let photons = trace_pass(&lab.world, &optics, &settings, (Sought::AsEmitted, Classes::ALL), pass, p.photons)?;
        readings.counted.push(count_outgoing(p, &photons, &mut stream(p.seed, u64::from(pass))));
        let map = PhotonMap::build(photons.positions, photons.photons, SplitRule::Median)?;
        let irradiance = |up: f32, tests| {
            let at = GatherPoint { position: [0.0; 3], normal: [0.0, 0.0, up] };
            map.gather(&at, Bandwidth::Radius(RADIUS), AreaModel::Disc, &tests, &mut Scratch::default()).irradiance[0]
        };
        let (front, back) = (irradiance(1.0, Tests::default()), irradiance(-1.0, Tests::default()));
        readings.front.push(front);
        readings.back.push(back);
        readings.both.push(irradiance(1.0, Tests { normal: false, side: false, max_segments: None }));
        for (reading, values) in [
            (EquationReading::LuminanceFactor, &mut readings.luminance_factor),
            (EquationReading::PerSteradian, &mut readings.per_steradian),
            (EquationReading::SignedCosine, &mut readings.signed_cosine),
        ] {
            values.push(sheet.read(reading, front, back));
        }
    }
    Ok(readings)
}

/// Lets every photon that arrived leave as the sheet's shares say, by cosine, and counts the front's radiance: no
/// equation, flux alone.
fn count_outgoing(p: &Sheet, photons: &PassPhotons<1>, random: &mut Stream) -> f64 {
    let mut flux = 0.0;
    for photon in &photons.photons {
        let came_to_front = photon.normal.unpack()[2] > 0.0;
        let fate = random.next();
        let direction = warp::square_to_cosine_hemisphere(random.next2(), DVec3::Z);
        let leaves_front =
            if fate < p.reflectance { came_to_front } else { fate < p.reflectance + p.transmittance && !came_to_front };
        if leaves_front && direction.z >= CONE {
            flux += f64::from(photon.flux[0]);
        }
    }
    let projected_solid_angle = PI * (1.0 - CONE * CONE);
    flux / (SHEET_AREA * projected_solid_angle)
}

/// The square [-1, 1]^2 in parallel light from above (front) and below; what it reflects meets nothing more.
fn xml(p: &Sheet) -> String {
    let lamp = |z: f64, irradiance: f64| {
        format!(
            "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"0\" z=\"{z}\"/>\
             <rgb name=\"irradiance\" value=\"{irradiance}\"/></emitter>"
        )
    };
    let [front, back] = p.irradiance;
    format!(
        "<scene version=\"3.0.0\">{}{}<shape type=\"rectangle\"><bsdf type=\"twosided\"><bsdf type=\"diffuse\">\
         <rgb name=\"reflectance\" value=\"{}\"/></bsdf></bsdf></shape></scene>",
        lamp(-1.0, front),
        lamp(1.0, back),
        p.reflectance
    )
}
