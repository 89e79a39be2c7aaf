//! Which colour and mark a series gets.

use photonlab_measure::{FigureData, SeriesKind};
use plotters::style::RGBColor;

use crate::canvas::{Canvas, Spot};

/// Text and axes.
pub(crate) const INK: RGBColor = RGBColor(34, 34, 34);
/// Grid lines.
pub(crate) const GRID: RGBColor = RGBColor(226, 226, 226);
/// The sheet.
pub(crate) const PAPER: RGBColor = RGBColor(255, 255, 255);

/// Okabe and Ito's colours (2008), told apart by all common kinds of colour vision; the darker ones first, yellow left
/// out: on white it is not seen.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];

/// Dash and gap of reference lines, in pixels.
const DASHES: [(f64, f64); 3] = [(9.0, 6.0), (3.0, 4.0), (16.0, 5.0)];

/// The shape of a measured point; with the colours it makes 30 combinations before one repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mark {
    Disc,
    Square,
    Triangle,
    Diamond,
    Wedge,
}

const MARKS: [Mark; 5] = [Mark::Disc, Mark::Square, Mark::Triangle, Mark::Diamond, Mark::Wedge];

/// How one series is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Style {
    /// Its colour.
    pub(crate) colour: RGBColor,
    /// The shape of its points, if measured.
    pub(crate) mark: Mark,
    /// Dash and gap in pixels, if a reference.
    pub(crate) dash: (f64, f64),
}

/// The styles of a figure's series, in their order.
///
/// Measured series take the colours in turn. Predictions share them when there are as many (the n-th law belongs to the
/// n-th measurement), a single prediction is black, others take the colours that follow. References are grey, told
/// apart by their dashes.
pub(crate) fn styles(figure: &FigureData) -> Vec<Style> {
    let count = |kind| figure.series.iter().filter(|s| s.kind == kind).count();
    let (measured, predicted) = (count(SeriesKind::Measured), count(SeriesKind::Predicted));
    let (mut m, mut p, mut r) = (0, 0, 0);
    let style = |colour, mark: usize, dash: usize| Style {
        colour,
        mark: MARKS[mark % MARKS.len()],
        dash: DASHES[dash % DASHES.len()],
    };
    let one = |kind| match kind {
        SeriesKind::Measured => {
            m += 1;
            style(COLOURS[(m - 1) % COLOURS.len()], m - 1, 0)
        }
        SeriesKind::Predicted => {
            p += 1;
            let first = if measured == predicted { 0 } else { measured };
            let colour = if predicted == 1 { INK } else { COLOURS[(first + p - 1) % COLOURS.len()] };
            style(colour, 0, 0)
        }
        SeriesKind::Reference => {
            r += 1;
            style(RGBColor(100, 100, 100), 0, r - 1)
        }
    };
    figure.series.iter().map(|series| series.kind).map(one).collect()
}

impl Mark {
    /// Draws the mark with a white rim that keeps overlapping marks apart.
    pub(crate) fn draw(self, canvas: &Canvas<'_>, at: Spot, radius: f64, colour: RGBColor) {
        for (radius, colour) in [(radius + 1.2, PAPER), (radius, colour)] {
            match self.corners() {
                Some(corners) => {
                    let spots: Vec<Spot> =
                        corners.iter().map(|(x, y)| (at.0 + x * radius, at.1 + y * radius)).collect();
                    canvas.shape(&spots, colour, 1.0);
                }
                None => canvas.disc(at, radius, colour),
            }
        }
    }

    /// Corners about the centre, sized to look as large as a disc of radius one; `None` for the disc.
    fn corners(self) -> Option<&'static [Spot]> {
        match self {
            Mark::Disc => None,
            Mark::Square => Some(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
            Mark::Triangle => Some(&[(0.0, -1.25), (1.15, 0.85), (-1.15, 0.85)]),
            Mark::Diamond => Some(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]),
            Mark::Wedge => Some(&[(0.0, 1.25), (1.15, -0.85), (-1.15, -0.85)]),
        }
    }
}
