//! A map of illuminance in false colours, with isolux lines and how sure they are.

use crate::{
    canvas::{Canvas, DOT, GLYPH},
    false_colour::colour,
    image::encode_png,
    isolux::{Grid, Line},
    levels::Levels,
    line_labels::LineLabels,
};

/// The shorter side of a map is drawn at least this many pixels long.
const SHORTEST_SIDE: usize = 512;
/// Pixels of the legend to the right of the map.
const LEGEND_WIDTH: usize = 170;
const MARGIN: usize = 14;
const BAR: usize = 28;
/// Half the width of a line and of its light outline, pixels.
const DARK: f64 = 1.1;
const LIGHT: f64 = 2.3;
/// Pixels from one stripe of a band's hatching to the next.
const HATCH: usize = 7;

/// Illuminance and half the length of its interval for each cell, lx.
pub(crate) struct IlluminanceMap {
    pub(crate) value: Grid,
    pub(crate) half_width: Grid,
}

impl IlluminanceMap {
    /// Share of the picture that is under bands.
    pub(crate) fn banded(&self, levels: &Levels) -> f64 {
        self.share(|place| self.is_in_band(place, levels))
    }

    /// Share of the picture that lies on the wrong side of a line, by the truth in lx, where no band warns of it.
    pub(crate) fn missed(&self, levels: &Levels, truth: &Grid) -> f64 {
        self.share(|place| levels.is_missed(self.value.at(place), self.half_width.at(place), truth.at(place)))
    }

    /// True at a place in cells where the interval holds a level: a line may pass here.
    fn is_in_band(&self, place: [f64; 2], levels: &Levels) -> bool {
        levels.is_near(self.value.at(place), self.half_width.at(place))
    }

    /// Share of the picture's pixels for whose places, in cells, something is true.
    fn share(&self, is_so: impl Fn([f64; 2]) -> bool) -> f64 {
        let [width, height] = self.size();
        let place = |pixel: usize| self.place(pixel % width, pixel / width);
        let count = (0..width * height).filter(|&pixel| is_so(place(pixel))).count();
        count as f64 / (width * height) as f64
    }

    /// Pixels along a cell's side.
    fn zoom(&self) -> usize {
        SHORTEST_SIDE.div_ceil(self.value.width.min(self.value.height).max(1))
    }

    /// Pixels of the map, without the legend.
    fn size(&self) -> [usize; 2] {
        [self.value.width, self.value.height].map(|cells| cells * self.zoom())
    }

    /// The middle of a pixel, in cells.
    fn place(&self, x: usize, y: usize) -> [f64; 2] {
        [x, y].map(|at| (at as f64 + 0.5) / self.zoom() as f64)
    }

    /// The picture with its legend in lx.
    pub(crate) fn png(&self, levels: &Levels) -> anyhow::Result<Vec<u8>> {
        let (zoom, size) = (self.zoom(), self.size());
        let mut canvas = Canvas::new(size[0] + LEGEND_WIDTH, size[1]);
        self.draw_cells(&mut canvas, levels);
        let in_pixels = |line: Line| line.iter().map(|place| place.map(|at| at * zoom as f64)).collect::<Line>();
        let of_level = |level: f64| self.value.isolux(level).into_iter().map(move |line| (level, line));
        let lines: Vec<(String, Line)> =
            levels.inner().flat_map(of_level).map(|(level, line)| (levels.text(level), in_pixels(line))).collect();
        // All outlines come before all lines, so that none cuts through a neighbour.
        for (radius, rgb) in [(LIGHT, [255; 3]), (DARK, [0; 3])] {
            lines.iter().for_each(|(_, line)| canvas.stroke(line, radius, rgb));
        }
        LineLabels::new(size, &lines).draw(&mut canvas);
        // Strokes along the border reach over it.
        canvas.fill([size[0], 0], [LEGEND_WIDTH, size[1]], [255; 3]);
        draw_legend(&mut canvas, size[0] + MARGIN, levels);
        encode_png(canvas.width, canvas.height, &canvas.rgb)
    }

    /// Every cell in its own colour, hatched where a line may pass.
    fn draw_cells(&self, canvas: &mut Canvas, levels: &Levels) {
        let ([width, height], zoom) = (self.size(), self.zoom());
        for y in 0..height {
            for x in 0..width {
                let value = self.value.values[y / zoom * self.value.width + x / zoom];
                let rgb = colour(levels.share(value) as f32);
                let rgb = if self.is_in_band(self.place(x, y), levels) { hatched(rgb, x, y) } else { rgb };
                canvas.set(x, y, rgb);
            }
        }
    }
}

/// A light and a dark stripe side by side, so that one of them shows on any colour.
fn hatched(rgb: [u8; 3], x: usize, y: usize) -> [u8; 3] {
    let towards = |end: f64| rgb.map(|channel| (0.3 * f64::from(channel) + 0.7 * end).round() as u8);
    match (x + y) % HATCH {
        0 => towards(255.0),
        1 => towards(0.0),
        _ => rgb,
    }
}

/// The scale with its levels as they are drawn in the map, a line and a band.
fn draw_legend(canvas: &mut Canvas, left: usize, levels: &Levels) {
    let letter = GLYPH.1 * DOT;
    canvas.text(left, MARGIN, "illuminance");
    canvas.text(left, MARGIN + letter + DOT * 3, "lx");
    let (first, last) = (MARGIN + 4 * letter, canvas.height - MARGIN - 5 * letter);
    for y in first..last {
        let share = (last - 1 - y) as f32 / (last - 1 - first) as f32;
        canvas.fill([left, y], [BAR, 1], colour(share));
    }
    let middle_of = |value: f64| last - 1 - (levels.share(value) * (last - 1 - first) as f64).round() as usize;
    let number = |canvas: &mut Canvas, value: f64| {
        canvas.text(left + BAR + MARGIN / 2, middle_of(value) - letter / 2, &levels.text(value));
    };
    for end in [levels.low(), levels.high()] {
        number(canvas, end);
    }
    for level in levels.inner() {
        sample_line(canvas, left, middle_of(level));
        number(canvas, level);
    }
    let (line, band) = (last + 2 * letter, last + 4 * letter);
    sample_line(canvas, left, line);
    canvas.text(left + BAR + MARGIN / 2, line - letter / 2, "isolux");
    for y in band - letter / 2 - DOT..band + letter / 2 + DOT {
        for x in left..left + BAR {
            canvas.set(x, y, hatched(colour(0.5), x, y));
        }
    }
    canvas.text(left + BAR + MARGIN / 2, band - letter / 2, "95 % band");
}

fn sample_line(canvas: &mut Canvas, left: usize, y: usize) {
    let line = [left + 2, left + BAR - 2].map(|x| [x as f64, y as f64 + 0.5]);
    canvas.stroke(&line, LIGHT, [255; 3]);
    canvas.stroke(&line, DARK, [0; 3]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope of one lux a cell with level 10 in its middle, read two cells too far to the right: bands of one lux miss a strip
    /// of one cell of twenty, bands of two lux none.
    #[test]
    fn only_what_no_band_marks_is_missed() {
        let slope = |shift: f64| {
            let values = (0..20 * 20).map(|i| (i % 20) as f64 + 0.5 - shift).collect();
            Grid { width: 20, height: 20, values }
        };
        let levels = Levels::between(0.0, 20.0, 2);
        let missed = |half: f64| {
            let half_width = Grid { width: 20, height: 20, values: vec![half; 400] };
            let map = IlluminanceMap { value: slope(2.0), half_width };
            (map.missed(&levels, &slope(0.0)), map.banded(&levels))
        };
        assert_eq!(levels.inner().collect::<Vec<_>>(), [10.0]);
        let (narrow, wide) = (missed(1.0), missed(2.0));
        assert!((narrow.0 - 0.05).abs() < 0.01 && (narrow.1 - 0.1).abs() < 0.01, "{narrow:?}");
        assert!(wide.0 < 0.01 && (wide.1 - 0.2).abs() < 0.01, "{wide:?}");
    }
}
