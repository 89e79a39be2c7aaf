//! A closed cube whose walls all emit and reflect alike, read as the command reads scenes.

use photonlab_gather::Estimator;
use photonlab_measure::{Interval, Row};
use photonlab_photometry::Colour;
use photonlab_readout::{Aids, Cell, Direct, Method, Settings, Wanted};
use photonlab_reference::furnace::Furnace;
use photonlab_trace::Limits;
use serde::Deserialize;

use super::{lab::Lab, table::row};

/// Half the cube's edge, metres.
const HALF_EDGE: f64 = 1.0;
/// Emitted radiance, W/(m^2 sr).
const EMITTED: f64 = 1.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Parameters {
    pub(super) seed: u64,
    pub(super) reflectances: Vec<f64>,
    /// Where meters look: places of a face in half-edges from its centre.
    pub(super) places: Vec<[f64; 2]>,
    /// Of the radius method, metres: twice as far, nothing else is near any place.
    radius: f64,
    photons: u64,
    passes: u64,
    samples: u64,
}

impl Parameters {
    /// The methods that read it.
    pub(super) fn methods(&self) -> [Method; 3] {
        [Method::Path, Method::Radius { radius: Some(self.radius) }, Method::FinalGather { radius: None }]
    }

    /// Readings in all.
    pub(super) fn readings(&self) -> usize {
        self.methods().len() * self.reflectances.len() * self.places.len()
    }
}

/// The radiance at one place.
pub(super) struct FurnaceReading {
    pub(super) reflectance: f64,
    pub(super) method: Method,
    place: [f64; 2],
    photons: f64,
    /// Over the emitted radiance; its interval holds the method's own bound on its bias.
    pub(super) measured: Option<Interval>,
}

/// Reads every furnace with every method.
pub(super) fn read(p: &Parameters, confidence: f64) -> anyhow::Result<Vec<FurnaceReading>> {
    let mut readings = Vec::with_capacity(p.readings());
    for &reflectance in &p.reflectances {
        let furnace = Furnace::<1>::new(Colour([EMITTED]), Colour([reflectance]))?;
        let lab = Lab::new("furnace.xml", &furnace.cube_xml(HALF_EDGE, &p.places), &[])?;
        let cells = Cell::of_meters(&lab.world.scene);
        for method in p.methods() {
            let settings = Settings {
                method,
                direct: Direct::Photons,
                estimator: Estimator::default(),
                gather_rays: 1,
                aids: Aids::default(),
                draws: method.usual_draws(),
                seed: p.seed,
                limits: Limits::default(),
            };
            let wanted = Wanted {
                photons: Some(p.photons),
                passes: Some(p.passes),
                samples: Some(p.samples),
                ..Wanted::default()
            };
            let outcome = lab.read::<1>(&cells, settings, &wanted, confidence)?;
            for (cell, &place) in outcome.cells.iter().zip(&p.places) {
                let value = cell.value[0].mean().zip(cell.half_width(0, confidence));
                let measured =
                    value.map(|(value, half)| Interval::around(value, half, confidence).scaled(1.0 / EMITTED));
                readings.push(FurnaceReading { reflectance, method, place, photons: cell.photons, measured });
            }
        }
    }
    Ok(readings)
}

impl FurnaceReading {
    /// Radiance over emitted radiance.
    pub(super) fn truth(&self) -> f64 {
        1.0 / (1.0 - self.reflectance)
    }

    pub(super) fn name(&self) -> String {
        let [u, v] = self.place;
        format!("furnace rho = {}, {}, at ({u}, {v})", self.reflectance, self.method.name())
    }

    pub(super) fn row(&self) -> Row {
        row([
            ("case", self.name().into()),
            ("mean", self.measured.map(|m| m.value).into()),
            ("half_width", self.measured.map(|m| m.half_width()).into()),
            ("photons_gathered", self.photons.into()),
            ("law", self.truth().into()),
            ("eq1_with_bsdf_per_steradian", (1.0 / (1.0 - self.reflectance / std::f64::consts::PI)).into()),
        ])
    }
}
