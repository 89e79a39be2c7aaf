//! `needs`: what is saved by modelling no more than a scene needs.

use photonlab_measure::{
    Axis, Expected, FigureData, Group, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict,
};
use photonlab_photometry::Channels;
use photonlab_readout::{Cell, Wanted};
use photonlab_scene::{Film, Needs, Receiver};
use serde::Deserialize;

use crate::{
    by_channels,
    reproduce::{
        context::{Context, Findings},
        cpu_clock::{CPU_SECONDS, CpuClock, microseconds},
        lab::Lab,
        strategy::Strategy,
        table::{Table, row},
    },
};

const SCENES: [(&str, &str); 5] = [
    (GREY_ROOM, include_str!("../../../scenes/interior/closed-room.xml")),
    ("CUBE", include_str!("../../../scenes/cube.xml")),
    ("square lamp", include_str!("../../../scenes/square-lamp.xml")),
    ("ball lens", include_str!("../../../scenes/ball-lens.xml")),
    ("Cornell box", include_str!("../../../scenes/cornell-box.xml")),
];
/// The scene whose saving has a bound.
const GREY_ROOM: &str = "grey diffuse room";
const AT_MOST: f64 = 0.8;
/// A part that is left out may cost no less than nothing by this.
const NO_FASTER: f64 = 0.1;
/// Pixels across and down of a scene that is read by a camera.
const SIZE: u32 = 12;
/// Passes of a run.
const PASSES: u64 = 16;
/// Of so many runs of one seed the fastest counts.
const ROUNDS: usize = 2;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    photons: u64,
    /// Points of a cell.
    points: u64,
    /// Largest half-width of a ratio of times.
    precision: f64,
    /// Largest half-width of a difference of readings that still says something.
    same: f64,
}

/// Something that can be modelled though it is not needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    ThreeChannels,
    Wavelengths,
    CausticMap,
    SurfaceMap,
    VolumeMap,
    Everything,
}

impl Part {
    const ALL: [Self; 6] =
        [Self::ThreeChannels, Self::Wavelengths, Self::CausticMap, Self::SurfaceMap, Self::VolumeMap, Self::Everything];

    fn name(self) -> &'static str {
        match self {
            Self::ThreeChannels => "three channels",
            Self::Wavelengths => "wavelengths",
            Self::CausticMap => "caustic map",
            Self::SurfaceMap => "surface map",
            Self::VolumeMap => "volume map",
            Self::Everything => "everything",
        }
    }

    /// The needs with it; `None` if the scene needs it anyway.
    fn added_to(self, needs: &Needs) -> Option<Needs> {
        let mut with = needs.clone();
        let all = self == Self::Everything;
        if self == Self::ThreeChannels && with.channels == Channels::Grey {
            with.channels = Channels::Rgb;
        }
        // As many channels as a scene with wavelengths has; in a coloured one each would be one of three.
        if (all || self == Self::Wavelengths) && with.channels == Channels::Grey {
            with.channels = Channels::Spectral;
        }
        with.caustic |= all || self == Self::CausticMap;
        with.indirect |= all || self == Self::SurfaceMap;
        with.in_scattering |= all || self == Self::VolumeMap;
        (with != *needs).then_some(with)
    }
}

/// What a part costs in a scene, by seed.
struct Cost {
    scene: &'static str,
    part: Part,
    /// Time without over time with.
    ratios: Replicates,
    /// Mean over the cells with over that without, less 1.
    differences: Replicates,
}

/// One run: CPU seconds, mean over the cells.
struct Read {
    seconds: f64,
    mean: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let mut found = Findings { seeds: (p.seed..p.seed + p.replicates).collect(), ..Findings::default() };
    let mut costs = Vec::new();
    for (name, xml) in SCENES {
        say!("       {name}");
        costs.extend(costs_in(name, xml, &p, &mut found)?);
    }
    let mut table = Table::new(2 * costs.len());
    for cost in &costs {
        cost.judge(&p, &mut table);
    }
    found.figures = vec![figure(&costs, &table)];
    let intervals = table.confidence;
    let (comparisons, verdict, reason) = table.conclude(|| (Verdict::Holds, words(&costs, intervals)));
    // What is known narrowly enough and misses refutes the promise.
    let verdict = if verdict == Verdict::NotCertifiable { Verdict::DoesNotHold } else { verdict };
    for (name, _) in SCENES {
        let of = |cost: &&Cost| cost.scene == name;
        let parts: Vec<String> = costs.iter().filter(of).map(|cost| cost.words(intervals)).collect();
        found.groups.push(Group {
            title: name.into(),
            summary: format!("time as needed over the time with: {}", parts.join("; ")),
            comparisons: 2 * parts.len(),
        });
    }
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// Every part that a scene does not need, switched on by itself and with all others.
fn costs_in(scene: &'static str, xml: &str, p: &Parameters, found: &mut Findings) -> anyhow::Result<Vec<Cost>> {
    let mut lab = Lab::new(scene, xml, &[])?;
    if matches!(lab.world.scene.sensors[0].receiver, Receiver::Camera(_)) {
        lab.world.scene.sensors[0].film = Film { width: SIZE, height: SIZE };
    }
    let plain = lab.needs.clone();
    let unneeded = Part::ALL.into_iter().filter_map(|part| Some((part, part.added_to(&plain)?)));
    let mut costs: Vec<(Cost, Needs)> = unneeded
        .map(|(part, with)| (Cost { scene, part, ratios: Replicates::new(), differences: Replicates::new() }, with))
        .collect();
    for seed in p.seed..p.seed + p.replicates {
        let mut read = |needs: &Needs| {
            lab.needs = needs.clone();
            by_channels!(needs.channels, read(&lab, seed, p))
        };
        for (cost, with) in &mut costs {
            let (mut needed, mut more) = (read(&plain)?, read(with)?);
            for _ in 1..ROUNDS {
                needed.seconds = needed.seconds.min(read(&plain)?.seconds);
                more.seconds = more.seconds.min(read(with)?.seconds);
            }
            cost.ratios.push(needed.seconds / more.seconds);
            cost.differences.push(more.mean / needed.mean - 1.0);
            found.rows.push(row([
                ("scene", scene.into()),
                ("part", cost.part.name().into()),
                ("seed", seed.into()),
                ("cpu_seconds", microseconds(needed.seconds).into()),
                ("cpu_seconds_with", microseconds(more.seconds).into()),
                ("mean", needed.mean.into()),
                ("mean_with", more.mean.into()),
            ]));
        }
    }
    Ok(costs.into_iter().map(|(cost, _)| cost).collect())
}

fn read<const C: usize>(lab: &Lab, seed: u64, p: &Parameters) -> anyhow::Result<Read> {
    let cells = match lab.world.scene.sensors[0].receiver {
        Receiver::Camera(_) => Cell::of_sensor(&lab.world.scene, 0),
        Receiver::Meter(_) => Cell::of_meters(&lab.world.scene),
    };
    // As many passes whatever is carried: thinner maps would have wider balls.
    let wanted =
        Wanted { photons: Some(p.photons), passes: Some(PASSES), samples: Some(p.points), ..Wanted::default() };
    let clock = CpuClock::start();
    let outcome = lab.read::<C>(&cells, Strategy::FINAL_GATHER.settings(seed), &wanted, 0.95)?;
    let seconds = clock.seconds();
    let values = outcome.cells.iter().flat_map(|cell| cell.value.iter().map(|value| value.mean().unwrap_or(0.0)));
    Ok(Read { seconds, mean: values.sum::<f64>() / (C * cells.len()) as f64 })
}

impl Cost {
    fn judge(&self, p: &Parameters, table: &mut Table) {
        let bounded = self.scene == GREY_ROOM && self.part == Part::Everything;
        let high = if bounded { AT_MOST } else { 1.0 + NO_FASTER };
        let source = if bounded {
            "one channel of sixteen, no map that no photon enters"
        } else {
            "what is not modelled costs nothing"
        };
        let expected = Expected { value: high, low: 0.0, high, source: source.into() };
        let label = format!("{}: CPU time as needed over that with {}", self.scene, self.part.name());
        table.judge(label, expected, self.ratios.interval(table.confidence), p.precision);
        let label = format!("{}: readings with {}, over those without, less 1", self.scene, self.part.name());
        let expected = Expected::exact(0.0, "what is left out cannot change a reading");
        // An interval is judged by what is expected or a hundredth, whichever is more.
        table.judge(
            label,
            expected,
            self.differences.interval(table.confidence),
            p.same / crate::reproduce::table::LEAST,
        );
    }

    fn ratio(&self, confidence: f64) -> Option<Interval> {
        self.ratios.interval(confidence)
    }

    fn words(&self, confidence: f64) -> String {
        match self.ratio(confidence) {
            Some(ratio) => format!("{} {:.2} ({:.2} to {:.2})", self.part.name(), ratio.value, ratio.low, ratio.high),
            None => format!("{} unknown", self.part.name()),
        }
    }
}

fn words(costs: &[Cost], confidence: f64) -> String {
    let everything = costs.iter().filter(|cost| cost.part == Part::Everything);
    let of_scenes: Vec<String> = everything
        .map(|cost| format!("{}: {}", cost.scene, cost.words(confidence).replace("everything ", "")))
        .collect();
    let channels = costs.iter().find(|cost| cost.scene == GREY_ROOM && cost.part == Part::ThreeChannels);
    let of_channels = channels.map_or(String::new(), |cost| format!("; of the room's, {}", cost.words(confidence)));
    format!(
        "readings stay what they are with everything switched on; CPU time as needed over the time with everything, {}{of_channels}",
        of_scenes.join("; ")
    )
}

fn figure(costs: &[Cost], table: &Table) -> FigureData {
    let place = |part: Part| Part::ALL.iter().position(|&one| one == part).unwrap_or(0) as f64 + 1.0;
    let series = SCENES.iter().enumerate().map(|(number, &(name, _))| {
        let aside = 0.12 * (number as f64 - 2.0);
        let point = |cost: &Cost| Some(Point::measured(place(cost.part) + aside, cost.ratio(table.confidence)?));
        let points = costs.iter().filter(|cost| cost.scene == name).filter_map(point).collect();
        Series { label: name.into(), kind: SeriesKind::Measured, points }
    });
    FigureData {
        id: "savings".into(),
        title: "Time as a scene needs it over the time with more".into(),
        caption: format!(
            "Final gather; a part that a scene needs has no mark there. Bars: {}. {CPU_SECONDS}.",
            table.intervals()
        ),
        x: Axis::named("switched on though not needed", Part::ALL.map(Part::name)),
        y: Axis::linear("CPU time as needed over that with it"),
        series: series.filter(|series| !series.points.is_empty()).collect(),
    }
}
