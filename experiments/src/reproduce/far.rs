//! Readings far from what spoils density estimates, by the closed forms' own geometry: how many of them are certified.

use photonlab_measure::student_t_quantile;
use photonlab_measure::{Comparison, Expected, Replicates, Row};
use photonlab_photometry::Colour;
use photonlab_readout::{Aids, Cell, Direct, Method, Settings, Target, Wanted};
use photonlab_reference::{
    ball_lens::BallLens, cube::Cube, integrating_sphere::IntegratingSphere, square_lamp::RectangularLamp,
};
use photonlab_sampling::{Purpose, Stream, leak};
use photonlab_trace::Limits;

use super::{
    covered::{LEVELS, USUAL},
    lab::Lab,
    table::row,
};
use crate::{
    certificate::{doubt, nothing, objections},
    chosen::DEFAULT_ESTIMATOR,
};

/// Points of one scene.
const POINTS: usize = 24;
/// A run's radii shrink: the first is this much wider than their mean at most.
const FIRST_OVER_MEAN: f64 = 1.5;
/// Least share of the readings more than two radii away that are certified.
const LEAST: f64 = 0.9;
/// Orders of rays in the ball whose folds are kept away from.
const ORDERS: u32 = 4;
/// Radius of the ball and its shadow, metres.
const BALL: f64 = 0.5;

/// The maps' methods; the nearest photons are judged by the radius that the one before has found.
pub(super) const METHODS: [(&str, Method); 3] = [
    ("final gather", Method::FinalGather { radius: None }),
    ("found radius", Method::Radius { radius: None }),
    ("k nearest", Method::Nearest { k: None }),
];

/// A scene with meters at random points and how far, in metres, each is from any edge, shadow boundary or fold of a caustic.
struct Field {
    name: &'static str,
    xml: String,
    distances: Vec<f64>,
}

/// What is found: rows, and for each method the share of certified readings among those farther than two radii, by run.
#[derive(Default)]
pub(super) struct Far {
    pub(super) rows: Vec<Row>,
    shares: [Replicates; METHODS.len()],
}

impl Far {
    /// The share, each run of a scene one replicate.
    pub(super) fn certified(&self, method: usize) -> f64 {
        self.shares[method].mean().unwrap_or(f64::NAN)
    }

    /// Is it as large as it should be?
    pub(super) fn comparisons(&self, confidence: f64) -> Vec<Comparison> {
        let compare = |((name, _), share): (&(&str, Method), &Replicates)| {
            let label =
                format!("{name}: certified share of readings more than two radii from edges, shadows and folds");
            let source = "smooth light on an open surface has an honest bound".into();
            let expected = Expected { value: 1.0, low: LEAST, high: 1.0, source };
            Comparison::judge(label, "1", expected, share.interval(confidence))
        };
        METHODS.iter().zip(&self.shares).map(compare).collect()
    }
}

/// Reads every field by every method and some seeds.
pub(super) fn measure(first: u64, seeds: u64, photons: u64, points: u64, confidence: f64) -> anyhow::Result<Far> {
    let mut far = Far::default();
    for (number, field) in fields(first).into_iter().enumerate() {
        say!("       far from edges: {}", field.name);
        let lab = Lab::new(field.name, &field.xml, &[])?;
        let along = |cell: &Cell| matches!(cell.target, Target::Along(_));
        let cells: Vec<Cell> = Cell::of_meters(&lab.world.scene).into_iter().filter(along).collect();
        let mut radius = 0.0f64;
        for (method, &(name, of)) in METHODS.iter().enumerate() {
            let settings = |seed: u64| Settings {
                method: of,
                direct: Direct::Photons,
                estimator: DEFAULT_ESTIMATOR,
                gather_rays: 1,
                aids: Aids::default(),
                draws: of.usual_draws(),
                seed,
                limits: Limits::default(),
            };
            let wanted = Wanted { photons: Some(photons), samples: Some(points), ..Wanted::default() };
            let is_doubted = doubt(&lab.world, &lab.needs, leak(&lab.world), &settings(first)).is_some();
            let (mut judged, mut certified) = (0, 0);
            for seed in 0..seeds {
                let seed = first + 100 * (number as u64 + 1) + seed;
                let outcome = lab.read::<1>(&cells, settings(seed), &wanted, confidence)?;
                radius = outcome.radius.map_or(radius, |mean| FIRST_OVER_MEAN * mean);
                let mut share = Replicates::new();
                for (cell, _) in outcome.cells.iter().zip(&field.distances).filter(|(_, away)| **away > 2.0 * radius) {
                    let degrees = cell.value[0].degrees_of_freedom();
                    let t = if degrees > 0.0 { student_t_quantile(LEVELS[USUAL], degrees) } else { 0.0 };
                    let found = nothing(cell, 0, outcome.lamp_flux[0] > 0.0).is_none();
                    let is_certified = found && !is_doubted && objections(cell, 0, t).is_empty();
                    share.push(f64::from(u8::from(is_certified)));
                    judged += 1;
                    certified += u64::from(is_certified);
                }
                if let Some(mean) = share.mean() {
                    far.shares[method].push(mean);
                }
            }
            far.rows.push(row([
                ("scene", format!("far from edges: {}", field.name).into()),
                ("method", name.into()),
                ("farther_than", (2.0 * radius).into()),
                ("readings", judged.into()),
                ("certified", (certified as f64 / f64::from(judged.max(1))).into()),
            ]));
        }
    }
    Ok(far)
}

fn fields(seed: u64) -> Vec<Field> {
    let mut stream = Stream::new(seed, Purpose::Synthetic, 0, 0);
    let mut even = || -> Vec<[f64; 2]> { (0..POINTS).map(|_| stream.next2().map(|x| 2.0 * x - 1.0)).collect() };
    let from_rim = |p: &[f64; 2], half: f64| half * (1.0 - p[0].abs().max(p[1].abs()));
    let lens = BallLens::BENCHMARK;
    let folds: Vec<f64> = lens.folds(ORDERS, 2.0).iter().map(|fold| fold.radius).chain([BALL]).collect();
    let from_folds = |p: &[f64; 2]| {
        let r = p[0].hypot(p[1]);
        folds.iter().map(|fold| (r - fold).abs()).fold(from_rim(p, 1.0), f64::min)
    };
    let lamp = RectangularLamp::new([2.0, 1.0], 1.5, 1000.0 / std::f64::consts::PI).expect("in range");
    let sphere = IntegratingSphere::new(1.0, [0.2, 0.0, -0.5], Colour([1000.0]), Colour([0.8])).expect("in range");
    let (floor, face, ball, wall) = (even(), even(), even(), even());
    vec![
        Field {
            name: "square lamp",
            xml: with_meters(&lamp.xml(0.5, 1.0, 1), &floor, |[x, y]| {
                ([2.0 * x, 2.0 * y, 0.3], [2.0 * x, 2.0 * y, 0.0])
            }),
            distances: floor.iter().map(|p| from_rim(p, 2.0)).collect(),
        },
        Field {
            name: "CUBE",
            xml: Cube::BENCHMARK.xml(&face),
            distances: face.iter().map(|p| from_rim(p, Cube::BENCHMARK.half_edge())).collect(),
        },
        Field {
            name: "ball lens",
            xml: with_meters(&lens.xml(0.5, 0.5, 1), &ball, |[x, y]| ([x, y, 0.1], [x, y, 0.0])),
            distances: ball.iter().map(from_folds).collect(),
        },
        Field {
            name: "integrating sphere",
            xml: with_meters(&sphere.xml(), &wall, |[x, y]| ([0.0; 3], [x, y, 0.6])),
            distances: vec![f64::INFINITY; POINTS],
        },
    ]
}

/// A scene with a radiance meter for each place.
fn with_meters(xml: &str, places: &[[f64; 2]], ends: impl Fn([f64; 2]) -> ([f64; 3], [f64; 3])) -> String {
    let meter = |(number, place): (usize, &[f64; 2])| {
        let (from, to) = ends(*place);
        let up = if to[0] == from[0] && to[1] == from[1] { "0 1 0" } else { "0.6 0.8 0" };
        let text = |v: [f64; 3]| format!("{} {} {}", v[0], v[1], v[2]);
        format!(
            r#"<sensor type="radiancemeter" id="far-{number}"><transform name="to_world"><lookat origin="{}" target="{}" up="{up}"/>
            </transform></sensor>"#,
            text(from),
            text(to)
        )
    };
    let meters: String = places.iter().enumerate().map(meter).collect();
    xml.replacen("</scene>", &(meters + "</scene>"), 1)
}
