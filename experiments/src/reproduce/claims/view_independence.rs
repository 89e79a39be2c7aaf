//! `view-independence`: one saved map read from many viewpoints.

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, Point, Record, Row, Series, SeriesKind, Verdict,
};
use photonlab_photometry::Palette;
use photonlab_readout::{Cell, MapFile, MapHeader, Outcome, Source, Wanted, scene_identity, trace_pass};
use photonlab_sampling::{Optics, Sought};
use photonlab_scene::{Film, Receiver};
use photonlab_trace::Classes;
use serde::Deserialize;

use crate::reproduce::{
    context::{Context, Findings},
    cpu_clock::{CPU_SECONDS, CpuClock},
    lab::Lab,
    strategy::Strategy,
};

const SCENE: &str = include_str!("../../../scenes/cornell-box.xml");
const CHANNELS: usize = 3;
/// Replicates in the map.
const PASSES: u64 = 8;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    photons: u64,
    points: u64,
    views: usize,
    size: u32,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut lab = Lab::new("cornell-box.xml", SCENE, &[])?;
    let mut found = Findings { seeds: vec![p.seed], ..Findings::default() };
    // The map is built, saved and read back before any view exists.
    let clock = CpuClock::start();
    let map = build(&lab, &p)?;
    let build_seconds = clock.seconds();
    let folder = tempfile_in_system()?;
    let file = folder.join("view-independence.map");
    map.save(&file)?;
    let saved = MapFile::<CHANNELS>::load(&file)?;
    let bytes = std::fs::read(&file)?;
    std::fs::remove_dir_all(&folder)?;
    let mut same_photons = u64::from(same_bits(&map, &saved));
    let (mut same_readings, mut reused, mut anew) = (0, vec![0.0], vec![0.0]);
    for view in 0..p.views {
        turn_camera(&mut lab, view, p.size);
        let cells = Cell::of_sensor(&lab.world.scene, 0);
        let (from_map, read_seconds) = read(&lab, &cells, &p, &Source::Map(&saved))?;
        let (traced, run_seconds) = read(&lab, &cells, &p, &Source::Trace)?;
        let same = readings(&from_map) == readings(&traced);
        same_readings += u64::from(same);
        same_photons += u64::from(same_bits(&map, &build(&lab, &p)?));
        reused.push(reused[view] + read_seconds);
        anew.push(anew[view] + run_seconds);
        found.rows.push(row(view, same, read_seconds, run_seconds));
    }
    found.comparisons.push(count(
        "photons equal in bits (saved and read back; traced again beside each view)",
        p.views as u64 + 1,
        same_photons,
    ));
    found.comparisons.push(count(
        "views whose readings from the map equal a run that traces anew",
        p.views as u64,
        same_readings,
    ));
    found.figures.push(chart(build_seconds, &reused, &anew, bytes.len()));
    let (n, holds) = (p.views, found.comparisons.iter().all(|c| c.holds == Some(true)));
    let reason = format!(
        "{same_readings} of {n} views give the same bits; {n} views take {:.1} CPU seconds with one map and {:.1} with a map each",
        build_seconds + reused[n],
        anew[n]
    );
    Ok(context.record(found, if holds { Verdict::Holds } else { Verdict::DoesNotHold }, reason))
}

fn build(lab: &Lab, p: &Parameters) -> anyhow::Result<MapFile<CHANNELS>> {
    let settings = Strategy::FINAL_GATHER.settings(p.seed);
    let optics = Optics::<CHANNELS>::new(&lab.world, Palette::Channels);
    let header = MapHeader {
        channels: CHANNELS as u32,
        identity: scene_identity(&lab.world.scene),
        seed: p.seed,
        classes: Classes::ALL,
        limits: settings.limits,
    };
    let share = |pass: u64| p.photons * (pass + 1) / PASSES - p.photons * pass / PASSES;
    let light = (Sought::All, Classes::ALL);
    let passes = (0..PASSES).map(|pass| trace_pass(&lab.world, &optics, &settings, light, pass as u32, share(pass)));
    Ok(MapFile { header, passes: passes.collect::<Result<_, _>>()? })
}

/// Moves the camera around the box's axis, a different place for each view.
fn turn_camera(lab: &mut Lab, view: usize, size: u32) {
    let sensor = &mut lab.world.scene.sensors[0];
    sensor.film = Film { width: size, height: size };
    if let Receiver::Camera(camera) = &mut sensor.receiver {
        let angle = 0.2 * view as f64;
        camera.to_world.translation =
            glam::DVec3::new(0.5 * angle.sin(), 0.5 * angle.cos() - 0.5, 3.9 - 0.1 * view as f64);
    }
}

fn read(
    lab: &Lab,
    cells: &[Cell],
    p: &Parameters,
    source: &Source<'_, CHANNELS>,
) -> anyhow::Result<(Outcome<CHANNELS>, f64)> {
    let clock = CpuClock::start();
    let wanted =
        Wanted { photons: Some(p.photons), passes: Some(PASSES), samples: Some(p.points), ..Wanted::default() };
    let outcome = lab.read_from(cells, Strategy::FINAL_GATHER.settings(p.seed), &wanted, 0.95, source)?;
    Ok((outcome, clock.seconds()))
}

fn readings(outcome: &Outcome<CHANNELS>) -> Vec<[u64; 2]> {
    let bits = |x: Option<f64>| x.map_or(0, f64::to_bits);
    let values = outcome.cells.iter().flat_map(|cell| cell.value.iter());
    values.map(|value| [bits(value.mean()), bits(value.std_error())]).collect()
}

fn same_bits(a: &MapFile<CHANNELS>, b: &MapFile<CHANNELS>) -> bool {
    a.passes.len() == b.passes.len()
        && a.passes.iter().zip(&b.passes).all(|(a, b)| a.positions == b.positions && a.photons == b.photons)
}

fn tempfile_in_system() -> anyhow::Result<std::path::PathBuf> {
    let folder = std::env::temp_dir().join(format!("photonlab-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}

fn count(label: &str, all: u64, equal: u64) -> Comparison {
    let expected = Expected::exact(all as f64, "photons do not depend on sensors");
    let measured = Interval { value: equal as f64, low: equal as f64, high: equal as f64, confidence: 0.99 };
    Comparison::judge(label, "1", expected, Some(measured)).with_note("an exact count, without sampling error")
}

fn chart(build_seconds: f64, reused: &[f64], anew: &[f64], bytes: usize) -> FigureData {
    let points = |first: f64, sums: &[f64]| {
        sums.iter().enumerate().skip(1).map(|(n, sum)| Point::new(n as f64, first + sum)).collect()
    };
    FigureData {
        id: "cost-of-reuse".into(),
        title: "Cost of several views of one scene".into(),
        caption: format!(
            "Cornell box, final gather; the map takes {build_seconds:.2} CPU seconds once and {:.1} MB on disk. One run, no bars. {CPU_SECONDS}.",
            bytes as f64 * 1e-6
        ),
        x: Axis::linear("views"),
        y: Axis::linear("CPU seconds in all"),
        series: vec![
            Series { label: "one saved map".into(), kind: SeriesKind::Measured, points: points(build_seconds, reused) },
            Series { label: "a map for each view".into(), kind: SeriesKind::Measured, points: points(0.0, anew) },
        ],
    }
}

fn row(view: usize, same: bool, read_seconds: f64, run_seconds: f64) -> Row {
    let mut row = Row::new();
    row.insert("view".into(), view.into());
    row.insert("same_bits".into(), same.into());
    row.insert("cpu_seconds_from_map".into(), read_seconds.into());
    row.insert("cpu_seconds_traced".into(), run_seconds.into());
    row
}
