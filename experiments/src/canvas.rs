//! A white canvas in RGB, with letters and strokes.

/// A glyph's cell: 5 x 7 dots and a column of space, each dot drawn `DOT` pixels wide.
pub(crate) const GLYPH: (usize, usize) = (6, 7);
/// Pixels of a dot.
pub(crate) const DOT: usize = 2;

/// Pixels, row 0 on top; what is drawn outside is left out.
pub(crate) struct Canvas {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Three bytes for each pixel.
    pub(crate) rgb: Vec<u8>,
}

impl Canvas {
    pub(crate) fn new(width: usize, height: usize) -> Self {
        Self { width, height, rgb: vec![255; width * height * 3] }
    }

    pub(crate) fn set(&mut self, x: usize, y: usize, rgb: [u8; 3]) {
        if x < self.width && y < self.height {
            self.rgb[3 * (y * self.width + x)..][..3].copy_from_slice(&rgb);
        }
    }

    /// Black letters, from their top left corner.
    pub(crate) fn text(&mut self, left: usize, top: usize, text: &str) {
        for (place, letter) in text.chars().enumerate() {
            for (row, dots) in glyph(letter).into_iter().enumerate() {
                for column in 0..5 {
                    if dots >> (4 - column) & 1 == 1 {
                        for i in 0..DOT * DOT {
                            let x = left + (place * GLYPH.0 + column) * DOT + i % DOT;
                            self.set(x, top + row * DOT + i / DOT, [0, 0, 0]);
                        }
                    }
                }
            }
        }
    }

    /// A rectangle of one colour.
    pub(crate) fn fill(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2], rgb: [u8; 3]) {
        for y in top..top + height {
            (left..left + width).for_each(|x| self.set(x, y, rgb));
        }
    }

    /// A line through places in pixels, with round ends, `radius` pixels to either side.
    pub(crate) fn stroke(&mut self, line: &[[f64; 2]], radius: f64, rgb: [u8; 3]) {
        for ends in line.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            let steps = (2.0 * length).ceil().max(1.0);
            for step in 0..=steps as usize {
                let along = |axis: usize| from[axis] + step as f64 / steps * (to[axis] - from[axis]);
                self.dot([along(0), along(1)], radius, rgb);
            }
        }
    }

    fn dot(&mut self, [x, y]: [f64; 2], radius: f64, rgb: [u8; 3]) {
        let range = |at: f64| (at - radius).max(0.0) as usize..=(at + radius).max(0.0) as usize;
        for row in range(y) {
            for column in range(x) {
                if (column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y) <= radius {
                    self.set(column, row, rgb);
                }
            }
        }
    }
}

/// The letters that numbers and units need, five dots wide and seven high.
fn glyph(letter: char) -> [u8; 7] {
    match letter {
        '0' => [14, 17, 19, 21, 25, 17, 14],
        '1' => [4, 12, 4, 4, 4, 4, 14],
        '2' => [14, 17, 1, 2, 4, 8, 31],
        '3' => [31, 2, 4, 2, 1, 17, 14],
        '4' => [2, 6, 10, 18, 31, 2, 2],
        '5' => [31, 16, 30, 1, 1, 17, 14],
        '6' => [6, 8, 16, 30, 17, 17, 14],
        '7' => [31, 1, 2, 4, 8, 8, 8],
        '8' => [14, 17, 17, 14, 17, 17, 14],
        '9' => [14, 17, 17, 15, 1, 2, 12],
        '.' => [0, 0, 0, 0, 0, 12, 12],
        '-' => [0, 0, 0, 31, 0, 0, 0],
        '%' => [24, 25, 2, 4, 8, 19, 3],
        '/' => [1, 1, 2, 4, 8, 16, 16],
        '(' => [2, 4, 8, 8, 8, 4, 2],
        ')' => [8, 4, 2, 2, 2, 4, 8],
        '^' => [4, 10, 17, 0, 0, 0, 0],
        'W' => [17, 17, 17, 21, 21, 21, 10],
        'a' => [0, 0, 14, 1, 15, 17, 15],
        'b' => [16, 16, 22, 25, 17, 17, 30],
        'c' => [0, 0, 14, 16, 16, 17, 14],
        'd' => [1, 1, 13, 19, 17, 17, 15],
        'e' => [0, 0, 14, 17, 31, 16, 14],
        'i' => [4, 0, 12, 4, 4, 4, 14],
        'l' => [12, 4, 4, 4, 4, 4, 14],
        'm' => [0, 0, 26, 21, 21, 17, 17],
        'n' => [0, 0, 22, 25, 17, 17, 17],
        'o' => [0, 0, 14, 17, 17, 17, 14],
        'r' => [0, 0, 22, 25, 16, 16, 16],
        's' => [0, 0, 14, 16, 14, 1, 30],
        'u' => [0, 0, 17, 17, 17, 19, 13],
        'x' => [0, 0, 17, 10, 4, 10, 17],
        _ => [0; 7],
    }
}
