//! A figure's numbers on a sheet.

use photonlab_measure::{FigureData, Point, Series, SeriesKind};

use crate::FigureError;
use crate::canvas::{self, Anchor, Canvas, Spot};
use crate::legend::{Legend, draw_arrow};
use crate::scale::Scale;
use crate::style::{GRID, INK, PAPER, Style, styles};
use crate::text;

/// Width of the sheet in pixels: about that of a column of text, and still legible when scaled to a phone.
const WIDTH: f64 = 640.0;
/// Height of the plot itself.
const PLOT_HEIGHT: f64 = 330.0;
const MARGIN: f64 = 14.0;
const TITLE: f64 = 18.0;
const LABEL: f64 = 15.0;
/// Line height over text size.
const LEADING: f64 = 1.35;
/// A logarithmic axis follows an interval's low end down to the smallest value over this, then cuts it.
const DEEPEST: f64 = 30.0;

/// Draws a figure as SVG text: complete, without scripts, styles or anything from outside.
///
/// On a logarithmic y axis a value or interval that reaches zero (or far below all values) is cut at the axis and ends in
/// an open arrow, which the legend explains and [`caption`] says. A predicted line that reaches zero runs to the axis.
pub fn draw(figure: &FigureData) -> Result<String, FigureError> {
    check(figure)?;
    let chart = Chart::new(figure)?;
    Ok(canvas::svg(WIDTH, chart.height, &figure.title, |canvas| {
        chart.draw(canvas)
    }))
}

/// The figure's caption, and a sentence about intervals that were cut if there are any.
pub fn caption(figure: &FigureData) -> String {
    let cut = match vertical(figure) {
        Ok(scale) => cut_points(figure, &scale),
        Err(_) => 0,
    };
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
    x: Scale,
    y: Scale,
    x_label: Vec<String>,
    y_label: Vec<String>,
    left: f64,
    right: f64,
    top: f64,
    height: f64,
}

impl<'a> Chart<'a> {
    fn new(figure: &'a FigureData) -> Result<Self, FigureError> {
        let (x, y) = (horizontal(figure), vertical(figure)?);
        let styles = styles(figure);
        let inside = WIDTH - 2.0 * MARGIN;
        let cut = cut_points(figure, &y) > 0;
        let title = text::wrap(&figure.title, TITLE, inside);
        let legend = Legend::new(figure, &styles, cut, inside);
        let (x_label, y_label) = (
            text::wrap(&figure.x.label, LABEL, inside),
            text::wrap(&figure.y.label, LABEL, inside),
        );

        // From the top: title, legend, the y axis' label, the plot, tick labels, the x axis' label.
        let widest = y
            .ticks
            .iter()
            .map(|t| text::width(&t.label, LABEL))
            .fold(0.0, f64::max);
        let last = x.ticks.last().map_or(0.0, |t| {
            text::width(&t.label, LABEL) / 2.0 * x.position(t.at).powi(8)
        });
        let lines = |size: f64, lines: &[String]| size * LEADING * lines.len() as f64;
        let top = MARGIN
            + lines(TITLE, &title)
            + 8.0
            + legend.height()
            + 10.0
            + lines(LABEL, &y_label)
            + 10.0;
        let height = top + PLOT_HEIGHT + 32.0 + lines(LABEL, &x_label) + MARGIN;
        let (left, right) = (MARGIN + widest + 10.0, WIDTH - MARGIN - last);
        Ok(Chart {
            figure,
            styles,
            title,
            legend,
            x,
            y,
            x_label,
            y_label,
            left,
            right,
            top,
            height,
        })
    }

    fn draw(&self, canvas: &Canvas<'_>) {
        let (w, h) = (WIDTH, self.height);
        canvas.shape(&[(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)], PAPER, 1.0);
        self.draw_words(canvas);
        self.draw_grid(canvas);

        // What is predicted lies under what was measured.
        for kind in [
            SeriesKind::Reference,
            SeriesKind::Predicted,
            SeriesKind::Measured,
        ] {
            for (series, &style) in self
                .figure
                .series
                .iter()
                .zip(&self.styles)
                .filter(|(s, _)| s.kind == kind)
            {
                match kind {
                    SeriesKind::Measured => self.draw_points(canvas, series, style),
                    SeriesKind::Predicted | SeriesKind::Reference => {
                        self.draw_line(canvas, series, style)
                    }
                }
            }
        }
    }

    fn draw_words(&self, canvas: &Canvas<'_>) {
        let mut y = MARGIN;
        let write = |lines: &[String], y: &mut f64, size: f64, x: f64, anchor, bold| {
            for line in lines {
                canvas.text(
                    line,
                    (x, *y + 0.5 * size * LEADING),
                    size,
                    anchor,
                    INK,
                    bold,
                );
                *y += size * LEADING;
            }
        };
        write(&self.title, &mut y, TITLE, MARGIN, Anchor::Start, true);
        self.legend.draw(canvas, (MARGIN, y + 8.0));
        y += 8.0 + self.legend.height() + 10.0;
        write(&self.y_label, &mut y, LABEL, MARGIN, Anchor::Start, false);
        y = self.top + PLOT_HEIGHT + 30.0;
        write(
            &self.x_label,
            &mut y,
            LABEL,
            0.5 * (self.left + self.right),
            Anchor::Middle,
            false,
        );
    }

    fn draw_grid(&self, canvas: &Canvas<'_>) {
        let bottom = self.top + PLOT_HEIGHT;
        for tick in &self.y.ticks {
            let y = self.spot_y(tick.at);
            canvas.line(&[(self.left, y), (self.right, y)], GRID, 1.0);
            canvas.text(
                &tick.label,
                (self.left - 8.0, y),
                LABEL,
                Anchor::End,
                INK,
                false,
            );
        }
        for tick in &self.x.ticks {
            let x = self.spot_x(tick.at);
            canvas.line(&[(x, self.top), (x, bottom)], GRID, 1.0);
            canvas.line(&[(x, bottom), (x, bottom + 6.0)], INK, 1.2);
            canvas.text(
                &tick.label,
                (x, bottom + 18.0),
                LABEL,
                Anchor::Middle,
                INK,
                false,
            );
        }
        for &value in &self.x.minor {
            canvas.line(
                &[
                    (self.spot_x(value), bottom),
                    (self.spot_x(value), bottom + 3.0),
                ],
                INK,
                1.0,
            );
        }
        for &value in &self.y.minor {
            canvas.line(
                &[
                    (self.left - 3.0, self.spot_y(value)),
                    (self.left, self.spot_y(value)),
                ],
                INK,
                1.0,
            );
        }
        canvas.line(
            &[
                (self.left, self.top),
                (self.left, bottom),
                (self.right, bottom),
            ],
            INK,
            1.4,
        );
    }

    fn draw_points(&self, canvas: &Canvas<'_>, series: &Series, style: Style) {
        let radius = if series.points.len() > 60 { 3.0 } else { 5.0 };
        for point in &series.points {
            self.draw_error_bar(canvas, point, radius, style);
        }
        for point in series.points.iter().filter(|p| !self.y.cuts(p.y)) {
            style
                .mark
                .draw(canvas, self.spot(point), radius, style.colour);
        }
    }

    /// Ends that hide behind the mark are left out: the interval is then smaller than the mark.
    fn draw_error_bar(&self, canvas: &Canvas<'_>, point: &Point, radius: f64, style: Style) {
        let (low, high) = (point.low.unwrap_or(point.y), point.high.unwrap_or(point.y));
        let (x, y) = self.spot(point);
        let (above, below) = (self.spot_y(high), self.spot_y(low));
        if below > above {
            canvas.line(&[(x, above), (x, below)], style.colour, 1.6);
        }
        let cut = self.y.cuts(low.min(point.y));
        for end in [Some(above), (!cut).then_some(below)].into_iter().flatten() {
            if (end - y).abs() > radius + 1.5 {
                canvas.line(&[(x - 4.5, end), (x + 4.5, end)], style.colour, 1.6);
            }
        }
        if cut {
            draw_arrow(canvas, (x, self.top + PLOT_HEIGHT - 2.0), style.colour);
        }
    }

    fn draw_line(&self, canvas: &Canvas<'_>, series: &Series, style: Style) {
        let end = |y: fn(&Point) -> Option<f64>| -> Option<Vec<f64>> {
            series.points.iter().map(y).collect()
        };
        if let (Some(highs), Some(lows)) = (end(|p| p.high), end(|p| p.low)) {
            let (above, below) = (self.path(series, &highs), self.path(series, &lows));
            let outline: Vec<Spot> = above.into_iter().chain(below.into_iter().rev()).collect();
            canvas.shape(&outline, style.colour, 0.16);
        }
        let middle: Vec<f64> = series.points.iter().map(|p| p.y).collect();
        let spots = self.path(series, &middle);
        match series.kind {
            SeriesKind::Reference => {
                canvas.dashed(&spots, style.colour, 2.0, style.dash.0, style.dash.1)
            }
            SeriesKind::Predicted | SeriesKind::Measured => canvas.line(&spots, style.colour, 2.4),
        }
    }

    /// The series' points at the given heights; a single point has no line, a short bar marks its height.
    fn path(&self, series: &Series, heights: &[f64]) -> Vec<Spot> {
        let spots = series
            .points
            .iter()
            .zip(heights)
            .map(|(p, &y)| (self.spot_x(p.x), self.spot_y(y)));
        match spots.clone().next() {
            Some((x, y)) if heights.len() == 1 => {
                vec![
                    ((x - 16.0).max(self.left), y),
                    ((x + 16.0).min(self.right), y),
                ]
            }
            _ => spots.collect(),
        }
    }

    fn spot(&self, point: &Point) -> Spot {
        (self.spot_x(point.x), self.spot_y(point.y))
    }

    fn spot_x(&self, x: f64) -> f64 {
        self.left + (self.right - self.left) * self.x.position(x)
    }

    /// What the axis cuts stands at its low end.
    fn spot_y(&self, y: f64) -> f64 {
        let position = if self.y.cuts(y) {
            0.0
        } else {
            self.y.position(y)
        };
        self.top + PLOT_HEIGHT * (1.0 - position)
    }
}

fn points(figure: &FigureData) -> impl Iterator<Item = &Point> {
    figure.series.iter().flat_map(|series| &series.points)
}

fn check(figure: &FigureData) -> Result<(), FigureError> {
    let id = || figure.id.clone();
    for series in &figure.series {
        for p in &series.points {
            let all = [Some(p.x), Some(p.y), p.low, p.high];
            if let Some(value) = all.into_iter().flatten().find(|v| !v.is_finite()) {
                return Err(FigureError::NotFinite {
                    figure: id(),
                    series: series.label.clone(),
                    value,
                });
            }
            if figure.x.log && p.x <= 0.0 {
                return Err(FigureError::NotOnLogAxis {
                    figure: id(),
                    series: series.label.clone(),
                    x: p.x,
                });
            }
        }
    }
    match points(figure).next() {
        Some(_) => Ok(()),
        None => Err(FigureError::Empty { figure: id() }),
    }
}

fn horizontal(figure: &FigureData) -> Scale {
    let values: Vec<f64> = points(figure).map(|p| p.x).collect();
    if figure.x.log {
        Scale::logarithmic(&values, 8)
    } else {
        Scale::linear(&values, 7)
    }
}

fn vertical(figure: &FigureData) -> Result<Scale, FigureError> {
    let mut values: Vec<f64> = points(figure)
        .flat_map(|p| [Some(p.y), p.high])
        .flatten()
        .collect();
    let lows = points(figure).filter_map(|p| p.low);
    if !figure.y.log {
        values.extend(lows);
        return Ok(Scale::linear(&values, 6));
    }
    values.retain(|&v| v > 0.0);
    let Some(smallest) = values.iter().copied().reduce(f64::min) else {
        return Err(FigureError::NothingAboveZero {
            figure: figure.id.clone(),
        });
    };
    values.extend(lows.map(|low| low.max(smallest / if low > 0.0 { DEEPEST } else { 2.0 })));
    Ok(Scale::logarithmic(&values, 7))
}

/// How many measured points have a value or an interval that the axis cuts.
fn cut_points(figure: &FigureData, y: &Scale) -> usize {
    let measured = figure
        .series
        .iter()
        .filter(|s| s.kind == SeriesKind::Measured);
    measured
        .flat_map(|s| &s.points)
        .filter(|p| y.cuts(p.low.unwrap_or(p.y).min(p.y)))
        .count()
}
