//! `rendering-equation`: what the symbols of the paper's equation 1 must mean.

use std::f64::consts::PI;

use photonlab_measure::{Axis, Expected, FigureData, Point, Record, Replicates, Series, SeriesKind, Verdict};
use photonlab_reference::rendering_equation::{DiffuseTransmitter, EquationReading};
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    furnace::{self, FurnaceReading},
    slab::{self, SlabReading},
    table::{Table, row},
    transmitter::{self, Sheet, SheetReadings},
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    furnace: furnace::Parameters,
    sheet: Sheet,
    slab: slab::Parameters,
    /// A radiance known worse than this (relative half-width) says nothing.
    precision: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let sheet = DiffuseTransmitter::new(p.sheet.reflectance, p.sheet.transmittance)?;
    let mut table = Table::new(p.furnace.readings() + transmitter::QUANTITIES + p.slab.readings());
    let mut found = Findings { seeds: vec![p.furnace.seed, p.sheet.seed, p.slab.seed], ..Findings::default() };
    let furnaces = furnace::read(&p.furnace, table.confidence)?;
    for reading in &furnaces {
        let expected =
            Expected::exact(reading.truth(), "L_e / (1 - rho) in a closed cavity of uniform walls (catalogue D2)");
        table.judge(reading.name(), expected, reading.measured, p.precision);
        found.rows.push(reading.row());
    }
    let readings = transmitter::read(&p.sheet, &sheet)?;
    judge_sheet(&mut table, &p, &sheet, &readings, &mut found);
    let slabs = slab::read(&p.slab, table.confidence)?;
    for reading in &slabs {
        reading.judge(&mut table, p.precision);
        found.rows.push(reading.row());
    }
    found.figures = vec![
        furnace_figure(&p, &table, &furnaces),
        sheet_figure(&p, &table, &sheet, &readings),
        slab::figure(&p.slab, &table, &slabs)?,
    ];
    let (comparisons, verdict, reason) = table.conclude(|| verdict(&p, &furnaces, &readings, &slabs));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

fn judge_sheet(
    table: &mut Table,
    p: &Parameters,
    sheet: &DiffuseTransmitter,
    readings: &SheetReadings,
    found: &mut Findings,
) {
    let [front, back] = p.sheet.irradiance;
    let read = |reading| sheet.read(reading, front, back);
    let parallel = "parallel light";
    let laws = "reference::rendering_equation, three readings of eq. 1";
    let cases = [
        ("W/m^2", "sheet: irradiance of the front, side test", front, parallel, &readings.front),
        ("W/m^2", "sheet: irradiance of the back, side test", back, parallel, &readings.back),
        ("W/m^2", "sheet: either side without tests", front + back, parallel, &readings.both),
        (
            "W/(m^2 sr)",
            "sheet: radiance of the front, outgoing photons counted",
            sheet.radiance(front, back),
            "(rho E_front + tau E_back) / pi, flux leaves as it came",
            &readings.counted,
        ),
        (
            "W/(m^2 sr)",
            "sheet: eq. 1 with luminance factors and |cos|",
            read(EquationReading::LuminanceFactor),
            laws,
            &readings.luminance_factor,
        ),
        (
            "W/(m^2 sr)",
            "sheet: eq. 1 with a BSDF in 1/sr",
            read(EquationReading::PerSteradian),
            laws,
            &readings.per_steradian,
        ),
        (
            "W/(m^2 sr)",
            "sheet: eq. 1 with luminance factors and signed cos",
            read(EquationReading::SignedCosine),
            laws,
            &readings.signed_cosine,
        ),
    ];
    for (unit, label, law, source, values) in cases {
        let expected = Expected::exact(law, source);
        table.judge_in(unit, label, expected, values.interval(table.confidence), p.precision);
        found.rows.push(row([
            ("case", label.into()),
            ("replicates", values.len().into()),
            ("mean", values.mean().into()),
            ("std_error", values.std_error().into()),
            ("law", law.into()),
        ]));
    }
}

fn verdict(
    p: &Parameters,
    furnaces: &[FurnaceReading],
    readings: &SheetReadings,
    slabs: &[SlabReading],
) -> (Verdict, String) {
    let brightest = p.furnace.reflectances.iter().copied().fold(0.0, f64::max);
    let values = furnaces.iter().filter(|f| f.reflectance == brightest).filter_map(|f| Some(f.measured?.value));
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let mean = |values: &Replicates| values.mean().unwrap_or(f64::NAN);
    let of_slabs = slab::shortfall(slabs);
    let reason = format!(
        "with luminance factors (relative to a perfect diffuser) and |cos| eq. 1 gives what is measured: {low:.3} to {high:.3} times \
         the emission in a furnace of rho = {brightest} ({:.3} expected), {:.3} for a diffusing sheet ({:.3} by counting photons). \
         With a BSDF in 1/sr, which is this program's convention and has no extra 1 / pi, it would read {:.3} and {:.3}; with the \
         cosine's sign kept, {:.3}. In media it lacks the light scattered into the line: {of_slabs}",
        1.0 / (1.0 - brightest),
        mean(&readings.luminance_factor),
        mean(&readings.counted),
        1.0 / (1.0 - brightest / PI),
        mean(&readings.per_steradian),
        mean(&readings.signed_cosine),
    );
    (Verdict::HoldsWithinLimits, reason)
}

fn furnace_figure(p: &Parameters, table: &Table, furnaces: &[FurnaceReading]) -> FigureData {
    let most = p.furnace.reflectances.iter().copied().fold(0.0, f64::max);
    let line = |label: &str, kind, over: fn(f64) -> f64| {
        let points = (0..=60).map(|i| most * f64::from(i) / 60.0).map(|rho| Point::new(rho, 1.0 / (1.0 - over(rho))));
        Series { label: label.into(), kind, points: points.collect() }
    };
    let mut series: Vec<Series> = p
        .furnace
        .methods()
        .into_iter()
        .enumerate()
        .map(|(number, method)| {
            // Marks of different methods at one reflectance stand side by side.
            let shift = 0.008 * (number as f64 - 1.0);
            let points = furnaces.iter().filter(|f| f.method == method);
            let points = points.filter_map(|f| Some(Point::measured(f.reflectance + shift, f.measured?))).collect();
            Series { label: method.name().into(), kind: SeriesKind::Measured, points }
        })
        .collect();
    series.push(line("1 / (1 - rho)", SeriesKind::Predicted, |rho| rho));
    series.push(line("eq. 1 with a BSDF in 1/sr: 1 / (1 - rho / pi)", SeriesKind::Reference, |rho| rho / PI));
    FigureData {
        id: "furnace".into(),
        title: "Radiance in a furnace of uniform walls".into(),
        caption: format!(
            "A closed cube whose walls all emit L_e and reflect rho, read at {} places per method (marks set a little apart); {}, \
             widened by the method's own bound on its bias.",
            p.furnace.places.len(),
            table.intervals()
        ),
        x: Axis::linear("reflectance rho"),
        y: Axis::linear("radiance over emitted radiance"),
        series,
    }
}

fn sheet_figure(p: &Parameters, table: &Table, sheet: &DiffuseTransmitter, readings: &SheetReadings) -> FigureData {
    let [front, back] = p.sheet.irradiance;
    let truth = sheet.radiance(front, back);
    let cases = [
        ("1: outgoing photons counted", &readings.counted),
        ("2: luminance factors, |cos|", &readings.luminance_factor),
        ("3: BSDF in 1/sr, |cos|", &readings.per_steradian),
        ("4: luminance factors, signed cos", &readings.signed_cosine),
    ];
    let mark = |(number, (label, values)): (usize, (&str, &Replicates))| Series {
        label: label.into(),
        kind: SeriesKind::Measured,
        points: values
            .interval(table.confidence)
            .map(|m| Point::measured(number as f64 + 1.0, m))
            .into_iter()
            .collect(),
    };
    let mut series: Vec<Series> = cases.into_iter().enumerate().map(mark).collect();
    let ends = [0.5, cases.len() as f64 + 0.5];
    series.push(Series {
        label: "truth".into(),
        kind: SeriesKind::Predicted,
        points: ends.map(|x| Point::new(x, truth)).to_vec(),
    });
    FigureData {
        id: "sheet".into(),
        title: "Front of a diffusing sheet, eq. 1 read in three ways".into(),
        caption: format!(
            "Reflectance {}, transmittance {}, irradiance {front} W/m^2 on the front and {back} W/m^2 on the back, both measured with \
             the photon map and the side test. {} maps; {}.",
            p.sheet.reflectance,
            p.sheet.transmittance,
            p.sheet.replicates,
            table.intervals()
        ),
        x: Axis::linear("1: photons counted; 2, 3, 4: readings of eq. 1 (see the legend)"),
        y: Axis::linear("radiance, W/(m^2 sr)"),
        series,
    }
}
