//! A slab of scattering medium before a lamp or before nothing, read as the command reads scenes.

use photonlab_gather::Estimator;
use photonlab_measure::{Axis, Expected, FigureData, Interval, Point, Row, Series, SeriesKind};
use photonlab_readout::{Aids, Cell, Direct, Draws, Method, Settings, Target, Wanted};
use photonlab_reference::{catalogue::Case, medium::slab::Slab, rendering_equation::transmittance};
use photonlab_trace::Limits;
use serde::Deserialize;

use super::{
    lab::Lab,
    table::{Table, row},
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Parameters {
    pub(super) seed: u64,
    /// Optical thickness across; the slab is as many metres thick.
    thickness: f64,
    /// Mean cosine of scattering.
    asymmetry: f64,
    albedos: Vec<f64>,
    /// Of the lines looked along, from the slab's normal.
    cosines: Vec<f64>,
    passes: u64,
    /// Paths per reading.
    samples: u64,
}

impl Parameters {
    /// Readings in all.
    pub(super) fn readings(&self) -> usize {
        Side::BOTH.len() * self.albedos.len() * self.cosines.len()
    }
}

/// Where the slab's light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Behind,
    Above,
}

impl Side {
    const BOTH: [Side; 2] = [Side::Behind, Side::Above];

    fn words(self) -> &'static str {
        match self {
            Side::Behind => "lit from behind",
            Side::Above => "lit from above",
        }
    }

    fn case(self, slab: &Slab, cosines: &[f64]) -> Case {
        match self {
            Side::Behind => slab.lit_from_behind(cosines),
            Side::Above => slab.lit_from_above(cosines),
        }
    }
}

/// The radiance of a slab along one line, over that of the light.
pub(super) struct SlabReading {
    side: Side,
    albedo: f64,
    cosine: f64,
    expected: f64,
    uncertainty: f64,
    /// What eq. 1 gives: transmittance times the radiance behind, which is black where the light comes from above.
    by_equation_1: f64,
    measured: Option<Interval>,
}

/// Reads every slab along every line by following rays: no map lies between the medium and the reading.
pub(super) fn read(p: &Parameters, confidence: f64) -> anyhow::Result<Vec<SlabReading>> {
    let settings = Settings {
        method: Method::Path,
        direct: Direct::Sampled,
        estimator: Estimator::default(),
        gather_rays: 1,
        aids: Aids::default(),
        draws: Draws::Independent,
        seed: p.seed,
        limits: Limits::default(),
    };
    let wanted = Wanted { passes: Some(p.passes), samples: Some(p.samples), ..Wanted::default() };
    let mut readings = Vec::with_capacity(p.readings());
    for side in Side::BOTH {
        for &albedo in &p.albedos {
            let case = side.case(&Slab::new(p.thickness, albedo, p.asymmetry)?, &p.cosines);
            let lab = Lab::new("slab.xml", &case.xml, &[])?;
            let along = |cell: &Cell| matches!(cell.target, Target::Along(_));
            let cells: Vec<Cell> = Cell::of_meters(&lab.world.scene).into_iter().filter(along).collect();
            let outcome = lab.read::<1>(&cells, settings, &wanted, confidence)?;
            for ((result, &cosine), answer) in outcome.cells.iter().zip(&p.cosines).zip(&case.expected) {
                let value = result.value[0].mean().zip(result.half_width(0, confidence));
                let by_equation_1 = if side == Side::Behind { transmittance(p.thickness, cosine) } else { 0.0 };
                readings.push(SlabReading {
                    side,
                    albedo,
                    cosine,
                    expected: answer.value[0],
                    uncertainty: answer.uncertainty,
                    by_equation_1,
                    measured: value.map(|(value, half)| Interval::around(value, half, confidence)),
                });
            }
        }
    }
    Ok(readings)
}

impl SlabReading {
    fn name(&self) -> String {
        format!("slab {}, albedo {}, at cosine {}", self.side.words(), self.albedo, self.cosine)
    }

    /// Against the slab's transmitted or reflected share.
    pub(super) fn judge(&self, table: &mut Table, precision: f64) {
        let source = "adding and doubling (catalogue F7)";
        let expected = Expected::within(self.expected, self.uncertainty, source);
        table.judge_in("W/(m^2 sr)", self.name(), expected, self.measured, precision);
    }

    pub(super) fn row(&self) -> Row {
        row([
            ("case", self.name().into()),
            ("mean", self.measured.map(|m| m.value).into()),
            ("half_width", self.measured.map(|m| m.half_width()).into()),
            ("law", self.expected.into()),
            ("eq1_without_in_scattering", self.by_equation_1.into()),
        ])
    }
}

/// What is measured beside what eq. 1 gives, in words, for the medium that scatters most.
pub(super) fn shortfall(readings: &[SlabReading]) -> String {
    let most = readings.iter().map(|r| r.albedo).fold(0.0, f64::max);
    let of_most = readings.iter().filter(|r| r.albedo == most);
    let words = of_most.filter_map(|r| {
        let measured = r.measured?.value;
        Some(format!("{measured:.4} where it reads {:.4} ({}, cosine {})", r.by_equation_1, r.side.words(), r.cosine))
    });
    format!("at albedo {most} a slab shows {}", words.collect::<Vec<_>>().join(", "))
}

/// Readings over the albedo, with what adding and doubling says and what eq. 1 does.
pub(super) fn figure(p: &Parameters, table: &Table, readings: &[SlabReading]) -> anyhow::Result<FigureData> {
    let mut series = Vec::new();
    for side in Side::BOTH {
        for &cosine in &p.cosines {
            let of_line = readings.iter().filter(|r| r.side == side && r.cosine == cosine);
            let points = of_line.filter_map(|r| Some(Point::measured(r.albedo, r.measured?))).collect();
            let label = format!("{}, cosine {cosine}", side.words());
            series.push(Series { label, kind: SeriesKind::Measured, points });
        }
    }
    for side in Side::BOTH {
        for (place, cosine) in p.cosines.iter().enumerate() {
            let at = |albedo: f64| -> anyhow::Result<Point> {
                let shares = Slab::new(p.thickness, albedo, p.asymmetry)?.shares(&p.cosines).beams[place];
                Ok(Point::new(albedo, if side == Side::Behind { shares.transmitted } else { shares.reflected }))
            };
            let points = (0..=20).map(|i| at(f64::from(i) / 20.0)).collect::<Result<_, _>>()?;
            let label = format!("adding and doubling: {}, {cosine}", side.words());
            series.push(Series { label, kind: SeriesKind::Predicted, points });
        }
    }
    for &cosine in &p.cosines {
        let points = [0.0, 1.0].map(|albedo| Point::new(albedo, transmittance(p.thickness, cosine))).to_vec();
        series.push(Series { label: format!("eq. 1, {cosine}"), kind: SeriesKind::Reference, points });
    }
    Ok(FigureData {
        id: "slab".into(),
        title: "Radiance of a scattering slab, and what eq. 1 leaves of it".into(),
        caption: format!(
            "Optical thickness {}, mean cosine of scattering {}; light of radiance 1 from behind, or from above over black. Eq. 1 \
             reads the transmittance times what is behind: right at albedo 0, too low by the light that the medium scatters \
             into the line elsewhere, and nothing of light from above; {}.",
            p.thickness,
            p.asymmetry,
            table.intervals()
        ),
        x: Axis::linear("albedo of the medium"),
        y: Axis::linear("radiance over that of the light"),
        series,
    })
}
