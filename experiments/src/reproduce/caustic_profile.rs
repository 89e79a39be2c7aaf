//! The caustic of the ball lens read across its strong fold.

use std::ops::Range;

use photonlab_measure::{Axis, FigureData, Point, Replicates, Series, SeriesKind};
use photonlab_readout::{Cell, Method, Settings, Wanted};

use super::{
    caustic_flux::lens,
    context::Findings,
    lab::Lab,
    strategy::Strategy,
    table::{Table, row},
};

/// Half-width of the floor (m) and cells along it.
const FLOOR: (f64, u32) = (0.1, 500);
/// Columns that are read, in the row beside the axis: from 20 to 60 mm, 1.6 mm apart.
const COLUMNS: Range<u32> = 300..402;
const STEP: usize = 4;
/// Distances (m) of the places that are judged: well inside the fold, close inside and close outside.
const JUDGED: [f64; 3] = [0.0282, 0.0362, 0.0378];
/// Points of a cell where the map is read.
const READS: u64 = 64;
/// How far from the fold readings are looked at, in radii of the disc, and in which steps.
const LOOK: (i32, f64) = (12, 0.5);

/// Readings with one radius.
pub(super) struct Profile {
    pub(super) blur: f64,
    places: Vec<Place>,
}

/// Readings in one place.
pub(super) struct Place {
    /// Distance from the axis (m).
    pub(super) r: f64,
    /// Irradiance over the beam's.
    pub(super) read: Replicates,
    /// The law's mean over the disc.
    pub(super) blurred: f64,
}

impl Profile {
    /// Precision of the law's mean over a disc and of the cell's extent.
    pub(super) const PRECISION: f64 = 0.005;

    pub(super) fn read(blur: f64, photons: u64, seeds: &Range<u64>, found: &mut Findings) -> anyhow::Result<Self> {
        let (half, cells) = FLOOR;
        let lab = Lab::new("ball lens", &lens().metered_xml(None, half, cells as usize), &[])?;
        let edge = 2.0 * half / f64::from(cells);
        let wanted =
            |cell: &Cell| cell.cell[1] == cells / 2 && COLUMNS.step_by(STEP).any(|column| column == cell.cell[0]);
        let read: Vec<Cell> = Cell::of_meters(&lab.world.scene).into_iter().filter(wanted).collect();
        let place = |cell: &Cell| {
            let at = |i: usize| -half + edge * (f64::from(cell.cell[i]) + 0.5);
            let r = at(0).hypot(at(1));
            Place { r, read: Replicates::new(), blurred: lens().blurred_irradiance(r, blur) }
        };
        let mut places: Vec<Place> = read.iter().map(place).collect();
        for seed in seeds.clone() {
            let method = Method::FinalGather { radius: Some(blur) };
            let settings = Settings { method, ..Strategy::FINAL_GATHER.settings(seed) };
            let wanted = Wanted { photons: Some(photons), samples: Some(READS), ..Wanted::default() };
            let outcome = lab.read::<1>(&read, settings, &wanted, 0.99)?;
            for (place, result) in places.iter_mut().zip(&outcome.cells) {
                let value = result.value[0].mean().unwrap_or(0.0);
                place.read.push(value);
                found.rows.push(row([
                    ("blur", blur.into()),
                    ("r", place.r.into()),
                    ("seed", seed.into()),
                    ("irradiance", value.into()),
                    ("law_over_disc", place.blurred.into()),
                ]));
            }
        }
        Ok(Self { blur, places })
    }

    /// The places that are judged.
    pub(super) fn judged(&self) -> impl Iterator<Item = &Place> {
        self.places.iter().filter(|place| JUDGED.iter().any(|r| (place.r - r).abs() < 1e-4))
    }

    pub(super) fn figure(profiles: &[Profile], table: &Table) -> FigureData {
        let mut series = Vec::new();
        for profile in profiles {
            let measured = |place: &Place| Some(Point::measured(place.r, place.read.interval(table.confidence)?));
            series.push(Series {
                label: format!("read, radius {} m", profile.blur),
                kind: SeriesKind::Measured,
                points: profile.places.iter().filter_map(measured).collect(),
            });
            series.push(Series {
                label: format!("law over a disc of {} m", profile.blur),
                kind: SeriesKind::Predicted,
                points: profile.places.iter().map(|place| Point::new(place.r, place.blurred)).collect(),
            });
        }
        // The law rises beyond all bounds inside the fold; it is drawn up to a twentieth of a millimetre from it.
        let fold = fold();
        let beside = [-5e-5, 5e-5].map(|aside| fold + aside);
        let mut law: Vec<f64> = (0..=80).map(|i| 0.02 + 0.0005 * f64::from(i)).chain(beside).collect();
        law.sort_by(f64::total_cmp);
        series.push(Series {
            label: "ray optics".into(),
            kind: SeriesKind::Reference,
            points: law.into_iter().map(|r| Point::new(r, lens().irradiance(r))).collect(),
        });
        FigureData {
            id: "fold".into(),
            title: "The caustic behind a ball lens, across its fold".into(),
            caption: format!(
                "Irradiance read straight from the map over discs of two radii, and ray optics, infinite inside the fold, {fold:.4} m from the \
                 axis. {}.",
                table.intervals()
            ),
            x: Axis::linear("distance from the axis, m"),
            y: Axis::log("irradiance over the beam's"),
            series,
        }
    }
}

/// Distance from the axis (m) of the fold of the light that goes straight through.
fn fold() -> f64 {
    lens().folds(1, FLOOR.0).first().expect("the floor lies before the focus").radius
}

/// What a reading over a disc is beside the fold, by the laws.
pub(super) struct BesideFold {
    /// How far, in radii, it is more than 5 % off.
    pub(super) reach: f64,
    /// Its share of the irradiance half a radius inside the fold and outside.
    pub(super) half_a_radius: [f64; 2],
}

impl BesideFold {
    pub(super) fn over(blur: f64) -> Self {
        let fold = fold();
        let share = |radii: f64| {
            let r = fold + radii * blur;
            lens().blurred_irradiance(r, blur) / lens().irradiance(r)
        };
        let (steps, step) = LOOK;
        let off = (-steps..=steps).map(|i| f64::from(i) * step).filter(|&d| d != 0.0 && (share(d) - 1.0).abs() > 0.05);
        let reach = off.fold(0.0, |far: f64, d| far.max(d.abs()));
        Self { reach, half_a_radius: [-0.5, 0.5].map(share) }
    }
}
