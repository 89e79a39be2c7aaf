//! `fine-detail`: a checker of shadow and light, and a caustic's fold, read from the map and without it.

use photonlab_measure::{
    Axis, Comparison, Expected, FigureData, Interval, Point, Record, Replicates, Series, SeriesKind, Verdict,
};
use photonlab_readout::Cell;
use serde::Deserialize;

use crate::reproduce::{
    checker_detail::Squares,
    context::{Context, Findings},
    cpu_clock::CPU_SECONDS,
    lamp_caustic::under,
    ray_curves::{Curve, Measured, chart, error_ratio},
    strategy::Strategy,
    table::Table,
};

/// Radius of the lamp over the ball lens (m).
const LAMP: f64 = 0.02;
/// Half-width of the floor under it (m) and cells along it.
const FLOOR: (f64, u32) = (0.1, 250);
/// Columns of the row beside the axis that are read: from 30 to 46 mm, the fold at 37 mm among them.
const COLUMNS: std::ops::Range<u32> = 163..183;
/// Points of a cell where the map is read, in all passes.
const READS: u64 = 64;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    replicates: u64,
    /// Sides of the checker's squares in search radii.
    sides: Vec<f64>,
    /// Photons in a full disc under the checker.
    photons: f64,
    /// Cells of the checker that are read.
    cells: usize,
    /// Repetitions at the fold.
    fold_replicates: u64,
    /// Radii of the gather discs at the fold (m), falling.
    radii: Vec<f64>,
    /// The one of them whose first reading is judged.
    judged: f64,
    /// Photons over the ball lens, rising.
    fold_photons: Vec<u64>,
    /// Paths per cell at the fold.
    fold_points: Vec<u64>,
    /// Largest relative half-width.
    precision: f64,
}

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let p: Parameters = context.parameters()?;
    let seeds = p.seed..p.seed + p.replicates.max(p.fold_replicates);
    let mut found = Findings { seeds: seeds.clone().collect(), ..Findings::default() };
    let of_checker = p.seed..p.seed + p.replicates;
    let squares = p
        .sides
        .iter()
        .map(|&side| Squares::read(side, p.photons, p.cells, &of_checker, &mut found))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let fold = Fold::read(&p, &mut found)?;

    let mut table = Table::new(squares.len() * Squares::COMPARISONS);
    squares.iter().for_each(|squares| squares.judge(&mut table, p.precision));
    found.figures.push(Squares::figure(&squares, p.replicates, &table));
    found.figures.extend(fold.figures(&p));
    let judged = fold.ratio(p.judged, 0);
    let (mut comparisons, verdict, reason) = table.conclude(|| verdict(&squares, &fold, &p));
    let expected = Expected { value: 0.5, low: 0.0, high: 1.0, source: "the definition's bound".into() };
    let photons = p.fold_photons.first().copied().unwrap_or(0);
    let label = format!("fold, radius {} m, {photons} photons: error over path tracing's at equal CPU time", p.judged);
    comparisons.push(Comparison::judge(label, "1", expected, judged));
    found.comparisons = comparisons;
    Ok(context.record(found, verdict, reason))
}

/// Path tracing across the fold, and the caustic map, read at the point, with each radius.
struct Fold {
    paths: Curve,
    maps: Vec<(f64, Curve)>,
}

impl Fold {
    fn read(p: &Parameters, found: &mut Findings) -> anyhow::Result<Self> {
        let seeds = p.seed..p.seed + p.fold_replicates;
        let wanted = |cell: &Cell| cell.cell[1] == FLOOR.1 / 2 && COLUMNS.contains(&cell.cell[0]);
        let bench = under("fold", LAMP, FLOOR, wanted)?;
        let counts: Vec<_> = p.fold_points.iter().map(|&points| (None, points)).collect();
        let paths = bench.curve(Strategy::PATH, &counts, &seeds, found)?;
        let counts: Vec<_> = p.fold_photons.iter().map(|&photons| (Some(photons), READS)).collect();
        let of_radius = |&radius: &f64| {
            let curve = bench.curve(Strategy::FINAL_GATHER.within(radius), &counts, &seeds, found)?;
            Ok((radius, Curve { title: format!("map, radius {radius} m"), ..curve }))
        };
        Ok(Self { paths, maps: p.radii.iter().map(of_radius).collect::<anyhow::Result<_>>()? })
    }

    /// Error of the map over that of path tracing in the same time.
    fn ratio(&self, radius: f64, count: usize) -> Option<Interval> {
        let (_, curve) = self.maps.iter().find(|(of, _)| *of == radius)?;
        error_ratio(&self.paths, curve.points.get(count)?)
    }

    fn figures(&self, p: &Parameters) -> [FigureData; 2] {
        let title = "A caustic's fold: error of the map and of path tracing";
        let curves = std::iter::once(&self.paths).chain(self.maps.iter().map(|(_, curve)| curve));
        let replicates = p.fold_replicates;
        let against_time =
            chart("fold-error-against-time", title, "CPU seconds", replicates, curves, Measured::seconds);
        let of_count = |(number, photons): (usize, &u64)| {
            let point = |&radius: &f64| Some(Point::measured(radius, self.ratio(radius, number)?));
            let points = p.radii.iter().filter_map(point).collect();
            Series { label: format!("map, {photons} photons"), kind: SeriesKind::Measured, points }
        };
        let mut series: Vec<Series> = p.fold_photons.iter().enumerate().map(of_count).collect();
        let equal = p.radii.iter().map(|&radius| Point::new(radius, 1.0)).collect();
        series.push(Series { label: "path tracing".into(), kind: SeriesKind::Reference, points: equal });
        let ratios = FigureData {
            id: "fold-ratio".into(),
            title: "A caustic's fold: the map against path tracing at equal time".into(),
            caption: format!(
                "Twenty cells of 0.8 mm across the fold behind a ball lens, under a lamp of {LAMP} m. {replicates} seeds; bars: 99 % intervals of \
                 the map's error. {CPU_SECONDS}."
            ),
            x: Axis::log("radius of the gather disc, m"),
            y: Axis::log("RMS error over path tracing's at equal CPU time"),
            series,
        };
        [against_time, ratios]
    }
}

fn verdict(squares: &[Squares], fold: &Fold, p: &Parameters) -> (Verdict, String) {
    let last = p.fold_photons.len().saturating_sub(1);
    let (Some(first), Some(later)) = (fold.ratio(p.judged, 0), fold.ratio(p.judged, last)) else {
        return (Verdict::NotMeasured, "the error at the fold could not be measured".into());
    };
    if first.half_width() > p.precision * first.value {
        return (Verdict::NotMeasured, "the interval at the fold is wider than the definition asks".into());
    }
    let mean = |values: &Replicates| values.mean().unwrap_or(f64::NAN);
    let rms = |squares: Option<&Squares>| 100.0 * squares.map_or(f64::NAN, |s| mean(&s.errors[0])).sqrt();
    let side = |squares: Option<&Squares>| squares.map_or(f64::NAN, |s| s.side);
    let (small, large) = (squares.first(), squares.last());
    let time = |s: &Squares| mean(&s.seconds[2]) / mean(&s.seconds[0]);
    let most = squares.iter().map(time).fold(0.0, f64::max);
    let reason = format!(
        "in the checker the map follows its law: squares of {} radii are read {:.0} % off (RMS, of the mean irradiance) and squares of {} radii still \
         {:.0} %, where sampled shadows are exact in at most {most:.2} of the map's CPU time. At a caustic's fold under a small lamp the map of {} m has {:.2} \
         ({:.2} to {:.2}) times path tracing's error at equal time with {} photons and {:.2} ({:.2} to {:.2}) times with {}",
        side(small),
        rms(small),
        side(large),
        rms(large),
        p.judged,
        first.value,
        first.low,
        first.high,
        p.fold_photons[0],
        later.value,
        later.low,
        later.high,
        p.fold_photons[last]
    );
    (if first.high < 1.0 { Verdict::HoldsWithinLimits } else { Verdict::Holds }, reason)
}
