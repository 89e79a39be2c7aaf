//! A receiver in a closed room, behind a window and in an open field, with what it must read.

use std::f64::consts::PI;

use photonlab_measure::Expected;
use photonlab_readout::{Cell, Wanted};
use photonlab_reference::{cube::Cube, lamps::patch::StandingPatch};
use photonlab_scene::Film;

use super::{lab::Lab, strategy::Strategy};

const CLOSED_ROOM: &str = include_str!("../../scenes/interior/closed-room.xml");
const WINDOW_ROOM: &str = include_str!("../../scenes/interior/window-room.xml");
const OPEN_FIELD: &str = include_str!("../../scenes/interior/open-field.xml");
/// What makes the window a source.
const PORTAL: &str = r#"<emitter type="portal"/>"#;
/// Of the scenes: flux of the lamp, reflectance of walls, radiance of the sky, area of the window.
const LAMP: f64 = 10_000.0;
const WALLS: f64 = 0.6;
const SKY: f64 = 1000.0;
const WINDOW: f64 = 1.0;
/// Of the field: reflectance, width of the ground and lower edge of the receiver (m), which is 1 m wide and high.
const GROUND: f64 = 0.2;
const FIELD: f64 = 20.0;
const ABOVE: f64 = 1.0;
/// Photons that look for ways beside a portal: at least this share goes through it.
const AIMED: f64 = 0.9;

/// Where the receiver is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Site {
    ClosedRoom,
    AimedWindow,
    Window,
    OpenField,
}

impl Site {
    pub(super) const ALL: [Site; 4] = [Site::ClosedRoom, Site::AimedWindow, Site::Window, Site::OpenField];

    /// Its name in rows and files.
    pub(super) fn id(self) -> &'static str {
        match self {
            Site::ClosedRoom => "closed-room",
            Site::AimedWindow => "window-aimed",
            Site::Window => "window-not-aimed",
            Site::OpenField => "open-field",
        }
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Site::ClosedRoom => "closed room",
            Site::AimedWindow => "window, aimed",
            Site::Window => "window, not aimed",
            Site::OpenField => "open field",
        }
    }
}

/// A receiver of 64 cells and their truths.
pub(super) struct Receiver {
    pub(super) site: Site,
    pub(super) lab: Lab,
    pub(super) cells: Vec<Cell>,
    pub(super) truth: Vec<f64>,
}

impl Receiver {
    /// By closed forms, or behind a window by path tracing through the portal with this seed and so many points per cell.
    pub(super) fn new(site: Site, seed: u64, points: u64) -> anyhow::Result<Self> {
        let aimed = || Lab::new("window-room.xml", WINDOW_ROOM, &[]);
        let lab = match site {
            Site::ClosedRoom => Lab::new("closed-room.xml", CLOSED_ROOM, &[]),
            Site::AimedWindow => aimed(),
            Site::Window => Lab::new("window-room.xml", &without_portal(WINDOW_ROOM), &[]),
            Site::OpenField => Lab::new("open-field.xml", OPEN_FIELD, &[]),
        }?;
        let cells = Cell::of_meters(&lab.world.scene);
        let film = lab.world.scene.sensors[0].film;
        let truth = match site {
            Site::ClosedRoom => closed_room(&cells, film)?,
            Site::AimedWindow | Site::Window => {
                let (lab, wanted) = (aimed()?, Wanted { samples: Some(points), ..Wanted::default() });
                let cells = Cell::of_meters(&lab.world.scene);
                let control = lab.read::<1>(&cells, Strategy::PATH.settings(seed), &wanted, 0.99)?;
                control.cells.iter().map(|cell| cell.value[0].mean().unwrap_or(0.0)).collect()
            }
            Site::OpenField => cells.iter().map(|cell| open_field(cell, film)).collect::<anyhow::Result<_>>()?,
        };
        Ok(Self { site, lab, cells, truth })
    }

    /// Mean irradiance times area over the emitted flux: arrivals per emitted photon.
    pub(super) fn expected_share(&self) -> Expected {
        let area = match self.site {
            Site::ClosedRoom | Site::AimedWindow | Site::Window => 16.0,
            Site::OpenField => 1.0,
        };
        let flux_on = self.truth.iter().sum::<f64>() / self.truth.len() as f64 * area;
        let (low, high) = self.lab.world.bounds();
        let radius = 0.5 * (high - low).length();
        // An even sky shines through every disc across the sphere around the scene.
        let sky = 4.0 * PI * SKY * PI * radius * radius;
        match self.site {
            Site::ClosedRoom => Expected::exact(flux_on / LAMP, "E A / Phi"),
            Site::AimedWindow => {
                let all = flux_on / (PI * SKY * WINDOW);
                let source = "E A / Phi of the window, less the photons that look for other ways".into();
                Expected { value: all, low: AIMED * all, high: all, source }
            }
            Site::Window | Site::OpenField => Expected::within(flux_on / sky, 0.01 * flux_on / sky, "E A / Phi"),
        }
    }
}

/// The same scene with nothing in the window.
fn without_portal(xml: &str) -> String {
    assert!(xml.contains(PORTAL), "the scene has a portal");
    xml.replace(PORTAL, r#"<bsdf type="null"/>"#)
}

/// Means over the cells of a face by the radiosity solution, by 4 x 4 midpoints.
fn closed_room(cells: &[Cell], film: Film) -> anyhow::Result<Vec<f64>> {
    let solution = Cube::new(2.0, LAMP / (4.0 * PI), WALLS)?.solve();
    let mean = |cell: &Cell| {
        let at = |i: usize, part: usize, count: u32| {
            2.0 * (f64::from(cell.cell[i]) + (part as f64 + 0.5) / 4.0) / f64::from(count) - 1.0
        };
        let points = (0..16).map(|k| solution.illuminance(at(0, k % 4, film.width), at(1, k / 4, film.height)));
        points.sum::<f64>() / 16.0
    };
    Ok(cells.iter().map(mean).collect())
}

/// Half a hemisphere of sky, the ground in front of the receiver, which gets a whole one, and the sky past its edge, in the middle of
/// a cell; by reciprocity the ground is a standing patch over a floor.
fn open_field(cell: &Cell, film: Film) -> anyhow::Result<f64> {
    // The receiver's first axis points down, its second along y.
    let [u, v] = [0, 1].map(|i| (f64::from(cell.cell[i]) + 0.5) / f64::from([film.width, film.height][i]));
    let ground = StandingPatch::new(FIELD, 0.5 * FIELD, 1.0)?.irradiance(v - 0.5, ABOVE + 1.0 - u);
    Ok(PI * SKY * (0.5 + GROUND * ground + (0.5 - ground)))
}
