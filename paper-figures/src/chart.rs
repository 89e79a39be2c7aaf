//! A figure on its sheet: words, legend and plot, each in its place.

use photonlab_measure::{FigureData, SeriesKind};

use crate::FigureError;
use crate::axes::{check, cut_points, horizontal, vertical};
use crate::canvas::{self, Anchor, Canvas};
use crate::legend::Legend;
use crate::plot::{LABEL, LEADING, Plot};
use crate::style::{INK, PAPER, Style, styles};
use crate::text;

/// Width of the sheet in pixels: about that of a column of text, and still legible when scaled to a phone.
const WIDTH: f64 = 640.0;
/// Between the sheet's edge and anything on it.
const MARGIN: f64 = 14.0;
/// Between two parts of the sheet.
const GAP: f64 = 10.0;
/// Text size of the title.
const TITLE: f64 = 18.0;

/// Draws a figure as SVG text: complete, without scripts, styles or anything from outside.
///
/// On a logarithmic y axis a value or interval that reaches zero (or far below all values) is cut at the axis and ends in
/// an open arrow, which the legend explains and [`caption`] says. A predicted line that reaches zero runs to the axis.
pub fn draw(figure: &FigureData) -> Result<String, FigureError> {
    check(figure)?;
    let chart = Chart::new(figure)?;
    Ok(canvas::svg(WIDTH, chart.height, &figure.title, |canvas| chart.draw(canvas)))
}

/// The figure's caption, and a sentence about intervals that were cut if there are any.
pub fn caption(figure: &FigureData) -> String {
    let cut = vertical(figure).map_or(0, |scale| cut_points(figure, &scale));
    let said = match cut {
        0 => return figure.caption.clone(),
        1 => "One interval goes on below the axis, to zero or near it: an open arrow.".to_owned(),
        n => format!("{n} intervals go on below the axis, to zero or near it: open arrows."),
    };
    format!("{} {said}", figure.caption).trim_start().to_owned()
}

/// Everything placed, nothing drawn.
struct Chart<'a> {
    figure: &'a FigureData,
    styles: Vec<Style>,
    title: Vec<String>,
    legend: Legend,
    plot: Plot,
    x_label: Vec<String>,
    y_label: Vec<String>,
    height: f64,
}

impl<'a> Chart<'a> {
    fn new(figure: &'a FigureData) -> Result<Self, FigureError> {
        let (x, y) = (horizontal(figure), vertical(figure)?);
        let styles = styles(figure);
        let inside = WIDTH - 2.0 * MARGIN;
        let title = text::wrap(&figure.title, TITLE * text::BOLD, inside);
        let legend = Legend::new(figure, &styles, cut_points(figure, &y) > 0, inside);
        let x_label = text::wrap(&figure.x.label, LABEL, inside);
        let y_label = text::wrap(&figure.y.label, LABEL, inside);

        // From the top: title, legend, the y axis' label, the plot, tick labels, the x axis' label.
        let words = block(TITLE, &title) + block(LABEL, &y_label) + legend.height();
        let top = MARGIN + words + 3.0 * GAP;

        // Room for the tick labels at the left, and for half of the last one where it stands at the right end.
        let wide = |label: &str| text::width(label, LABEL);
        let widest = y.ticks.iter().map(|tick| wide(&tick.label)).fold(0.0, f64::max);
        let last = x.ticks.last().map_or(0.0, |tick| 0.5 * wide(&tick.label) * x.position(tick.at).powi(8));
        let (left, right) = (MARGIN + widest + GAP, WIDTH - MARGIN - last);
        let plot = Plot { named: !figure.x.names.is_empty(), x, y, left, right, top };
        let height = (plot.bottom() + plot.further_label_lines() + 32.0 + block(LABEL, &x_label) + MARGIN).ceil();
        Ok(Chart { figure, styles, title, legend, plot, x_label, y_label, height })
    }

    fn draw(&self, canvas: &Canvas<'_>) {
        let (w, h) = (WIDTH, self.height);
        canvas.shape(&[(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)], PAPER, 1.0);
        self.draw_words(canvas);
        self.plot.draw_grid(canvas);

        // What is predicted lies under what was measured.
        let of_kind = |kind| {
            let series = self.figure.series.iter().zip(&self.styles);
            series.filter(move |(series, _)| series.kind == kind)
        };
        for (series, &style) in of_kind(SeriesKind::Reference).chain(of_kind(SeriesKind::Predicted)) {
            self.plot.draw_line(canvas, series, style);
        }
        for (series, &style) in of_kind(SeriesKind::Measured) {
            self.plot.draw_points(canvas, series, style);
        }
    }

    fn draw_words(&self, canvas: &Canvas<'_>) {
        let write = |lines: &[String], top: f64, size: f64, x: f64, anchor| {
            for (i, line) in lines.iter().enumerate() {
                let y = top + (i as f64 + 0.5) * size * LEADING;
                canvas.text(line, (x, y), size, anchor, INK, size == TITLE);
            }
        };
        let below_title = MARGIN + block(TITLE, &self.title) + GAP;
        let below_legend = below_title + self.legend.height() + GAP;
        write(&self.title, MARGIN, TITLE, MARGIN, Anchor::Start);
        self.legend.draw(canvas, (MARGIN, below_title));
        write(&self.y_label, below_legend, LABEL, MARGIN, Anchor::Start);
        let middle = 0.5 * (self.plot.left + self.plot.right);
        write(
            &self.x_label,
            self.plot.bottom() + self.plot.further_label_lines() + 30.0,
            LABEL,
            middle,
            Anchor::Middle,
        );
    }
}

/// The height of some lines of text.
fn block(size: f64, lines: &[String]) -> f64 {
    size * LEADING * lines.len() as f64
}
