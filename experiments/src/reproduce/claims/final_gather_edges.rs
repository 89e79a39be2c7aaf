//! `final-gather-edges`: CUBE's edge and corner meters by the direct view of the map and by final gather.

use photonlab_gather::Estimator;
use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Point, Record, Replicates, Row, Series, SeriesKind, Verdict, sidak_level,
};
use photonlab_readout::{Aids, Cell, Direct, Draws, Method, Settings, Wanted};
use photonlab_reference::cube::Cube;
use photonlab_trace::Limits;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    cpu_clock::{CPU_SECONDS, CpuClock},
    cube_field::{CubeField, METERS},
    cube_law,
    lab::Lab,
};

const SCENE: &str = include_str!("../../../scenes/cube.xml");
/// Adds a meter that averages over all faces.
const FACES: &str = "<sensor type=\"irradiancemeter\" id=\"faces\"/></shape>";
/// Passes of each replicate: each has a map of its own with that share of the photons.
const PASSES: u64 = 4;
const FAMILY: f64 = 0.99;
/// As the definition says: final gather, its mean over the faces, and the direct view against its law.
const GATHER_TOLERANCE: f64 = 0.004;
const MEAN_TOLERANCE: f64 = 0.002;
const LAW_TOLERANCE: f64 = 0.03;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    photons: u64,
    points: u64,
    radius: f64,
    k: usize,
    /// Largest half-width of an edge meter's relative reading by the direct view.
    precision: f64,
}

/// A way to read the meters, and what it should read relative to the truth.
struct Reader {
    title: &'static str,
    method: Method,
    direct: Direct,
    law: [f64; 6],
    tolerance: f64,
    source: &'static str,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let lab = Lab::new("cube.xml", &SCENE.replace("</shape>", FACES), &[])?;
    let solution = Cube::BENCHMARK.solve();
    let truth = METERS.map(|(_, [u, v])| solution.luminance(u, v));
    let mut found = Findings { seeds: (p.seed..p.seed + p.replicates).collect(), ..Findings::default() };
    let readers = readers(&p);
    let confidence = 1.0 - sidak_level(1.0 - FAMILY, readers.len() * METERS.len() + 1);
    let (mut series, mut wide, mut seconds) = (Vec::new(), false, Vec::new());
    for (nth, reader) in readers.iter().enumerate() {
        let (values, spent) = read(&lab, &p, reader, &truth, &mut found)?;
        let mut points = Vec::new();
        for (i, (name, _)) in METERS.iter().enumerate() {
            let measured = values[i].interval(confidence);
            wide |= measured.is_none_or(|m| m.half_width() > p.precision);
            let expected = Expected::within(reader.law[i], reader.tolerance * reader.law[i], reader.source);
            found.comparisons.push(Comparison::judge(format!("{}, {name}", reader.title), "1", expected, measured));
            points.extend(measured.map(|m| Point::measured(place(i, nth), m)));
        }
        if reader.title == "final gather" {
            let expected = Expected::within(1.0, MEAN_TOLERANCE, "energy balance: mean luminance 2000/3 cd/m^2");
            let label = "final gather, mean over the faces";
            found.comparisons.push(Comparison::judge(label, "1", expected, values[METERS.len()].interval(confidence)));
        }
        let law = reader.law.iter().enumerate().map(|(i, &y)| Point::new(place(i, nth), y)).collect();
        series.push(Series { label: format!("{}, measured", reader.title), kind: SeriesKind::Measured, points });
        series.push(Series { label: format!("{}, predicted", reader.title), kind: SeriesKind::Predicted, points: law });
        seconds.push(format!("{} {spent:.2}", reader.title));
    }
    found.figures.push(FigureData {
        id: "six-meters".into(),
        title: "CUBE's six meters by three strategies, relative to the radiosity solution".into(),
        caption: format!(
            "B and C lie on the face, D, E and F 1 cm from the edges. {} seeds of {} photons; direct view with radius {} m and k = {}; \
             bars: {:.3} % intervals. CPU seconds per seed: {}. {CPU_SECONDS}.",
            p.replicates,
            p.photons,
            p.radius,
            p.k,
            100.0 * confidence,
            seconds.join(", ")
        ),
        x: Axis::named("meter", METERS.map(|(name, _)| name)),
        y: Axis::linear("luminance over the truth"),
        series,
    });
    conclude(context, found, wide)
}

/// Along the axis: the meter's name, the readers side by side around it.
fn place(meter: usize, reader: usize) -> f64 {
    meter as f64 + 1.0 + 0.25 * (reader as f64 - 1.0)
}

fn conclude(context: &Context, found: Findings, wide: bool) -> anyhow::Result<Record> {
    let value = |label: &str| {
        let comparison = found.comparisons.iter().find(|c| c.label == label);
        comparison.and_then(|c| c.measured).map_or(f64::NAN, |m| m.value)
    };
    let corner = METERS[5].0;
    let reason = format!(
        "in the corner the direct view reads {:.2} (fixed radius) and {:.2} (k nearest) of the truth, final gather {:.4}; at the \
         edge middle {:.2}, {:.2} and {:.4}",
        value(&format!("direct view, fixed radius, {corner}")),
        value(&format!("direct view, k nearest, {corner}")),
        value(&format!("final gather, {corner}")),
        value(&format!("direct view, fixed radius, {}", METERS[3].0)),
        value(&format!("direct view, k nearest, {}", METERS[3].0)),
        value(&format!("final gather, {}", METERS[3].0)),
    );
    let holds = found.comparisons.iter().all(|c| c.holds == Some(true));
    let verdict = match (wide, holds) {
        (true, _) => Verdict::NotMeasured,
        (false, true) => Verdict::Holds,
        (false, false) => Verdict::DoesNotHold,
    };
    Ok(context.record(found, verdict, reason))
}

fn readers(p: &Parameters) -> [Reader; 3] {
    let field = CubeField::new();
    let (radius, paths) = (p.radius, p.photons / PASSES);
    [
        Reader {
            title: "direct view, fixed radius",
            method: Method::Radius { radius: Some(radius) },
            direct: Direct::Photons,
            law: METERS.map(|(_, at)| cube_law::fixed_radius(&field, at, radius)),
            tolerance: LAW_TOLERANCE,
            source: "area law over the radiosity field (catalogue B1, B2)",
        },
        Reader {
            title: "direct view, k nearest",
            method: Method::Nearest { k: Some(p.k) },
            direct: Direct::Photons,
            law: METERS.map(|(_, at)| cube_law::nearest(&field, at, p.k as u32, paths).mean),
            tolerance: LAW_TOLERANCE,
            source: "Gamma law over the radiosity field (catalogue B3, B7)",
        },
        Reader {
            title: "final gather",
            method: Method::FinalGather { radius: None },
            direct: Direct::Sampled,
            law: [1.0; 6],
            tolerance: GATHER_TOLERANCE,
            source: "radiosity solution at the meter's own point",
        },
    ]
}

/// Readings relative to the truth over the seeds, the mean over the faces last, and CPU seconds per seed.
fn read(
    lab: &Lab,
    p: &Parameters,
    reader: &Reader,
    truth: &[f64; 6],
    found: &mut Findings,
) -> anyhow::Result<(Vec<Replicates>, f64)> {
    let mut cells = Cell::of_meters(&lab.world.scene);
    // The scene's meters in the order of their names A to F, the mean over the faces after them.
    cells.sort_by_key(|cell| lab.world.scene.sensors[cell.sensor].id == "faces");
    let mut values = vec![Replicates::new(); cells.len()];
    let mut seconds = Replicates::new();
    for seed in p.seed..p.seed + p.replicates {
        let settings = Settings {
            method: reader.method,
            direct: reader.direct,
            estimator: Estimator::default(),
            gather_rays: 1,
            aids: Aids::default(),
            draws: Draws::Independent,
            seed,
            limits: Limits::default(),
        };
        let wanted =
            Wanted { photons: Some(p.photons), passes: Some(PASSES), samples: Some(p.points), ..Wanted::default() };
        let clock = CpuClock::start();
        let outcome = lab.read::<1>(&cells, settings, &wanted, FAMILY)?;
        seconds.push(clock.seconds());
        let mut row = Row::new();
        row.insert("strategy".into(), reader.title.into());
        row.insert("seed".into(), seed.into());
        for (i, cell) in outcome.cells.iter().enumerate() {
            let value = cell.value[0].mean().unwrap_or(0.0);
            let relative = value / truth.get(i).copied().unwrap_or_else(|| Cube::BENCHMARK.mean_irradiance());
            values[i].push(relative);
            row.insert(METERS.get(i).map_or("mean over the faces", |meter| meter.0).into(), relative.into());
        }
        found.rows.push(row);
    }
    Ok((values, seconds.mean().unwrap_or(0.0)))
}
