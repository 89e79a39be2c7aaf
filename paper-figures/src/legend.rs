//! What the marks mean: rows above the plot, so that it never covers a point.

use photonlab_measure::{FigureData, SeriesKind};

use crate::canvas::{Anchor, Canvas, Spot};
use crate::style::{INK, Style};
use crate::text;

/// Text size in pixels.
const SIZE: f64 = 15.0;
/// Height of a row in pixels.
const ROW: f64 = 22.0;
/// Length of the sample in front of a label.
const KEY: f64 = 34.0;
/// Between two entries.
const GAP: f64 = 22.0;

/// What the sample in front of a label shows.
#[derive(Clone, Copy, Debug)]
enum Key {
    Series(SeriesKind, Style),
    Cut,
}

/// One line of text with its place; the first of an entry carries the sample.
struct Entry {
    key: Option<Key>,
    text: String,
    column: f64,
    row: usize,
}

/// The laid-out legend.
pub(crate) struct Legend {
    entries: Vec<Entry>,
    rows: usize,
}

impl Legend {
    /// Entries in the order of the series, in as few rows of `width` pixels as they need; with `cut`, the meaning of
    /// the open arrow.
    pub(crate) fn new(figure: &FigureData, styles: &[Style], cut: bool, width: f64) -> Self {
        let mut legend = Legend { entries: Vec::new(), rows: 0 };
        let mut column = 0.0;
        for (series, &style) in figure.series.iter().zip(styles) {
            legend.add(Key::Series(series.kind, style), &series.label, &mut column, width);
        }
        if cut {
            legend.add(Key::Cut, "goes on below the axis", &mut column, width);
        }
        if column > 0.0 {
            legend.rows += 1;
        }
        legend
    }

    fn add(&mut self, key: Key, label: &str, column: &mut f64, width: f64) {
        let mut lines = text::wrap(label, SIZE, width - KEY);
        if lines.is_empty() {
            lines.push(String::new());
        }
        let widest = lines.iter().map(|line| text::width(line, SIZE)).fold(0.0, f64::max);
        if *column > 0.0 && *column + KEY + widest > width {
            self.rows += 1;
            *column = 0.0;
        }
        let several = lines.len() - 1;
        for (i, text) in lines.into_iter().enumerate() {
            self.entries.push(Entry { key: (i == 0).then_some(key), text, column: *column, row: self.rows + i });
        }
        self.rows += several;
        *column += KEY + widest + GAP;
    }

    /// Its height in pixels.
    pub(crate) fn height(&self) -> f64 {
        self.rows as f64 * ROW
    }

    /// Draws it with its top left corner at `corner`.
    pub(crate) fn draw(&self, canvas: &Canvas<'_>, corner: Spot) {
        for entry in &self.entries {
            let (x, y) = (corner.0 + entry.column, corner.1 + (entry.row as f64 + 0.5) * ROW);
            match entry.key {
                Some(Key::Series(kind, style)) => draw_sample(canvas, (x, y), kind, style),
                Some(Key::Cut) => {
                    canvas.line(&[(x + 13.0, y - 8.0), (x + 13.0, y + 1.0)], INK, 1.6);
                    draw_arrow(canvas, (x + 13.0, y + 8.0), INK);
                }
                None => {}
            }
            canvas.text(&entry.text, (x + KEY, y), SIZE, Anchor::Start, INK, false);
        }
    }
}

fn draw_sample(canvas: &Canvas<'_>, (x, y): Spot, kind: SeriesKind, style: Style) {
    let middle = x + 13.0;
    match kind {
        SeriesKind::Measured => {
            canvas.line(&[(middle, y - 9.0), (middle, y + 9.0)], style.colour, 1.6);
            style.mark.draw(canvas, (middle, y), 5.0, style.colour);
        }
        SeriesKind::Predicted => canvas.line(&[(x, y), (x + 26.0, y)], style.colour, 2.4),
        SeriesKind::Reference => {
            canvas.dashed(&[(x, y), (x + 26.0, y)], style.colour, 2.0, style.dash.0, style.dash.1);
        }
    }
}

/// An open arrow head with its tip at `tip`, pointing down: what it ends goes on below the axis.
pub(crate) fn draw_arrow(canvas: &Canvas<'_>, tip: Spot, colour: plotters::style::RGBColor) {
    let (x, y) = tip;
    canvas.shape(&[(x - 4.5, y - 8.0), (x + 4.5, y - 8.0), tip], crate::style::PAPER, 1.0);
    canvas.line(&[(x - 4.5, y - 8.0), tip, (x + 4.5, y - 8.0), (x - 4.5, y - 8.0)], colour, 1.4);
}
