//! The plot: where values stand on the sheet, and the marks and lines that show them.

use photonlab_measure::{Point, Series, SeriesKind};

use crate::canvas::{Anchor, Canvas, Spot};
use crate::legend::draw_arrow;
use crate::scale::Scale;
use crate::style::{GRID, INK, Style};
use crate::text;

/// Height of the plot in pixels.
pub(crate) const HEIGHT: f64 = 330.0;
/// Text size of ticks and axis labels in pixels.
pub(crate) const LABEL: f64 = 15.0;
/// Line height over text size.
pub(crate) const LEADING: f64 = 1.35;

/// Two axes and their place on the sheet, in pixels.
pub(crate) struct Plot {
    /// The x axis has names: points stand side by side and are not joined.
    pub(crate) named: bool,
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
}

impl Plot {
    /// The low end of the y axis on the sheet.
    pub(crate) fn bottom(&self) -> f64 {
        self.top + HEIGHT
    }

    /// The frame, the grid and what stands at the ticks.
    pub(crate) fn draw_grid(&self, canvas: &Canvas<'_>) {
        let bottom = self.bottom();
        for tick in &self.y.ticks {
            let y = self.spot_y(tick.at);
            canvas.line(&[(self.left, y), (self.right, y)], GRID, 1.0);
            canvas.text(&tick.label, (self.left - 8.0, y), LABEL, Anchor::End, INK, false);
        }
        for tick in &self.x.ticks {
            let x = self.spot_x(tick.at);
            canvas.line(&[(x, self.top), (x, bottom)], GRID, 1.0);
            canvas.line(&[(x, bottom), (x, bottom + 6.0)], INK, 1.2);
            for (line, words) in self.x_label_lines(&tick.label).iter().enumerate() {
                let y = bottom + 18.0 + line as f64 * LABEL * LEADING;
                canvas.text(words, (x, y), LABEL, Anchor::Middle, INK, false);
            }
        }
        for &value in &self.x.minor {
            canvas.line(&[(self.spot_x(value), bottom), (self.spot_x(value), bottom + 3.0)], INK, 1.0);
        }
        for &value in &self.y.minor {
            canvas.line(&[(self.left - 3.0, self.spot_y(value)), (self.left, self.spot_y(value))], INK, 1.0);
        }
        canvas.line(&[(self.left, self.top), (self.left, bottom), (self.right, bottom)], INK, 1.4);
    }

    /// A tick's label in lines: names share the axis' length, numbers stand in one line.
    fn x_label_lines(&self, label: &str) -> Vec<String> {
        match self.named {
            true => text::wrap(label, LABEL, (self.right - self.left) / self.x.ticks.len() as f64 - 6.0),
            false => vec![label.to_owned()],
        }
    }

    /// Height of the tick labels below their first line, in pixels.
    pub(crate) fn further_label_lines(&self) -> f64 {
        let lines = self.x.ticks.iter().map(|tick| self.x_label_lines(&tick.label).len()).max();
        lines.map_or(0.0, |lines| lines.saturating_sub(1) as f64 * LABEL * LEADING)
    }

    /// Marks with error bars.
    pub(crate) fn draw_points(&self, canvas: &Canvas<'_>, series: &Series, style: Style) {
        let radius = if series.points.len() > 60 { 3.0 } else { 5.0 };
        for point in &series.points {
            self.draw_error_bar(canvas, point, radius, style);
        }
        for point in series.points.iter().filter(|p| !self.y.cuts(p.y)) {
            style.mark.draw(canvas, self.spot(point), radius, style.colour);
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
            draw_arrow(canvas, (x, self.bottom() - 2.0), style.colour);
        }
    }

    /// A line, with a band if every point has an interval.
    pub(crate) fn draw_line(&self, canvas: &Canvas<'_>, series: &Series, style: Style) {
        if self.named && series.points.len() > 1 {
            for &point in &series.points {
                self.draw_line(canvas, &Series { points: vec![point], ..series.clone() }, style);
            }
            return;
        }
        let end = |y: fn(&Point) -> Option<f64>| -> Option<Vec<f64>> { series.points.iter().map(y).collect() };
        if let (Some(highs), Some(lows)) = (end(|p| p.high), end(|p| p.low)) {
            let (above, below) = (self.path(series, &highs), self.path(series, &lows));
            let outline: Vec<Spot> = above.into_iter().chain(below.into_iter().rev()).collect();
            canvas.shape(&outline, style.colour, 0.16);
        }
        let middle: Vec<f64> = series.points.iter().map(|p| p.y).collect();
        let spots = self.path(series, &middle);
        match series.kind {
            SeriesKind::Reference => canvas.dashed(&spots, style.colour, 2.0, style.dash.0, style.dash.1),
            SeriesKind::Predicted | SeriesKind::Measured => canvas.line(&spots, style.colour, 2.4),
        }
    }

    /// The series' points at the given heights; a single point has no line, a short bar marks its height.
    fn path(&self, series: &Series, heights: &[f64]) -> Vec<Spot> {
        let spots = series.points.iter().zip(heights).map(|(p, &y)| (self.spot_x(p.x), self.spot_y(y)));
        match spots.clone().next() {
            Some((x, y)) if heights.len() == 1 => {
                vec![((x - 16.0).max(self.left), y), ((x + 16.0).min(self.right), y)]
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
        let position = if self.y.cuts(y) { 0.0 } else { self.y.position(y) };
        self.top + HEIGHT * (1.0 - position)
    }
}
