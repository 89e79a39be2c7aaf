//! Flux of caustics in rings and boxes, counted and read from the map.

use std::ops::Range;

use photonlab_measure::{Axis, Expected, FigureData, Interval, Point, Replicates, Series, SeriesKind};
use photonlab_photometry::{Palette, PathClass};
use photonlab_readout::{Cell, Method, Settings, Wanted, trace_pass};
use photonlab_reference::{ball_lens::BallLens, mirror_arc};
use photonlab_sampling::{Optics, Sought};
use photonlab_trace::Classes;

use super::{
    context::Findings,
    lab::Lab,
    ray_curves::CONFIDENCE,
    strategy::Strategy,
    table::{Table, row},
};

/// The ball with the floor before its focus, where the light straight through has a fold: a bright ring.
pub(super) fn lens() -> BallLens {
    BallLens::new(0.5, 1.5, 0.6).expect("a ball over a floor")
}

/// Ends of the rings on the floor (m), the second one around the fold at 0.037.
const RINGS: [f64; 5] = [0.0, 0.02, 0.05, 0.07, 0.095];
/// Half-width of the floor (m) and cells along it.
const FLOOR: (f64, usize) = (0.1, 50);
/// Points per cell of the floor, one for each pass.
const READS: u64 = 16;
/// Cells along the floor of the cup, 0.8 m long.
const CUP_CELLS: usize = 16;
/// The boxes of the cup with most flux, by their place in the catalogue's list.
const CUP_BOXES: [usize; 4] = [1, 2, 4, 5];

/// Flux in one part of the floor, over what ray optics says.
pub(super) struct Kept {
    name: String,
    counted: Replicates,
    /// From the map; none in the boxes.
    read: Replicates,
}

impl Kept {
    fn new(name: String) -> Self {
        Self { name, counted: Replicates::new(), read: Replicates::new() }
    }

    /// How many comparisons [`Kept::judge`] makes.
    pub(super) fn comparisons(&self) -> usize {
        1 + usize::from(!self.read.is_empty())
    }

    pub(super) fn judge(&self, table: &mut Table, tolerance: f64, precision: f64) {
        let measured = self.counted.interval(table.confidence);
        let law = Expected::exact(1.0, "flux conserved along rays");
        table.judge(format!("{}: counted flux over ray optics", self.name), law, measured, precision);
        if !self.read.is_empty() {
            let measured = self.read.interval(table.confidence);
            let law = Expected::within(1.0, tolerance, "the same, blurred by the gather disc");
            table.judge(format!("{}: flux read from the map over ray optics", self.name), law, measured, precision);
        }
    }

    /// Relative error of the read flux, with its 99 % interval.
    pub(super) fn read_error(&self) -> Option<Interval> {
        let read = self.read.interval(CONFIDENCE)?;
        Some(Interval { value: read.value - 1.0, low: read.low - 1.0, high: read.high - 1.0, ..read })
    }

    pub(super) fn figure(rings: &[Kept], boxes: &[Kept], table: &Table) -> FigureData {
        let all: Vec<&Kept> = rings.iter().chain(boxes).collect();
        let points = |of: fn(&Kept) -> &Replicates, aside: f64| {
            let place = |i: usize| i as f64 + 1.0 + aside;
            let interval =
                |(i, kept): (usize, &&Kept)| Some(Point::measured(place(i), of(kept).interval(table.confidence)?));
            all.iter().enumerate().filter_map(interval).collect::<Vec<_>>()
        };
        let law = (0..all.len()).map(|i| Point::new(i as f64 + 1.0, 1.0)).collect();
        FigureData {
            id: "flux".into(),
            title: "Flux of caustics over ray optics".into(),
            caption: format!(
                "Behind a ball lens in rings, in a cylindrical mirror in boxes of its floor (metres along its axis). {}.",
                table.intervals()
            ),
            x: Axis::named("part of the floor", all.iter().map(|kept| kept.name.as_str())),
            y: Axis::linear("flux over ray optics"),
            series: vec![
                Series {
                    label: "photons counted".into(),
                    kind: SeriesKind::Measured,
                    points: points(|kept| &kept.counted, -0.1),
                },
                Series {
                    label: "read from the caustic map".into(),
                    kind: SeriesKind::Measured,
                    points: points(|kept| &kept.read, 0.1),
                },
                Series { label: "ray optics".into(), kind: SeriesKind::Predicted, points: law },
            ],
        }
    }
}

/// Rings behind the ball lens in parallel light.
pub(super) fn ball_rings(photons: u64, seeds: &Range<u64>, found: &mut Findings) -> anyhow::Result<Vec<Kept>> {
    let (lens, (half, cells)) = (lens(), FLOOR);
    let lab = Lab::new("ball lens", &lens.metered_xml(None, half, cells), &[])?;
    let on_floor = Cell::of_meters(&lab.world.scene);
    let (optics, middle) = (Optics::<1>::new(&lab.world, Palette::Channels), lab.world.middle());
    let mut rings: Vec<Kept> =
        RINGS.windows(2).map(|ends| Kept::new(format!("ring {} to {} m", ends[0], ends[1]))).collect();
    let ring_of = |r: f64| RINGS[1..].iter().position(|&end| r < end);
    let law: Vec<f64> = RINGS.windows(2).map(|ends| lens.flux_within(ends[1]) - lens.flux_within(ends[0])).collect();
    for seed in seeds.clone() {
        let settings = Strategy::FINAL_GATHER.settings(seed);
        let pass = trace_pass(&lab.world, &optics, &settings, (Sought::AsEmitted, Classes::ALL), 0, photons)?;
        let mut counted = vec![0.0; law.len()];
        for (position, photon) in pass.positions.iter().zip(&pass.photons) {
            let r = (f64::from(position[0]) + middle.x).hypot(f64::from(position[1]) + middle.y);
            if let Some(ring) = ring_of(r).filter(|_| photon.class == PathClass::Caustic) {
                counted[ring] += photon.flux().0[0];
            }
        }
        let wanted = Wanted { photons: Some(photons), samples: Some(READS), ..Wanted::default() };
        let outcome = lab.read::<1>(&on_floor, settings, &wanted, 0.99)?;
        let mut read = vec![0.0; law.len()];
        let edge = 2.0 * half / cells as f64;
        for (cell, result) in on_floor.iter().zip(&outcome.cells) {
            let flux = result.value[0].mean().unwrap_or(0.0) * edge * edge / 256.0;
            for part in 0..256 {
                let at =
                    |i: usize, step: u32| -half + edge * (f64::from(cell.cell[i]) + (f64::from(step) + 0.5) / 16.0);
                if let Some(ring) = ring_of(at(0, part % 16).hypot(at(1, part / 16))) {
                    read[ring] += flux;
                }
            }
        }
        for (i, ring) in rings.iter_mut().enumerate() {
            ring.counted.push(counted[i] / law[i]);
            ring.read.push(read[i] / law[i]);
            found.rows.push(row([
                ("part", ring.name.as_str().into()),
                ("seed", seed.into()),
                ("counted_over_law", (counted[i] / law[i]).into()),
                ("read_over_law", (read[i] / law[i]).into()),
            ]));
        }
    }
    Ok(rings)
}

/// Boxes of the floor of the cylindrical mirror, without the sun's direct light, by counting.
pub(super) fn cup_boxes(photons: u64, seeds: &Range<u64>, found: &mut Findings) -> anyhow::Result<Vec<Kept>> {
    let lab = Lab::new("cylindrical mirror", &mirror_arc::floor_xml(CUP_CELLS), &[])?;
    let cells = Cell::of_meters(&lab.world.scene);
    let edge = 0.8 / CUP_CELLS as f64;
    let mut boxes = Vec::new();
    for [x, y] in CUP_BOXES.map(|number| mirror_arc::BOXES[number]) {
        let name = format!("box {} to {}, {} to {} m", x[0], x[1], y[0], y[1]);
        boxes.push((Kept::new(name), x, y, mirror_arc::box_flux(x, y, 1.0)));
    }
    for seed in seeds.clone() {
        let settings = Settings { method: Method::Bins, ..Strategy::PATH.settings(seed) };
        let wanted = Wanted { photons: Some(photons), ..Wanted::default() };
        let outcome = lab.read::<1>(&cells, settings, &wanted, 0.99)?;
        for (kept, x, y, law) in &mut boxes {
            let inside = |cell: &Cell| {
                let (along, across) =
                    ((f64::from(cell.cell[0]) + 0.5) * edge, (f64::from(cell.cell[1]) + 0.5) * edge - 0.4);
                (x[0]..x[1]).contains(&along) && (y[0]..y[1]).contains(&across)
            };
            let all = cells.iter().zip(&outcome.cells).filter(|(cell, _)| inside(cell));
            let flux: f64 = all.map(|(_, result)| result.value[0].mean().unwrap_or(0.0)).sum();
            let over_law = (flux - (x[1] - x[0]) * (y[1] - y[0])) / *law;
            kept.counted.push(over_law);
            found.rows.push(row([
                ("part", kept.name.as_str().into()),
                ("seed", seed.into()),
                ("counted_over_law", over_law.into()),
            ]));
        }
    }
    Ok(boxes.into_iter().map(|(kept, ..)| kept).collect())
}
